/* schema.c - see schema.h.
 *
 * Every section becomes a definition. A section with cases becomes a choice by `if`/`then`,
 * each branch with all keys that apply, so that a key of the wrong case is an error in the
 * editor too. Each definition exists twice: whole, and as a part ("domain-part") in which
 * nothing is required and null deletes, for overlays and for files that extend another. */
#include "case/schema.h"

#include "base/mem.h"
#include "case/family.h"
#include "case/scalar.h"
#include "case/scene_draft.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

/* A number with a unit, or an expression. */
#define SCHEMA_QUANTITY "^ *=|^ *[-+]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][-+]?[0-9]+)? *[^ 0-9].*$"
#define SCHEMA_STEPS "|^ *[0-9]+ *steps?$"

enum { SCHEMA_DEPTH = 8 };

struct schema {
    struct forest *forest;
    json_t *definitions;
    bool part; /* nothing required, null allowed */
};

static json_t *schema_section(struct schema *schema, const struct keys_section *section);

static json_t *schema_words(const char *const *words)
{
    json_t *list = json_array();
    for (; *words; words++) json_array_append_new(list, json_string(*words));
    return list;
}

/* {"type": ["a", "b"]} */
static json_t *schema_types(const char *first, const char *second)
{
    return second ? json_pack("{s:[s,s]}", "type", first, second) : json_pack("{s:s}", "type", first);
}

static void schema_bounds(json_t *object, const struct key *key)
{
    if (key->min == 0 && key->max == 0) return;
    if (key->min == KEYS_POSITIVE) json_object_set_new(object, "exclusiveMinimum", json_integer(0));
    else if (key->min > -KEYS_MOST) json_object_set_new(object, "minimum", json_real(key->min));
    if (key->max < KEYS_MOST) json_object_set_new(object, "maximum", json_real(key->max));
}

static json_t *schema_number(struct schema *schema, const struct key *key)
{
    bool steps = key->type == KEYS_EVERY;
    json_t *object = schema_types("number", "string");
    const char *wanted = scalar_wanted(schema->forest, key);
    json_object_set_new(object, "pattern", json_string(steps ? SCHEMA_QUANTITY SCHEMA_STEPS : SCHEMA_QUANTITY));
    json_object_set_new(object, "patternErrorMessage",
                        json_sprintf("%s is needed here: a number%s%s, a number with a unit, or an expression '= ...'",
                                     wanted, key->unit && strcmp(key->unit, "1") != 0 ? " in " : "",
                                     key->unit && strcmp(key->unit, "1") != 0 ? key->unit : ""));
    schema_bounds(object, key);
    return object;
}

static json_t *schema_integer(const struct key *key)
{
    json_t *object = schema_types("integer", "string");
    json_object_set_new(object, "pattern", json_string("^ *="));
    json_object_set_new(object, "patternErrorMessage", json_string("an integer is needed, or an expression '= ...'"));
    schema_bounds(object, key);
    return object;
}

static json_t *schema_ref(struct schema *schema, const struct keys_section *section)
{
    const char *name = tree_print(schema->forest, "%s%s", section->name, schema->part ? "-part" : "");
    if (!json_object_get(schema->definitions, name)) {
        json_object_set_new(schema->definitions, name, json_object()); /* a section may contain itself */
        json_object_set_new(schema->definitions, name, schema_section(schema, section));
    }
    return json_pack("{s:[{s:o}]}", "allOf", "$ref", json_sprintf("#/definitions/%s", name));
}

static json_t *schema_part(struct schema *schema, const struct keys_section *section)
{
    bool part = schema->part;
    schema->part = true;
    json_t *ref = schema_ref(schema, section);
    schema->part = part;
    return ref;
}

/* One value of a key, without its documentation. */
static json_t *schema_one(struct schema *schema, const struct key *key)
{
    switch (key->type) {
    case KEYS_NUMBER:
    case KEYS_VALUE:
    case KEYS_PARAMETER:
    case KEYS_EVERY: return schema_number(schema, key);
    case KEYS_INTEGER: return schema_integer(key);
    case KEYS_FLAG: return schema_types("boolean", NULL);
    case KEYS_TEXT: return schema_types("string", "number");
    case KEYS_SCRIPT: return schema_types("string", NULL);
    case KEYS_NAME: return json_pack("{s:s,s:s}", "type", "string", "pattern", "^[A-Za-z_][A-Za-z0-9_]*$");
    case KEYS_CHOICE:
        return json_pack("{s:o}", "enum",
                         schema_words(scalar_choices(schema->forest, key->choices ? key->choices : "")));
    case KEYS_SECTION: return schema_ref(schema, key->section);
    case KEYS_TREE: return key->section ? schema_part(schema, key->section) : json_object();
    default: return json_object();
    }
}

/* In a part, null deletes. */
static json_t *schema_or_null(const struct schema *schema, json_t *object)
{
    return schema->part ? json_pack("{s:[{s:s},o]}", "anyOf", "type", "null", object) : object;
}

static json_t *schema_many(struct schema *schema, const struct key *key)
{
    json_t *one = schema_one(schema, key);
    if (key->many == KEYS_NAMED) one = schema_or_null(schema, one);
    if (key->many == KEYS_LIST) return json_pack("{s:s,s:o}", "type", "array", "items", one);
    if (key->many == KEYS_NAMED) return json_pack("{s:s,s:o}", "type", "object", "additionalProperties", one);
    if (key->many != KEYS_ONE_OR_NAMED) return one;
    json_t *both = json_copy(one);
    json_array_append_new(json_object_get(both, "type"), json_string("object"));
    json_object_set_new(both, "additionalProperties", one);
    return both;
}

