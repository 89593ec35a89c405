/* phase_pair.h - what terms ask of a liquid and its vapour: who belongs together, and where the surface between them
 * is. */
#ifndef PHASE_PAIR_H
#define PHASE_PAIR_H

#include "phys/model.h"

/* Are materials l and m the liquid of a pair and its vapour, or a gas beside that? */
bool phase_pair_joins(const struct model *model, unsigned l, unsigned m);

/* Vapour and gases fill this share of a cell at the surface of a pair with an `onset`: half of it, or less where the
 * onset is less. Cells between it and the onset pass on the heat that comes to them (scheme/conduction_front.h); only
 * those at the shore (scheme/shore.h) evaporate. */
double phase_pair_front(const struct scene_phase *scene);

#endif
