/* conduction_wall.h - heat from walls: of a given temperature, q_l = alpha_l k_l (T_wall - T_l)/d with d from the
 * cell's centroid to the wall and k_l at the mean of both temperatures, or a given flux, shared by fraction. These are
 * fluxes and no ghosts: 2 T_wall - T may be negative. */
#ifndef CONDUCTION_WALL_H
#define CONDUCTION_WALL_H

#include "scheme/term.h"

/* Rows of the cells beside the faces of a piece, [n_material] with pitch FACE_ROOM, as conduction.c has them. */
struct conduction_wall_cells {
    const double *T, *part; /* [K]; fractions that are felt */
    const double *sets;     /* those that set the time step, else 0 */
    const double *c;        /* rho cv for the bound on traces; NULL: there are none */
    double most;            /* as in conduction_channel_bound */
};

/* The first failure of a script. */
struct conduction_wall_fault {
    int status;
    char *message, place[160];
};

/* Adds what a heated wall gives to the fluxes of energy and of each material's heat. Where a script fails they are
 * NaN. */
void conduction_wall_add(const struct term_piece *piece, int side, const struct conduction_wall_cells *cells,
                         struct conduction_wall_fault *fault);

#endif