/* "Courant number of the time step. In Pa. Default: 0.4." */
static const char *schema_doc(struct schema *schema, const struct key *key)
{
    const char *doc = key->doc ? key->doc : "";
    if (key->unit && strcmp(key->unit, "1") != 0) doc = tree_print(schema->forest, "%s Unit: `%s`.", doc, key->unit);
    if (key->fallback) doc = tree_print(schema->forest, "%s Default: `%s`.", doc, key->fallback);
    if (key->later && !key->refused) doc = tree_print(schema->forest, "%s Not in this version.", doc);
    return doc;
}

/* Schema of a key: value, documentation, default. `cases`: allowed words of a selector. */
static json_t *schema_key(struct schema *schema, const struct key *key, const char *const *cases)
{
    json_t *object = cases ? json_pack("{s:o}", "enum", schema_words(cases)) : schema_many(schema, key);
    object = schema_or_null(schema, object);
    json_object_set_new(object, "description", json_string(key->doc ? key->doc : ""));
    json_object_set_new(object, "markdownDescription", json_string(schema_doc(schema, key)));
    if (key->fallback && !strchr("[{", *key->fallback)) {
        json_t *number = json_loads(key->fallback, JSON_DECODE_ANY, NULL);
        json_object_set_new(object, "default", number ? number : json_string(key->fallback));
    }
    return object;
}

/* The way from a section to one of its cases: the keys of all of them apply. */
struct schema_rows {
    const struct keys_section *path[SCHEMA_DEPTH];
    unsigned depth;
};

static void schema_properties(struct schema *schema, const struct keys_section *section, json_t *properties,
                              json_t *required)
{
    if (section->base) schema_properties(schema, section->base, properties, required);
    for (const struct key *key = section->keys; key && key->name; key++) {
        bool selects = section->selector && strcmp(section->selector, key->name) == 0;
        const char *const *cases = selects ? family_names(schema->forest, section) : NULL;
        json_object_set_new(properties, key->name, schema_key(schema, key, cases));
        if (key->required && !schema->part) json_array_append_new(required, json_string(key->name));
    }
}

static json_t *schema_choice(struct schema *schema, const struct schema_rows *rows);

/* An object with all keys along the rows, closed unless cases below add more. */
static json_t *schema_object(struct schema *schema, const struct schema_rows *rows)
{
    const struct keys_section *last = rows->path[rows->depth - 1];
    json_t *properties = json_object(), *required = json_array(), *object = json_object();
    for (unsigned i = 0; i < rows->depth; i++) {
        const struct keys_section *section = rows->path[i];
        schema_properties(schema, section, properties, required);
        if (section->module && section->module->presets) json_array_clear(required); /* a preset may give them all */
    }
    if (!last->selector)
        json_object_set_new(object, "additionalProperties",
                            last->others ? schema_key(schema, last->others, NULL) : json_false());
    else json_object_set_new(object, "allOf", schema_choice(schema, rows));
    json_object_set_new(object, "properties", properties);
    if (json_array_size(required)) json_object_set(object, "required", required);
    json_decref(required);
    if (last->doc) json_object_set_new(object, "description", json_string(last->doc));
    return object;
}

/* if {selector: case} then {all its keys}, for every case. */
static json_t *schema_choice(struct schema *schema, const struct schema_rows *rows)
{
    const struct keys_section *section = rows->path[rows->depth - 1];
    json_t *list = json_array();
    for (const char *const *name = family_names(schema->forest, section); *name; name++) {
        struct schema_rows below = *rows;
        below.path[below.depth++] = family_find(schema->forest, section, *name);
        json_t *when = json_pack("{s:{s:{s:s}},s:[s]}", "properties", section->selector, "const", *name, "required",
                                 section->selector);
        json_array_append_new(list, json_pack("{s:o,s:o}", "if", when, "then", schema_object(schema, &below)));
    }
    return list;
}

/* [{"required": ["a"]}, {"required": ["b"]}] for the first rows of a section. */
static json_t *schema_one_of(const struct keys_section *section)
{
    json_t *list = json_array();
    for (unsigned i = 0; i < section->choose; i++)
        json_array_append_new(list, json_pack("{s:[s]}", "required", section->keys[i].name));
    return list;
}

static json_t *schema_section(struct schema *schema, const struct keys_section *section)
{
    struct schema_rows rows = {{section}, 1};
    json_t *object = schema_object(schema, &rows);
    if (section->choose && !schema->part) json_object_set_new(object, "oneOf", schema_one_of(section));
    if (!section->selector) {
        json_object_set_new(object, "type", json_string("object"));
        return object;
    }
    json_object_set_new(object, "type", json_pack("[s,s]", "object", "string"));
    json_t *word = json_pack("{s:{s:s},s:{s:o}}", "if", "type", "string", "then", "enum",
                             schema_words(family_names(schema->forest, section)));
    json_array_append_new(json_object_get(object, "allOf"), word);
    return object;
}

char *schema_text(void)
{
    struct schema schema = {tree_forest_new(), json_object(), false};
    json_decref(schema_ref(&schema, &scene_root_keys)); /* its overlays bring the parts */
    json_t *root =
        json_pack("{s:s,s:s,s:{s:[s]},s:{s:s},s:{s:s},s:o}", "$schema", "http://json-schema.org/draft-07/schema#",
                  "title", "Case file of bulla", "if", "required", "extends", "then", "$ref", "#/definitions/case-part",
                  "else", "$ref", "#/definitions/case", "definitions", schema.definitions);
    char *dump = json_dumps(root, JSON_INDENT(1) | JSON_REAL_PRECISION(15) | JSON_SORT_KEYS);
    char *text = mem_print("%s\n", dump);
    free(dump);
    json_decref(root);
    tree_forest_free(schema.forest);
    return text;
}
