/* elastic_settle.c - whose a stretch is, how much of it stays where there is little solid, and how those that were
 * averaged or interpolated become stretches again; see elastic.h. */
#include "phys/elastic.h"

#include "phys/elastic_tensor.h"
#include "phys/row.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { SETTLE_BATCH = 128 };

void elastic_sum(const struct model *model, size_t n, size_t stride, const double *block, double *restrict sum)
{
    memset(sum, 0, n * sizeof *sum);
    for (unsigned s = 0; s < model->n_solid; s++) row_add(n, block + model->solids[s].material * stride, sum);
}

void elastic_carriers(const struct model *model, unsigned k, size_t n, size_t stride, const double *block,
                      double *restrict sum)
{
    memset(sum, 0, n * sizeof *sum);
    for (unsigned s = 0; s < model->n_solid; s++)
        if (model_carries(model, k, s)) row_add(n, block + model->solids[s].material * stride, sum);
}

void elastic_identity(const struct model *model, size_t n, size_t stride, double *V)
{
    for (unsigned c = 0; c < model->n_stretch; c++)
        for (size_t i = 0; i < n; i++) V[c * stride + i] = c < 3 ? 1.0 : 0.0;
}

/* Square of |V - 1|, component by component: weight 2 off the diagonal. */
static BULLA_KERNEL void elastic_settle_distance(size_t n, double one, double weight, const double *restrict V,
                                                 double *restrict square)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double e = V[i] - one, s = square[i];
        square[i] = s + weight * e * e;
    }
}

/* How much of V - 1 stays: 1 within the bound, 0 without solid. */
static BULLA_KERNEL void elastic_settle_share(size_t n, const double *restrict alpha, double *restrict square)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double phi = alpha[i] / ELASTIC_FADE, bound = phi * phi, size = sqrt(square[i]), cut = bound / size;
        double share = size > bound ? cut : 1.0;
        square[i] = phi > 0.0 ? share : 0.0;
    }
}

static BULLA_KERNEL void elastic_settle_shrink(size_t n, double one, const double *restrict share, double *restrict V)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double v = V[i], s = share[i], less = one + s * (v - one);
        less = s < 1.0 ? less : v;
        V[i] = s > 0.0 ? less : one;
    }
}

void elastic_fade(const struct model *model, size_t n, size_t stride, const double *alpha, double *V)
{
    double share[SETTLE_BATCH];
    for (size_t from = 0; from < n; from += SETTLE_BATCH) {
        size_t part = n - from < SETTLE_BATCH ? n - from : SETTLE_BATCH;
        for (size_t i = 0; i < part; i++) share[i] = 0.0;
        for (unsigned c = 0; c < model->n_stretch; c++)
            elastic_settle_distance(part, c < 3 ? 1.0 : 0.0, c < 3 ? 1.0 : 2.0, V + c * stride + from, share);
        elastic_settle_share(part, alpha + from, share);
        for (unsigned c = 0; c < model->n_stretch; c++)
            elastic_settle_shrink(part, c < 3 ? 1.0 : 0.0, share, V + c * stride + from);
    }
}

/* What rounding can do to the components of V on the way to det V = 1: as much as to its determinant. */
static double elastic_settle_round_off(const double V[6])
{
    double xx = fabs(V[ELASTIC_XX]), yy = fabs(V[ELASTIC_YY]), zz = fabs(V[ELASTIC_ZZ]);
    double xy = fabs(V[ELASTIC_XY]), xz = fabs(V[ELASTIC_XZ]), yz = fabs(V[ELASTIC_YZ]);
    double terms = (xx * yy + xy * xy) * zz + (2.0 * (xy * (xz * yz)) + (xx * yz * yz + yy * xz * xz));
    return 2.0 * DBL_EPSILON * terms * ((xx + yy) + (zz + (xy + (xz + yz))));
}

/* The nearest stretches of det 1, up to what elastic_unimodular corrects. */
static void elastic_settle_nearest(const struct model *model, size_t n, size_t stride, double *V)
{
    for (size_t i = 0; i < n; i++) {
        double at[6] = {0};
        for (unsigned c = 0; c < model->n_stretch; c++) at[c] = V[c * stride + i];
        struct elastic_tensor to =
            elastic_tensor_nearest((struct elastic_tensor){at[0], at[1], at[2], at[3], at[4], at[5]});
        memcpy(at, (double[]){to.xx, to.yy, to.zz, to.xy, to.xz, to.yz}, sizeof at);
        for (unsigned c = 0; c < model->n_stretch; c++) V[c * stride + i] = at[c];
    }
}

/* Stretch k at n <= SETTLE_BATCH points; alpha NULL: nothing but solid. */
static void elastic_settle_batch(const struct model *model, unsigned k, size_t n, size_t stride, const double *alpha,
                                 double *V)
{
    double before[6][SETTLE_BATCH] = {{0}}, phi[SETTLE_BATCH];
    for (unsigned c = 0; c < model->n_stretch; c++) memcpy(before[c], V + c * stride, n * sizeof *V);
    if (alpha) elastic_carriers(model, k, n, stride, alpha, phi);
    if (alpha) elastic_fade(model, n, stride, phi, V);
    elastic_settle_nearest(model, n, stride, V);
    elastic_unimodular(model, n, stride, V);
    for (size_t i = 0; i < n; i++) {
        double was[6], most = 0.0;
        for (unsigned c = 0; c < 6; c++) was[c] = before[c][i];
        for (unsigned c = 0; c < model->n_stretch; c++) {
            double moved = fabs(V[c * stride + i] - was[c]);
            most = moved <= most ? most : moved; /* a NaN stays one */
        }
        if (!(most <= elastic_settle_round_off(was)) || (alpha && !(phi[i] > 0.0))) continue;
        for (unsigned c = 0; c < model->n_stretch; c++) V[c * stride + i] = was[c];
    }
}

void elastic_settle(const struct model *model, size_t n, size_t stride, double *fields)
{
    for (unsigned k = 0; k < model_stretches(model); k++)
        for (size_t from = 0; from < n; from += SETTLE_BATCH)
            elastic_settle_batch(model, k, n - from < SETTLE_BATCH ? n - from : SETTLE_BATCH, stride,
                                 model->n_alpha ? fields + model->i_alpha * stride + from : NULL,
                                 fields + model_stretch(model, k) * stride + from);
}
