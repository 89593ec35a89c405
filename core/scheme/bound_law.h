/* bound_law.h - boundaries that are modules (bulla/boundary.h): rows of cells inside, and what lies behind. */
#ifndef BOUND_LAW_H
#define BOUND_LAW_H

#include "phys/model.h"

/* Faces that lie side by side. w: primitives [n_field] rows of `stride`, of the cells inside; then of those behind. */
struct bound_law_row {
    const struct model *model;
    int axis, side;
    double t, depth; /* [s]; to the centres behind [m] */
    size_t n, stride;
    const double *x[3];              /* [n] centres of the faces [m] */
    const double *Z;                 /* [n] rho c [Pa s/m] */
    const double *p_start, *u_start; /* [n] at the start, u outwards; NULL: not asked for */
    double *w;
};

/* Is the boundary of a scene asked layer by layer, for the cells that mirror them? */
bool bound_law_mirrors(const struct scene_boundary *boundary);

/* Does core move the densities? Does it bring materials of its own? */
bool bound_law_is_isentropic(const struct scene_boundary *boundary);
bool bound_law_brings(const struct scene_boundary *boundary);

/* Fractions, densities, velocity and pressure behind; other fields stay. */
void bound_law_fill(const struct scene_boundary *boundary, const struct bound_law_row *row);

#endif
