/* schema.c - see schema.h.
 *
 * Every section becomes a definition. A section with cases becomes a choice by `if`/`then`,
 * each branch with all keys that apply, so that a key of the wrong case is an error in the
 * editor too. Each definition exists twice: whole, and as a part ("domain-part") in which
 * nothing is required and null deletes, for overlays and for files that extend another. */
#include "case/schema.h"

#include "base/mem.h"
#include "base/text.h"
#include "case/family.h"
#include "case/scalar.h"
#include "case/scene_draft.h"
#include "plug/registry.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

/* Texts that the program takes for numbers: expressions, numbers (unit.c has the units behind them), steps. */
#define SCHEMA_EXPRESSION "^[ \\n]*=(?!=)"
#define SCHEMA_NUMBER "(?:(?:0|[1-9][0-9]*)(?:[.][0-9]*)?|[.][0-9]+)(?:[eE][-+]?[0-9]+)?"
#define SCHEMA_STEPS "|^[+]?[1-9][0-9]*(?:[.]0*)?(?:[eE][+]?[0-9]+)? *steps?$"

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

/* Texts with a unit of the key's dimension; without a minus sign where only positive numbers will do. */
static json_t *schema_quantity(const struct key *key)
{
    struct text text = {0};
    struct unit unit;
    char bad[32];
    bool known = key->unit && unit_parse(key->unit, &unit, bad);
    bool warm = key->unit && strcmp(key->unit, "K") == 0; /* -10 degC is above 0 */
    text_add(&text, SCHEMA_EXPRESSION "|^%s" SCHEMA_NUMBER "(?![0-9]) *", key->min > 0 && !warm ? "[+]?" : "[-+]?");
    unit_pattern(known ? &unit : NULL, &text);
    text_add(&text, "? *$%s", key->type == KEYS_EVERY ? SCHEMA_STEPS : "");
    json_t *pattern = json_string(text.at);
    text_done(&text);
    return pattern;
}

static json_t *schema_number(struct schema *schema, const struct key *key)
{
    json_t *object = schema_types("number", "string");
    bool unit = key->unit && strcmp(key->unit, "1") != 0 && key->type != KEYS_EVERY;
    json_object_set_new(object, "pattern", schema_quantity(key));
    json_object_set_new(
        object, "patternErrorMessage",
        json_sprintf("%s%s is needed here: a number%s%s, a number with a unit, or an expression '= ...'",
                     scalar_wanted(schema->forest, key), key->min > 0 ? " above 0" : "", unit ? " in " : "",
                     unit ? key->unit : ""));
    schema_bounds(object, key);
    return object;
}

