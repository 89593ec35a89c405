/* viscous_plain.c - see viscous_plain.h. One pass per component of the momentum, over values of the patch. Sums are in
 * the order of viscous_strain.c and viscous_mix.c; halves and doubles are exact, wherever they stand. */
#include "scheme/viscous_plain.h"

#include "phys/coefficient.h"

/* At how many faces a fraction is not 1 on both sides. */
static BULLA_KERNEL double viscous_plain_less(size_t n, const double *restrict left, const double *restrict right)
{
    double count = 0.0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) count += ((left[i] != 1.0) | (right[i] != 1.0)) ? 1.0 : 0.0;
    return count;
}

int viscous_plain_alone(const struct model *path, const struct frame *frame, const struct viscous_block *block,
                        const struct face_work *faces)
{
    const double *alpha = faces->frame + path->i_alpha * FACE_ROOM + block->face + frame_reach(frame);
    unsigned l = 0;
    while (l < path->n_alpha && alpha[l * FACE_ROOM] != 1.0) l++;
    if (l == path->n_material || path->beta || !coefficient_is_number(&path->viscosity[l].mu)) return -1;
    if (!path->n_alpha) return 0;
    alpha += l * FACE_ROOM;
    return viscous_plain_less(block->n, alpha, alpha + frame->inner) == 0.0 ? (int)l : -1;
}

/* Of a block of faces; pointers to where it begins in the patch. */
struct viscous_plain {
    double per_h, mu2, iso;  /* 2 mu, zeta - 2/3 mu */
    const double *u;         /* through the faces */
    const double *across[2]; /* the velocities along them */
    size_t aside[2];         /* from a cell to the next in their directions, and 1/(2 h); 0: no such axis */
    double per_2h[2];
    enum viscous_plain_sum { VISCOUS_PLAIN_PLANE, VISCOUS_PLAIN_SPACE, VISCOUS_PLAIN_LAST } sum; /* of div u */
};

/* The mean of the slopes of both cells along a face. */
static inline double viscous_plain_slope(const double *a, size_t step, size_t t, double per)
{
    return 0.5 * ((a[t] - *(a - t)) * per + (a[step + t] - *(a + step - t)) * per);
}

/* A row of faces; which sum div u is comes from outside, so that no loop asks: of one or two axes, of three, of three
 * with the normal last, whose derivative is added last. */
static inline __attribute__((always_inline)) void viscous_plain_row(size_t n, size_t step,
                                                                    const struct viscous_plain *work,
                                                                    enum viscous_plain_sum sum, size_t from,
                                                                    double *restrict momentum, double *restrict energy)
{
    const double *restrict u = work->u + from, *restrict v = work->across[0] + from,
                           *restrict w = work->across[1] + from;
    const size_t tv = work->aside[0], tw = work->aside[1];
    const double per_h = work->per_h, mu2 = work->mu2, iso = work->iso, pv = work->per_2h[0], pw = work->per_2h[1];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = u[i], b = u[i + step], m = momentum[i], e = energy[i], d = (b - a) * per_h;
        double dv = viscous_plain_slope(v + i, step, tv, pv);
        double dw = sum == VISCOUS_PLAIN_PLANE ? 0.0 : viscous_plain_slope(w + i, step, tw, pw);
        double div = sum == VISCOUS_PLAIN_LAST ? (dv + dw) + d : (d + dv) + dw, tau = mu2 * d + iso * div;
        momentum[i] = m - tau;
        energy[i] = e - tau * (0.5 * (a + b));
    }
}

static BULLA_KERNEL void viscous_plain_normal(const struct viscous_block *block, const struct viscous_plain *work,
                                              double *restrict momentum, double *restrict energy)
{
    const size_t n = block->n, step = block->step;
    for (size_t r = 0; r < block->rows; r++) {
        size_t from = r * block->patch_row, to = r * block->face_row;
        double *f = momentum + to, *e = energy + to;
        if (work->sum == VISCOUS_PLAIN_PLANE) viscous_plain_row(n, step, work, VISCOUS_PLAIN_PLANE, from, f, e);
        else if (work->sum == VISCOUS_PLAIN_LAST) viscous_plain_row(n, step, work, VISCOUS_PLAIN_LAST, from, f, e);
        else viscous_plain_row(n, step, work, VISCOUS_PLAIN_SPACE, from, f, e);
    }
}

/* v along the faces; t, per: in its direction, along which u has a slope. */
static BULLA_KERNEL void viscous_plain_shear(const struct viscous_block *block, const struct viscous_plain *work,
                                             const double *restrict v, size_t t, double per, double *restrict momentum,
                                             double *restrict energy)
{
    const double *restrict u = work->u;
    const size_t n = block->n, step = block->step, row = block->patch_row;
    const double per_h = work->per_h, mu2 = work->mu2;
    for (size_t r = 0; r < block->rows; r++, u += row, v += row) {
#pragma omp simd
        for (size_t i = 0; i < n; i++) {
            double a = v[i], b = v[i + step], m = momentum[i], e = energy[i];
            double d = (b - a) * per_h, tau = mu2 * (0.5 * (d + viscous_plain_slope(u + i, step, t, per)));
            momentum[i] = m - tau;
            energy[i] = e - tau * (0.5 * (a + b));
        }
        momentum += block->face_row;
        energy += block->face_row;
    }
}

static void viscous_plain_block(const struct viscous_slopes *slopes, const struct viscous_block *block,
                                struct viscous_plain *work, struct face_work *faces)
{
    const struct model *path = slopes->tile->model;
    double *energy = faces->energy + block->face, *momentum = faces->momentum + block->face;
    work->u = viscous_slopes_velocity(slopes, (unsigned)block->axis) + block->patch;
    for (unsigned k = 0; k < 2; k++) {
        unsigned i = axis_component(block->axis, k + 1);
        work->across[k] = i < path->n_velocity ? viscous_slopes_velocity(slopes, i) + block->patch : work->u;
    }
    viscous_plain_normal(block, work, momentum, energy);
    for (unsigned k = 1; k < path->n_velocity; k++)
        viscous_plain_shear(block, work, work->across[k - 1], work->aside[k - 1], work->per_2h[k - 1],
                            momentum + k * FACE_ROOM, energy);
}

void viscous_plain_faces(const struct viscous_slopes *slopes, const struct frame *frame, unsigned l,
                         const struct viscous_block *block, struct face_work *faces)
{
    const struct model *path = slopes->tile->model;
    const struct model_viscosity *law = &path->viscosity[l];
    const double *h = slopes->tile->level->h;
    struct viscous_plain work = {.per_h = 1.0 / h[frame->axis],
                                 .mu2 = 2.0 * law->mu.number,
                                 .iso = law->zeta - 2.0 / 3.0 * law->mu.number,
                                 .sum = path->dim < 3      ? VISCOUS_PLAIN_PLANE
                                        : frame->axis == 2 ? VISCOUS_PLAIN_LAST
                                                           : VISCOUS_PLAIN_SPACE};
    for (unsigned k = 0; k < 2; k++) {
        unsigned i = axis_component(frame->axis, k + 1);
        work.aside[k] = i < (unsigned)path->dim ? slopes->stride[i] : 0;
        work.per_2h[k] = i < (unsigned)path->dim ? 0.5 / h[i] : 0.0;
    }
    viscous_plain_block(slopes, block, &work, faces);
}
