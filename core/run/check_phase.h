/* check_phase.h - what `bulla check` says of liquids and their vapours: where they boil, by their own laws and
 * really. */
#ifndef CHECK_PHASE_H
#define CHECK_PHASE_H

#include "case/scene.h"

/* Prints to stdout; nothing without `phase-change:`. */
void check_phase_print(const struct scene *scene);

#endif
