/* provenance_laws.h - what provenance.json says about the equations of state in a run. */
#ifndef PROVENANCE_LAWS_H
#define PROVENANCE_LAWS_H

#include "solve/state.h"

#include <jansson.h>

/* Iterated mixture pressures; counts of all ranks. */
json_t *provenance_laws_closures(const struct state_counts *counts);

/* Per material whose law tells: in how many cell-steps a continuation stood in, and most cells at once. */
json_t *provenance_laws_outside(const struct model *model, const struct state_counts *counts);

/* Per pair of liquid and vapour, "water+steam": the same where pressure was past the end of their saturation curve. */
json_t *provenance_laws_past(const struct scene *scene, const struct state_counts *counts);

#endif
