/* facts.h - what a case must have in common with a checkpoint to go on from it: dimension, domain, cells,
 * tile size, materials with their laws, evolved fields. All else may differ: end time, outputs, boundaries,
 * scheme, levels, criteria of refinement. */
#ifndef FACTS_H
#define FACTS_H

#include "io/notes.h"
#include "phys/model.h"

/* Adds the facts; `tile` is the side of a tile. Names begin as the keys of a case do. */
void facts_put(const struct scene *scene, const struct model *model, int tile, struct notes *notes);

/* Do the facts of a case agree with those among saved notes? STATUS_CASE that says what differs, and how. */
int facts_compare(const struct notes *saved, const struct notes *now);

/* Notes which peaks are kept in which rows, if any are; is that what the saved notes say? */
void facts_put_kept(const struct scene *scene, struct notes *notes);
bool facts_same_kept(const struct scene *scene, const struct notes *saved);

#endif
