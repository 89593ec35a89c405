/* viscous_hold.c - see viscous_hold.h. Sums begin with what lies opposite, so that mirrors and the exchange of axes
 * keep all bits. */
#include "scheme/viscous_hold.h"

#include "phys/pick.h"
#include "phys/row.h"
#include "scheme/viscous_mix.h"

#include <string.h>

static const double viscous_hold_none[STRAIN_POINTS];

static BULLA_KERNEL void viscous_hold_add(size_t n, double number, const double *restrict alpha,
                                          const double *restrict mu_l, double *restrict mu, double *restrict fluidity,
                                          double *restrict alone)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], m = mu_l[i], sum = mu[i], f = fluidity[i], only = alone[i], fluid = viscous_mix_fluid(m);
        mu[i] = sum + a * m;
        fluidity[i] = f + a * fluid;
        alone[i] = a == 1.0 ? number : only;
    }
}

static BULLA_KERNEL void viscous_hold_lack(size_t n, const double *restrict mu, const double *restrict fluidity,
                                           const double *restrict alone, double *restrict film)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double more = mu[i] - 1.0 / fluidity[i];
        film[i] = ((alone[i] == 0.0) & (more > 0.0)) ? more : 0.0;
    }
}

void viscous_hold_fraction(const struct viscous_slopes *slopes, size_t n, const unsigned *at, size_t around, unsigned l,
                           double *alpha)
{
    unsigned others = slopes->tile->model->n_around_alpha;
    double other[STRAIN_POINTS];
    if (l) {
        pick_take(n, at, slopes->data + (l - 1) * slopes->pitch + around, alpha);
        return;
    }
    for (size_t i = 0; i < n; i++) alpha[i] = 1.0;
    for (unsigned k = 0; k < others; k++) {
        pick_take(n, at, slopes->data + k * slopes->pitch + around, other);
        row_take(n, other, alpha);
    }
    for (size_t i = 0; i < n; i++) alpha[i] = alpha[i] > 0.0 ? alpha[i] : 0.0;
}

void viscous_hold_make(const struct viscous_slopes *slopes, size_t n, const unsigned *at, size_t around,
                       const double *const *mu, unsigned c, struct viscous_hold *ret)
{
    const struct model *path = slopes->tile->model;
    double alpha[STRAIN_POINTS], fluidity[STRAIN_POINTS];
    size_t bytes = n * sizeof *alpha;
    memset(ret->mu[c], 0, bytes);
    memset(ret->alone[c], 0, bytes);
    memset(fluidity, 0, bytes);
    for (unsigned l = 0; l < path->n_material; l++) {
        unsigned of = path->first + l;
        viscous_hold_fraction(slopes, n, at, around, of, alpha);
        viscous_hold_add(n, of + 1.0, alpha, mu[l], ret->mu[c], fluidity, ret->alone[c]);
    }
    viscous_hold_lack(n, ret->mu[c], fluidity, ret->alone[c], ret->film[c]);
}

/* The lesser content of a pair, and the most of all pairs. */
static BULLA_KERNEL void viscous_hold_pair(size_t n, const double *restrict low, const double *restrict high,
                                           const double *restrict alone_low, const double *restrict alone_high,
                                           double *restrict least, double *restrict top)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = low[i], b = high[i], most = top[i], of = alone_low[i];
        int plain = (of > 0.0) & (of == alone_high[i]);
        double less = a < b ? a : b, more = a < b ? b : a;
        less = plain ? 0.0 : less;
        more = plain ? 0.0 : more;
        least[i] = less;
        top[i] = more > most ? more : most;
    }
}

/* Parts of a sum, or of `top` where that is more. */
static BULLA_KERNEL void viscous_hold_share(size_t n, const double *restrict sum, const double *restrict top,
                                            double *restrict part)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double all = sum[i] > top[i] ? sum[i] : top[i], share = part[i] / all;
        part[i] = all > 0.0 ? share : 0.0;
    }
}

void viscous_hold_weigh(const struct viscous_hold *hold, size_t n, int axis, unsigned pairs,
                        double (*weight)[STRAIN_POINTS])
{
    double sum[STRAIN_POINTS], top[STRAIN_POINTS];
    unsigned last = pairs - 1;
    memset(sum, 0, n * sizeof *sum);
    memset(top, 0, n * sizeof *top);
    for (unsigned p = 0; p <= last; p++) {
        unsigned low = viscous_hold_low(p, axis), high = low | 1u << axis;
        viscous_hold_pair(n, hold->mu[low], hold->mu[high], hold->alone[low], hold->alone[high], weight[p], top);
    }
    for (unsigned p = 0; p <= last / 2; p++)
        row_add_both(n, weight[p], last ? weight[last - p] : viscous_hold_none, sum);
    for (unsigned p = 0; p <= last; p++) viscous_hold_share(n, sum, top, weight[p]);
}

/* What a mixed cell holds. */
static BULLA_KERNEL void viscous_hold_own(size_t n, const double *restrict mu, const double *restrict alone,
                                          double *restrict ret)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double own = mu[i];
        ret[i] = alone[i] > 0.0 ? 0.0 : own;
    }
}

void viscous_hold_ring(const struct viscous_hold *hold, size_t n, unsigned corners, double (*weight)[STRAIN_POINTS])
{
    double sum[STRAIN_POINTS];
    memset(sum, 0, n * sizeof *sum);
    for (unsigned c = 0; c < corners; c++) {
        if (hold) viscous_hold_own(n, hold->mu[c], hold->alone[c], weight[c]);
        for (size_t i = 0; !hold && i < n; i++) weight[c][i] = 1.0;
    }
    for (unsigned side = 0; side < 2; side++)
        row_add_both(n, weight[side], corners > 2 ? weight[side + 2] : viscous_hold_none, sum);
    for (unsigned c = 0; c < corners; c++) viscous_hold_share(n, sum, viscous_hold_none, weight[c]);
}
