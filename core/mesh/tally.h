/* tally.h - sums over the mesh that do not depend on the ranks.
 *
 * Sums are taken per tile and added up exactly, own tiles first, then ranks: no order changes a bit, and no rank hears
 * of another one's tiles.
 * Only leaves count: the cells that no finer tile covers. */
#ifndef TALLY_H
#define TALLY_H

#include "mesh/mesh.h"

/* Is there no leaf in this tile? */
bool tally_is_covered(const struct mesh *mesh, const struct tile *tile);

/* Whole volumes of the cells of a tile (metric.h), 0 under finer tiles. */
void tally_volumes(const struct mesh *mesh, const struct level *level, const struct tile *tile, double *ret_volume);

/* Sum of a[i] b[i] over a row, in an order that depends on n alone (eight interleaved sums). */
double tally_row(size_t n, const double *a, const double *b);

/* Raises ret_extremes[0] to the largest of the values, [1] to the largest of their negatives, where both
 * weights are at least 1/2. NaN values do not count. */
void tally_extremes(size_t n, const double *values, const double *a, const double *b, double ret_extremes[2]);

/* Adds per-tile values up: `local` is [local tiles of level 0, then of level 1, ...][n_value]; the
 * totals of each value, exact but for one rounding (account.h), are the same on all ranks. Collective. */
void tally_add(const struct mesh *mesh, unsigned n_value, const double *local, double *ret_totals);

/* Local tiles of all levels: rows of `local` above. */
size_t tally_tiles(const struct mesh *mesh);

#endif
