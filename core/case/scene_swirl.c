/* scene_swirl.c - what does not go with matter that turns around the axis (`velocity-components: 3`). */
#include "case/scene_draft.h"

/* What stands in the way, in words; NULL: nothing. */
static const char *scene_swirl_foreign(const struct draft *draft)
{
    const struct scene *scene = draft->scene;
    const struct {
        bool is;
        const char *words;
    } all[] = {{scene_matter_solid(draft) != NULL, "solids, which would be wrung"},
               {scene->n_rigid > 0, "bodies"},
               {scene->scheme.integrator == SCENE_HANCOCK, "'integrator: hancock'"}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i].is) return all[i].words;
    return NULL;
}

void scene_swirl(struct draft *draft)
{
    const struct scene_domain *domain = &draft->scene->domain;
    const struct keys_value *velocity = keys_at(keys_at(draft->root, "domain")->map, "velocity-components");
    bool more = domain->geometry == SCENE_AXISYMMETRIC && domain->n_velocity > domain->dim;
    const char *foreign = more ? scene_swirl_foreign(draft) : NULL;
    if (!foreign) return;
    keys_error(&draft->keys, velocity, "motion across the axes of an axisymmetric domain does not go with %s", foreign);
    diag_help(draft->keys.diag, "without 'velocity-components' matter moves along r and z alone");
}
