/* slip.c - see slip.h. */
#include "scheme/slip.h"

#include "base/mem.h"
#include "phys/pick.h"
#include "phys/row.h"
#include "scheme/seam.h"

#include <math.h>

/* Less fluid than this lets nothing slide: traces are everywhere. */
#define SLIP_TRACE 1e-6

static bool slip_wanted(const struct model *path)
{
    bool both = path->n_solid > 0 && path->n_solid < path->n_material && path->n_alpha > 0;
    return path->scene->scheme.free && both && path->n_velocity > 1;
}

/* Of n cells from cell `from` on those that hold a solid and a fluid. */
static size_t slip_pick(const struct term_tile *tile, const double *u, size_t from, size_t n, unsigned *at)
{
    const struct model *model = tile->model;
    unsigned char there[SEAM_LOOK] = {0};
    double solid[SEAM_LOOK] = {0};
    for (unsigned s = 0; s < model->n_solid; s++) {
        seam_count(tile, s, u, from, n, there);
        row_add(n, u + (model->i_alpha + model->solids[s].material) * tile->n_cell + from, solid);
    }
    for (size_t i = 0; i < n; i++) there[i] = (unsigned char)((there[i] > 0) & (1.0 - solid[i] > SLIP_TRACE));
    return pick_marked(n, (unsigned)from, there, at);
}

/* Has a cell a surface? Then of its shear the part goes that fluids fill. */
static void slip_look(struct seam *seam, const struct term_tile *tile, const double *u, unsigned cell)
{
    const struct model *model = tile->model;
    double g[3], each[SCENE_MATERIALS], solid = 0.0;
    for (unsigned s = 0; s < model->n_solid; s++) {
        each[s] = 1.0;
        solid += u[(model->i_alpha + model->solids[s].material) * tile->n_cell + cell];
    }
    seam_gradient(tile, cell, each, g);
    double weight = seam_add(seam, tile, cell, g), fluid = 1.0 - solid;
    if (weight > 0.0) seam->part[seam->n - 1] = fluid * weight;
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

static void slip_slide(struct seam *seam, const struct term_tile *tile)
{
    for (unsigned d = 0; d + 1 < tile->model->n_velocity; d++)
        for (unsigned s = 0; s < tile->model->n_solid; s++)
            slip_way(seam->n, seam->part, seam->t[d][s], seam->k[s], seam->a[d][s]);
}

static size_t slip_apply(const struct term_tile *tile, double *u_new)
{
    static const struct seam_work work = {slip_pick, slip_look, slip_slide};
    seam_apply(&work, tile, u_new);
    return 0;
}

const struct term slip_term = {
    .name = "slip",
    .owner = "core/scheme/slip.c",
    .equation = "V_l <- (1 + a_l n^T) V_l: where a solid meets a fluid its surface bears no shear",
    .wanted = slip_wanted,
    .open = seam_open,
    .close = mem_free,
    .apply = slip_apply,
};
