/* scene_repeat.c - rows of layers: a layer `repeat: {i: 5}` becomes five, with i = 0 to 4 in its expressions.
 *
 * It happens before the layers are read, in the tree: the name is replaced by its number wherever an expression uses
 * it. */
#include "case/scene_draft.h"

#include "base/text.h"

#include <math.h>
#include <string.h>

enum { SCENE_REPEAT_MOST = 10000 };

/* The text with a free name replaced by a number. */
static const char *scene_repeat_put(struct forest *forest, const char *text, const char *name, long value)
{
    struct text out = {0};
    char word[PARAMS_WORD];
    const char *from = text, *at = text;
    while (params_next(&at, word)) {
        if (strcmp(word, name) != 0) continue;
        text_add_n(&out, from, (size_t)(at - from) - strlen(word));
        text_add(&out, "(%ld)", value);
        from = at;
    }
    text_add(&out, "%s", from);
    const char *put = tree_print(forest, "%s", out.at);
    text_done(&out);
    return put;
}

static void scene_repeat_replace(struct forest *forest, struct node *node, const char *name, long value)
{
    if (params_is_expression(node)) node->text = scene_repeat_put(forest, node->text, name, value);
    for (unsigned i = 0; i < node->count; i++) scene_repeat_replace(forest, node->items[i], name, value);
}

/* A whole number: as it stands, or an expression of parameters. */
static bool scene_repeat_number(struct draft *draft, const struct node *node, long *ret)
{
    double value = (double)NAN;
    if (params_is_expression(node)) {
        if (!params_evaluate(draft->keys.params, node, "initial[].repeat", &value)) return false;
    } else if (node->kind == TREE_SCALAR) text_number(node->text, &value);
    if (isfinite(value) && value == floor(value) && fabs(value) <= 1e6) {
        *ret = (long)value;
        return true;
    }
    diag_error(draft->keys.diag, &node->mark, "repeat: a whole number is needed, not %s", tree_describe(node));
    return false;
}

/* First and last value of a name; false after a recorded error. */
static bool scene_repeat_range(struct draft *draft, const struct node *key, const struct node *node, long *ret_from,
                               long *ret_to)
{
    static const char *const taken[] = {"x", "y", "z", "r", "t"};
    bool bad = !text_is_identifier(key->text) || strlen(key->text) >= PARAMS_WORD;
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++) bad = bad || strcmp(taken[i], key->text) == 0;
    if (bad || params_has(draft->keys.params, key->text)) {
        diag_error(draft->keys.diag, &key->mark,
                   bad ? "repeat: '%s' cannot be the name of a number that counts"
                       : "repeat: '%s' is a parameter already",
                   key->text);
        return false;
    }
    *ret_from = 0;
    if (node->kind != TREE_LIST) {
        if (!scene_repeat_number(draft, node, ret_to)) return false;
        --*ret_to;
    } else if (node->count != 2) {
        diag_error(draft->keys.diag, &node->mark, "repeat: a number, or [first, last], is needed");
        return false;
    } else if (!scene_repeat_number(draft, node->items[0], ret_from) ||
               !scene_repeat_number(draft, node->items[1], ret_to))
        return false;
    if (*ret_to >= *ret_from) return true;
    diag_error(draft->keys.diag, &node->mark, "repeat: '%s' takes no value at all", key->text);
    return false;
}

/* Appends the layers of the names from `index` on; false after a recorded error. */
static bool scene_repeat_layer(struct draft *draft, struct node *into, const struct node *layer,
                               const struct node *repeat, unsigned index)
{
    long from, to;
    if (index == repeat->count) {
        if (into->count == SCENE_REPEAT_MOST) {
            diag_error(draft->keys.diag, &repeat->mark, "repeat: more than %d layers", SCENE_REPEAT_MOST);
            return false;
        }
        tree_append(draft->keys.forest, into, tree_copy(draft->keys.forest, layer));
        return true;
    }
    if (!scene_repeat_range(draft, repeat->keys[index], repeat->items[index], &from, &to)) return false;
    for (long value = from; value <= to; value++) {
        struct node *copy = tree_copy(draft->keys.forest, layer);
        scene_repeat_replace(draft->keys.forest, copy, repeat->keys[index]->text, value);
        if (!scene_repeat_layer(draft, into, copy, repeat, index + 1)) return false;
    }
    return true;
}

void scene_repeat(struct draft *draft, struct node *layers)
{
    if (!layers || layers->kind != TREE_LIST) return;
    struct node *all = tree_list(draft->keys.forest, &layers->mark);
    for (unsigned i = 0; i < layers->count; i++) {
        struct node *layer = layers->items[i];
        int at = layer->kind == TREE_MAP ? tree_find(layer, "repeat") : -1;
        if (at < 0) {
            tree_append(draft->keys.forest, all, layer);
            continue;
        }
        const struct node *repeat = layer->items[at];
        tree_remove(layer, (unsigned)at);
        if (repeat->kind == TREE_MAP && repeat->count > 0) scene_repeat_layer(draft, all, layer, repeat, 0);
        else diag_error(draft->keys.diag, &repeat->mark, "repeat: names and how often are needed, as in {i: 5}");
    }
    layers->items = all->items;
    layers->count = all->count;
}
