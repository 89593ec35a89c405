/* merge.c - see merge.h. */
#include "case/merge.h"

#include "case/parse.h"
#include "case/scene_draft.h"
#include "case/show.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { MERGE_DEPTH = 16, MERGE_VARIANTS = 64 };

struct merge {
    struct forest *forest;
    struct diag *diag;
    const char *open[MERGE_DEPTH]; /* files that are being read, outermost first */
    unsigned n_open;
};

/* The value of a key, if it is a scalar. */
static const char *merge_word(const struct node *map, const char *key)
{
    const struct node *node = tree_get(map, key);
    return node && node->kind == TREE_SCALAR ? node->text : NULL;
}

static bool merge_type_changes(const struct node *base, const struct node *over)
{
    const char *was = merge_word(base, "type"), *is = merge_word(over, "type");
    return was && is && strcmp(was, is) != 0;
}

/* An incoming wave whose pulse changes: what was the old pulse's own goes, what is the wave's (its delay, the pressure
 * far away) stays. */
static void merge_pulse(struct node *base, const struct node *over)
{
    const char *type = merge_word(base, "type"), *was = merge_word(base, "pulse"), *is = merge_word(over, "pulse");
    if (!type || !was || !is || strcmp(type, "incoming-wave") != 0 || strcmp(was, is) == 0) return;
    for (unsigned i = base->count; i-- > 0;)
        if (scene_pulse_owns(base->keys[i]->text)) tree_remove(base, i);
}

/* Lays `over` onto the map `base`. What null would delete must be there. */
static void merge_onto(struct merge *merge, struct node *base, const struct node *over)
{
    struct forest *forest = merge->forest;
    merge_pulse(base, over);
    for (unsigned i = 0; i < over->count; i++) {
        struct node *item = over->items[i];
        int at = tree_find(base, over->keys[i]->text);
        if (tree_is_null(item)) {
            if (at >= 0) tree_remove(base, (unsigned)at);
            else
                diag_error(merge->diag, &over->keys[i]->mark, "there is no '%s' here that null could delete",
                           over->keys[i]->text);
            continue;
        }
        bool maps = at >= 0 && item->kind == TREE_MAP && base->items[at]->kind == TREE_MAP;
        if (maps && !merge_type_changes(base->items[at], item)) {
            merge_onto(merge, base->items[at], item);
            continue;
        }
        if (at >= 0) tree_remove(base, (unsigned)at);
        tree_add(forest, base, over->keys[i], tree_copy(forest, item));
    }
}

static struct node *merge_file(struct merge *merge, const char *path, const struct mark *from);

/* The path of a file named in another one. */
static const char *merge_beside(struct merge *merge, const struct node *name)
{
    const char *here = name->mark.source->name, *slash = strrchr(here, '/');
    if (!slash || name->text[0] == '/') return name->text;
    return tree_print(merge->forest, "%.*s/%s", (int)(slash - here), here, name->text);
}

static struct node *merge_extend(struct merge *merge, struct node *root)
{
    int at = tree_find(root, "extends");
    if (at < 0) return root;
    struct node *name = root->items[at];
    if (name->kind != TREE_SCALAR || tree_is_null(name)) {
        diag_error(merge->diag, &name->mark, "extends: the name of a case file is needed, not %s", tree_describe(name));
        return NULL;
    }
    struct node *base = merge_file(merge, merge_beside(merge, name), &name->mark);
    if (!base) return NULL;
    tree_remove(root, (unsigned)at);
    merge_onto(merge, base, root);
    base->mark = root->mark;
    return base;
}

/* Does the file stand above itself? */
static bool merge_circle(struct merge *merge, const char *real, const struct mark *from)
{
    for (unsigned i = 0; i < merge->n_open; i++) {
        if (strcmp(merge->open[i], real) != 0) continue;
        diag_error(merge->diag, from, "extends: '%s' extends itself", real);
        return true;
    }
    if (merge->n_open < MERGE_DEPTH) return false;
    diag_error(merge->diag, from, "extends: more than %d files on top of each other", MERGE_DEPTH);
    return true;
}

