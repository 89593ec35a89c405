/* derive_vapour.h - liquid and vapour as fields: how much is vapour, where they would be in equilibrium, how far from
 * it the liquid is. For the pair of a scene whose vapour the field names; of the pure vapour, whatever gases are beside
 * it. */
#ifndef DERIVE_VAPOUR_H
#define DERIVE_VAPOUR_H

#include "derive/derive_view.h"

/* m_v/(m_l + m_v) [1]; 0 where neither is. */
void derive_vapour_quality(const struct derive_view *tile, double *out);

/* psat at the temperature of the liquid [Pa]; 0 where the liquid is not felt (presence.h), or the curve does not
 * reach. */
void derive_vapour_pressure(const struct derive_view *tile, double *out);

/* Tsat at the pressure of the cell [K]; 0 where the curve does not reach. */
void derive_vapour_temperature(const struct derive_view *tile, double *out);

/* T_l - Tsat [K], above 0 where liquid could boil; 0 where one of them is not. */
void derive_vapour_superheat(const struct derive_view *tile, double *out);

#endif
