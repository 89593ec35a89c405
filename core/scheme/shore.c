/* shore.c - see shore.h. */
#include "scheme/shore.h"

#include "bulla/module.h"
#include "phys/phase_pair.h"
#include "phys/row.h"
#include "scheme/patch.h"

#include <string.h>

/* A tile and the cells around it. */
struct shore {
    const struct mesh *mesh;
    struct box_block block;
    double front, onset;
    double *thin, *high; /* vapour and gases of the cells; the most of a cell and those beside it */
};

size_t shore_marks(const struct model *model, const struct mesh *mesh)
{
    return model->fronts ? model->n_phase * mesh->n_cell : 0;
}

/* Fraction of material `l` of the scene: all are there but the first, which is the rest. */
static void shore_add(const struct shore *shore, const struct model *path, unsigned l, const double *around)
{
    size_t n = shore->block.pitch;
    if (l > 0) {
        row_add(n, around + (l - 1) * n, shore->thin);
        return;
    }
    for (size_t i = 0; i < n; i++) {
        double others = 0.0;
        for (unsigned m = 0; m < path->n_around_alpha; m++) others += around[m * n + i];
        shore->thin[i] += 1.0 - others;
    }
}

static BULLA_KERNEL void shore_rise(size_t n, const double *restrict before, const double *restrict after,
                                    double *restrict high)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = before[i], b = after[i], most = high[i];
        most = a > most ? a : most;
        high[i] = b > most ? b : most;
    }
}

/* What is dry itself is at the shore, too: if others have more, they are as dry. */
static BULLA_KERNEL void shore_mark(size_t n, double front, double onset, const double *restrict thin,
                                    const double *restrict high, unsigned char *restrict ret_shore)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double own = thin[i], most = high[i];
        ret_shore[i] = (most >= onset) | ((own >= front) & !(most > own + PHASE_PAIR_FELT));
    }
}

/* The most of each cell and those beside it, of all that lie between the first and the last cell of the tile. */
static void shore_top(const struct shore *shore)
{
    const struct mesh *mesh = shore->mesh;
    size_t from = box_at(&shore->block, 0, 0, 0), step = 1;
    size_t n = box_at(&shore->block, mesh->n[0] - 1, mesh->n[1] - 1, mesh->n[2] - 1) + 1 - from;
    const double *thin = shore->thin + from;
    memcpy(shore->high + from, thin, n * sizeof *thin);
    for (int axis = 0; axis < mesh->dim; step *= shore->block.size[axis++])
        shore_rise(n, thin - step, thin + step, shore->high + from);
}

/* Where nothing reaches the surface of heat there is no shore: most tiles are liquid. */
static void shore_pair(const struct shore *shore, unsigned char *ret_shore)
{
    const struct mesh *mesh = shore->mesh;
    if (row_most(shore->block.pitch, shore->thin) < shore->front) {
        memset(ret_shore, 0, mesh->n_cell);
        return;
    }
    shore_top(shore);
    for (int k = 0; k < mesh->n[2]; k++)
        for (int j = 0; j < mesh->n[1]; j++, ret_shore += mesh->n[0]) {
            size_t from = box_at(&shore->block, 0, j, k);
            shore_mark((size_t)mesh->n[0], shore->front, shore->onset, shore->thin + from, shore->high + from,
                       ret_shore);
        }
}

size_t shore_room(const struct model *model, const struct mesh *mesh)
{
    return model->fronts ? 2 * rim_block(mesh, 1, NULL).pitch : 0;
}

void shore_look(const struct model *path, const struct mesh *mesh, const double *around, double *room,
                unsigned char *ret_shore)
{
    struct shore shore = {.mesh = mesh, .block = rim_block(mesh, 1, NULL), .thin = room};
    shore.high = room + shore.block.pitch;
    for (unsigned k = 0; k < path->n_phase; k++) {
        const struct model_phase *phase = &path->phases[k];
        shore.onset = phase->scene->onset;
        shore.front = phase_pair_front(phase->scene);
        memset(shore.thin, 0, shore.block.pitch * sizeof *shore.thin);
        for (unsigned i = 1; i < phase->n; i++) shore_add(&shore, path, path->first + phase->member[i], around);
        shore_pair(&shore, ret_shore + k * mesh->n_cell);
    }
}
