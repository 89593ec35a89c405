/* keys_read.c - see keys_read.h: maps, lists and what may stand in them; single scalars are in scalar.c.
 *
 * Reading a map: collect the rows that apply (keys_rows.c), read what is there, name what is not known or missing,
 * write the defaults into the tree, and put the keys in the order of the rows. */
#include "case/keys_read.h"

#include "case/family.h"
#include "case/keys_unknown.h"
#include "case/parse.h"
#include "case/scalar.h"

#include <string.h>

static const char *keys_read_join(struct keys *keys, const char *path, const char *name)
{
    return *path ? tree_print(keys->forest, "%s.%s", path, name) : tree_print(keys->forest, "%s", name);
}

static void keys_read_value(struct keys *keys, struct keys_value *value, const char *const *choices);

static void keys_read_entry(struct keys *keys, struct keys_value *value, struct keys_value *entry, unsigned i)
{
    bool named = value->node->kind == TREE_MAP;
    *entry = (struct keys_value){.key = value->key, .node = value->node->items[i]};
    if (named) entry->name = value->node->keys[i]->text;
    entry->path =
        named ? keys_read_join(keys, value->path, entry->name) : tree_print(keys->forest, "%s[%u]", value->path, i);
    keys_read_value(keys, entry, NULL);
}

/* A list or a map of names; given when all entries are. */
static void keys_read_many(struct keys *keys, struct keys_value *value)
{
    value->count = value->node->count;
    value->list = tree_take(keys->forest, (value->count + 1) * sizeof *value->list);
    value->given = true;
    for (unsigned i = 0; i < value->count; i++) {
        keys_read_entry(keys, value, &value->list[i], i);
        value->given &= value->list[i].given;
    }
}

void keys_read_again(struct keys *keys, const struct keys_map *map, const char *name)
{
    for (unsigned i = 0; i < map->count; i++)
        if (strcmp(map->values[i].key->name, name) == 0) keys_read_many(keys, &map->values[i]);
}

static void keys_read_refuse(struct keys *keys, const struct keys_value *value, const char *what, const char *help)
{
    const struct node *node = value->node;
    keys_error(keys, value, "%s is needed, not %s", what, tree_describe(node));
    if (node->kind == TREE_SCALAR && !tree_is_null(node)) diag_help(keys->diag, help, value->key->name, node->text);
}

static void keys_read_value(struct keys *keys, struct keys_value *value, const char *const *choices)
{
    const struct key *key = value->key;
    if (value->node->broken && value->node->count == 0) return;
    bool entry = value->name != NULL || value->path[strlen(value->path) - 1] == ']';
    bool is_map = value->node->kind == TREE_MAP, is_list = value->node->kind == TREE_LIST;
    if (key->type == KEYS_TREE && (entry || key->many != KEYS_NAMED || is_map)) value->given = true;
    else if (!entry && key->many == KEYS_LIST && !is_list)
        keys_read_refuse(keys, value, "a list", "a list is written as '%s: [%s]'");
    else if (!entry && key->many == KEYS_NAMED && !is_map)
        keys_read_refuse(keys, value, "a map with names as keys", "it is written as '%s: {NAME: %s}'");
    else if (!entry && key->many != KEYS_ONE && (is_list || is_map) && !(key->many == KEYS_ONE_OR_NAMED && is_list))
        keys_read_many(keys, value);
    else if (key->type == KEYS_PARAMETER) value->given = value->node->kind == TREE_SCALAR;
    else if (key->type == KEYS_SECTION) {
        value->map = keys_read(keys, value->node, key->section, value->path);
        value->given = value->map != NULL;
    } else scalar_read(keys, value, choices);
}

/* A number or an expression, right or wrong, and no word. */
static bool keys_read_is_amount(const struct node *node)
{
    return *node->text && strchr("0123456789.+-=", *node->text);
}

/* A scalar may stand for a map with only its selector, or for the one number of a case. */
static bool keys_read_shorthand(struct keys *keys, struct node *node, const struct keys_section *section)
{
    if (node->kind != TREE_SCALAR || !section->selector || tree_is_null(node)) return false;
    bool amount = section->amount && keys_read_is_amount(node);
    struct node *scalar = tree_scalar(keys->forest, &node->mark, node->style, node->text);
    struct node *name = amount ? tree_scalar(keys->forest, &node->mark, TREE_PLAIN, section->amount) : scalar;
    *node = (struct node){.kind = TREE_MAP, .mark = node->mark};
    tree_set(keys->forest, node, section->selector, name);
    if (amount) tree_set(keys->forest, node, section->amount_key, scalar);
    return true;
}

