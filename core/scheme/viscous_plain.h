/* viscous_plain.h - the stress of one material with constant viscosities in cartesian geometry: most faces of most scenes. */
#ifndef VISCOUS_PLAIN_H
#define VISCOUS_PLAIN_H

#include "scheme/face.h"
#include "scheme/viscous_slopes.h"

/* Is that all there is to a path? */
bool viscous_plain_is(const struct model *path);

/* Adds to the fluxes of a piece, whose rows are gathered, bit by bit what viscous.c would. */
void viscous_plain_faces(const struct viscous_slopes *slopes, const struct frame *frame, struct face_work *faces);

#endif
