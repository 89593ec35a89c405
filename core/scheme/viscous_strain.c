/* viscous_strain.c - see viscous_strain.h. Loops over components are those of n_velocity, which may be more than the
 * axes: derivatives along axes that are not there are 0 and are not stored. */
#include "scheme/viscous_strain.h"

#include "phys/elastic.h"

#include <math.h>
#include <string.h>

/* For components that are not there. */
static const double viscous_strain_none[STRAIN_POINTS];

static BULLA_KERNEL void viscous_strain_mean(size_t n, const double *restrict a, const double *restrict b,
                                             double *restrict mean)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) mean[i] = 0.5 * (a[i] + b[i]);
}

/* a + b + c + f d */
static BULLA_KERNEL void viscous_strain_sum(size_t n, const double *restrict a, const double *restrict b,
                                            const double *restrict c, double f, const double *restrict d,
                                            double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) sum[i] = ((a[i] + b[i]) + c[i]) + f * d[i];
}

/* One component, as a row. */
static const double *viscous_strain_component(struct viscous_strain *strain, unsigned i, unsigned j)
{
    const struct model *path = strain->path;
    unsigned dim = (unsigned)path->dim;
    if (i >= path->n_velocity || j >= dim) return viscous_strain_none;
    if (i == j) return strain->gradient[i][i];
    double *shear = strain->shear[elastic_component(i, j) - 3];
    viscous_strain_mean(strain->n, strain->gradient[i][j], i < dim ? strain->gradient[j][i] : viscous_strain_none,
                        shear);
    return shear;
}

static void viscous_strain_tensor(struct viscous_strain *strain)
{
    const struct model *path = strain->path;
    for (unsigned i = 0; i < 3; i++)
        for (unsigned j = 0; j <= i; j++) strain->D[elastic_component(i, j)] = viscous_strain_component(strain, i, j);
    viscous_strain_sum(strain->n, strain->D[0], strain->D[1], strain->D[2], path->beta,
                       path->beta ? strain->hoop : viscous_strain_none, strain->div);
}

/* |g|^2, and at how many points it is above a limit. */
static BULLA_KERNEL double viscous_strain_steepness(size_t n, double limit, const double *restrict a,
                                                    const double *restrict b, const double *restrict c,
                                                    double *restrict g2)
{
    double steep = 0.0;
#pragma omp simd reduction(+ : steep)
    for (size_t i = 0; i < n; i++) {
        double g = (a[i] * a[i] + b[i] * b[i]) + c[i] * c[i];
        g2[i] = g;
        steep += g > limit ? 1.0 : 0.0;
    }
    return steep;
}

/* sqrt(w)/|g|, or 0 where g is a thousandth of flat: then m is 0 to the bit whether or not there is an interface
 * elsewhere. */
static BULLA_KERNEL void viscous_strain_scale(size_t n, double flat2, double limit, double *restrict g2)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double g = g2[i], part = flat2 / g, square = part * part, scale = sqrt(1.0 / (g * (1.0 + square * square)));
        g2[i] = g > limit ? scale : 0.0;
    }
}

/* m and |m|^2 from the gradient and its scale. Rows beyond the axes are 0. */
static BULLA_KERNEL void viscous_strain_point(size_t n, const double *restrict scale,
                                              struct viscous_strain *restrict strain)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = scale[i], a = s * strain->colour[0][i], b = s * strain->colour[1][i], c = s * strain->colour[2][i];
        strain->colour[0][i] = a;
        strain->colour[1][i] = b;
        strain->colour[2][i] = c;
        strain->sharp[i] = (a * a + b * b) + c * c;
    }
}

