/* scene_diffusion.c - what super time steps of viscosity and conduction (solve/rkl.h) do not go with. */
#include "case/scene_draft.h"

void scene_diffusion(struct draft *draft)
{
    const struct scene *scene = draft->scene;
    const struct keys_value *diffusion = keys_at(keys_at(draft->root, "scheme")->map, "diffusion");
    bool diffuses = scene_matter_conducts(draft);
    if (scene->scheme.diffusion != SCENE_DIFFUSION_RKL2) return;
    for (unsigned l = 0; l < scene->n_material; l++) diffuses = diffuses || scene->material[l].viscosity.module;
    if (scene->scheme.integrator != SCENE_MIDPOINT) {
        keys_error(&draft->keys, diffusion, "'rkl2' goes with the midpoint rule alone");
        diag_help(draft->keys.diag, "'integrator: midpoint'");
    }
    if (scene->n_phase + scene->n_fick > 0) {
        keys_error(&draft->keys, diffusion, "'rkl2' does not go with '%s': masses stay while heat flows",
                   scene->n_phase ? "phase-change" : "gas-diffusion");
        diag_help(draft->keys.diag, "'diffusion: explicit'");
    }
    if (scene->n_rigid > 0) {
        keys_error(&draft->keys, diffusion, "'rkl2' does not go with 'bodies': what diffuses knows of no cut cells");
        diag_help(draft->keys.diag, "'diffusion: explicit'");
    }
    if (!diffuses) {
        diag_warn(draft->keys.diag, &diffusion->node->mark, "%s: no material is viscous or conducts heat",
                  diffusion->path);
        diag_help(draft->keys.diag, "leave it out");
    }
}
