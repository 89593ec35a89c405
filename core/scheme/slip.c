/* slip.c - see slip.h. */
#include "scheme/slip.h"

#include "base/mem.h"
#include "phys/pick.h"
#include "phys/row.h"
#include "scheme/seam.h"

#include <math.h>
#include <string.h>

/* Less fluid than this lets nothing slide: traces are everywhere. */
#define SLIP_TRACE 1e-6

/* The cells of a tile in which solids meet fluids. */
struct slip {
    struct seam seam;
    double part[SEAM_BATCH]; /* of the shear traction that goes */
};

static bool slip_wanted(const struct model *path)
{
    bool both = path->n_solid > 0 && path->n_solid < path->n_material && path->n_alpha > 0;
    return path->scene->scheme.free && both && path->n_velocity > 1;
}

static void *slip_open(const struct term_room *room)
{
    (void)room;
    return mem_new(1, sizeof(struct slip));
}

/* Of n cells from cell `from` on those that hold a solid and a fluid; solid[n]: fractions of all solids. */
static size_t slip_pick(const struct term_tile *tile, const double *u, size_t from, size_t n, double *solid,
                        unsigned *at)
{
    const struct model *model = tile->model;
    unsigned char there[SEAM_LOOK] = {0};
    memset(solid, 0, n * sizeof *solid);
    for (unsigned s = 0; s < model->n_solid; s++) {
        seam_count(tile, s, u, from, n, there);
        row_add(n, u + (model->i_alpha + model->solids[s].material) * tile->n_cell + from, solid);
    }
    for (size_t i = 0; i < n; i++) there[i] = (unsigned char)((there[i] > 0) & (1.0 - solid[i] > SLIP_TRACE));
    return pick_marked(n, (unsigned)from, there, at);
}

/* Has a cell a surface? Then it comes into the batch; fluid: the fraction of all fluids. */
static void slip_look(struct slip *slip, const struct term_tile *tile, unsigned cell, double fluid)
{
    double g[3], each[SCENE_MATERIALS];
    for (unsigned s = 0; s < tile->model->n_solid; s++) each[s] = 1.0;
    seam_gradient(tile, cell, each, g);
    double weight = seam_add(&slip->seam, cell, g);
    if (weight > 0.0) slip->part[slip->seam.n - 1] = fluid * weight;
}

static BULLA_KERNEL void slip_way(size_t n, const double *restrict part, const double *restrict t,
                                  const double *restrict k, double *restrict slide)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double stiff = k[i], a = -part[i] * t[i] / stiff;
        a = stiff > 0.0 ? a : 0.0;
        slide[i] = fabs(a) > SEAM_NOTHING ? a : 0.0;
    }
}

static void slip_batch(struct slip *slip, const struct term_tile *tile, double *u)
{
    struct seam *seam = &slip->seam;
    if (!seam->n) return;
    seam_gather(seam, tile, u);
    for (unsigned d = 0; d + 1 < tile->model->n_velocity; d++)
        for (unsigned s = 0; s < tile->model->n_solid; s++)
            slip_way(seam->n, slip->part, seam->t[d][s], seam->k[s], seam->a[d][s]);
    seam_scatter(seam, tile, u);
}

static size_t slip_apply(const struct term_tile *tile, double *u_new)
{
    struct slip *slip = tile->own;
    unsigned at[SEAM_LOOK];
    double solid[SEAM_LOOK];
    slip->seam.model = tile->model;
    slip->seam.n = 0;
    for (size_t from = 0; from < tile->n_cell; from += SEAM_LOOK) {
        size_t left = tile->n_cell - from;
        size_t n = slip_pick(tile, u_new, from, left < SEAM_LOOK ? left : SEAM_LOOK, solid, at);
        for (size_t i = 0; i < n; i++) {
            slip_look(slip, tile, at[i], 1.0 - solid[at[i] - from]);
            if (slip->seam.n == SEAM_BATCH) slip_batch(slip, tile, u_new);
        }
    }
    slip_batch(slip, tile, u_new);
    return 0;
}

const struct term slip_term = {
    .name = "slip",
    .owner = "core/scheme/slip.c",
    .equation = "V_l <- (1 + a_l n^T) V_l: where a solid meets a fluid its surface bears no shear",
    .wanted = slip_wanted,
    .open = slip_open,
    .close = mem_free,
    .apply = slip_apply,
};
