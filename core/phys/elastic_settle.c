/* elastic_settle.c - stretches that were averaged or interpolated become stretches again; see elastic.h. */
#include "phys/elastic.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { SETTLE_BATCH = 128 };

/* Is det V = 1 up to the rounding of its own terms? */
static bool settle_is_unimodular(const struct model *model, size_t stride, const double *V)
{
    double at[6] = {0};
    for (unsigned c = 0; c < model->n_stretch; c++) at[c] = V[c * stride];
    double xx = at[ELASTIC_XX], yy = at[ELASTIC_YY], zz = at[ELASTIC_ZZ];
    double xy = at[ELASTIC_XY], xz = at[ELASTIC_XZ], yz = at[ELASTIC_YZ];
    double det = (xx * yy - xy * xy) * zz + (2.0 * (xy * xz * yz) - (xx * yz * yz + yy * xz * xz));
    double size = (fabs(xx * yy) + xy * xy) * fabs(zz) + (2.0 * fabs(xy * xz * yz) + fabs(xx * yz * yz + yy * xz * xz));
    return fabs(det - 1.0) <= 8.0 * DBL_EPSILON * size;
}

/* det V = 1 of n <= SETTLE_BATCH points; those that have it already keep their bits. */
static void settle_batch(const struct model *model, size_t n, size_t stride, double *V)
{
    double before[6][SETTLE_BATCH];
    bool keep[SETTLE_BATCH], all = true;
    for (size_t i = 0; i < n; i++) {
        keep[i] = settle_is_unimodular(model, stride, V + i);
        all = all && keep[i];
    }
    if (all) return;
    for (unsigned c = 0; c < model->n_stretch; c++) memcpy(before[c], V + c * stride, n * sizeof *V);
    elastic_unimodular(model, n, stride, V);
    for (unsigned c = 0; c < model->n_stretch; c++)
        for (size_t i = 0; i < n; i++)
            if (keep[i]) V[c * stride + i] = before[c][i];
}

void elastic_settle(const struct model *model, size_t n, size_t stride, double *fields)
{
    double *V = fields + model->i_V * stride;
    if (!model->n_stretch) return;
    for (size_t from = 0; from < n; from += SETTLE_BATCH)
        settle_batch(model, n - from < SETTLE_BATCH ? n - from : SETTLE_BATCH, stride, V + from);
    if (model->n_alpha) elastic_fade(model, n, stride, fields + model->i_alpha * stride, V);
}
