/* derive_formula.h - fields that are expressions of other fields: those that a case makes itself. */
#ifndef DERIVE_FORMULA_H
#define DERIVE_FORMULA_H

#include "derive/derive_view.h"

/* Expression field->index of the scene, one call of Lua per cell; NaN where it has no number (a root of what is
 * negative), and in the whole rest of a tile once it fails. Its arguments have been prepared. */
void derive_formula(const struct derive_view *tile, double *out);

/* derive_prepare for its arguments, whose scales go into field->scales. Collective. */
void derive_formula_prepare(struct derive_moment *moment, struct derive *field);

#endif
