/* viscous_strain.c - see viscous_strain.h. Loops over components are those of n_velocity, which may be more than the axes:
 * derivatives along axes that are not there are 0 and are not stored. */
#include "scheme/viscous_strain.h"

#include "phys/elastic.h"
#include "phys/row.h"

#include <math.h>
#include <string.h>

static BULLA_KERNEL void viscous_strain_mean(size_t n, const double *restrict a, const double *restrict b,
                                             double *restrict mean)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) mean[i] = 0.5 * (a[i] + b[i]);
}

static BULLA_KERNEL void viscous_strain_half(size_t n, const double *restrict a, double *restrict half)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) half[i] = 0.5 * a[i];
}

/* sum += f a */
static BULLA_KERNEL void viscous_strain_add(size_t n, double f, const double *restrict a, double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = sum[i];
        sum[i] = s + f * a[i];
    }
}

/* sum += f a b */
static BULLA_KERNEL void viscous_strain_add_product(size_t n, double f, const double *restrict a,
                                                    const double *restrict b, double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = sum[i];
        sum[i] = s + f * (a[i] * b[i]);
    }
}

static void viscous_strain_tensor(struct viscous_strain *strain)
{
    unsigned dim = (unsigned)strain->path->dim, n_velocity = strain->path->n_velocity;
    for (unsigned i = 0; i < n_velocity; i++)
        for (unsigned j = 0; j <= i; j++) {
            double *D = strain->D[elastic_component(i, j)];
            if (j >= dim) memset(D, 0, strain->n * sizeof *D);
            else if (i >= dim) viscous_strain_half(strain->n, strain->gradient[i][j], D);
            else if (i == j) memcpy(D, strain->gradient[i][i], strain->n * sizeof *D);
            else viscous_strain_mean(strain->n, strain->gradient[i][j], strain->gradient[j][i], D);
        }
    memcpy(strain->div, strain->gradient[0][0], strain->n * sizeof *strain->div);
    for (unsigned d = 1; d < dim; d++) viscous_strain_add(strain->n, 1.0, strain->gradient[d][d], strain->div);
    if (strain->path->beta) viscous_strain_add(strain->n, strain->path->beta, strain->hoop, strain->div);
}

/* 1/sqrt(g^2 + flat^2), or 0 where g is a thousandth of flat: then m is 0 to the bit whether or not there is an interface
 * elsewhere. */
static BULLA_KERNEL void viscous_strain_scale(size_t n, double flat2, double *restrict g2)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double g = g2[i], scale = 1.0 / sqrt(g + flat2);
        g2[i] = g > 1e-6 * flat2 ? scale : 0.0;
    }
}

static BULLA_KERNEL void viscous_strain_times(size_t n, const double *restrict scale, double *restrict a)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) a[i] *= scale[i];
}

/* m from the gradient of the colour, and what it makes of D. */
static void viscous_strain_normal(struct viscous_strain *strain, double h)
{
    unsigned dim = (unsigned)strain->path->dim;
    double scale[STRAIN_POINTS] = {0};
    strain->interface = false;
    if (!strain->path->n_alpha) return;
    for (unsigned e = 0; e < dim; e++)
        viscous_strain_add_product(strain->n, 1.0, strain->colour[e], strain->colour[e], scale);
    viscous_strain_scale(strain->n, STRAIN_FLAT * STRAIN_FLAT / (h * h), scale);
    strain->interface = row_most(strain->n, scale) > 0.0;
    if (!strain->interface) return;
    memset(strain->normal, 0, strain->n * sizeof *strain->normal);
    memset(strain->sharp, 0, strain->n * sizeof *strain->sharp);
    for (unsigned e = 0; e < dim; e++) viscous_strain_times(strain->n, scale, strain->colour[e]);
    for (unsigned i = 0; i < strain->path->n_velocity; i++) {
        memset(strain->along[i], 0, strain->n * sizeof *strain->along[i]);
        for (unsigned e = 0; e < dim; e++)
            viscous_strain_add_product(strain->n, 1.0, strain->D[elastic_component(i, e)], strain->colour[e],
                                       strain->along[i]);
    }
    for (unsigned e = 0; e < dim; e++) {
        viscous_strain_add_product(strain->n, 1.0, strain->colour[e], strain->along[e], strain->normal);
        viscous_strain_add_product(strain->n, 1.0, strain->colour[e], strain->colour[e], strain->sharp);
    }
}

void viscous_strain_make(struct viscous_strain *strain, double h)
{
    viscous_strain_tensor(strain);
    viscous_strain_normal(strain, h);
}

/* D:D, the hoop included. What the exchange of x and y exchanges is added up first. */
static void viscous_strain_square(const struct viscous_strain *strain, double *sum)
{
    const struct model *path = strain->path;
    double crossed[STRAIN_POINTS];
    memset(sum, 0, strain->n * sizeof *sum);
    memset(crossed, 0, strain->n * sizeof *crossed);
    for (unsigned i = 0; i < path->n_velocity; i++)
        viscous_strain_add_product(strain->n, 1.0, strain->D[i], strain->D[i], sum);
    for (unsigned i = path->n_velocity; i-- > 1;)
        for (unsigned j = 0; j < i; j++) {
            const double *D = strain->D[elastic_component(i, j)];
            viscous_strain_add_product(strain->n, 2.0, D, D, crossed);
        }
    viscous_strain_add(strain->n, 1.0, crossed, sum);
    if (path->beta) viscous_strain_add_product(strain->n, path->beta, strain->hoop, strain->hoop, sum);
}

static BULLA_KERNEL void viscous_strain_root(size_t n, double *restrict square)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = square[i], root = sqrt(2.0 * s);
        square[i] = s < 0.0 ? 0.0 : root;
    }
}

void viscous_strain_rate(const struct viscous_strain *strain, double *rate)
{
    viscous_strain_square(strain, rate);
    viscous_strain_add_product(strain->n, -1.0 / 3.0, strain->div, strain->div, rate);
    viscous_strain_root(strain->n, rate);
}

/* D_l = D - (1 - r) div u m m: from D:D, m D m and |m|^2. */
static BULLA_KERNEL void viscous_strain_reduce(size_t n, const double *restrict r, const double *restrict div,
                                               const double *restrict normal, const double *restrict sharp,
                                               double *restrict dev2, double *restrict dilatation)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double less = (1.0 - r[i]) * div[i], w = sharp[i], d = div[i] - w * less, old = dev2[i];
        double square = old - 2.0 * less * normal[i] + less * less * (w * w), dev = square - d * d / 3.0;
        dev2[i] = dev > 0.0 ? dev : 0.0;
        dilatation[i] = d;
    }
}

void viscous_strain_own(const struct viscous_strain *strain, const double *r, double *dev2, double *dilatation)
{
    static const double none[STRAIN_POINTS];
    viscous_strain_square(strain, dev2);
    viscous_strain_reduce(strain->n, r, strain->div, strain->interface ? strain->normal : none,
                          strain->interface ? strain->sharp : none, dev2, dilatation);
}
