/* ledger.h - how much mass, momentum and energy there is in the domain. */
#ifndef LEDGER_H
#define LEDGER_H

#include "solve/state.h"

enum { LEDGER_MOST = SCENE_MATERIALS + SCENE_AXES + 1 };

/* Whole volumes (2 pi, 4 pi included): kg, kg m/s, J in 3D, axisymmetric and spherical scenes; per metre
 * of depth in 2D, per square metre in 1D. Order: mass of each material, momentum by axis, energy. */
struct ledger {
    unsigned n;
    double total[LEDGER_MOST];
};

/* Takes stock of the present state; does not depend on the ranks. Collective. */
void ledger_take(const struct state *state, struct ledger *ret_ledger);

/* "mass_<material>", "momentum_x", ..., "energy". */
void ledger_name(const struct model *model, unsigned index, char *ret_name, size_t size);

#endif
