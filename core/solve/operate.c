/* operate.c - see operate.h. */
#include "solve/operate.h"

#include "solve/evaporate.h"

void operate_tile(struct stage *stage, unsigned local, double *u, double *w)
{
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