static BULLA_KERNEL void viscous_strain_turn(size_t n, struct viscous_strain *restrict strain)
{
    const double *restrict xx = strain->D[0], *restrict yy = strain->D[1], *restrict zz = strain->D[2];
    const double *restrict xy = strain->D[3], *restrict xz = strain->D[4], *restrict yz = strain->D[5];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = strain->colour[0][i], b = strain->colour[1][i], c = strain->colour[2][i];
        double p = (xx[i] * a + xy[i] * b) + xz[i] * c, q = (xy[i] * a + yy[i] * b) + yz[i] * c,
               r = (xz[i] * a + yz[i] * b) + zz[i] * c;
        strain->along[0][i] = p;
        strain->along[1][i] = q;
        strain->along[2][i] = r;
        strain->normal[i] = (a * p + b * q) + c * r;
    }
}

void viscous_strain_across(struct viscous_strain *strain)
{
    viscous_strain_turn(strain->n, strain);
}

/* m from the gradient of the colour. */
static void viscous_strain_normal(struct viscous_strain *strain, double h)
{
    double scale[STRAIN_POINTS], flat2 = STRAIN_FLAT * STRAIN_FLAT / (h * h), limit = 1e-6 * flat2;
    int dim = strain->path->dim;
    strain->interface =
        strain->path->n_alpha &&
        viscous_strain_steepness(strain->n, limit, strain->colour[0], dim > 1 ? strain->colour[1] : viscous_strain_none,
                                 dim > 2 ? strain->colour[2] : viscous_strain_none, scale) > 0.0;
    if (!strain->interface) return;
    for (int e = dim; e < 3; e++) memset(strain->colour[e], 0, strain->n * sizeof *strain->colour[e]);
    viscous_strain_scale(strain->n, flat2, limit, scale);
    viscous_strain_point(strain->n, scale, strain);
}

void viscous_strain_make(struct viscous_strain *strain, double h)
{
    viscous_strain_tensor(strain);
    viscous_strain_normal(strain, h);
}

/* D:D, the hoop included. What the exchange of x and y exchanges is added up first. */
static BULLA_KERNEL void viscous_strain_square_of(size_t n, const double *const D[STRAIN_TENSOR], double beta,
                                                  const double *restrict hoop, double *restrict square)
{
    const double *restrict xx = D[0], *restrict yy = D[1], *restrict zz = D[2];
    const double *restrict xy = D[3], *restrict xz = D[4], *restrict yz = D[5];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double own = (xx[i] * xx[i] + yy[i] * yy[i]) + zz[i] * zz[i];
        double crossed = (xz[i] * xz[i] + yz[i] * yz[i]) + xy[i] * xy[i];
        square[i] = (own + 2.0 * crossed) + beta * (hoop[i] * hoop[i]);
    }
}

void viscous_strain_square(const struct viscous_strain *strain, double *square)
{
    const struct model *path = strain->path;
    viscous_strain_square_of(strain->n, strain->D, path->beta, path->beta ? strain->hoop : viscous_strain_none, square);
}

static BULLA_KERNEL void viscous_strain_root(size_t n, const double *restrict square, const double *restrict div,
                                             double *restrict rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double d = div[i], s = square[i] - 1.0 / 3.0 * (d * d), root = sqrt(2.0 * s);
        rate[i] = s < 0.0 ? 0.0 : root;
    }
}

void viscous_strain_rate(const struct viscous_strain *strain, const double *square, double *rate)
{
    viscous_strain_root(strain->n, square, strain->div, rate);
}

/* D_l = D - (1 - r) div u m m: D_l:D_l from D:D, m D m and |m|^2. */
static BULLA_KERNEL void viscous_strain_reduce(size_t n, const struct viscous_strain *restrict strain,
                                               const double *restrict square, const double *restrict r,
                                               double *restrict ret_square, double *restrict dilatation)
{
    const double *restrict div = strain->div, *restrict normal = strain->normal, *restrict sharp = strain->sharp;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double less = (1.0 - r[i]) * div[i], w = sharp[i];
        dilatation[i] = div[i] - w * less;
        ret_square[i] = square[i] - 2.0 * less * normal[i] + less * less * (w * w);
    }
}

void viscous_strain_own(const struct viscous_strain *strain, const double *square, const double *r, double *ret_square,
                        double *dilatation)
{
    viscous_strain_reduce(strain->n, strain, square, r, ret_square, dilatation);
}
