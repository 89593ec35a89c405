/* scene.c - from a case file to a scene: merge, modules, parameters, keys, sections, in this
 * order; what each section means is in scene_*.c. */
#include "case/scene.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/donor.h"
#include "case/merge.h"
#include "case/scene_draft.h"
#include "case/show.h"
#include "plug/registry.h"

#include <string.h>

/* Loads what `modules:` lists; the names become absolute. */
static void scene_load_modules(struct draft *draft, const struct node *modules)
{
    for (unsigned i = 0; modules && modules->kind == TREE_LIST && i < modules->count; i++) {
        struct node *item = modules->items[i];
        if (item->kind != TREE_SCALAR) continue; /* reported with the other keys */
        item->text = scene_file_beside(draft->keys.forest, item->mark.source, item->text);
        if (registry_load(item->text)) diag_error(draft->keys.diag, &item->mark, "modules[%u]: %s", i, status_text());
    }
}

static char *scene_text(const struct keys_map *root, const char *name)
{
    const struct keys_value *value = keys_at(root, name);
    return value->given ? mem_text(value->text) : NULL;
}

/* "dir/name.yaml" -> "name" */
static char *scene_base_name(const char *path)
{
    const char *slash = strrchr(path, '/'), *start = slash ? slash + 1 : path, *dot = strrchr(start, '.');
    return mem_text_n(start, dot && dot > start ? (size_t)(dot - start) : strlen(start));
}

static void scene_list_variants(struct scene *scene, const struct node *root)
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
static void scene_list_settings(struct draft *draft, const struct node *root)
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

static void scene_fill(struct draft *draft)
{
    struct scene *scene = draft->scene;
    scene->title = scene_text(draft->root, "title");
    scene->about = scene_text(draft->root, "about");
    scene->cite = scene_text(draft->root, "cite");
    scene_material(draft);
    scene_domain(draft);
    scene_scheme(draft);
    scene_heat(draft);
    scene_mesh(draft);
    scene_derived(draft);
    scene_refine(draft);
    scene_boundary(draft);
    scene_tension(draft);
    scene_phase(draft);
    scene_damage_voids(draft);
    scene_initial(draft);
    scene_rigid(draft);
    scene_diffusion(draft);
    scene_source(draft);
    scene_output(draft);
    scene_history(draft);
    scene_map(draft);
    scene_expect(draft);
    scene_peak(draft);
}

/* The resolved case: what has been used up is left out. */
static void scene_resolve(struct draft *draft, struct node *root)
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
static void scene_build(struct draft *draft, struct node *root)
{
    scene_load_modules(draft, tree_get(root, "modules"));
    scene_list_variants(draft->scene, root);
    scene_list_settings(draft, root);
    params_read(draft->keys.params, tree_get(root, "parameters"));
    scene_repeat(draft, tree_get(root, "initial"));
    draft->root = keys_read(&draft->keys, root, &scene_root_keys, "");
    if (draft->root) scene_fill(draft);
    if (diag_errors(draft->keys.diag)) return;
    scene_idle(draft, root);
    scene_coarse(draft);
    scene_branch_times(draft);
    scene_damage_times(draft);
    scene_spare(draft, root);
    scene_resolve(draft, root);
}

static int scene_make(const char *path, const struct scene_options *options, struct diag *diag, struct scene *scene)
{
    struct forest *forest = tree_forest_new();
    scene->path = mem_text(path);
    scene->name = scene_base_name(path);
    scene->output.directory = mem_text(options->directory);
    scene->host = script_host_new();
    struct params *params = params_new(forest, diag, scene->host);
    struct draft draft = {{forest, diag, params, &scene_root_keys}, scene, NULL};
    struct merge_options merge = {options->sets, options->variant};
    struct node *root = merge_case(forest, diag, path, &merge);
    if (root) scene_build(&draft, root);
    params_free(params);
    tree_forest_free(forest);
    return diag_errors(diag) ? STATUS_CASE : STATUS_OK;
}

/* Reads the case in another way, for its errors alone. */
static void scene_try(const char *path, const struct scene_options *options, struct diag *diag, const char *context)
{
    struct scene *scene = mem_new(1, sizeof *scene);
    diag_context(diag, context);
    scene_make(path, options, diag, scene);
    diag_context(diag, NULL);
    scene_free(scene);
}

/* A case that is right by itself may still have a variant or a row of its matrix that is not. */
static void scene_try_overlays(const struct scene *scene, struct diag *diag)
{
    for (unsigned i = 0; i < scene->n_variant; i++) {
        struct scene_options options = {.variant = scene->variants[i]};
        char *context = mem_print("this is read with --variant %s", scene->variants[i]);
        scene_try(scene->path, &options, diag, context);
        mem_free(context);
    }
    for (unsigned i = 0; i < scene->n_setting; i++) {
        const char *sets[] = {scene->settings[i], NULL};
        struct scene_options options = {.sets = sets};
        scene_try(scene->path, &options, diag, "this is one of the values under 'matrix:'");
    }
}

