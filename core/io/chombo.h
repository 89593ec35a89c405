/* chombo.h - the second view of a plot file: the layout of Chombo, which yt reads.
 *
 * Boxes are the blocks of leaves (leaves.h); their data are virtual data sets onto /VTKHDF/CellData, so
 * nothing is stored twice. Indices count from round(lower / width) so that yt finds the domain's corner. */
#ifndef CHOMBO_H
#define CHOMBO_H

#include "io/vtkhdf.h"

/* Writes the view of fields that vtkhdf_write has written. 2D and 3D only. Collective; returns what h5out_write does.
 */
int chombo_write(struct h5 *file, const struct state *state, const struct leaves *leaves,
                 const struct vtkhdf_fields *fields);

#endif