/* A list may stand for a map of the first rows. */
static bool keys_read_positional(struct keys *keys, struct node *node, const struct keys_section *section)
{
    if (node->kind != TREE_LIST || section->positional == 0 || node->count != section->positional) return false;
    struct node *map = tree_map(keys->forest, &node->mark);
    for (unsigned i = 0; i < node->count; i++) tree_set(keys->forest, map, section->keys[i].name, node->items[i]);
    *node = *map;
    return true;
}

/* What stands where a map should is neither one nor short for one. */
static void keys_read_no_map(struct keys *keys, const struct node *node, const struct keys_section *section,
                             const char *path)
{
    const char *list =
        section->positional ? tree_print(keys->forest, "a list of %u values or ", section->positional) : "";
    const char *what = tree_describe(node);
    if (node->kind == TREE_LIST && *list) what = tree_print(keys->forest, "a list of %u", node->count);
    diag_error(keys->diag, &node->mark, "%s: %sa map of keys is needed, not %s", path, list, what);
    if (tree_is_null(node)) diag_help(keys->diag, "keys that belong to it are indented deeper than it is");
}

static struct node *keys_read_fallback(struct keys *keys, const struct keys_map *map, const struct key *key)
{
    const char *text = key->fallback;
    if (map->chosen && map->chosen->module) {
        const struct node *preset = tree_get(map->node, "preset");
        const char *number = preset && preset->kind == TREE_SCALAR
                                 ? family_preset(keys->forest, map->chosen->module, preset->text, key->name)
                                 : NULL;
        if (number) text = number;
    }
    if (!text) return NULL;
    if (strchr("[{", *text)) return parse_source(keys->forest, keys->diag, diag_text(keys->diag, key->name, text));
    return tree_scalar(keys->forest, &map->node->mark, TREE_PLAIN, text);
}

static void keys_read_missing(struct keys *keys, const struct keys_map *map, const struct key *key)
{
    diag_error(keys->diag, &map->node->mark, "key '%s' is missing in %s", key->name,
               *map->path ? map->path : "the case");
    diag_help(keys->diag, "%s: %s", key->name, key->doc);
}

/* One row of the map: what is there, or its default. */
static void keys_read_row(struct keys *keys, struct keys_map *map, const struct keys_rows *rows, unsigned i)
{
    struct keys_value *value = &map->values[i];
    const struct key *key = rows->list[i].key;
    *value = (struct keys_value){.key = key,
                                 .path = keys_read_join(keys, map->path, key->name),
                                 .meant = rows->list[i].meant};
    int at = tree_find(map->node, key->name);
    value->node = at >= 0 ? map->node->items[at] : keys_read_fallback(keys, map, key);
    if (!value->node) {
        bool preset = map->chosen && map->chosen->module && tree_get(map->node, "preset"); /* wrong, and told so */
        if (key->required && !rows->list[i].meant && !preset && !map->node->broken) keys_read_missing(keys, map, key);
        return;
    }
    if (at < 0) tree_set(keys->forest, map->node, key->name, value->node);
    const struct keys_section *selects = rows->list[i].selects;
    const char *word = value->node->kind == TREE_SCALAR ? value->node->text : "";
    keys_read_value(keys, value, selects ? family_names_for(keys->forest, selects, word) : NULL);
}

/* Rows first, in their order; keys that are not known last. */
static void keys_read_sort(struct node *map, const struct keys_rows *rows)
{
    unsigned done = 0;
    for (unsigned i = 0; i < rows->count; i++) {
        int at = tree_find(map, rows->list[i].key->name);
        if (at < 0) continue;
        struct node *key = map->keys[at], *item = map->items[at];
        memmove(map->keys + done + 1, map->keys + done, ((unsigned)at - done) * sizeof(struct node *));
        memmove(map->items + done + 1, map->items + done, ((unsigned)at - done) * sizeof(struct node *));
        map->keys[done] = key;
        map->items[done++] = item;
    }
}

struct keys_map *keys_read(struct keys *keys, struct node *node, const struct keys_section *section, const char *path)
{
    if (node->kind != TREE_MAP && !keys_read_shorthand(keys, node, section) &&
        !keys_read_positional(keys, node, section)) {
        keys_read_no_map(keys, node, section, path);
        return NULL;
    }
    struct keys_rows rows = keys_rows(keys, section, node);
    struct keys_map *map = tree_take(keys->forest, sizeof *map);
    *map =
        (struct keys_map){.section = section, .chosen = rows.chosen, .node = node, .path = path, .count = rows.count};
    map->values = tree_take(keys->forest, rows.count * sizeof *map->values);
    if (!rows.open) keys_unknown(keys, map, &rows);
    for (unsigned i = 0; i < rows.count; i++) keys_read_row(keys, map, &rows, i);
    keys_read_sort(node, &rows);
    return map;
}
