/* adopt.c - see adopt.h. */
#include "solve/adopt.h"

#include "base/mem.h"
#include "phys/mix.h"
#include "scheme/shore.h"
#include "solve/evaporate.h"
#include "solve/rkl.h"
#include "solve/verdict.h"

#include <string.h>

void adopt_bounds(struct stage *stage)
{
    bound_free(stage->bound);
    stage->bound = bound_new(stage->model, stage->mesh, stage->level);
}

static void adopt_tile(struct stage *stage, unsigned local, bool born)
{
    const struct level *level = stage->level;
    size_t n_cell = stage->mesh->n_cell;
    double *w = level->w[local];
    if (born) mix_primitives(stage->model, n_cell, n_cell, level->u_old[local], w);
    memcpy(level->u_new[local], level->u_old[local],
           stage->model->n_field * n_cell * sizeof *w); /* for verdict_touch */
    verdict_welcome(stage, local);
}

/* The tiles of the level are others: those that stayed keep what is known of them. */
static void adopt_tiles(struct stage *stage, const int *from, const bool *born)
{
    const struct level *level = stage->level;
    struct census_tile *before = stage->census.tiles;
    stage->census.tiles = mem_new(level->n_local, sizeof *stage->census.tiles);
    for (unsigned tile = 0; tile < level->n_local; tile++) {
        if (from[tile] >= 0) stage->census.tiles[tile] = before[from[tile]];
        else adopt_tile(stage, tile, born[level->first + tile]);
    }
    mem_free(before);
    stage->bound = bound_paint(stage->model, stage->mesh, level, stage->bound, from);
    guard_free(stage->guard);
    stage->guard = guard_new(stage->model, stage->mesh, stage->l);
    mem_free(stage->previous);
    stage->previous = NULL;
    if (tableau_keeps(tableau_of(stage->model->scene))) /* the step before may have been a last try's single one */
        stage->previous =
            mem_new(level->n_local * stage->model->n_field * stage->mesh->n_cell, sizeof *stage->previous);
    mem_free(stage->shore);
    size_t marks = level->n_local * shore_marks(stage->model, stage->mesh);
    stage->shore = marks ? mem_new(marks, sizeof *stage->shore) : NULL;
    evaporate_renew(stage);
    rkl_free(stage->rkl);
    stage->rkl = rkl_new(stage);
}

void adopt_level(struct stage *stage, const int *from, const bool *born)
{
    const struct level *level = stage->level;
    if (from) adopt_tiles(stage, from, born);
    reflux_free(stage->reflux);
    stage->reflux = reflux_new(stage->model, stage->mesh, stage->l);
    mem_free(stage->census.behind);
    stage->census.behind = mem_new(level->link ? level->link->n_face : 0, sizeof *stage->census.behind);
    if (level->link) census_receive(&stage->census); /* the strips of a level that stays hold for its next steps */
    verdict_survey(stage);                           /* tiles that slept count again */
}
