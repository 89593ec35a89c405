/* paint_contact.h - the state of a cell through which the surface between two bodies of fluid goes.
 *
 * Where they have one pressure, the mean of what they hold is the state of the cell, also of bodies that move. Where
 * they have not, the mean is a body that was never there: of water at 1 GPa and gas of 1 kg/m3 at 1 bar it has gas of a
 * million kelvin, which runs ahead of the contact for the rest of the run. What is in that cell is the contact itself.
 * It has one pressure and one velocity from the first instant, those of the waves that go out from it (paint_star.h).
 * Masses and fractions stay what the shapes say, to round-off; momentum and energy of this one cell become the
 * contact's. Figures: docs/decisions/cut-cells.md. */
#ifndef PAINT_CONTACT_H
#define PAINT_CONTACT_H

#include "phys/model.h"

#include <stdbool.h>

/* u_a, u_b: conserved fields of the bodies, per their own volume; n: unit normal from a to b; u: the cell, whose
 * momentum along n and energy change. All of stride 1. False, and u is as it was: the pressures hardly differ or the
 * bodies are of one material, one of them holds a solid, or the fluids cannot bear p*. */
bool paint_contact(const struct model *model, const double *u_a, const double *u_b, const double n[3], double *u);

#endif
