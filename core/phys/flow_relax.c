/* flow_relax.c - see flow_relax.h.
 *
 * r falls as exp(-t/tau) but for g, which is 1 at small strain. So the unknown is q = r exp(t/tau), which then stays 1:
 * dq/dt = q (1 - g(r))/tau. The exponentials are those of a whole batch. */
#include "phys/flow_relax.h"

#include "phys/elastic.h"
#include "phys/flow_curve.h"

#include <math.h>

enum { RELAX_BATCH = 256 };

/* Part of a relaxation time that is one step of second order: its cube is beside that of the motion. */
#define RELAX_SHORT 0.03125

/* Relaxation times after which nothing is left that a double could hold. */
#define RELAX_GONE 40.0

/* J1 and J2. */
#define RELAX_OPEN(nv)                                                                             \
    static BULLA_KERNEL void relax_open_##nv(size_t n, struct elastic_rows V, double *restrict J1, \
                                             double *restrict J2)                                  \
    {                                                                                              \
        ELASTIC_LOCAL(V);                                                                          \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                         \
        {                                                                                          \
            struct elastic_tensor B = elastic_tensor_square(ELASTIC_AT(i, nv));                    \
            J1[i] = (B.xx - 1.0) + ((B.yy - 1.0) + (B.zz - 1.0));                                  \
            J2[i] = elastic_tensor_trace(elastic_tensor_cofactors(B)) - 3.0;                       \
        }                                                                                          \
    }
RELAX_OPEN(1)
RELAX_OPEN(2)
RELAX_OPEN(3)

/* g^3 at r. */
static ELASTIC_BODY double flow_relax_cube(double r, double J1, double J2)
{
    double rest = 1.0 - r;
    return 1.0 + r * rest * (r * J1 + rest * J2);
}

/* q (1 - g), which sets the pace; 0 to the bit without stretch. */
static ELASTIC_BODY double flow_relax_slope(double q, double left, double J1, double J2)
{
    double cube = flow_relax_cube(q * left, J1, J2), per = elastic_tensor_per_root(cube, 2);
    return q * (1.0 - cube * per * per);
}

/* One step of q over `h` relaxation times; left: exp(-t/tau) at its beginning, middle and end. */
static BULLA_KERNEL void flow_relax_step(size_t n, double h, const double left[3], const double *restrict J1,
                                         const double *restrict J2, double *restrict q)
{
    const double first = left[0], half = left[1], last = left[2];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double at = q[i], one = J1[i], two = J2[i];
        double a = flow_relax_slope(at, first, one, two), b = flow_relax_slope(at + 0.5 * h * a, half, one, two);
        double c = flow_relax_slope(at + 0.5 * h * b, half, one, two), d = flow_relax_slope(at + h * c, last, one, two);
        q[i] = at + (h / 6.0) * ((a + d) + 2.0 * (b + c));
    }
}

/* The same of second order, from 1, for steps of at most RELAX_SHORT. */
static BULLA_KERNEL void flow_relax_short(size_t n, double h, double half, const double *restrict J1,
                                          const double *restrict J2, double *restrict q)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) { /* nothing flows at first: r = 1 has g = 1 */
        double one = J1[i], two = J2[i];
        q[i] = 1.0 + h * flow_relax_slope(1.0, half, one, two);
    }
}

/* V of B(r). */
#define RELAX_CLOSE(nv)                                                                                 \
    static BULLA_KERNEL void relax_close_##nv(size_t n, double left, const double *restrict q,          \
                                              const double *restrict J1, const double *restrict J2,     \
                                              double *const out[6])                                     \
    {                                                                                                   \
        double *restrict xx = out[0], *restrict yy = out[1], *restrict zz = out[2];                     \
        double *restrict xy = out[3], *restrict xz = out[4], *restrict yz = out[5];                     \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                              \
        {                                                                                               \
            double r = q[i] * left, per = elastic_tensor_per_root(flow_relax_cube(r, J1[i], J2[i]), 3), \
                   part = per * per;                                                                    \
            double a = part * r * r, b = part * r * (1.0 - r), add = part + b * J2[i];                  \
            struct elastic_tensor from = {xx[i],                                                        \
                                          yy[i],                                                        \
                                          zz[i],                                                        \
                                          (nv) > 1 ? xy[(nv) > 1 ? i : 0] : 0.0,                        \
                                          (nv) > 2 ? xz[(nv) > 2 ? i : 0] : 0.0,                        \
                                          (nv) > 2 ? yz[(nv) > 2 ? i : 0] : 0.0};                       \
            struct elastic_tensor B = elastic_tensor_square(from), C = elastic_tensor_cofactors(B);     \
            B = (struct elastic_tensor){(a * (B.xx - 1.0) - b * (C.xx - 1.0)) + add,                    \
                                        (a * (B.yy - 1.0) - b * (C.yy - 1.0)) + add,                    \
                                        (a * (B.zz - 1.0) - b * (C.zz - 1.0)) + add,                    \
                                        a * B.xy - b * C.xy,                                            \
                                        a * B.xz - b * C.xz,                                            \
                                        a * B.yz - b * C.yz};                                           \
            from = (nv) == 1   ? flow_curve_root_line(B)                                                \
                   : (nv) == 2 ? flow_curve_root_plane(B)                                               \
                               : flow_curve_root_space(from, B, r);                                     \
            xx[i] = from.xx;                                                                            \
            yy[i] = from.yy;                                                                            \
            zz[i] = from.zz;                                                                            \
            if ((nv) > 1) xy[i] = from.xy;                                                              \
            if ((nv) > 2) xz[i] = from.xz;                                                              \
            if ((nv) > 2) yz[i] = from.yz;                                                              \
        }                                                                                               \
    }
RELAX_CLOSE(1)
RELAX_CLOSE(2)
RELAX_CLOSE(3)

/* q of n <= RELAX_BATCH points at the end. */
static void flow_relax_run(size_t n, double part, const double *J1, const double *J2, double *q)
{
    int steps = (int)ceil(8.0 * part);
    double h = part / steps;
    if (part <= RELAX_SHORT) flow_relax_short(n, part, exp(-0.5 * part), J1, J2, q);
    if (part <= RELAX_SHORT) return;
    for (size_t i = 0; i < n; i++) q[i] = 1.0;
    for (int k = 0; k < steps; k++) {
        const double left[3] = {exp(-k * h), exp(-(k + 0.5) * h), exp(-(k + 1) * h)};
        flow_relax_step(n, h, left, J1, J2, q);
    }
}

void flow_relax(const struct model *model, size_t n, size_t stride, double part, double *V)
{
    double J1[RELAX_BATCH], J2[RELAX_BATCH], q[RELAX_BATCH], left = exp(-part);
    if (part > RELAX_GONE) elastic_identity(model, n, stride, V);
    if (!(part > 0.0) || part > RELAX_GONE) return;
    for (size_t from = 0; from < n; from += RELAX_BATCH) {
        size_t some = n - from < RELAX_BATCH ? n - from : RELAX_BATCH;
        struct elastic_rows rows = elastic_tensor_rows(V + from, stride, model->n_stretch);
        double *out[6];
        for (unsigned c = 0; c < 6; c++) out[c] = V + (c < model->n_stretch ? c : 0) * stride + from;
        ELASTIC_CHOOSE(model->n_velocity, relax_open, some, rows, J1, J2);
        flow_relax_run(some, part, J1, J2, q);
        ELASTIC_CHOOSE(model->n_velocity, relax_close, some, left, q, J1, J2, out);
    }
}
