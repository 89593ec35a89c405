/* derive_heat.h - the flux of heat by conduction as a field. */
#ifndef DERIVE_HEAT_H
#define DERIVE_HEAT_H

#include "derive/derive_view.h"

/* q [W/m2], three components: the mean over both faces of a cell along each axis of what conduction takes through them,
 * without the bound on traces, which belongs to a time step. 0 in scenes that do not conduct. */
void derive_heat_flux(const struct derive_view *tile, double *out);

#endif
