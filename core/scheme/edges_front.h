/* edges_front.h - with what temperature liquid comes through the surface, for pairs with an `onset`.
 *
 * The liquid behind the surface of heat (conduction_front.h) is at saturation, a plateau, whose limited slope is 0.
 * While the surface crosses a cell that liquid flows on into the cell before; at saturation it would take a layer of
 * cold h thick with it, whose heat evaporates a second time. The surface lies d cells behind the centre of the cell
 * before, d <= 1, and the face half a cell: there the straight line from saturation at the surface to the density of
 * the cell before has come by the part 1 - 1/(2 d) of the difference. With that density the liquid of the cell behind
 * leaves it. Where the surface lies before the face, d <= 1/2, it is saturated. Edges stay between the cells. */
#ifndef EDGES_FRONT_H
#define EDGES_FRONT_H

#include "phys/model.h"

#include <stddef.h>

/* A row of n cells that have edges, `step` apart along the axis. */
struct edges_front {
    const struct model *model;
    size_t n, step, pitch;
    const double *w; /* primitives of the first, component q at q pitch */
    double *state;   /* their edges: upper ones of component q at 2 q pitch, lower ones n behind */
    double *thin;    /* [n] to work with */
};

/* Puts the densities of liquids where a surface lies between two cells. */
void edges_front(const struct edges_front *row);

#endif