/* Outputs are named after the case, and listed by these names. */
static int scene_check_name(const char *path)
{
    char *name = scene_base_name(path), *plain = mem_text(name);
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
    TRY(scene_check_name(path));
    TRY(registry_init());
    if (registry_count() == 0)
        return status_fail(STATUS_CASE, "no modules were found: without them there are no equations of state; look at "
                                        "BULLA_MODULE_PATH and the folder lib/bulla/modules of the installation");
    struct diag *diag = diag_new();
    struct scene *scene = mem_new(1, sizeof *scene);
    bool plain = !options->variant && !(options->sets && options->sets[0]);
    int code = scene_make(path, options, diag, scene);
    if (!code && plain) scene_try_overlays(scene, diag);
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

int scene_value_at(const struct scene_value *value, const double x[SCENE_AXES], double r, double t, double *ret)
{
    if (!value->script) {
        *ret = value->number;
        return STATUS_OK;
    }
    double in[] = {x[0], x[1], x[2], r, t};
    return script_call(value->script, in, 5, ret, 1);
}

static void scene_free_boundaries(struct scene *scene)
{
    for (int face = 0; face < 2 * SCENE_AXES; face++) {
        struct scene_boundary *boundary = &scene->domain.boundary[face / 2][face % 2];
        mem_free(boundary->sum);
        mem_free(boundary->series_t);
        mem_free(boundary->series_p);
        mem_free(boundary->fractions);
        mem_free(boundary->density);
    }
}

static void scene_free_output(struct scene *scene)
{
    for (unsigned i = 0; i < scene->output.n_column; i++) {
        shape_free(scene->output.columns[i].where);
        mem_free(scene->output.columns[i].uses);
    }
    for (unsigned i = 0; i < scene->output.n_probe; i++) mem_free(scene->output.probes[i].fields);
    for (unsigned i = 0; i < scene->n_expect; i++) {
        struct scene_expect *expect = &scene->expects[i];
        char *texts[] = {expect->value,  expect->reference,  expect->norm, expect->field,
                         expect->column, expect->coordinate, expect->label};
        for (unsigned k = 0; k < sizeof texts / sizeof *texts; k++) mem_free(texts[k]);
    }
    mem_free(scene->output.snapshot_fields);
    mem_free(scene->output.columns);
    mem_free(scene->output.probes);
    mem_free(scene->output.peaks);
    for (unsigned i = 0; i < scene->output.n_formula; i++) {
        mem_free(scene->output.formulas[i].text);
        mem_free(scene->output.formulas[i].uses);
    }
    mem_free(scene->output.formulas);
    scene_map_done(scene);
    mem_free(scene->expects);
}

struct instance *scene_instance(struct scene *scene, unsigned index)
{
    enum { LAWS = 6, SCHEMES = 4, FACES = 2 * SCENE_AXES };
    if (index < LAWS * scene->n_material) {
        struct scene_material *material = &scene->material[index / LAWS];
        struct instance *const laws[LAWS] = {&material->eos,       &material->constitutive, &material->plastic,
                                             &material->viscosity, &material->conductivity, &material->damage.law};
        return laws[index % LAWS];
    }
    index -= LAWS * scene->n_material;
    struct scene_scheme *scheme = &scene->scheme;
    struct instance *const schemes[SCHEMES] = {&scheme->reconstruction, &scheme->limiter, &scheme->interface_limiter,
                                               &scheme->riemann};
    if (index < SCHEMES) return schemes[index];
    index -= SCHEMES;
    if (index < FACES) return &scene->domain.boundary[index / 2][index % 2].law;
    index -= FACES;
    return index < scene->n_derived ? &scene->derived[index].law : NULL;
}

void scene_free(struct scene *scene)
{
    if (!scene) return;
    scene_free_boundaries(scene);
    scene_free_output(scene);
    for (unsigned i = 0; i < scene->n_layer; i++) {
        shape_free(scene->layers[i].shape);
        mem_free(scene->layers[i].fractions);
        mem_free(scene->layers[i].density);
        mem_free(scene->layers[i].checkpoint);
        donor_free(scene->layers[i].donor);
    }
    mem_free(scene->layers);
    for (unsigned i = 0; i < scene->n_rigid; i++) shape_free(scene->rigids[i].shape);
    mem_free(scene->sources);
    for (unsigned i = 0; i < scene->mesh.n_refine; i++) {
        shape_free(scene->mesh.refines[i].where);
        mem_free(scene->mesh.refines[i].uses);
    }
    mem_free(scene->mesh.refines);
    struct instance *instance;
    for (unsigned i = 0; (instance = scene_instance(scene, i)); i++) instance_done(instance);
    mem_free(scene->derived);
    for (unsigned i = 0; i < scene->n_variant; i++) mem_free(scene->variants[i]);
    mem_free(scene->variants);
    for (unsigned i = 0; i < scene->n_setting; i++) mem_free(scene->settings[i]);
    mem_free(scene->settings);
    char *texts[] = {scene->path,
                     scene->name,
                     scene->title,
                     scene->about,
                     scene->cite,
                     scene->resolved,
                     scene->output.directory,
                     scene->domain.cells_place};
    for (unsigned i = 0; i < sizeof texts / sizeof *texts; i++) mem_free(texts[i]);
    script_host_free(scene->host);
    mem_free(scene);
}
