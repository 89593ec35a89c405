/* paint_press.h - the pressure of a cell that is made of two bodies.
 *
 * Masses and energies of a cell that a surface cuts are the means of both bodies. With ideal and stiffened gases and
 * NASG its pressure lies between theirs. With other laws it need not: energy and density of water at one pressure lie
 * on a curve, and half of it at 300 K, half at 350 K have -5 MPa in their mean. Such a cell gets the mean of the
 * pressures, and its energy becomes that of this pressure. Masses stay. */
#ifndef PAINT_PRESS_H
#define PAINT_PRESS_H

#include "phys/model.h"

/* u_a, u_b: conserved fields of the bodies, per their own volume; part: that of b in the cell; u: the means, whose
 * energy may change. All of stride 1. */
void paint_press(const struct model *model, const double *u_a, const double *u_b, double part, double *u);

#endif
