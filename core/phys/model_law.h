/* model_law.h - the equation of state of a material, as kernels ask for it: what stands in where the material is
 * absent, and how far it may be compressed. */
#ifndef MODEL_LAW_H
#define MODEL_LAW_H

#include "phys/model.h"

/* Fills eos[l] of a model from its scene. */
void model_law_open(struct model *model, unsigned l);

#endif
