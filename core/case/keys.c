/* keys.c - see keys.h: maps, lists and what may stand in them; single scalars are in scalar.c.
 *
 * Reading a map: collect the rows that apply (base, own, those of the chosen cases), read what
 * is there, name what is not known or missing, write the defaults into the tree, and put the
 * keys in the order of the rows. */
#include "case/keys.h"

#include "base/mem.h"
#include "base/text.h"
#include "case/family.h"
#include "case/parse.h"
#include "case/scalar.h"

#include <stdarg.h>
#include <string.h>

enum { KEYS_HOME_DEPTH = 4 };

struct keys_row {
    const struct key *key;
    const struct keys_section *selects; /* the section whose selector this row is, or NULL */
    bool meant;                         /* an unknown key probably meant this one: it is not missing */
};

/* The rows that apply to one map, while it is read. */
struct keys_rows {
    struct forest *forest;
    struct keys_row *list;
    unsigned count;
    const struct keys_section *chosen;
    bool open; /* a case was not recognised: which keys are allowed is not known */
};

void keys_error(struct keys *keys, const struct keys_value *value, const char *format, ...)
{
    char message[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    diag_error(keys->diag, &value->node->mark, "%s: %s", value->path, message);
}

const struct keys_value *keys_at(const struct keys_map *map, const char *name)
{
    static const struct key none = {.name = ""};
    static const struct keys_value absent = {.key = &none, .path = ""};
    for (unsigned i = 0; map && i < map->count; i++)
        if (strcmp(map->values[i].key->name, name) == 0) return &map->values[i];
    return &absent;
}

static const char *keys_join(struct keys *keys, const char *path, const char *name)
{
    return *path ? tree_print(keys->forest, "%s.%s", path, name) : tree_print(keys->forest, "%s", name);
}

static void keys_rows_push(struct keys_rows *rows, const struct key *key)
{
    unsigned count = rows->count;
    if ((count & (count - 1)) == 0) { /* full at every power of two */
        struct keys_row *larger = tree_take(rows->forest, (count ? 2 * (size_t)count : 1) * sizeof *larger);
        if (count) memcpy(larger, rows->list, count * sizeof *larger);
        rows->list = larger;
    }
    rows->list[rows->count++] = (struct keys_row){.key = key};
}

static void keys_rows_add(struct keys_rows *rows, const struct keys_section *section)
{
    if (section->base) keys_rows_add(rows, section->base);
    for (const struct key *key = section->keys; key && key->name; key++) keys_rows_push(rows, key);
}

static int keys_rows_find(const struct keys_rows *rows, const char *name)
{
    for (unsigned i = 0; i < rows->count; i++)
        if (strcmp(rows->list[i].key->name, name) == 0) return (int)i;
    return -1;
}

/* Follows the selectors inwards: boundary -> incoming-wave -> sine. */
static void keys_rows_choose(struct keys *keys, struct keys_rows *rows, const struct keys_section *section,
                             const struct node *map)
{
    while (section && section->selector) {
        int row = keys_rows_find(rows, section->selector);
        const struct node *node = tree_get(map, section->selector);
        const char *name = node && node->kind == TREE_SCALAR ? node->text : node ? "" : rows->list[row].key->fallback;
        rows->list[row].selects = section;
        section = name ? family_find(keys->forest, section, name) : NULL;
        rows->open = !section;
        if (!section) return;
        keys_rows_add(rows, section);
        rows->chosen = section;
    }
}

/* Keys with free names become rows of their own. */
static void keys_rows_others(struct keys *keys, struct keys_rows *rows, const struct keys_section *section,
                             const struct node *map)
{
    for (unsigned i = 0; section->others && i < map->count; i++) {
        if (keys_rows_find(rows, map->keys[i]->text) >= 0) continue;
        struct key *key = tree_take(keys->forest, sizeof *key);
        *key = *section->others;
        key->name = map->keys[i]->text;
        keys_rows_push(rows, key);
    }
}

static bool keys_home(const struct keys_section *section, const char *name, unsigned depth, struct text *path);

/* The same below one key. */
static bool keys_home_below(const struct key *key, const char *name, unsigned depth, struct text *path)
{
    if (!key->section || key->type == KEYS_TREE) return false;
    size_t before = path->length;
    const char *entry = key->many == KEYS_NAMED ? ".NAME" : key->many == KEYS_LIST ? "[..]" : "";
    text_add(path, "%s%s%s", before ? "." : "", key->name, entry);
    if (keys_home(key->section, name, depth, path)) return true;
    path->length = before;
    return false;
}

/* Finds a section `depth` levels below this one that has a key; writes its path. */
static bool keys_home(const struct keys_section *section, const char *name, unsigned depth, struct text *path)
{
    for (; section; section = section->base)
        for (const struct key *key = section->keys; key && key->name; key++) {
            if (depth == 0 && strcmp(key->name, name) == 0) return true;
            if (depth > 0 && keys_home_below(key, name, depth - 1, path)) return true;
        }
    return false;
}

/* Another case of the same section that has this key: `cycles` of a sine beside a lithotripter. */
static const char *keys_other_case(struct keys *keys, const struct keys_rows *rows, const char *name)
{
    for (unsigned i = 0; i < rows->count; i++) {
        const char *const *cases = rows->list[i].selects ? family_names(keys->forest, rows->list[i].selects) : NULL;
        for (; cases && *cases; cases++) {
            struct keys_rows other = {.forest = keys->forest};
            keys_rows_add(&other, family_find(keys->forest, rows->list[i].selects, *cases));
            if (keys_rows_find(&other, name) >= 0)
                return tree_print(keys->forest, "%s: %s", rows->list[i].key->name, *cases);
        }
    }
    return NULL;
}

/* At the left margin: is it a key of one of the sections, to the letter? Then that is meant, not one that is spelled like it. */
static bool keys_lies_below(const struct keys *keys, const struct keys_rows *rows, const char *name)
{
    struct text path = {0};
    bool top = keys_rows_find(rows, keys->root->keys[0].name) >= 0,
         below = top && keys_home(keys->root, name, 1, &path);
    text_done(&path);
    return below;
}

static void keys_unknown_help(struct keys *keys, const struct keys_rows *rows, const char *name, const char *nearest)
{
    size_t colon = strcspn(name, ":");
    char head[64];
    snprintf(head, sizeof head, "%.*s", (int)colon, name);
    if (name[colon] && keys_rows_find(rows, head) >= 0) {
        diag_help(keys->diag, "a blank is needed after the colon: '%s: %s'", head, name + colon + 1);
        return;
    }
    if (strpbrk(name, "()*")) {
        diag_help(keys->diag, "inside { } a comma ends a value: quote the expression before it, \"= ...\"");
        return;
    }
    size_t length = nearest ? strlen(nearest) : 0, given = strlen(name);
    bool near =
        length + 2 >= given && given + 2 >= length; /* else it may be a word of another section, at the wrong place */
    if (nearest && (near || !keys_lies_below(keys, rows, name))) {
        diag_help(keys->diag, "did you mean '%s'?", nearest);
        return;
    }
    const char *other = keys_other_case(keys, rows, name);
    if (other) {
        diag_help(keys->diag, "'%s' is a key of '%s'", name, other);
        return;
    }
    struct text path = {0};
    for (unsigned depth = 0; depth < KEYS_HOME_DEPTH; depth++) {
        if (!keys_home(keys->root, name, depth, &path)) continue;
        if (path.length)
            diag_help(keys->diag, "'%s' belongs in '%.*s': is the indentation right?", name, (int)path.length, path.at);
        else diag_help(keys->diag, "'%s' belongs at the left margin, outside of every section", name);
        text_done(&path);
        return;
    }
    for (unsigned i = 0; i < rows->count; i++) text_add(&path, "%s%s", i ? ", " : "", rows->list[i].key->name);
    diag_help(keys->diag, "allowed: %s", path.length ? path.at : "no keys at all");
    text_done(&path);
}

/* Records keys that are in no row. */
static void keys_unknown(struct keys *keys, const struct keys_map *map, struct keys_rows *rows)
{
    const char **names = tree_take(keys->forest, (rows->count + 1) * sizeof *names);
    for (unsigned i = 0; i < rows->count; i++) names[i] = rows->list[i].key->name;
    names[rows->count] = NULL;
    for (unsigned k = 0; k < map->node->count; k++) {
        const struct node *key = map->node->keys[k];
        if (keys_rows_find(rows, key->text) >= 0) continue;
        const char *nearest = text_nearest(key->text, names);
        const char *in = map->chosen ? map->chosen->name : map->section->name;
        diag_error(keys->diag, &key->mark, "unknown key '%s' in %s%s%s%s", key->text,
                   *map->path ? map->path : "the case", map->chosen ? " (" : "", map->chosen ? in : "",
                   map->chosen ? ")" : "");
        keys_unknown_help(keys, rows, key->text, nearest);
        for (unsigned i = 0; i < rows->count; i++) rows->list[i].meant |= nearest == names[i];
    }
}

static void keys_read_value(struct keys *keys, struct keys_value *value, const char *const *choices);

static void keys_entry(struct keys *keys, struct keys_value *value, struct keys_value *entry, unsigned i)
{
    bool named = value->node->kind == TREE_MAP;
    *entry = (struct keys_value){.key = value->key, .node = value->node->items[i]};
    if (named) entry->name = value->node->keys[i]->text;
    entry->path =
        named ? keys_join(keys, value->path, entry->name) : tree_print(keys->forest, "%s[%u]", value->path, i);
    keys_read_value(keys, entry, NULL);
}

/* A list or a map of names; given when all entries are. */
static void keys_read_many(struct keys *keys, struct keys_value *value)
{
    value->count = value->node->count;
    value->list = tree_take(keys->forest, (value->count + 1) * sizeof *value->list);
    value->given = true;
    for (unsigned i = 0; i < value->count; i++) {
        keys_entry(keys, value, &value->list[i], i);
        value->given &= value->list[i].given;
    }
}

void keys_again(struct keys *keys, const struct keys_map *map, const char *name)
{
    for (unsigned i = 0; i < map->count; i++)
        if (strcmp(map->values[i].key->name, name) == 0) keys_read_many(keys, &map->values[i]);
}

static void keys_refuse_many(struct keys *keys, const struct keys_value *value, const char *what, const char *help)
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
        keys_refuse_many(keys, value, "a list", "a list is written as '%s: [%s]'");
    else if (!entry && key->many == KEYS_NAMED && !is_map)
        keys_refuse_many(keys, value, "a map with names as keys", "it is written as '%s: {NAME: %s}'");
    else if (!entry && key->many != KEYS_ONE && (is_list || is_map) && !(key->many == KEYS_ONE_OR_NAMED && is_list))
        keys_read_many(keys, value);
    else if (key->type == KEYS_PARAMETER) value->given = value->node->kind == TREE_SCALAR;
    else if (key->type == KEYS_SECTION) {
        value->map = keys_read(keys, value->node, key->section, value->path);
        value->given = value->map != NULL;
    } else scalar_read(keys, value, choices);
}

