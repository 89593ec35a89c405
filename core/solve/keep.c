/* keep.c - see keep.h. */
#include "solve/keep.h"

#include <string.h>

/* Do tiles across edges and corners rest, where terms look at them? */
static bool keep_rests_around(const struct stage *stage, unsigned local)
{
    unsigned tiles[26];
    int n = around_diagonal(stage->work->around, stage->l, local, tiles);
    for (int i = 0; i < n; i++)
        if (!stage->census.tiles[tiles[i]].still) return false;
    return n >= 0;
}

/* May something move it on its path? */
static bool keep_moves(const struct stage *stage, unsigned local)
{
    const struct model *path = stage->census.tiles[local].path;
    return work_terms(stage->work, path)->moves || work_operators(stage->work, path)->moves;
}

static bool keep_rests(const struct stage *stage, unsigned local)
{
    const struct census_tile *tile = &stage->census.tiles[local];
    if (!tile->still || keep_moves(stage, local) || stage->guard->masked) return false;
    if (stage->tableau->stage[stage->turn].previous && !tile->skipped) return false;
    if (!keep_rests_around(stage, local)) return false;
    return !reflux_concerns(stage->reflux, local) && census_rests(&stage->census, local);
}

bool keep_skips(struct stage *stage, unsigned local)
{
    bool skips = stage_tile(stage, local)->hidden || keep_rests(stage, local);
    return stage->census.tiles[local].skipped = skips;
}

void keep_tile(struct stage *stage, unsigned local, const double *from, double *to)
{
    struct census_tile *tile = &stage->census.tiles[local];
    if (stage_tile(stage, local)->sleeps) return;
    memcpy(to, from, stage->model->n_field * stage->mesh->n_cell * sizeof *to);
    tile->present_next = tile->present;
    tile->still_next = tile->still;
    if (stage_tile(stage, local)->hidden) return;
    stage->cells += (long long)stage->mesh->n_cell;
    stage->carried += (long long)stage->mesh->n_cell;
}

void keep_rows(struct stage *stage, unsigned local, const double *from, double *to)
{
    struct census_tile *tile = &stage->census.tiles[local];
    size_t n_cell = stage->mesh->n_cell;
    const struct model *model = stage->model, *path = tile->path;
    unsigned settled = (unsigned)stage->tableau->n + 1;
    if (path != tile->kept) tile->streak = 0;
    tile->kept = path;
    if (path == model) return;
    for (unsigned q = 0, active = 0; q < model->n_field; q++) {
        bool density = q >= model->i_m && q < model->i_u;
        bool evolved = active < path->n_active && path->active[active] == q;
        active += evolved;
        bool normal = q - model->i_normal < model->n_normal; /* wraps below i_normal */
        if (normal && tile->streak < settled) memset(to + q * n_cell, 0, n_cell * sizeof *to);
        else if (!evolved && (density || tile->streak < settled))
            memcpy(to + q * n_cell, from + q * n_cell, n_cell * sizeof *to);
    }
    if (tile->streak < settled) tile->streak++;
}

double *keep_previous(const struct stage *stage, unsigned local)
{
    return stage->previous ? stage->previous + local * stage->model->n_field * stage->mesh->n_cell : NULL;
}

void keep_stage(const struct stage *stage, unsigned local, const double *made)
{
    const struct model *path = stage->census.tiles[local].path;
    size_t n_cell = stage->mesh->n_cell;
    double *previous = keep_previous(stage, local);
    if (!previous || stage_tile(stage, local)->sleeps) return;
    memcpy(previous, stage->level->u_old[local], stage->model->n_field * n_cell * sizeof *previous);
    for (unsigned i = 0; made && i < path->n_active; i++)
        memcpy(previous + path->active[i] * n_cell, made + path->active[i] * n_cell, n_cell * sizeof *previous);
}
