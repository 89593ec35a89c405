/* viscous_plain.h - the stress of one material with constant viscosities in cartesian geometry: most faces of most
 * scenes, and in tiles with an interface the rows of faces between cells of one material. An interface beside them does
 * nothing there: films and layers in series are of cells that are mixed (viscous_film.h). */
#ifndef VISCOUS_PLAIN_H
#define VISCOUS_PLAIN_H

#include "scheme/face.h"
#include "scheme/viscous_slopes.h"

/* The material that is alone in both cells of each face of the first row of a block, if it is such a one; or -1. */
int viscous_plain_alone(const struct model *path, const struct frame *frame, const struct viscous_block *block,
                        const struct face_work *faces);

/* Adds to the fluxes of a block of faces in material l, whose rows are gathered, bit by bit what viscous.c would. */
void viscous_plain_faces(const struct viscous_slopes *slopes, const struct frame *frame, unsigned l,
                         const struct viscous_block *block, struct face_work *faces);

#endif
