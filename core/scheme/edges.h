/* edges.h - from the cells of a frame to the values at both edges of each: the reconstruction of the scheme.
 *
 * Edges of a component stand behind each other in one row: the upper ones of all cells that have edges, then the lower
 * ones. Cells with edges begin at frame_reach(frame) and are frame_edged(frame) many. */
#ifndef EDGES_H
#define EDGES_H

#include "phys/model.h"
#include "scheme/frame.h"

struct edges;

/* Work space for frames whose components lie `pitch` apart. */
struct edges *edges_new(const struct model *model, size_t pitch);
void edges_free(struct edges *edges);

/* What lies in the cells of a frame. */
struct edges_cells {
    const double *w;       /* primitives */
    const double *mask;    /* 0 or 1; or NULL */
    const double *rise[2]; /* of pressure from the middle to the faces that forces hold (face.h); or NULL */
    const double *lean[2]; /* to be added to the differences of pressure to the cells before and behind; or NULL */
};

/* Fills the edges of all active components of `model` (that of edges_new, or a narrower path of it) from a frame:
 * component q at state + 2 q pitch. With a mask, faces of marked cells get the values of the cells: first order. With
 * rises or leans pressure has edges of its own (edges_slope.h), and so it has in all frames of a scene in which some
 * have them, unless the scheme's are the same to the bit. */
void edges_fill(struct edges *edges, const struct model *model, const struct frame *frame, const struct edges_cells *in,
                double *state);

/* The mask of a frame (NULL: none marked) with, for pairs that condense over cells, those in which vapour is squeezed
 * along its axis (edges_squeeze.h): above 0. In room, frame->count numbers, which are overwritten. */
const double *edges_squeezed(const struct edges *edges, const struct model *model, const struct frame *frame,
                             const double *w, const double *mask, double *room);

#endif
