/* face_carry.h - volume fluxes at a row of faces and what they carry from the side they come from.
 *
 * The fluid at a face came from the side that u* points away from, and was compressed on the way by (u_L - u*)/c_L or
 * (u* - u_R)/c_R. */
#ifndef FACE_CARRY_H
#define FACE_CARRY_H

#include "phys/model.h"

/* Rows of faces->n; those of materials are `pitch` numbers apart. */
struct face_carry {
    const struct model *model;
    const struct bulla_faces *faces; /* solved */
    size_t pitch;
    const double *u;                /* u* */
    const double *p_left, *p_right; /* of both sides */
    double *alpha;                  /* [n_alpha] alpha* becomes alpha* u* */
    double *carried, *strained;     /* [n_alpha] that times the pressure and the compression */
    double *solid;                  /* [n_solid] fractions of the solids at the faces. Not alpha*, which takes
                                       a side even where nothing moves */
    double *origin, *strain;        /* work space */
};

void face_carry_volumes(const struct face_carry *carry);

#endif
