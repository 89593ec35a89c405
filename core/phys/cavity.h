/* cavity.h - voids: where a broken solid is in tension, a gas of the scene gets a part of the cell.
 *
 * A broken solid bears no shear, but by its equation of state it would bear tension. Its void opens at once as far as
 * it wants to: the solid shrinks to where the cell, whose energy stays what it is, is at the small pressure p_v of the
 * gas: a rho_s e_s(rho_s, p_v) + (alpha_s - a) rho_v e_g(rho_v, p_v) + the others at p_v = rho E - kinetic - elastic,
 * solved for the fraction a that is left of alpha_s. The gas in it, density rho_v, comes from the mass of the solid:
 * the masses together, momentum and energy stay to round-off. From there the gas is a material like others: it expands
 * as the pieces part, and is compressed when they meet again. Its mass is (alpha_s - a) rho_v, 1e-8 of that of a
 * spalling metal.
 *
 * A trace of gas of fixed mass instead cannot begin: the pressure of the cell is common to its materials, and that of
 * the broken solid is one that no gas has. */
#ifndef CAVITY_H
#define CAVITY_H

#include "phys/model.h"

#include <stddef.h>

/* Opens voids at those of n points that want one; the others keep their bits. w: primitives, u: conserved fields. Does
 * nothing where no solid opens or the model has not got its gas. */
void cavity_open(const struct model *model, size_t n, size_t stride, const double *w, double *u);

#endif
