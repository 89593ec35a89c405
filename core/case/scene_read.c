/* scene_read.c - from a case file to a scene: merge, modules, parameters, keys, sections, in this order; what each
 * section means is in scene_*.c. */
#include "case/scene_read.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/keys_read.h"
#include "case/merge.h"
#include "case/scene_draft.h"
#include "case/script_host.h"
#include "case/show.h"
#include "plug/registry.h"

#include <string.h>

/* Loads what `modules:` lists; the names become absolute. */
static void scene_read_modules(struct draft *draft, const struct node *modules)
{
    for (unsigned i = 0; modules && modules->kind == TREE_LIST && i < modules->count; i++) {
        struct node *item = modules->items[i];
        if (item->kind != TREE_SCALAR) continue; /* reported with the other keys */
        item->text = scene_file_beside(draft->keys.forest, item->mark.source, item->text);
        if (registry_load(item->text)) diag_error(draft->keys.diag, &item->mark, "modules[%u]: %s", i, status_text());
    }
}

static char *scene_read_text(const struct keys_map *root, const char *name)
{
    const struct keys_value *value = keys_at(root, name);
    return value->given ? mem_text(value->text) : NULL;
}

/* "dir/name.yaml" -> "name" */
static char *scene_read_name(const char *path)
{
    const char *slash = strrchr(path, '/'), *start = slash ? slash + 1 : path, *dot = strrchr(start, '.');
    return mem_text_n(start, dot && dot > start ? (size_t)(dot - start) : strlen(start));
}

static void scene_read_variants(struct scene *scene, const struct node *root)
{
    const struct node *variants = tree_get(root, "variants");
    unsigned most = variants ? variants->count + 1 : 1;
    scene->variants = mem_new(most + 1, sizeof *scene->variants);
    for (unsigned i = 0; i + 1 < most && variants->kind == TREE_MAP; i++)
        scene->variants[scene->n_variant++] = mem_text(variants->keys[i]->text);
    if (tree_get(root, "quick") && !tree_get(variants, "quick"))
        scene->variants[scene->n_variant++] = mem_text("quick");
}

/* `matrix:` as settings, one per value of each list. */
static void scene_read_settings(struct draft *draft, const struct node *root)
{
    const struct node *matrix = tree_get(root, "matrix");
    struct scene *scene = draft->scene;
    if (!matrix || matrix->kind != TREE_MAP) return; /* reported with the other keys */
    scene->settings = mem_new(SCENE_SETTINGS, sizeof *scene->settings);
    for (unsigned i = 0; i < matrix->count; i++) {
        const struct node *list = matrix->items[i];
        const char *path = matrix->keys[i]->text;
        if (list->kind != TREE_LIST || list->count == 0)
            diag_error(draft->keys.diag, &list->mark, "matrix.%s: a list of values is needed, not %s", path,
                       tree_describe(list));
        for (unsigned k = 0; list->kind == TREE_LIST && k < list->count && scene->n_setting < SCENE_SETTINGS; k++) {
            struct text set = {0};
            text_add(&set, "%s=", path);
            show_value(list->items[k], &set);
            scene->settings[scene->n_setting++] = set.at;
        }
    }
}

static void scene_read_sections(struct draft *draft)
{
    struct scene *scene = draft->scene;
    scene->title = scene_read_text(draft->root, "title");
    scene->about = scene_read_text(draft->root, "about");
    scene->cite = scene_read_text(draft->root, "cite");
    scene_material(draft);
    scene_domain(draft);
    scene_scheme(draft);
    scene_heat(draft);
    scene_mesh(draft);
    scene_derived(draft);
    scene_refine(draft);
    scene_boundary(draft);
    scene_tension(draft);
    scene_contact(draft);
    scene_phase(draft);
    scene_fick(draft);
    scene_damage_voids(draft);
    scene_initial(draft);
    scene_rigid(draft);
    scene_diffusion(draft);
    scene_source(draft);
    scene_hancock(draft);
    scene_swirl(draft);
    scene_output(draft);
    scene_history(draft);
    scene_map(draft);
    scene_expect(draft);
    scene_peak(draft);
}

/* The resolved case: what has been used up is left out. */
static void scene_read_resolve(struct draft *draft, struct node *root)
{
    static const char *const used_up[] = {"extends", "variants", "quick", "matrix", NULL};
    struct text text = {0};
    int at;
    for (unsigned i = 0; used_up[i]; i++)
        if ((at = tree_find(root, used_up[i])) >= 0) tree_remove(root, (unsigned)at);
    params_prune(draft->keys.params, tree_get(root, "parameters"));
    if ((at = tree_find(root, "parameters")) >= 0 && root->items[at]->count == 0) tree_remove(root, (unsigned)at);
    text_add(&text, "# Resolved case: overlays, parameters, units and defaults are applied; all numbers are SI.\n");
    show_tree(root, &text);
    draft->scene->resolved = text.at;
}

