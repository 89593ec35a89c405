/* viscous_heat.h - what viscosity does in the cells: the hoop stress of curved geometry, and the volume that heat
 * moves. */
#ifndef VISCOUS_HEAT_H
#define VISCOUS_HEAT_H

#include "scheme/viscous_film.h"
#include "scheme/viscous_mix.h"
#include "scheme/viscous_slopes.h"

/* Adds both to the rates of the tile that `slopes` looks at; strain and mix are work space. */
void viscous_heat_cells(const struct term_tile *tile, const struct viscous_slopes *slopes,
                        struct viscous_strain *strain, struct viscous_mix *mix, const struct viscous_film *film);

/* sum alpha_l (2 mu_l |dev D_l|^2 + zeta_l d_l^2) of all cells [W/m3]. */
void viscous_heat_field(const struct term_tile *tile, const struct viscous_slopes *slopes,
                        struct viscous_strain *strain, const struct viscous_mix *mix, double *sum);

#endif
