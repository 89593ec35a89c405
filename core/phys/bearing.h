/* bearing.h - what of a solid still bears: (1 - D)^2 of its mass, D its damage.
 *
 * The elastic energy of a damaged solid is (1 - D)^2 m e^s, and so its stress and what elasticity adds to the speeds of
 * waves are (1 - D)^2 of what they were. All of elastic.h is linear in the masses that it is given, so this is one
 * factor of the mass. A path without damage keeps the masses as they are. */
#ifndef BEARING_H
#define BEARING_H

#include "phys/elastic.h"
#include "phys/model.h"

/* m: [n_solid] rows of partial densities of the solids at n points, those of damaged solids replaced by rows of `room`
 * ([n_solid] at `pitch`). `fields`: their primitives, component q at q * stride. */
void bearing_of(const struct model *model, size_t n, size_t stride, const double *fields, size_t pitch, double *room,
                const double **m);

/* The same of conserved fields. */
void bearing_of_conserved(const struct model *model, size_t n, size_t stride, const double *fields, size_t pitch,
                          double *room, const double **m);

/* left = what of n masses bears at damage D. */
void bearing_reduce(size_t n, const double *restrict D, const double *restrict m, double *restrict left);

/* The part of a solid's mass that bears at damage D. */
static inline double bearing_part(double D)
{
    double whole = D > 0.0 ? 1.0 - D : 1.0;
    return whole > 0.0 ? whole * whole : 0.0;
}

#endif