static struct node *merge_file(struct merge *merge, const char *path, const struct mark *from)
{
    char *found = realpath(path, NULL);
    const char *real = tree_print(merge->forest, "%s", found ? found : path);
    free(found);
    if (merge_circle(merge, real, from)) return NULL;
    const struct source *source = diag_file(merge->diag, path, PARSE_BYTES, from);
    struct node *root = source ? parse_source(merge->forest, merge->diag, source) : NULL;
    if (!root) return NULL;
    if (root->kind != TREE_MAP) {
        diag_error(merge->diag, &root->mark, "a case is a map of keys ('bulla: 1', 'domain: ...'), not %s",
                   tree_describe(root));
        return NULL;
    }
    merge->open[merge->n_open++] = real;
    root = merge_extend(merge, root);
    merge->n_open--;
    return root;
}

static void merge_no_variant(struct merge *merge, const struct node *root, const char *variant)
{
    const struct node *variants = tree_get(root, "variants");
    const char *names[MERGE_VARIANTS + 2];
    unsigned count = 0;
    for (; variants && count < variants->count && count < MERGE_VARIANTS; count++)
        names[count] = variants->keys[count]->text;
    if (tree_get(root, "quick")) names[count++] = "quick";
    names[count] = NULL;
    const struct source *source = diag_text(merge->diag, tree_print(merge->forest, "--variant %s", variant), variant);
    struct mark mark = {source, 1, 1, 1};
    diag_error(merge->diag, &mark, count ? "the case has no such variant" : "the case has no variants");
    if (count) diag_suggest(merge->diag, variant, names);
}

static void merge_variant(struct merge *merge, struct node *root, const char *variant)
{
    static const char *const fixed[] = {"extends", "variants", "quick", "matrix", NULL};
    const struct node *variants = tree_get(root, "variants");
    const struct node *over = variants && variants->kind == TREE_MAP ? tree_get(variants, variant) : NULL;
    if (!over && strcmp(variant, "quick") == 0) over = tree_get(root, "quick");
    if (!over) {
        merge_no_variant(merge, root, variant);
        return;
    }
    if (over->kind != TREE_MAP) {
        diag_error(merge->diag, &over->mark, "variant '%s': a map of keys to change is needed, not %s", variant,
                   tree_describe(over));
        return;
    }
    for (unsigned i = 0; fixed[i]; i++) {
        int at = tree_find(over, fixed[i]);
        if (at < 0) continue;
        diag_error(merge->diag, &over->keys[at]->mark, "variant '%s': a variant has no '%s' of its own", variant,
                   fixed[i]);
        return;
    }
    merge_onto(merge, root, over);
}

/* One step of a path: "initial", "1", "[1]". Moves `at` on; false if the path is malformed. */
static bool merge_step(struct merge *merge, const char **at, const char **ret_name)
{
    size_t bracket = **at == '[' ? 1 : 0, length = strcspn(*at + bracket, bracket ? "]" : ".[");
    *ret_name = tree_print(merge->forest, "%.*s", (int)length, *at + bracket);
    *at += bracket + length;
    if (bracket && *(*at)++ != ']') return false;
    if (**at == '.' && (*at)[1]) ++*at;
    else if (**at && **at != '[') return false;
    return length > 0;
}

/* The place in a list that a step names, or NULL after a recorded error. */
static struct node **merge_place(struct merge *merge, struct node *list, const char *name, const struct mark *mark)
{
    char *end;
    unsigned long index = strtoul(name, &end, 10);
    if (*name >= '0' && *name <= '9' && *end == '\0' && index < list->count) return &list->items[index];
    diag_error(merge->diag, mark, "'%s' is no entry of this list", name);
    diag_help(merge->diag, list->count ? "it has the entries 0 to %u" : "it has no entries", list->count - 1);
    return NULL;
}

