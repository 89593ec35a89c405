/* measure.h - the numbers of a history: volumes, means, extremes, ... of the present state.
 *
 * Only leaves count: cells that no finer tile covers.
 * What each measure is (V: whole cell volumes, 2 pi and 4 pi included; f: covered fraction of the
 * cell by `where`, 1 without it; a: volume fraction of the material, b: of the material `in`):
 *   volume              sum a b f V
 *   mass                sum m_l b f V; without a material: of all
 *   centroid            sum a x b f V / sum a b f V; x: centroid of the cell along `along`
 *   mean, integral      sum q b f V (/ sum b f V)
 *   plane-integral      sum q b f S, S the product of the sides of a cell (dr dz in axisymmetric scenes)
 *   total               sum of rho, rho u_i or rho E times b f V
 *   min, max            of q over the cells with b >= 0.5 and f >= 0.5
 *   equivalent-radius   of the ball (axisymmetric, spherical, 3D), disc (2D) or half-width (1D) with
 *                       that volume
 *   penetration         how far line_crossing along `along` has moved into the material since the measures
 *                       were made; negative: the material has been pulled out
 *   jet-speed           velocity along `along` of largest magnitude, with its sign, over the cells
 *                       with a >= 0.5 (b, f likewise)
 *   outside             number of cells with b f > 0 where outside_count finds the material's law left
 *   evaporated          evaporate_total of the vapour, over the whole domain
 *   min-between, max-between, value   not measured: history.c
 *   isosurface-mean     surface_mean of q on b = 0.5
 *   isosurface-min, isosurface-max   surface_extremes of it
 * Cells in which q says nothing (derive_material) take no part in means and extremes.
 * q of a vector field is its magnitude. `along` that is not given is the last axis. An empty set
 * gives NaN. Sums are the same on any number of ranks (tally.h). */
#ifndef MEASURE_H
#define MEASURE_H

#include "derive/derive.h"
#include "io/notes.h"
#include "solve/state.h"

struct measures;

/* Looks fields up (STATUS_CASE for an unknown one, naming the column) and notes where materials
 * end now. Collective. */
int measure_new(const struct state *state, struct measures **ret_measures);
void measure_free(struct measures *measures); /* NULL is fine */

/* Notes what columns carry from step to step (where materials ended at the start), and takes it back. */
void measure_keep(const struct measures *measures, struct notes *notes);
void measure_recall(struct measures *measures, const struct notes *notes);

/* One number per column of the scene, NaN for columns that are not measured; equal on all ranks. Only columns with
 * `wanted` (NULL: all) are looked at, the others are NaN too. At a moment inside a step of level 0 (moment->base above
 * 0) levels below the base count as they stand at the end of their own steps; what they add up to is kept from look to
 * look. Collective. */
void measure_take(struct measures *measures, const struct state *state, struct derive_moment *moment,
                  const bool *wanted, double *ret_values);

/* Instead of a look: the levels from `base` on have gone on. */
void measure_pass(struct measures *measures, int base);

#endif