/* A number or an expression, right or wrong, and no word. */
static bool keys_is_amount(const struct node *node)
{
    return *node->text && strchr("0123456789.+-=", *node->text);
}

/* A scalar may stand for a map with only its selector, or for the one number of a case. */
static bool keys_shorthand(struct keys *keys, struct node *node, const struct keys_section *section)
{
    if (node->kind != TREE_SCALAR || !section->selector || tree_is_null(node)) return false;
    bool amount = section->amount && keys_is_amount(node);
    struct node *scalar = tree_scalar(keys->forest, &node->mark, node->style, node->text);
    struct node *name = amount ? tree_scalar(keys->forest, &node->mark, TREE_PLAIN, section->amount) : scalar;
    *node = (struct node){.kind = TREE_MAP, .mark = node->mark};
    tree_set(keys->forest, node, section->selector, name);
    if (amount) tree_set(keys->forest, node, section->amount_key, scalar);
    return true;
}

/* A list may stand for a map of the first rows. */
static bool keys_positional(struct keys *keys, struct node *node, const struct keys_section *section)
{
    if (node->kind != TREE_LIST || section->positional == 0 || node->count != section->positional) return false;
    struct node *map = tree_map(keys->forest, &node->mark);
    for (unsigned i = 0; i < node->count; i++) tree_set(keys->forest, map, section->keys[i].name, node->items[i]);
    *node = *map;
    return true;
}

