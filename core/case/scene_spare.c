/* scene_spare.c - parameters that nothing uses: usually a slip of the pen in one of two places.
 *
 * A parameter may be there for a variant or a row of the matrix alone. One that only an overlay has, and that is
 * mentioned nowhere, would be missed by every reading of the case that leaves the overlay out. */
#include "case/scene_draft.h"

#include "base/mem.h"

#include <string.h>

static bool scene_spare_mentioned(const struct node *node, const char *name)
{
    if (node->kind == TREE_SCALAR) return params_mentions(node->text, name);
    for (unsigned i = 0; i < node->count; i++)
        if (scene_spare_mentioned(node->items[i], name)) return true;
    return false;
}

/* Parameters that an overlay adds. */
static void scene_spare_overlay(struct draft *draft, const struct node *root, const struct node *overlay)
{
    const struct node *added = tree_get(overlay, "parameters");
    for (unsigned i = 0; added && added->kind == TREE_MAP && i < added->count; i++) {
        const char *name = added->keys[i]->text;
        if (params_has(draft->keys.params, name) || scene_spare_mentioned(root, name)) continue;
        diag_warn(draft->keys.diag, &added->keys[i]->mark, "parameter '%s' is not used", name);
    }
}

static void scene_spare_unknown(struct draft *draft, const struct node *root, const struct node *key, const char *name)
{
    const struct node *map = tree_get(root, "parameters");
    unsigned n = map && map->kind == TREE_MAP ? map->count : 0;
    const char **names = mem_new(n + 1, sizeof *names);
    for (unsigned i = 0; i < n; i++) names[i] = map->keys[i]->text;
    diag_warn(draft->keys.diag, &key->mark, "matrix: the case has no parameter '%s'", name);
    if (n) diag_suggest(draft->keys.diag, name, names);
    mem_free(names);
}

void scene_spare(struct draft *draft, const struct node *root)
{
    static const char *const overlays[] = {"variants", "quick", "matrix"};
    static const char prefix[] = "parameters.";
    const struct node *variants = tree_get(root, "variants"), *matrix = tree_get(root, "matrix");
    for (unsigned i = 0; i < 3; i++) params_spare(draft->keys.params, tree_get(root, overlays[i]));
    for (unsigned i = 0; variants && i < variants->count; i++) scene_spare_overlay(draft, root, variants->items[i]);
    scene_spare_overlay(draft, root, tree_get(root, "quick"));
    for (unsigned i = 0; matrix && matrix->kind == TREE_MAP && i < matrix->count; i++) {
        const char *path = matrix->keys[i]->text, *name = path + strlen(prefix);
        if (strncmp(path, prefix, strlen(prefix)) != 0 || params_has(draft->keys.params, name)) continue;
        scene_spare_unknown(draft, root, matrix->keys[i], name);
    }
    params_warn_unused(draft->keys.params);
}
