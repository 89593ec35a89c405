/* tree.h - a YAML text as a tree of nodes that know where they stand.
 *
 * parse.h makes it. Scalars stay text; what a plain scalar means (YAML 1.2 core: `no` is a
 * string, 012 is nothing) is asked for by those who know what they want. All nodes of a case
 * live in one forest and go with it. */
#ifndef TREE_H
#define TREE_H

#include "case/diag.h"

enum tree_kind { TREE_SCALAR, TREE_LIST, TREE_MAP };
enum tree_style { TREE_PLAIN, TREE_QUOTED, TREE_BLOCK };

struct node {
    enum tree_kind kind;
    enum tree_style style; /* of a scalar */
    bool broken;           /* a mistake in it is recorded already: what is missing or odd is no news */
    struct mark mark;
    const char *text;    /* of a scalar; terminated */
    unsigned count;      /* entries of a list or map */
    struct node **items; /* [count] */
    struct node **keys;  /* [count] scalar nodes, of a map */
};

struct forest;

struct forest *tree_forest_new(void);
void tree_forest_free(struct forest *forest); /* all its nodes; NULL is fine */

/* Zeroed memory, and printf into a text, that go with the forest. */
void *tree_take(struct forest *forest, size_t bytes);
const char *tree_print(struct forest *forest, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* New nodes, for defaults and replacements. */
struct node *tree_scalar(struct forest *forest, const struct mark *mark, enum tree_style style, const char *text);
struct node *tree_list(struct forest *forest, const struct mark *mark);
struct node *tree_map(struct forest *forest, const struct mark *mark);
struct node *tree_copy(struct forest *forest, const struct node *node);

/* Appends to a list; adds to a map; sets the value of a key or adds it (the key is copied). */
void tree_append(struct forest *forest, struct node *list, struct node *item);
void tree_add(struct forest *forest, struct node *map, struct node *key, struct node *item);
void tree_set(struct forest *forest, struct node *map, const char *key, struct node *item);

/* Makes an entry the first one of a map. */
void tree_first(struct node *map, unsigned index);

/* Takes entry `index` out of a list or map. */
void tree_remove(struct node *node, unsigned index);

/* Index of a key, or -1; its value, or NULL. `map` may be NULL or no map. */
int tree_find(const struct node *map, const char *key);
struct node *tree_get(const struct node *map, const char *key);

/* What a scalar says under YAML 1.2 core. tree_flag returns false if it is no flag. */
bool tree_is_null(const struct node *node);
bool tree_flag(const struct node *node, bool *ret_value);

/* "a map", "a list", "a number", "the text 'abc'" ...: for messages; valid until the next call. */
const char *tree_describe(const struct node *node);

#endif
