/* paint_curvature.c - see paint_curvature.h. */
#include "paint/paint_curvature.h"

#include <string.h>

void paint_curvature_size(const struct metric *metric, size_t n, double *size)
{
    for (size_t i = 0; i < n; i++) size[i] = (metric->area[i + 1] - metric->area[i]) / metric->volume[i];
}

static void paint_curvature_sign(size_t n, const double *restrict size, const double *restrict a,
                                 const double *restrict b, double *restrict kappa)
{
    for (size_t i = 0; i < n; i++) {
        double g = b[i + 1] * (a[i + 2] - a[i]) - a[i + 1] * (b[i + 2] - b[i]), s = size[i];
        double outward = g > 0.0 ? -s : 0.0;
        kappa[i] = g < 0.0 ? s : outward;
    }
}

void paint_curvature_cells(size_t n, const double *size, const double *a, const double *b, double *kappa)
{
    paint_curvature_sign(n, size, a, b, kappa);
}

/* A row of fractions with its ends repeated. */
static void paint_curvature_widen(size_t n, const double *row, double *wide)
{
    memcpy(wide + 1, row, n * sizeof *row);
    wide[0] = row[0];
    wide[n + 1] = row[n - 1];
}

void paint_curvature(const struct model *model, const struct mesh *mesh, const struct level *level,
                     const struct tile *tile, double *u)
{
    double size[METRIC_CELLS], a[METRIC_CELLS + 2], b[METRIC_CELLS + 2];
    size_t n = mesh->n_cell;
    struct metric metric;
    metric_of_tile(mesh, level, tile, &metric);
    paint_curvature_size(&metric, n, size);
    for (unsigned k = 0; k < model->n_pair; k++) {
        const struct model_pair *pair = &model->pairs[k];
        paint_curvature_widen(n, u + (model->i_alpha + pair->inside) * n, a);
        paint_curvature_widen(n, u + (model->i_alpha + pair->outside) * n, b);
        paint_curvature_cells(n, size, a, b, u + pair->i_kappa * n);
    }
}
