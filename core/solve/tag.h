/* tag.h - which cells of a level ask for refinement: the case's criteria on derived fields.
 *
 * A criterion looks at a named field (its gradient, its jump to a neighbour, its value), at the surface of a
 * material, at a Lua function, or only at a region; all may be limited to a region, a time window and levels.
 * Jumps are taken to face neighbours on the same level; across coarse-fine faces and domain boundaries the
 * cell's own value stands in. A gradient is the larger of the two one-sided differences along an axis over the cell
 * size, the largest of all axes: one-sided, because a central one does not see an odd-even wave and halves a jump;
 * the largest, because that is the same in a turned frame to the bit. Thresholds are exceeded, not met. */
#ifndef TAG_H
#define TAG_H

#include "derive/derive.h"
#include "mesh/halo.h"

/* Sets marks[n_local][n_cell] of level l to 1 where a criterion asks for level l + 1, else 0. w is that of a
 * completed step, the moment one of it; `halo` exchanges one component on this level. hits[n_refine] counts the cells
 * of this rank that each criterion tagged (added to what is there). STATUS_RUN or STATUS_CASE: a script failed.
 * Collective. */
int tag_level(struct derive_moment *moment, int l, struct halo *halo, double **marks, long long *hits);

/* What a criterion is, with its line in the case file: "mesh.refine[0] (line 12): jump of density above 0.05 of the
 * larger cell". Free with mem_free. */
char *tag_describe(const struct scene *scene, unsigned criterion);

#endif
