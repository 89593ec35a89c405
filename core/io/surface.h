/* surface.h - a field on the interface of a material, its surface alpha = 0.5: its mean, and piece by piece. */
#ifndef SURFACE_H
#define SURFACE_H

#include "derive/derive.h"
#include "io/region.h"
#include "solve/state.h"

/* A crossing of the surface between two cells. */
struct surface_piece {
    double x[3]; /* where [m] */
    double h[3]; /* sizes of the cells there [m]; 0 beyond the dimension */
    double area, value;
};

/* Area-weighted mean of a field (prepared for the present time) on the surface; of a vector, its
 * magnitude; `where` (or NULL) restricts it to cells covered by half. A field that belongs to a material
 * (derive_material) counts with its volume fraction on both sides, and not at all where the material is absent. NaN if
 * there is no surface. Collective. */
double surface_mean(const struct state *state, unsigned material, const struct derive *field,
                    const struct region *where);

/* Least and largest value of a field there, each as surface_mean takes them; NaN if there is no surface. Collective. */
void surface_extremes(const struct state *state, unsigned material, const struct derive *field,
                      const struct region *where, double ret_ends[2]);

/* All pieces, of all ranks, in an order that does not depend on the ranks; release with mem_free. Collective. */
struct surface_piece *surface_pieces(const struct state *state, unsigned material, const struct derive *field,
                                     const struct region *where, size_t *ret_n);

#endif
