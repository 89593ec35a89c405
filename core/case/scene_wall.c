/* scene_wall.c - walls of the domain that move: what is wrong, or of no use, about the way they go. */
#include "case/scene_draft.h"

static bool scene_wall_has(const struct scene_value *value)
{
    return value->script || value->number != 0.0;
}

/* What a wall that fluids slip along does along itself, nobody feels. */
static void scene_wall_slides(struct draft *draft, int axis, const struct keys_map *map,
                              const struct scene_boundary *boundary)
{
    const struct keys_value *velocity = keys_at(map, "velocity");
    for (int d = 0; d < draft->scene->domain.n_velocity; d++) {
        if (d == axis || !scene_wall_has(&boundary->velocity[d])) continue;
        keys_error(&draft->keys, velocity, "along itself (%c) a wall without friction moves nothing", "xyz"[d]);
        diag_help(draft->keys.diag, "write 0 there, or 'type: no-slip' and give a material a 'viscosity'");
    }
}

/* A no-slip wall without viscosity: nothing sticks to it but what the scheme smears, or a solid, which it shears. */
static void scene_wall_drags(struct draft *draft, int axis, const struct keys_map *map,
                             const struct scene_boundary *boundary)
{
    const struct scene *scene = draft->scene;
    bool along = false;
    for (int d = 0; boundary->moves && d < scene->domain.n_velocity; d++)
        along = along || (d != axis && scene_wall_has(&boundary->velocity[d]));
    if (boundary->type != SCENE_NO_SLIP || scene->domain.n_velocity < 2 || scene_matter_viscous(draft)) return;
    if (along && !scene_matter_solid(draft))
        diag_warn(draft->keys.diag, &keys_at(map, "velocity")->node->mark,
                  "%s: the wall drags nothing along, because no material has a viscosity",
                  keys_at(map, "velocity")->path);
    if (boundary->moves || scene_matter_solid(draft)) return;
    const struct keys_value *type = keys_at(map, "type");
    diag_warn(draft->keys.diag, &type->node->mark,
              "%s: without any viscosity a no-slip wall stops only what the faces of the scheme smear", type->path);
    diag_help(draft->keys.diag, "'reflecting' lets fluids slip; or give a material a 'viscosity'");
}

void scene_wall(struct draft *draft, int axis, int side, const struct keys_map *map)
{
    const struct scene_boundary *boundary = &draft->scene->domain.boundary[axis][side];
    if (boundary->moves && boundary->type == SCENE_REFLECTING) scene_wall_slides(draft, axis, map, boundary);
    scene_wall_drags(draft, axis, map, boundary);
}
