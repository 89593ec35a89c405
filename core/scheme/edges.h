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

/* Fills the edges of all active components of `model` (that of edges_new, or a narrower path of it) from the frame w:
 * component q at state + 2 q pitch. With a mask ([cells of the frame]: 0 or 1), faces of marked cells get the values of
 * the cells: first order. */
void edges_fill(struct edges *edges, const struct model *model, const struct frame *frame, const double *w,
                const double *mask, double *state);

#endif
