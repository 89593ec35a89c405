/* elastic_settle.c - stretches that were averaged or interpolated become stretches again; see elastic.h. */
#include "phys/elastic.h"

#include "phys/elastic_tensor.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { SETTLE_BATCH = 128 };

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
    double before[6][SETTLE_BATCH] = {{0}}, none[SETTLE_BATCH];
    const double *phi = alpha ? elastic_carrier(model, k, n, stride, alpha, none) : NULL;
    for (unsigned c = 0; c < model->n_stretch; c++) memcpy(before[c], V + c * stride, n * sizeof *V);
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
