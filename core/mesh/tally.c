/* tally.c - see tally.h. */
#include "mesh/tally.h"

#include "base/account.h"
#include "base/comm.h"
#include "base/mem.h"
#include "mesh/metric.h"

#include <math.h>

enum { TALLY_LANES = 8 };

bool tally_is_covered(const struct mesh *mesh, const struct tile *tile)
{
    return tile->covered == (1u << (1u << mesh->dim)) - 1u;
}

void tally_volumes(const struct mesh *mesh, const struct level *level, const struct tile *tile, double *ret_volume)
{
    metric_volumes(mesh, level, tile, ret_volume);
    if (!tile->covered) return;
    double *leaf = mem_new(mesh->n_cell, sizeof *leaf);
    mesh_leaves(mesh, tile, leaf);
    for (size_t i = 0; i < mesh->n_cell; i++) ret_volume[i] *= leaf[i];
    mem_free(leaf);
}

double tally_row(size_t n, const double *a, const double *b)
{
    double lane[TALLY_LANES] = {0};
    size_t whole = n - n % TALLY_LANES;
    for (size_t i = 0; i < whole; i += TALLY_LANES)
        for (size_t j = 0; j < TALLY_LANES; j++) lane[j] += a[i + j] * b[i + j];
    for (size_t i = whole; i < n; i++) lane[i - whole] += a[i] * b[i];
    return ((lane[0] + lane[4]) + (lane[2] + lane[6])) + ((lane[1] + lane[5]) + (lane[3] + lane[7]));
}

void tally_extremes(size_t n, const double *values, const double *a, const double *b, double ret_extremes[2])
{
    double most[TALLY_LANES], least[TALLY_LANES];
    for (size_t j = 0; j < TALLY_LANES; j++) most[j] = least[j] = -INFINITY;
    for (size_t i = 0; i < n; i += TALLY_LANES)
        for (size_t j = 0; j < TALLY_LANES && i + j < n; j++) {
            bool counts = (a[i + j] >= 0.5) & (b[i + j] >= 0.5);
            double up = counts ? values[i + j] : -INFINITY, down = counts ? -values[i + j] : -INFINITY;
            most[j] = up > most[j] ? up : most[j];
            least[j] = down > least[j] ? down : least[j];
        }
    for (size_t j = 0; j < TALLY_LANES; j++) {
        if (most[j] > ret_extremes[0]) ret_extremes[0] = most[j];
        if (least[j] > ret_extremes[1]) ret_extremes[1] = least[j];
    }
}

size_t tally_tiles(const struct mesh *mesh)
{
    size_t tiles = 0;
    for (int l = 0; l < mesh->n_level; l++) tiles += mesh->levels[l].n_local;
    return tiles;
}

void tally_add(const struct mesh *mesh, unsigned n_value, const double *local, double *ret_totals)
{
    size_t tiles = tally_tiles(mesh);
    struct account *sums = mem_new(n_value, sizeof *sums);
    for (unsigned q = 0; q < n_value; q++) {
        for (size_t i = 0; i < tiles; i++) account_add(&sums[q], local[i * n_value + q]);
        account_carry(&sums[q]);
    }
    comm_sum_counts((long long *)sums, (int)n_value * ACCOUNT_NUMBERS);
    for (unsigned q = 0; q < n_value; q++) ret_totals[q] = account_value(&sums[q]);
    mem_free(sums);
}
