/* regrid.h - which tiles the finer levels have: from tags to tile sets, and the data of tiles that come and go. */
#ifndef REGRID_H
#define REGRID_H

#include "solve/state.h"

/* The hierarchy of the initial condition: level 0 is painted and has its primitives; finer levels are painted, not
 * interpolated, until no criterion asks for more. Collective. */
int regrid_initial(struct state *state);

/* New tile sets for the levels above `base`, which all stand at the same time. New tiles are interpolated from
 * the next coarser level, conservatively. Where nothing changes nothing is touched; so too where the new mesh would
 * need more than the memory limit, which state->starved then notes. Collective. */
int regrid_levels(struct state *state, int base);

/* STATUS_RUN and the reason if a regrid could not be afforded. */
int regrid_verdict(const struct state *state);

/* Weight of a tile of this rank when owners are chosen: work per cell relative to one of a single fluid (measured:
 * docs/numerics.md 10). */
double regrid_cost(const struct stage *stage, unsigned local);

/* Is it time, after a step of level `base`? */
bool regrid_due(const struct state *state, int base);

/* Gives every level of a mesh that was built by other means (a checkpoint) its stage. */
void regrid_stages(struct state *state);

/* Signals of all levels over all ranks, and what they mean for the time step. Collective. */
void regrid_signals(struct state *state);

#endif
