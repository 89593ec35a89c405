/* scene_hancock.c - what Hancock's first stage (scheme/hancock.h) knows nothing of. */
#include "case/scene_draft.h"

/* Another source than an acceleration or a force? */
static bool scene_hancock_is_driven(const struct scene_sources *sources)
{
    bool driven = sources && sources->script;
    for (unsigned s = SCENE_SOURCE_HEATING; sources && s < SCENE_SOURCES; s++)
        driven = driven || sources->value[s].given;
    return driven;
}

/* What stands in the way, in words; NULL: nothing. */
static const char *scene_hancock_foreign(const struct draft *draft)
{
    const struct scene *scene = draft->scene;
    bool viscous = false, drags = false;
    for (unsigned l = 0; l < scene->n_material; l++) {
        viscous = viscous || scene->material[l].viscosity.module;
        drags = drags || scene->material[l].drag > 0.0;
    }
    const struct {
        bool is;
        const char *words;
    } all[] = {{scene_matter_solid(draft) != NULL, "solids"},
               {viscous, "viscosity"},
               {drags, "drag"},
               {scene_matter_conducts(draft), "conduction of heat"},
               {scene->n_tension > 0, "surface tension"},
               {scene->n_phase > 0, "phase change"},
               {scene->n_fick > 0, "gases that diffuse"},
               {scene->n_rigid > 0, "bodies"},
               {scene_hancock_is_driven(scene->sources), "sources of heat, mass or volume, or in Lua"},
               {scene->n_material > 1 && scene->scheme.closure == SCENE_ALLAIRE, "'closure: allaire'"}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i].is) return all[i].words;
    return NULL;
}

void scene_hancock(struct draft *draft)
{
    const struct keys_value *integrator = keys_at(keys_at(draft->root, "scheme")->map, "integrator");
    const char *foreign = draft->scene->scheme.integrator == SCENE_HANCOCK ? scene_hancock_foreign(draft) : NULL;
    if (!foreign) return;
    keys_error(&draft->keys, integrator, "'hancock' does not go with %s", foreign);
    diag_help(draft->keys.diag, "'integrator: midpoint', the default, goes with all");
}