/* What stands where a map should is neither one nor short for one. */
static void keys_no_map(struct keys *keys, const struct node *node, const struct keys_section *section,
                        const char *path)
{
    const char *list =
        section->positional ? tree_print(keys->forest, "a list of %u values or ", section->positional) : "";
    const char *what = tree_describe(node);
    if (node->kind == TREE_LIST && *list) what = tree_print(keys->forest, "a list of %u", node->count);
    diag_error(keys->diag, &node->mark, "%s: %sa map of keys is needed, not %s", path, list, what);
    if (tree_is_null(node)) diag_help(keys->diag, "keys that belong to it are indented deeper than it is");
}

static struct node *keys_fallback(struct keys *keys, const struct keys_map *map, const struct key *key)
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

static void keys_missing(struct keys *keys, const struct keys_map *map, const struct key *key)
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
    *value =
        (struct keys_value){.key = key, .path = keys_join(keys, map->path, key->name), .meant = rows->list[i].meant};
    int at = tree_find(map->node, key->name);
    value->node = at >= 0 ? map->node->items[at] : keys_fallback(keys, map, key);
    if (!value->node) {
        bool preset = map->chosen && map->chosen->module && tree_get(map->node, "preset"); /* wrong, and told so */
        if (key->required && !rows->list[i].meant && !preset && !map->node->broken) keys_missing(keys, map, key);
        return;
    }
    if (at < 0) tree_set(keys->forest, map->node, key->name, value->node);
    keys_read_value(keys, value, rows->list[i].selects ? family_names(keys->forest, rows->list[i].selects) : NULL);
}

/* Rows first, in their order; keys that are not known last. */
static void keys_sort(struct node *map, const struct keys_rows *rows)
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
    if (node->kind != TREE_MAP && !keys_shorthand(keys, node, section) && !keys_positional(keys, node, section)) {
        keys_no_map(keys, node, section, path);
        return NULL;
    }
    struct keys_rows rows = {.forest = keys->forest};
    keys_rows_add(&rows, section);
    keys_rows_choose(keys, &rows, section, node);
    keys_rows_others(keys, &rows, section, node);
    struct keys_map *map = tree_take(keys->forest, sizeof *map);
    *map =
        (struct keys_map){.section = section, .chosen = rows.chosen, .node = node, .path = path, .count = rows.count};
    map->values = tree_take(keys->forest, rows.count * sizeof *map->values);
    if (!rows.open) keys_unknown(keys, map, &rows);
    for (unsigned i = 0; i < rows.count; i++) keys_read_row(keys, map, &rows, i);
    keys_sort(node, &rows);
    return map;
}