static json_t *schema_integer(const struct key *key)
{
    json_t *object = schema_types("integer", "string");
    json_object_set_new(object, "pattern", json_string(SCHEMA_EXPRESSION "|^[-+]?(?:0|[1-9][0-9]*)$"));
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

/* A field of every case, or one of a material; a peak of either; an expression, with or without a name. Where modules
 * make fields their names are those that cases choose. */
static json_t *schema_any_field(const struct schema *schema)
{
    struct text text = {0};
    bool free = *registry_names("field") != NULL;
    const char *const *each = scene_field_each(schema->forest), *const *always = scene_field_always(schema->forest);
    for (unsigned i = 0; each[i]; i++) text_add(&text, "%s%s", i ? "|" : "^(?:(?:when_)?(?:max|min)_)?(?:(?:", each[i]);
    text_add(&text, ")_[A-Za-z_][A-Za-z0-9_]*");
    for (unsigned i = 0; always[i]; i++) text_add(&text, "|%s", always[i]);
    text_add(&text, "%s)$", free ? "|[A-Za-z_][A-Za-z0-9_]*" : "");
    json_t *own = json_pack("{s:s,s:s,s:s}", "type", "string", "pattern", text.at, "patternErrorMessage",
                            "There is no such field.");
    text_done(&text);
    const char *formula = "^[ \\n]*=(?!=)";
    return json_pack("{s:[{s:o},o,{s:s,s:s},{s:s,s:i,s:i,s:{s:s,s:s}}]}", "anyOf", "enum",
                     schema_words(scene_field_always(schema->forest)), own, "type", "string", "pattern", formula,
                     "type", "object", "minProperties", 1, "maxProperties", 1, "additionalProperties", "type", "string",
                     "pattern", formula);
}

static json_t *schema_field(struct schema *schema)
{
    if (!json_object_get(schema->definitions, "field"))
        json_object_set_new(schema->definitions, "field", schema_any_field(schema));
    return json_pack("{s:[{s:s}]}", "allOf", "$ref", "#/definitions/field");
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
    case KEYS_TEXT: return json_pack("{s:[s,s,s]}", "type", "string", "number", "boolean");
    case KEYS_FIELD: return schema_field(schema);
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
    if (*doc && !strchr(".:", doc[strlen(doc) - 1])) doc = tree_print(schema->forest, "%s.", doc);
    if (key->unit && strcmp(key->unit, "1") != 0) doc = tree_print(schema->forest, "%s Unit: `%s`.", doc, key->unit);
    if (key->fallback) doc = tree_print(schema->forest, "%s Default: `%s`.", doc, key->fallback);
    return doc;
}

/* What may stand at a key. */
static json_t *schema_value(struct schema *schema, const struct key *key, const char *const *cases)
{
    if (cases && !*cases) return schema_types("string", NULL); /* of modules, and none is loaded */
    return cases ? json_pack("{s:o}", "enum", schema_words(cases)) : schema_many(schema, key);
}

/* Schema of a key: value, documentation, default. `cases`: allowed words of a selector. */
static json_t *schema_key(struct schema *schema, const struct key *key, const char *const *cases)
{
    json_t *object = schema_or_null(schema, schema_value(schema, key, cases));
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

/* What is gathered for one object. */
struct schema_object {
    json_t *properties, *required, *all;
};

/* What a table cannot say stands beside it, with ' for ". */
static void schema_rules(const struct schema *schema, const struct keys_section *section, json_t *all)
{
    if (!section->rules || schema->part) return;
    char *text = mem_print("[%s]", section->rules);
    for (char *at = text; *at; at++)
        if (*at == '\'') *at = '"';
    json_error_t error;
    json_t *rules = json_loads(text, 0, &error);
    if (!rules) rules = json_pack("[{s:s}]", "wrong-rules", error.text); /* the test looks for it */
    json_array_extend(all, rules);
    json_decref(rules);
    mem_free(text);
}

static void schema_properties(struct schema *schema, const struct keys_section *section, struct schema_object *gathered)
{
    if (section->base) schema_properties(schema, section->base, gathered);
    for (const struct key *key = section->keys; key && key->name; key++) {
        bool selects = section->selector && strcmp(section->selector, key->name) == 0;
        const char *const *cases = selects ? family_names(schema->forest, section) : NULL;
        json_object_set_new(gathered->properties, key->name, schema_key(schema, key, cases));
        if (key->required && !schema->part) json_array_append_new(gathered->required, json_string(key->name));
    }
    schema_rules(schema, section, gathered->all);
}

/* Keys of a module may come from a preset instead. */
static void schema_module(const struct keys_section *section, struct schema_object *gathered)
{
    if (!section->module || !section->module->presets || !json_array_size(gathered->required)) return;
    json_t *either = json_pack("{s:{s:{s:[s]}},s:{s:o}}", "if", "not", "required", "preset", "then", "required",
                               json_copy(gathered->required));
    json_array_append_new(gathered->all, either);
    json_array_clear(gathered->required);
}

static void schema_choice(struct schema *schema, const struct schema_rows *rows, json_t *all);

/* An object with all keys along the rows, closed unless cases below add more. */
static json_t *schema_object(struct schema *schema, const struct schema_rows *rows)
{
    const struct keys_section *last = rows->path[rows->depth - 1];
    struct schema_object gathered = {json_object(), json_array(), json_array()};
    json_t *object = json_object();
    for (unsigned i = 0; i < rows->depth; i++) {
        schema_properties(schema, rows->path[i], &gathered);
        schema_module(rows->path[i], &gathered);
    }
    if (!last->selector)
        json_object_set_new(object, "additionalProperties",
                            last->others ? schema_key(schema, last->others, NULL) : json_false());
    else schema_choice(schema, rows, gathered.all);
    json_object_set_new(object, "properties", gathered.properties);
    if (json_array_size(gathered.required)) json_object_set(object, "required", gathered.required);
    if (json_array_size(gathered.all)) json_object_set(object, "allOf", gathered.all);
    json_decref(gathered.required);
    json_decref(gathered.all);
    if (last->doc) json_object_set_new(object, "description", json_string(last->doc));
    return object;
}

/* if {selector: case} then {all its keys}, for every case. */
static void schema_choice(struct schema *schema, const struct schema_rows *rows, json_t *all)
{
    const struct keys_section *section = rows->path[rows->depth - 1];
    for (const char *const *name = family_names(schema->forest, section); *name; name++) {
        struct schema_rows below = *rows;
        below.path[below.depth++] = family_find(schema->forest, section, *name);
        json_t *when = json_pack("{s:{s:{s:s}},s:[s]}", "properties", section->selector, "const", *name, "required",
                                 section->selector);
        json_array_append_new(all, json_pack("{s:o,s:o}", "if", when, "then", schema_object(schema, &below)));
    }
}

/* [{"required": ["a"]}, {"required": ["b"]}] for the first rows of a section. */
static json_t *schema_one_of(const struct keys_section *section)
{
    json_t *list = json_array();
    for (unsigned i = 0; i < section->choose; i++)
        json_array_append_new(list, json_pack("{s:[s]}", "required", section->keys[i].name));
    return list;
}

/* Is the name of a case alone the whole of it? */
static bool schema_is_word(const struct keys_section *one)
{
    bool word = !one->rules;
    for (const struct key *key = one->keys; key && key->name; key++) word &= !key->required;
    return word;
}

/* A text in the place of a map: {"enum": [...]} with a sentence that tells of the map, too. Where there is no such word
 * a map is asked for: editors refuse a whole schema for one list without a word. */
static json_t *schema_alone(struct schema *schema, const struct keys_section *section)
{
    json_t *list = json_array();
    const char *words = "", *all = "";
    for (const char *const *name = family_names(schema->forest, section); *name; name++) {
        all = tree_print(schema->forest, "%s%s%s", all, *all ? ", " : "", *name);
        if (!schema_is_word(family_find(schema->forest, section, *name))) continue;
        words = tree_print(schema->forest, "%s%s%s", words, *words ? ", " : "", *name);
        json_array_append_new(list, json_string(*name));
    }
    json_t *error = json_sprintf("A word that needs no other keys (%s), or a map {%s: ..., ...} with one of: %s",
                                 *words ? words : "there is none", section->selector, all);
    if (*words) return json_pack("{s:o,s:o}", "enum", list, "errorMessage", error);
    json_decref(list);
    return json_pack("{s:s,s:o}", "type", "object", "errorMessage", error);
}

/* The number that stands for a map; NULL: none does. */
static json_t *schema_amount(struct schema *schema, const struct keys_section *section)
{
    const struct keys_section *one = section->amount ? family_find(schema->forest, section, section->amount) : NULL;
    for (const struct key *key = one ? one->keys : NULL; key && key->name; key++)
        if (strcmp(key->name, section->amount_key) == 0) return schema_number(schema, key);
    return NULL;
}

static json_t *schema_section(struct schema *schema, const struct keys_section *section)
{
    struct schema_rows rows = {{section}, 1};
    json_t *object = schema_object(schema, &rows);
    if (section->choose && !schema->part) json_object_set_new(object, "oneOf", schema_one_of(section));
    if (section->positional) {
        json_object_set_new(object, "type", json_pack("[s,s]", "object", "array"));
        json_object_set_new(object, "items", schema_one(schema, section->keys));
        json_object_set_new(object, "minItems", json_integer(section->positional));
        json_object_set_new(object, "maxItems", json_integer(section->positional));
        return object;
    }
    if (!section->selector) {
        json_object_set_new(object, "type", json_string("object"));
        return object;
    }
    json_t *amount = schema_amount(schema, section), *alone = schema_alone(schema, section);
    json_object_set_new(object, "type",
                        amount ? json_pack("[s,s,s]", "object", "string", "number")
                               : json_pack("[s,s]", "object", "string"));
    json_t *scalar = amount ? json_pack("[s,s]", "string", "number") : json_string("string");
    json_t *either = amount ? json_pack("{s:[o,o]}", "anyOf", amount, alone) : alone;
    json_t *word = json_pack("{s:{s:o},s:o}", "if", "type", scalar, "then", either);
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
