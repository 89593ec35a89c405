/* keys_rows.c - see keys_rows.h. */
#include "case/keys_rows.h"

#include "case/family.h"

#include <string.h>

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

void keys_rows_add(struct keys_rows *rows, const struct keys_section *section)
{
    if (section->base) keys_rows_add(rows, section->base);
    for (const struct key *key = section->keys; key && key->name; key++) keys_rows_push(rows, key);
}

int keys_rows_find(const struct keys_rows *rows, const char *name)
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

struct keys_rows keys_rows(struct keys *keys, const struct keys_section *section, const struct node *map)
{
    struct keys_rows rows = {.forest = keys->forest};
    keys_rows_add(&rows, section);
    keys_rows_choose(keys, &rows, section, map);
    keys_rows_others(keys, &rows, section, map);
    return rows;
}