/* Everything after the tree is there. */
static void scene_read_tree(struct draft *draft, struct node *root)
{
    scene_read_modules(draft, tree_get(root, "modules"));
    scene_read_variants(draft->scene, root);
    scene_read_settings(draft, root);
    params_read(draft->keys.params, tree_get(root, "parameters"));
    scene_repeat(draft, tree_get(root, "initial"));
    draft->root = keys_read(&draft->keys, root, &scene_root_keys, "");
    if (draft->root) scene_read_sections(draft);
    if (diag_errors(draft->keys.diag)) return;
    scene_idle(draft, root);
    scene_coarse(draft);
    scene_phase_surface_late(draft);
    scene_boil(draft);
    scene_condense(draft);
    scene_branch_times(draft);
    scene_damage_times(draft);
    scene_spare(draft, root);
    scene_read_resolve(draft, root);
}

static int scene_read_once(const char *path, const struct scene_options *options, struct diag *diag,
                           struct scene *scene)
{
    struct forest *forest = tree_forest_new();
    scene->path = mem_text(path);
    scene->name = scene_read_name(path);
    scene->output.directory = mem_text(options->directory);
    scene->host = script_host_new();
    struct params *params = params_new(forest, diag, scene->host);
    struct draft draft = {{forest, diag, params, &scene_root_keys}, scene, NULL};
    struct merge_options merge = {options->sets, options->variant};
    struct node *root = merge_case(forest, diag, path, &merge);
    if (root) scene_read_tree(&draft, root);
    params_free(params);
    tree_forest_free(forest);
    return diag_errors(diag) ? STATUS_CASE : STATUS_OK;
}

/* Reads the case in another way, for its errors alone. */
static void scene_read_again(const char *path, const struct scene_options *options, struct diag *diag,
                             const char *context)
{
    struct scene *scene = mem_new(1, sizeof *scene);
    diag_context(diag, context);
    scene_read_once(path, options, diag, scene);
    diag_context(diag, NULL);
    scene_free(scene);
}

/* A case that is right by itself may still have a variant or a row of its matrix that is not. */
static void scene_read_overlays(const struct scene *scene, struct diag *diag)
{
    for (unsigned i = 0; i < scene->n_variant; i++) {
        struct scene_options options = {.variant = scene->variants[i]};
        char *context = mem_print("this is read with --variant %s", scene->variants[i]);
        scene_read_again(scene->path, &options, diag, context);
        mem_free(context);
    }
    for (unsigned i = 0; i < scene->n_setting; i++) {
        const char *sets[] = {scene->settings[i], NULL};
        struct scene_options options = {.sets = sets};
        scene_read_again(scene->path, &options, diag, "this is one of the values under 'matrix:'");
    }
}

/* Outputs are named after the case, and listed by these names. */
static int scene_read_check_name(const char *path)
{
    char *name = scene_read_name(path), *plain = mem_text(name);
    text_line(plain, strlen(plain) + 4);
    int code = strcmp(name, plain) == 0
                   ? STATUS_OK
                   : status_fail(STATUS_CASE,
                                 "%s: outputs are named after the case: rename the file so that its name is UTF-8 "
                                 "without control characters",
                                 path);
    mem_free(name);
    mem_free(plain);
    return code;
}

int scene_read(const char *path, const struct scene_options *options, struct scene **ret_scene)
{
    static const struct scene_options none;
    if (!options) options = &none;
    TRY(scene_read_check_name(path));
    TRY(registry_init());
    if (registry_is_empty())
        return status_fail(STATUS_CASE, "no modules were found: without them there are no equations of state; look at "
                                        "BULLA_MODULE_PATH and the folder lib/bulla/modules of the installation");
    struct diag *diag = diag_new();
    struct scene *scene = mem_new(1, sizeof *scene);
    bool plain = !options->variant && !(options->sets && options->sets[0]);
    int code = scene_read_once(path, options, diag, scene);
    if (!code && plain) scene_read_overlays(scene, diag);
    if (comm_rank() == 0) diag_print(diag, options->messages ? options->messages : stderr, options->json);
    unsigned errors = diag_errors(diag);
    diag_free(diag);
    if (errors) {
        scene_free(scene);
        return status_fail(STATUS_CASE, "%s: %u error%s; nothing was run", path, errors, errors == 1 ? "" : "s");
    }
    *ret_scene = scene;
    return STATUS_OK;
}