/* Where a path leads, made on the way; NULL after a recorded error. */
static struct node **merge_walk(struct merge *merge, struct node *root, const char *path, const struct mark *mark)
{
    struct node **place = NULL, *node = root;
    for (const char *at = path; *at;) {
        const char *name;
        if (!merge_step(merge, &at, &name)) {
            diag_error(merge->diag, mark, "a path looks like 'scheme.cfl' or 'initial.1.pressure'");
            return NULL;
        }
        if (node->kind == TREE_LIST) {
            place = merge_place(merge, node, name, mark);
            if (!place) return NULL;
            node = *place;
            continue;
        }
        if (node->kind == TREE_SCALAR) { /* `limiter: mc` is short for {type: mc} */
            struct node *scalar = tree_copy(merge->forest, node);
            *node = *tree_map(merge->forest, mark);
            if (!tree_is_null(scalar)) tree_set(merge->forest, node, "type", scalar);
        }
        if (tree_find(node, name) < 0) tree_set(merge->forest, node, name, tree_map(merge->forest, mark));
        place = &node->items[tree_find(node, name)];
        node = *place;
    }
    return place;
}

/* Takes a key out: null deletes. */
static void merge_delete(struct merge *merge, struct node *root, const char *path, const struct mark *mark)
{
    const char *name = path, *last = path;
    struct node *parent = root;
    for (const char *at = path; *at;) {
        last = at;
        if (merge_step(merge, &at, &name)) continue;
        merge_walk(merge, root, path, mark); /* says what is wrong */
        return;
    }
    if (last > path) {
        size_t length = (size_t)(last - path) - (last[-1] == '.');
        struct node **place = merge_walk(merge, root, tree_print(merge->forest, "%.*s", (int)length, path), mark);
        if (!place) return;
        parent = *place;
    }
    int at = tree_find(parent, name);
    if (at >= 0) tree_remove(parent, (unsigned)at);
    else diag_error(merge->diag, mark, "there is nothing at '%s' that null could delete", path);
}

/* The item of the case's own matrix that a setting is, or NULL. It knows its line, and the folder of its files. */
static struct node *merge_row(struct merge *merge, const struct node *root, const char *path, const char *value)
{
    const struct node *list = tree_get(tree_get(root, "matrix"), path);
    for (unsigned i = 0; list && list->kind == TREE_LIST && i < list->count; i++) {
        struct text text = {0};
        show_value(list->items[i], &text);
        bool same = text.at && strcmp(text.at, value) == 0;
        text_done(&text);
        if (same) return tree_copy(merge->forest, list->items[i]);
    }
    return NULL;
}

static void merge_set(struct merge *merge, struct node *root, const char *set)
{
    const char *equals = strchr(set, '=');
    const char *name = tree_print(merge->forest, "--set %s", set);
    const struct source *source = diag_text(merge->diag, name, equals ? equals + 1 : "");
    struct mark mark = {source, 1, 1, 1};
    if (!equals || equals == set || !source->text[strspn(source->text, " ")]) {
        diag_error(merge->diag, &mark, "'path=value' is needed, as in --set scheme.cfl=0.2");
        return;
    }
    const char *path = tree_print(merge->forest, "%.*s", (int)(equals - set), set);
    struct node *value = merge_row(merge, root, path, source->text);
    if (value) mark = value->mark;
    else value = parse_source(merge->forest, merge->diag, source);
    if (!value) return;
    if (tree_is_null(value)) {
        merge_delete(merge, root, path, &mark);
        return;
    }
    struct node **place = merge_walk(merge, root, path, &mark);
    if (place) *place = value;
}

struct node *merge_case(struct forest *forest, struct diag *diag, const char *path, const struct merge_options *options)
{
    struct merge merge = {.forest = forest, .diag = diag};
    struct node *root = merge_file(&merge, path, NULL);
    if (!root) return NULL;
    if (options->variant) merge_variant(&merge, root, options->variant);
    for (unsigned i = 0; options->sets && options->sets[i]; i++) merge_set(&merge, root, options->sets[i]);
    return root;
}
