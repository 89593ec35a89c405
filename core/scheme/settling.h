/* settling.h - after the motion of a stage: fluids of cells that they share with solids have the pressure of their own
 * motion, and what energy is left is the solids' (phys/settle.h).
 *
 * The pressure of a fluid is followed through the stage as in a model where each material has an energy: what its
 * volume brought along through the faces, and what it was compressed by since, p' = [alpha p + dt (-div(alpha* u* p_K)
 * + alpha p div u)]/alpha',   p_l = p' - rho_l c_l^2 (div u dt - strain + dV), alpha' after transport, strain what HLLC
 * had compressed it by on the way (exchange.h), dV what closure and exchange gave it. */
#ifndef SETTLING_H
#define SETTLING_H

#include "scheme/term.h"

/* Owns n_material rows: pressures. */
extern const struct term settling_term;

#endif
