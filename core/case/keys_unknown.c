/* keys_unknown.c - see keys_unknown.h. */
#include "case/keys_unknown.h"

#include "base/text.h"
#include "case/family.h"

#include <string.h>

enum { KEYS_UNKNOWN_DEPTH = 4 };

static bool keys_unknown_home(const struct keys_section *section, const char *name, unsigned depth, struct text *path);

/* The same below one key. */
static bool keys_unknown_below_key(const struct key *key, const char *name, unsigned depth, struct text *path)
{
    if (!key->section || key->type == KEYS_TREE) return false;
    size_t before = path->length;
    const char *entry = key->many == KEYS_NAMED ? ".NAME" : key->many == KEYS_LIST ? "[..]" : "";
    text_add(path, "%s%s%s", before ? "." : "", key->name, entry);
    if (keys_unknown_home(key->section, name, depth, path)) return true;
    path->length = before;
    return false;
}

/* Finds a section `depth` levels below this one that has a key; writes its path. */
static bool keys_unknown_home(const struct keys_section *section, const char *name, unsigned depth, struct text *path)
{
    for (; section; section = section->base)
        for (const struct key *key = section->keys; key && key->name; key++) {
            if (depth == 0 && strcmp(key->name, name) == 0) return true;
            if (depth > 0 && keys_unknown_below_key(key, name, depth - 1, path)) return true;
        }
    return false;
}

/* Another case of the same section that has this key: `cycles` of a sine beside a lithotripter. */
static const char *keys_unknown_other(struct keys *keys, const struct keys_rows *rows, const char *name)
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

/* At the left margin: is it a key of one of the sections, to the letter? Then that is meant, not one that is spelled
 * like it. */
static bool keys_unknown_below(const struct keys *keys, const struct keys_rows *rows, const char *name)
{
    struct text path = {0};
    bool top = keys_rows_find(rows, keys->root->keys[0].name) >= 0,
         below = top && keys_unknown_home(keys->root, name, 1, &path);
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
    if (nearest && (near || !keys_unknown_below(keys, rows, name))) {
        diag_help(keys->diag, "did you mean '%s'?", nearest);
        return;
    }
    const char *other = keys_unknown_other(keys, rows, name);
    if (other) {
        diag_help(keys->diag, "'%s' is a key of '%s'", name, other);
        return;
    }
    struct text path = {0};
    for (unsigned depth = 0; depth < KEYS_UNKNOWN_DEPTH; depth++) {
        if (!keys_unknown_home(keys->root, name, depth, &path)) continue;
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

void keys_unknown(struct keys *keys, const struct keys_map *map, struct keys_rows *rows)
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
