/* stage_exchange.c - see stage_exchange.h. */
#include "solve/stage_exchange.h"

#include "mesh/halo.h"

void stage_exchange_start(struct stage *stage)
{
    stage->bound->t = stage->t + stage->at * stage->dt;
    if (stage->level->link) stage->level->link->theta = stage->from + stage->at * stage->part;
    curve_take(stage->work->curve, stage->l, stage->level->w);
    halo_start(stage->level->halo, stage->level->w);
    around_start(stage->work->around, stage->l, stage->bound);
    if (stage->guard->masked) halo_start(stage->guard->halo, stage->guard->mask);
    cost_lap(&stage->work->cost, COST_EXCHANGE);
}

void stage_exchange_finish(struct stage *stage)
{
    halo_finish(stage->level->halo);
    around_finish(stage->work->around, stage->l, stage->bound);
    if (stage->guard->masked) halo_finish(stage->guard->halo);
    cost_lap(&stage->work->cost, COST_EXCHANGE);
}

void stage_exchange_ghosts(struct stage *stage)
{
    if (stage->l + 1 >= stage->mesh->n_level) return;
    halo_finish(stage->level->halo);
    around_finish(stage->work->around, stage->l, stage->bound);
    cost_lap(&stage->work->cost, COST_EXCHANGE);
    stage->bound->t = stage->t;
    prolong_strips(stage->work->prolong, stage->mesh, stage->l, stage->bound, 0);
    around_finer(stage->work->around, stage->l, stage->bound, 0);
    curve_finer(stage->work->curve, stage->l, 0);
    cost_lap(&stage->work->cost, COST_LEVELS);
}

bool stage_exchange_waits(const struct stage *stage, unsigned local)
{
    return halo_is_remote(stage->level, local) || around_is_remote(stage->work->around, stage->l, local);
}
