/* metric.c - areas and volumes from exact r-integrals, see metric.h.
 *
 * Face radii come from the integer cell index of the level, so that both tiles at a shared
 * face use the same bits. */
#include "mesh/metric.h"

#include <math.h>

static double metric_area(int beta, double r)
{
    return beta == 0 ? 1.0 : beta == 1 ? r : r * r;
}

static double metric_volume(int beta, double a, double b)
{
    if (beta == 0) return b - a;
    if (beta == 1) return 0.5 * (b - a) * (b + a);
    return (b - a) * (a * a + a * b + b * b) / 3.0;
}

void metric_of_cells(const struct mesh *mesh, const struct level *level, int first, int n, struct metric *ret)
{
    double h = level->h[0], lower = mesh->lower[0];
    for (int i = 0; i <= n; i++) {
        double r = lower + (first + i) * h;
        ret->area[i] = metric_area(mesh->beta, r);
        if (i == n) break;
        double next = lower + (first + i + 1) * h;
        ret->volume[i] = mesh->beta == 0 ? h : metric_volume(mesh->beta, r, next);
        ret->centre[i] = 0.5 * (r + next);
    }
    for (int i = 0; mesh->beta == 1 && i <= n; i++) {
        double r = lower + (first + i) * h, next = lower + (first + i + 1) * h;
        ret->turn_area[i] = metric_area(2, r);
        if (i < n) ret->turn_volume[i] = metric_volume(2, r, next);
    }
}

void metric_of_tile(const struct mesh *mesh, const struct level *level, const struct tile *tile, struct metric *ret)
{
    metric_of_cells(mesh, level, tile->at[0] * mesh->n[0], mesh->n[0], ret);
}

double metric_centroid(int beta, double a, double b)
{
    if (beta == 0) return 0.5 * (a + b);
    if (beta == 1) return (2.0 / 3.0) * (a * a + a * b + b * b) / (a + b);
    return 0.75 * (a + b) * (a * a + b * b) / (a * a + a * b + b * b);
}

void metric_centroids(const struct mesh *mesh, const struct level *level, const struct tile *tile, double *ret)
{
    double h = level->h[0], lower = mesh->lower[0];
    int n = mesh->n[0], first = tile->at[0] * n, all = level->extent[0] * n;
    for (int i = -1; i <= n; i++) {
        int cell = first + i, inside = cell < 0 ? -1 - cell : cell >= all ? 2 * all - 1 - cell : cell;
        double a = lower + inside * h, b = lower + (inside + 1) * h, r = metric_centroid(mesh->beta, a, b);
        if (cell < 0) r = 2.0 * lower - r;
        if (cell >= all) r = 2.0 * (lower + all * h) - r;
        ret[i + 1] = r;
    }
}

void metric_volumes(const struct mesh *mesh, const struct level *level, const struct tile *tile, double *ret_volume)
{
    struct metric metric;
    metric_of_tile(mesh, level, tile, &metric);
    double depth = metric_full(mesh->beta);
    for (int d = 1; d < mesh->dim; d++) depth *= level->h[d];
    size_t n0 = (size_t)mesh->n[0];
    for (size_t row = 0; row < mesh->n_cell; row += n0)
        for (size_t i = 0; i < n0; i++) ret_volume[row + i] = metric.volume[i] * depth;
}

double metric_full(int beta)
{
    static const double full[] = {1.0, 2.0 * M_PI, 4.0 * M_PI};
    return full[beta];
}
