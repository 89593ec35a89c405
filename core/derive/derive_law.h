/* derive_law.h - fields that modules make (bulla/field.h). */
#ifndef DERIVE_LAW_H
#define DERIVE_LAW_H

#include "derive/derive_view.h"

/* Finds the field of that name: the index that the functions below go by, or -1; its unit. */
int derive_law_find(const struct scene *scene, const char *name, const char **ret_unit);

/* Does it look at neighbours? */
bool derive_law_needs_layers(const struct scene *scene, const struct derive *field);

/* Values of field->index. */
void derive_law(const struct derive_view *tile, double *out);

#endif
