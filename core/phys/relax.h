/* relax.h - the robust closure for one troubled cell: volume fractions from pressure relaxation.
 *
 * The explicit K term is the accurate form, but in a strong expansion of a liquid with gas in the
 * same cell it can leave fractions at which the conserved energy means a pressure that the gas
 * cannot have. Volume fractions are not conserved, so they are chosen anew in such a cell:
 * every material goes from its state at the start of the step to one common pressure p*, doing
 * work against p* (Saurel, Petitpas & Berry 2009, J. Comput. Phys. 228, 1678, eq. 31-33),
 *     e_l(v, p*) - e_l0 + p* (v - v_l0) = 0,     sum_l m_l v_l(p*) = 1,
 * which has a root above every material's least pressure. The mixture pressure then follows from
 * the conserved energy as always; if that is still too low, the fractions are shifted from the
 * material that holds most energy per volume to the one that holds least until it is p*. */
#ifndef RELAX_H
#define RELAX_H

#include "phys/model.h"

#include <stdbool.h>
#include <stddef.h>

/* Component q of the cell lies at pointer[q * stride]. u_old: conserved at the start of the step (an
 * admissible state); u: conserved now, its fractions are replaced; w: primitives of u, brought up
 * to date. m, momentum and energy are untouched. False: no such state (u may have changed). */
bool relax_cell(const struct model *model, size_t stride, const double *u_old, double *u, double *w);

#endif
