/* warm.h - the materials of mixed cells after each has got its heat: at one pressure again, in the volume that they had
 * together.
 *
 * Masses and the volume of a cell stay. Since a state alpha_l^0, p^0 material l has got H_l [J/m3 of the cell]. Then
 *     alpha_l rho_l e_l(p_l) = (alpha_l rho_l e_l)^0 + H_l - (pi + lag_l) (alpha_l - alpha_l^0),   sum_l alpha_l = 1,
 * rho_l = m_l/alpha_l, p_l = p + lag_l (traction.h), and pi = (p^0 + p)/2 the pressure at which they push each other.
 * It is what scheme/swell.h does at a rate, through a finite time: energy is exact whatever H_l is, and what they do on
 * each other of second order. A fraction that is off by 1e-6 is a kPa beside a liquid, so rates of fractions do not add
 * up over long steps; heat does. What the surfaces between them store, sum_l lag_l (alpha_l - alpha_l^0), is taken from
 * the energy (tension.h). Newton's method, each cell by its own values alone. */
#ifndef WARM_H
#define WARM_H

#include "phys/model.h"

#include <stddef.h>

/* n cells. w: primitives of the state before. heat: rows H_l of the n_alpha materials. u: conserved fields; on entry
 * its fractions are those of before. Changes fractions and energy. Cells in which nobody got anything, or that hold one
 * material, keep their bits; so do those without a solution, which a guard will find by their pressure. */
void warm_mix(const struct model *model, size_t n, size_t stride, const double *w, const double *heat, double *u);

#endif
