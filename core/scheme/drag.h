/* drag.h - linear resistance of a material against its motion, as in a porous medium: a force -alpha_l k_l u.
 *
 * k_l is viscosity over permeability (Darcy, Les fontaines publiques de la ville de Dijon, 1856) [kg/m3/s], `drag:` of
 * a material. The work of the force stays in the cell as heat, k_l |u|^2 per volume of the material: total energy does
 * not change, mass neither. In mixtures the heat moves volume (swell.h). The mesh rests: momentum goes into what
 * carries it. */
#ifndef DRAG_H
#define DRAG_H

#include "scheme/term.h"

extern const struct term drag_term;

#endif
