/* weno5_z.c - the weighted mean of three parabolas over five cells, with the global indicator of Borges et al.
 *
 * With the differences d1 = b - a, d2 = c - b, d3 = d - c, d4 = e - d of the cells a .. e, the parabolas through (a, b,
 * c), (b, c, d) and (c, d, e) are at the upper edge of c
 *     c + (5 d2 - 2 d1)/6,   c + (d2 + 2 d3)/6,   c + (4 d3 - d4)/6
 * with the ideal weights 1/10, 6/10, 3/10, each times 1 + (tau/(beta + eps))^2, tau = |beta_0 - beta_2|. The lower edge
 * is that of the mirrored cells. In differences equal cells give their value to the bit, and mirrored ones mirrored
 * edges. eps only keeps 0/0 away.
 *
 * Beside interfaces of materials everything has limited slopes, unless the case says otherwise: parabolas through two
 * materials make strong shocks ring there (docs/verification.md). */
#include "bulla/reconstruction.h"

#include <math.h>
#include <stdlib.h>

#define WENO_EPSILON 1e-40

/* A fraction that varies by more than this makes an interface. */
#define WENO_TRACE 1e-6

enum { WENO_BLOCK = 128 }; /* cells at a time */

struct weno_values {
    int fractions; /* is the scheme for fractions too? */
};

/* 1 + (tau/beta)^2. */
static inline double weno5_z_weight(double tau, double beta)
{
    double ratio = tau / (beta + WENO_EPSILON);
    return 1.0 + ratio * ratio;
}

/* From a cell to its upper edge; z0 belongs to the parabola that looks furthest down. */
static inline double weno5_z_step(double d1, double d2, double d3, double d4, double z0, double z1, double z2)
{
    double a0 = z0, a1 = 6.0 * z1, a2 = 3.0 * z2;
    double sum = (a0 * (5.0 * d2 - 2.0 * d1) + a1 * (d2 + 2.0 * d3)) + a2 * (4.0 * d3 - d4);
    return sum / (6.0 * (a0 + a1 + a2));
}

static inline double weno5_z_beta(double curve, double slope)
{
    return 13.0 / 12.0 * (curve * curve) + 0.25 * (slope * slope);
}

BULLA_KERNEL static void weno5_z_edges(size_t n, size_t step, const double *w, double *BULLA_RESTRICT lower,
                                       double *BULLA_RESTRICT upper)
{
    const double *wa = w - 2 * step, *wb = w - step, *wd = w + step, *we = w + 2 * step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = wa[i], b = wb[i], c = w[i], d = wd[i], e = we[i];
        double d1 = b - a, d2 = c - b, d3 = d - c, d4 = e - d;
        double beta0 = weno5_z_beta(d2 - d1, 3.0 * d2 - d1), beta1 = weno5_z_beta(d3 - d2, d2 + d3);
        double beta2 = weno5_z_beta(d4 - d3, 3.0 * d3 - d4), tau = fabs(beta0 - beta2);
        double z0 = weno5_z_weight(tau, beta0), z1 = weno5_z_weight(tau, beta1), z2 = weno5_z_weight(tau, beta2);
        lower[i] = c - weno5_z_step(d4, d3, d2, d1, z2, z1, z0);
        upper[i] = c + weno5_z_step(d1, d2, d3, d4, z0, z1, z2);
    }
}

/* 1 where a fraction varies over the five cells, added up over fractions. */
BULLA_KERNEL static void weno5_z_mix(size_t n, size_t step, const double *w, double *BULLA_RESTRICT mixed)
{
    const double *wa = w - 2 * step, *wb = w - step, *wd = w + step, *we = w + 2 * step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = wa[i], b = wb[i], c = w[i], d = wd[i], e = we[i], was = mixed[i];
        double spread = (fabs(a - c) + fabs(e - c)) + (fabs(b - c) + fabs(d - c));
        mixed[i] = was + (spread > WENO_TRACE ? 1.0 : 0.0);
    }
}

BULLA_KERNEL static void weno5_z_choose(size_t n, const double *BULLA_RESTRICT mixed,
                                        const double *BULLA_RESTRICT limited, double *BULLA_RESTRICT edge)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double m = mixed[i], a = limited[i], b = edge[i];
        edge[i] = m > 0.0 ? a : b;
    }
}

/* Limited edges beside interfaces, of n cells from `from`. */
static void weno5_z_yield(const struct bulla_cells *cells, size_t from, size_t n)
{
    double mixed[WENO_BLOCK] = {0.0}, lower[WENO_BLOCK], upper[WENO_BLOCK], any = 0.0;
    for (uint32_t l = 0; l < cells->n_alpha; l++)
        weno5_z_mix(n, cells->step, cells->w[cells->i_alpha + l] + from, mixed);
    for (size_t i = 0; i < n; i++) any += mixed[i];
    for (uint32_t q = cells->i_rho; any > 0.0 && q < cells->n_row; q++) {
        const struct bulla_limited *limited = cells->limited[q];
        limited->edges(limited, n, cells->step, cells->w[q] + from, lower, upper);
        weno5_z_choose(n, mixed, lower, cells->lower[q] + from);
        weno5_z_choose(n, mixed, upper, cells->upper[q] + from);
    }
}

static void weno5_z_all(const void *self, const struct bulla_cells *cells)
{
    const struct weno_values *values = self;
    for (uint32_t q = 0; q < cells->n_row; q++) {
        const struct bulla_limited *limited = cells->limited[q];
        int fraction = q - cells->i_alpha < cells->n_alpha;
        if (fraction && !values->fractions)
            limited->edges(limited, cells->n, cells->step, cells->w[q], cells->lower[q], cells->upper[q]);
        else weno5_z_edges(cells->n, cells->step, cells->w[q], cells->lower[q], cells->upper[q]);
    }
    for (size_t from = 0; cells->n_alpha && !values->fractions && from < cells->n; from += WENO_BLOCK)
        weno5_z_yield(cells, from, cells->n - from < WENO_BLOCK ? cells->n - from : WENO_BLOCK);
}

static const struct bulla_reconstruction weno5_z_table = {.size = sizeof(struct bulla_reconstruction),
                                                          .layers = 3,
                                                          .all = weno5_z_all};

static const struct bulla_param weno5_z_params[] = {
    {.name = "fractions",
     .type = BULLA_CHOICE,
     .choices = "limited|weno",
     .doc = "what interfaces of materials get: limited slopes, of all components, or the scheme itself, fractions too"},
    {0},
};

static int weno5_z_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct weno_values *self = malloc(sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    self->fractions = values[0].text[0] == 'w';
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "reconstruction",
    .name = "weno5-z",
    .version = "1.0",
    .doc = "Three parabolas over five cells, weighted by smoothness: little dissipation in smooth flow, about twice "
           "the work "
           "per face. Best with cfl of 0.3 or less.",
    .cite = "Borges, Carmona, Costa & Don, J. Comput. Phys. 227 (2008) 3191-3211, equations 25 and 28 with the power 2",
    .params = weno5_z_params,
    .open = weno5_z_open,
    .close = free,
    .table = &weno5_z_table,
};
