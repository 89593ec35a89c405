/* scene_free.c - releases a scene, section by section. */
#include "case/scene_draft.h"

#include "base/mem.h"
#include "case/donor.h"
#include "case/script_host.h"

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
