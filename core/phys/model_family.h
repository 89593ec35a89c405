/* model_family.h - which materials of a model belong together: liquids with their vapours and gases, gases that diffuse
 * through each other. */
#ifndef MODEL_FAMILY_H
#define MODEL_FAMILY_H

#include "phys/model.h"

/* Those of the scene. */
void model_family_all(struct model *model);

/* What of them a narrowed model has: pairs with all of their gases, mixtures of two gases or more. */
void model_family_narrow(const struct model *model, struct model *narrow);

#endif
