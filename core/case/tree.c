/* tree.c - the forest (arena and node edits); reading YAML is in parse.c.
 *
 * Nodes are small and die together, so they come from blocks that are freed at once. Lists
 * grow by doubling inside the arena: the room that is left behind is at most what is in use. */
#include "case/tree.h"

#include "base/mem.h"
#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { TREE_BLOCK_BYTES = 1 << 16 };

struct tree_room {
    struct tree_room *next;
    size_t used, size;
    _Alignas(16) char bytes[];
};

struct forest {
    struct tree_room *rooms;
};

struct forest *tree_forest_new(void)
{
    return mem_new(1, sizeof(struct forest));
}

void tree_forest_free(struct forest *forest)
{
    if (!forest) return;
    for (struct tree_room *room = forest->rooms, *next; room; room = next) {
        next = room->next;
        mem_free(room);
    }
    mem_free(forest);
}

void *tree_take(struct forest *forest, size_t bytes)
{
    bytes = (bytes + 15) & ~(size_t)15;
    struct tree_room *room = forest->rooms;
    if (!room || room->size - room->used < bytes) {
        size_t size = bytes > TREE_BLOCK_BYTES ? bytes : TREE_BLOCK_BYTES;
        room = mem_new(1, sizeof *room + size);
        room->size = size;
        room->next = forest->rooms;
        forest->rooms = room;
    }
    void *at = room->bytes + room->used;
    room->used += bytes;
    return at;
}

const char *tree_print(struct forest *forest, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    char *text = tree_take(forest, (size_t)length + 1);
    vsnprintf(text, (size_t)length + 1, format, again);
    va_end(again);
    return text;
}

static struct node *tree_new(struct forest *forest, const struct mark *mark, enum tree_kind kind)
{
    struct node *node = tree_take(forest, sizeof *node);
    *node = (struct node){.kind = kind};
    if (mark) node->mark = *mark;
    return node;
}

struct node *tree_scalar(struct forest *forest, const struct mark *mark, enum tree_style style, const char *text)
{
    struct node *node = tree_new(forest, mark, TREE_SCALAR);
    size_t length = strlen(text);
    char *copy = tree_take(forest, length + 1);
    memcpy(copy, text, length + 1);
    node->text = copy;
    node->style = style;
    return node;
}

struct node *tree_list(struct forest *forest, const struct mark *mark)
{
    return tree_new(forest, mark, TREE_LIST);
}

struct node *tree_map(struct forest *forest, const struct mark *mark)
{
    return tree_new(forest, mark, TREE_MAP);
}

static void tree_push(struct forest *forest, struct node ***list, unsigned count, struct node *item)
{
    if ((count & (count - 1)) == 0) { /* full at every power of two */
        struct node **larger = tree_take(forest, (count ? 2 * (size_t)count : 1) * sizeof *larger);
        if (count) memcpy(larger, *list, count * sizeof *larger);
        *list = larger;
    }
    (*list)[count] = item;
}

void tree_append(struct forest *forest, struct node *list, struct node *item)
{
    tree_push(forest, &list->items, list->count, item);
    list->count++;
}

void tree_add(struct forest *forest, struct node *map, struct node *key, struct node *item)
{
    tree_push(forest, &map->keys, map->count, key);
    tree_push(forest, &map->items, map->count, item);
    map->count++;
}

void tree_set(struct forest *forest, struct node *map, const char *key, struct node *item)
{
    int at = tree_find(map, key);
    if (at >= 0) map->items[at] = item;
    else tree_add(forest, map, tree_scalar(forest, &item->mark, TREE_PLAIN, key), item);
}

void tree_first(struct node *map, unsigned index)
{
    struct node *key = map->keys[index], *item = map->items[index];
    memmove(map->keys + 1, map->keys, index * sizeof(struct node *));
    memmove(map->items + 1, map->items, index * sizeof(struct node *));
    map->keys[0] = key;
    map->items[0] = item;
}

void tree_remove(struct node *node, unsigned index)
{
    size_t rest = (node->count - index - 1) * sizeof(struct node *);
    memmove(node->items + index, node->items + index + 1, rest);
    if (node->keys) memmove(node->keys + index, node->keys + index + 1, rest);
    node->count--;
}

struct node *tree_copy(struct forest *forest, const struct node *node)
{
    if (node->kind == TREE_SCALAR) return tree_scalar(forest, &node->mark, node->style, node->text);
    struct node *copy = tree_new(forest, &node->mark, node->kind);
    copy->broken = node->broken;
    for (unsigned i = 0; i < node->count; i++) {
        struct node *item = tree_copy(forest, node->items[i]);
        if (node->kind == TREE_MAP) tree_add(forest, copy, node->keys[i], item);
        else tree_append(forest, copy, item);
    }
    return copy;
}

int tree_find(const struct node *map, const char *key)
{
    if (!map || map->kind != TREE_MAP) return -1;
    for (unsigned i = 0; i < map->count; i++)
        if (strcmp(map->keys[i]->text, key) == 0) return (int)i;
    return -1;
}

struct node *tree_get(const struct node *map, const char *key)
{
    int at = tree_find(map, key);
    return at < 0 ? NULL : map->items[at];
}

static bool tree_is_one_of(const struct node *node, const char *const *words)
{
    if (node->kind != TREE_SCALAR || node->style != TREE_PLAIN) return false;
    for (; *words; words++)
        if (strcmp(node->text, *words) == 0) return true;
    return false;
}

bool tree_is_null(const struct node *node)
{
    static const char *const words[] = {"", "~", "null", "Null", "NULL", NULL};
    return tree_is_one_of(node, words);
}

bool tree_flag(const struct node *node, bool *ret_value)
{
    static const char *const yes[] = {"true", "True", "TRUE", NULL}, *const no[] = {"false", "False", "FALSE", NULL};
    bool is_yes = tree_is_one_of(node, yes);
    if (!is_yes && !tree_is_one_of(node, no)) return false;
    *ret_value = is_yes;
    return true;
}

const char *tree_describe(const struct node *node)
{
    static char words[80];
    bool flag;
    double number;
    if (node->kind == TREE_MAP) return node->count ? "a map of keys" : "an empty map";
    if (node->kind == TREE_LIST) return node->count ? "a list" : "an empty list";
    if (tree_is_null(node)) return "nothing";
    if (tree_flag(node, &flag)) return flag ? "'true'" : "'false'";
    size_t read = node->style == TREE_PLAIN ? text_number(node->text, &number) : 0;
    bool is_number = read && node->text[read] == '\0';
    int length = (int)strcspn(node->text, "\n");
    bool cut = length > 40 || node->text[length];
    if (length > 40) length = 40;
    snprintf(words, sizeof words, "%s '%.*s%s'", is_number ? "the number" : "the text", length, node->text,
             cut ? "..." : "");
    return words;
}
