/* sync.c - see sync.h. */
#include "solve/sync.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "mesh/halo.h"
#include "phys/restrict.h"

#include <string.h>

void sync_down(struct stage *coarse, struct stage *fine)
{
    halo_start(coarse->level->halo, coarse->level->w);
    halo_finish(coarse->level->halo);
    coarse->bound->t = coarse->t + coarse->dt;
    prolong_strips(coarse->work->prolong, coarse->mesh, coarse->l, coarse->bound, 1);
    link_down(fine->level->link);
    census_receive(&fine->census);
    reflux_clear(coarse->reflux);
}

static const struct tile *sync_tile(const struct stage *stage, unsigned local)
{
    return &stage->level->tiles[stage->level->first + local];
}

/* Fractions back into [0, 1] and to sum 1 where refluxing has moved them. */
static long long sync_bound_fractions(const struct model *model, size_t n_cell, const double *delta, double *u)
{
    long long clipped = 0;
    for (size_t i = 0; i < n_cell; i++) {
        double sum = 0.0;
        bool moved = false, acted = false;
        for (unsigned l = 0; l < model->n_alpha; l++) {
            double *alpha = &u[l * n_cell + i];
            moved = moved || delta[l * n_cell + i] != 0.0;
            acted = acted || *alpha < 0.0 || *alpha > 1.0;
            *alpha = *alpha > 0.0 ? *alpha < 1.0 ? *alpha : 1.0 : 0.0;
            sum += *alpha;
        }
        if (!moved) continue;
        clipped += acted;
        for (unsigned l = 0; l < model->n_alpha; l++) u[l * n_cell + i] /= sum;
    }
    return clipped;
}

/* Adds what refluxing gives to a tile and closes it; returns the number of cells that cannot bear it. */
static long long sync_reflux(struct stage *stage, unsigned local, bool spread, const double *before, double *delta)
{
    const struct model *model = stage->model;
    size_t n_cell = stage->mesh->n_cell;
    double *u = stage->level->u_old[local];
    guard_attempt(stage->guard);
    reflux_delta(stage->reflux, local, stage->dt, before, spread, delta);
    for (size_t i = 0; i < model->n_field * n_cell; i++) u[i] = before[i] + delta[i];
    long long clipped = sync_bound_fractions(model, n_cell, delta, u);
    stage_touch(stage, local);
    if (stage->guard->bad[1] == 0) stage->clipped += clipped;
    return stage->guard->bad[1];
}

/* One tile with coarse-fine faces; a NaN counts as what it is. */
static int sync_tile_faces(struct stage *stage, unsigned local, double *before, double *delta, long long *spread)
{
    size_t bytes = stage->model->n_field * stage->mesh->n_cell * sizeof *before;
    memcpy(before, stage->level->u_old[local], bytes);
    if (stage->model->scene->reflux == SCENE_REFLUX_OFF) {
        stage_touch(stage, local);
        return STATUS_OK;
    }
    if (sync_reflux(stage, local, false, before, delta) == 0) return STATUS_OK;
    ++*spread;
    if (sync_reflux(stage, local, true, before, delta) == 0) return STATUS_OK;
    return status_fail(STATUS_RUN, "at t = %.9g s the fluxes of the finer level cannot be taken over: %s",
                       stage->t + stage->dt, stage->guard->cause);
}

/* Local tiles that averages or refluxing have changed. */
static int sync_tiles(struct stage *stage, long long *spread)
{
    size_t block = stage->model->n_field * stage->mesh->n_cell;
    double *before = mem_new(2 * block, sizeof *before), *delta = before + block;
    const struct link *link = stage->reflux->up;
    int status = STATUS_OK;
    for (unsigned tile = 0; tile < stage->level->n_local && !status; tile++) {
        bool faces = link->source_from[tile] < link->source_from[tile + 1];
        guard_attempt(stage->guard);
        if (faces) status = sync_tile_faces(stage, tile, before, delta, spread);
        else if (sync_tile(stage, tile)->covered) stage_touch(stage, tile);
    }
    mem_free(before);
    return status;
}

int sync_up(struct stage *coarse, struct stage *fine, long long *spread)
{
    restrict_averages(coarse->mesh, fine->l);
    link_up(fine->level->link);
    restrict_take(coarse->mesh, fine->l);
    int status = sync_tiles(coarse, spread);
    guard_clear(coarse->guard);
    guard_attempt(coarse->guard);
    stage_survey(coarse);
    return comm_agree(status);
}
