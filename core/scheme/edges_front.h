/* edges_front.h - with what temperature liquid comes through the surface, for pairs with an `onset`.
 *
 * The liquid behind the surface of heat (conduction_front.h) is at saturation, a plateau, whose limited slope is 0.
 * While the surface crosses a cell that liquid flows on into the cell before; at saturation it would take a layer of
 * cold h thick with it, whose heat evaporates a second time. The surface lies d cells behind the centre of the cell
 * before, d <= 1, and the face half a cell: there the straight line from saturation at the surface to the density of
 * the cell before has come by the part 1 - 1/(2 d) of the difference; where the surface lies before the face, d <= 1/2,
 * it is saturated. The layer bends the other way: the line is too cold. What the cell before and the next one go on to
 * is too hot. With the mean of both the liquid of the cell behind leaves it. Edges stay between the cells.
 *
 * And the velocity at a face behind which there is only vapour. The velocity of a mixed cell is that of its mass, which
 * is liquid; vapour that the surface leaves behind is at rest beside it. Where a dry cell (vapour and gases fill the
 * `onset` of it, 0.99 at least) and one with more liquid move apart, there is no wave between them, but the volume that
 * evaporation makes: the mixed cell's edge has the normal velocity of the dry one's. The less so the more pressures
 * differ, and not at all where they do by as much as the smaller one: a wave is on its way then; nor where the jump is
 * a tenth of the vapour's sqrt(p/rho): nothing evaporates so fast, and a liquid that is torn away would leave vapour
 * behind that nothing fills. Faces of troubled cells keep theirs. */
#ifndef EDGES_FRONT_H
#define EDGES_FRONT_H

#include "phys/model.h"

#include <stddef.h>

/* A row of n cells that have edges, `step` apart along the axis; one more follows on both sides. */
struct edges_front {
    const struct model *model;
    size_t n, step, pitch;
    const double *w;    /* primitives of the first, component q at q pitch */
    double *state;      /* their edges: upper ones of component q at 2 q pitch, lower ones n behind */
    const double *mask; /* of the cells: 1 where troubled */
    int axis;
    double *thin; /* [n] to work with */
};

/* Puts the densities of liquids where a surface lies between two cells, and velocities beside vapour. */
void edges_front(const struct edges_front *row);

#endif
