/* derive_viscous.h - viscous stress and what it makes of heat, as fields. */
#ifndef DERIVE_VISCOUS_H
#define DERIVE_VISCOUS_H

#include "derive/derive_view.h"

/* Component field->index (elastic.h) of the viscous stress in the cells [Pa], and heat of viscosity [W/m3], from
 * central differences; behind boundaries that waves cross stands a copy of the cell inside (numerics.md, 6c). */
void derive_viscous_stress(const struct derive_view *tile, double *out);
void derive_viscous_dissipation(const struct derive_view *tile, double *out);

#endif
