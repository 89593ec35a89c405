/* update.h - from fluxes to the rate of change of a tile, and from rates to a new state.
 *
 * Rates are blocks of n_field components of n_cell, then one more: div u. Geometry enters here
 * alone (model.md 4): exact areas and volumes of metric.h; the radial momentum sees p relative to
 * the cell's own pressure, so that the hoop term beta p / r is balanced and a state at rest
 * stays at rest to round-off. */
#ifndef UPDATE_H
#define UPDATE_H

#include "mesh/metric.h"
#include "phys/face.h"

/* Adds the divergence of the fluxes of one piece to the rates of its cells. w: the tile's primitives. */
void update_add(const struct model *model, const struct level *level, const struct metric *metric,
                const struct frame *frame, const struct face_work *work, size_t n_cell, const double *w, double *rates);

/* Blocks of a tile that a stage combines. */
struct update_input {
    const double *u_old;
    const double *w; /* primitives at which the rates were taken */
    const double *K; /* K_l of mix_closure, blocks of n_alpha; zeros for the Allaire closure */
    const double *rates;
};

/* u_new = u_old + dt * rates, the non-conservative terms of alpha included (model.md 2). Volume
 * fractions are kept in [0, 1] and at sum 1; K may not push one below UPDATE_LEAST. Returns
 * the number of cells in which a bound acted. */
size_t update_apply(const struct model *model, size_t n_cell, double dt, const struct update_input *in, double *u_new);

#define UPDATE_LEAST 1e-9

#endif
