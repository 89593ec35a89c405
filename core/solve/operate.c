/* operate.c - see operate.h. */
#include "solve/operate.h"

#include "phys/mix.h"
#include "solve/evaporate.h"

#include <string.h>

/* The scene's model takes the place of a tile's narrowed path: what that leaves alone is as it was. */
static void operate_widen(struct stage *stage, unsigned local, double *u)
{
    const struct model *model = stage->model, *path = stage->census.tiles[local].path;
    size_t n_cell = stage->mesh->n_cell;
    const double *u_old = stage->level->u_old[local];
    for (unsigned q = 0, active = 0; q < model->n_field; q++) {
        if (active < path->n_active && path->active[active] == q) active++;
        else if (u != stage->level->u_new[local]) memcpy(u + q * n_cell, u_old + q * n_cell, n_cell * sizeof *u);
    }
    stage->census.tiles[local].path = model;
}

/* Where an operator that waits for materials wakes on what the stage has made, they are there from now on. Pressures
 * found here fit, so they keep their bits in what follows. A tile is still only after a stage in which none woke. */
static void operate_wake(struct stage *stage, unsigned local, double *u, double *w)
{
    const struct model *path = stage->census.tiles[local].path;
    const struct operators *operators = work_operators(stage->work, path);
    size_t n_cell = stage->mesh->n_cell;
    if (operators->n_waiting == 0) return;
    mix_pressure_sum(&stage->effort, mix_primitives(path, n_cell, n_cell, u, w));
    if (operators_wake(operators, path, n_cell, n_cell, w)) operate_widen(stage, local, u);
}

void operate_tile(struct stage *stage, unsigned local, double *u, double *w)
{
    operate_wake(stage, local, u, w);
    const struct model *path = stage->census.tiles[local].path;
    double dt = tableau_reach(stage->tableau, stage->turn) * stage->dt;
    const struct operator_tile tile = {.model = path,
                                       .mesh = stage->mesh,
                                       .level = stage->level,
                                       .tile = stage_tile(stage, local),
                                       .n_cell = stage->mesh->n_cell,
                                       .t = stage->t + dt,
                                       .dt = dt,
                                       .u = u,
                                       .w = w,
                                       .before = stage->work->rates, /* of verdict_hold */
                                       .grown = stage->work->grown,
                                       .shore = stage_shore(stage, local),
                                       .fault = &stage->fault};
    const struct operators *operators = work_operators(stage->work, path);
    evaporate_before(stage, local, u);
    mix_pressure_sum(&stage->effort, operators_act(operators, stage->turn + 1 == stage->tableau->n, &tile));
    evaporate_after(stage, local, tile.t, u);
}
