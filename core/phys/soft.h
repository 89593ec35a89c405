/* soft.h - the state of a mixed cell whose energy and fractions contradict each other.
 *
 * The pressure of a cell follows from its energy and its fractions. Water at 1 bar holds 1e9 J/m3 more than gas does,
 * so an error of 0.2 % in what came in with the water, or of 0.002 in a fraction, is 2 MPa in the gas beside it: gas of
 * ten thousands of kelvin that runs ahead of the contact for the rest of the run. What the gas should have, the gas
 * knows better: it was here before, and was squeezed. So every material but the stiffest goes from its state at the
 * start of the step to one pressure p, with the work of that pressure and the heat of a shock that brings it to the
 * velocity which the cell has now, e_l(v_l, p) - e_l0 - |u - u_0|^2 + p (v_l - v_l0) = 0, the stiffest takes the volume
 * that is left, and p is where the energy of all is that of the cell. Unlike in relax.h the stiffest need not agree
 * with what it was: it may have come in with another density. Where the pressure of the fractions is above p by more
 * than SOFT_ABOVE of the least rho_l c_l^2, or below by more than SOFT_BELOW of it (of air: twice p, half of p), the
 * cell takes p. Masses, momentum and energy stay. Figures: docs/decisions/cut-cells.md. */
#ifndef SOFT_H
#define SOFT_H

#include "phys/model.h"

#include <stdbool.h>
#include <stddef.h>

/* A material with less of the cell is a trace: whether it is stiff or soft does not count. */
#define SOFT_TRACE 1e-3

/* 1 is the heat of one impact. A cell comes to its speed in several steps, and n equal ones have but an n-th of it. */
#define SOFT_HEAT 2.5

/* The largest share of its volume that the stiffest may gain or lose: an error in its energy asks for hundredths. */
#define SOFT_ROOM 0.1

#define SOFT_ABOVE 0.7
#define SOFT_BELOW 0.35

/* Component q of the cell lies at pointer[q * stride]. u_old: conserved at the start of the step, admissible; u:
 * conserved now; w: its primitives; least: their least rho_l c_l^2, of materials that are no traces. True: the
 * fractions in u are new ones, and w is up to date. False, and nothing is touched: both pressures agree, there is no
 * such p, or the cell holds a solid. */
bool soft_cell(const struct model *model, size_t stride, const double *u_old, double least, double *u, double *w);

#endif
