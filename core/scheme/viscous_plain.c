/* viscous_plain.c - see viscous_plain.h. One pass per component of the momentum. Sums are in the order of
 * viscous_strain.c and viscous_mix.c; halves and doubles are exact, wherever they stand. */
#include "scheme/viscous_plain.h"

#include "phys/coefficient.h"

bool viscous_plain_is(const struct model *path)
{
    return path->n_material == 1 && !path->beta && !coefficient_sees_rate(&path->viscosity[0].mu) &&
           !coefficient_sees_state(&path->viscosity[0].mu);
}

/* For axes that are not there. */
static const double viscous_plain_none[FACE_ROOM];

/* Rows of cells around n faces: u through the faces, slopes along them of the velocities along them. */
struct viscous_plain {
    size_t n, step;
    double per_h, mu2, iso; /* 2 mu, zeta - 2/3 mu */
    const double *u, *across[2];
    bool last; /* the normal is the last of three axes: its derivative is added last */
};

static BULLA_KERNEL void viscous_plain_normal(const struct viscous_plain *work, double *restrict momentum,
                                              double *restrict energy)
{
    const double *restrict u = work->u, *restrict v = work->across[0], *restrict w = work->across[1];
    const size_t step = work->step;
    const double per_h = work->per_h, mu2 = work->mu2, iso = work->iso;
    const bool last = work->last;
#pragma omp simd
    for (size_t i = 0; i < work->n; i++) {
        double a = u[i], b = u[i + step], m = momentum[i], e = energy[i];
        double d = (b - a) * per_h, dv = 0.5 * (v[i] + v[i + step]), dw = 0.5 * (w[i] + w[i + step]);
        double div = last ? (dv + dw) + d : (d + dv) + dw;
        double tau = mu2 * d + iso * div;
        momentum[i] = m - tau;
        energy[i] = e - tau * (0.5 * (a + b));
    }
}

/* v along the faces; slope: of u along v. */
static BULLA_KERNEL void viscous_plain_shear(const struct viscous_plain *work, const double *restrict v,
                                             const double *restrict slope, double *restrict momentum,
                                             double *restrict energy)
{
    const size_t step = work->step;
    const double per_h = work->per_h, mu2 = work->mu2;
#pragma omp simd
    for (size_t i = 0; i < work->n; i++) {
        double a = v[i], b = v[i + step], m = momentum[i], e = energy[i];
        double d = (b - a) * per_h, other = 0.5 * (slope[i] + slope[i + step]);
        double tau = mu2 * (0.5 * (d + other));
        momentum[i] = m - tau;
        energy[i] = e - tau * (0.5 * (a + b));
    }
}

void viscous_plain_faces(const struct viscous_slopes *slopes, const struct frame *frame, struct face_work *faces)
{
    const struct term_tile *tile = slopes->tile;
    const struct model *path = tile->model;
    const struct model_viscosity *law = &path->viscosity[0];
    size_t shift = frame_reach(frame);
    unsigned axis = (unsigned)frame->axis, dim = (unsigned)path->dim;
    struct viscous_plain work = {.n = frame_edged(frame) - frame->inner,
                                 .step = frame->inner,
                                 .per_h = 1.0 / tile->level->h[axis],
                                 .mu2 = 2.0 * law->mu.number,
                                 .iso = law->zeta - 2.0 / 3.0 * law->mu.number,
                                 .u = viscous_slopes_row(slopes, axis, 0) + shift,
                                 .across = {viscous_plain_none, viscous_plain_none},
                                 .last = axis == 2};
    for (unsigned k = 1; k < dim; k++)
        work.across[k - 1] = viscous_slopes_row(slopes, axis_component(frame->axis, k), k) + shift;
    viscous_plain_normal(&work, faces->momentum, faces->energy);
    for (unsigned d = 1; d < path->n_velocity; d++) {
        unsigned i = axis_component(frame->axis, d);
        const double *slope = i < dim ? viscous_slopes_row(slopes, axis, d) + shift : viscous_plain_none;
        viscous_plain_shear(&work, viscous_slopes_row(slopes, i, 0) + shift, slope, faces->momentum + d * FACE_ROOM,
                            faces->energy);
    }
}
