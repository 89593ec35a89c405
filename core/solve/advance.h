/* advance.h - one accepted time step. */
#ifndef ADVANCE_H
#define ADVANCE_H

#include "solve/state.h"

/* The step that the CFL condition (or the case's fixed dt) allows from the present state [s].
 * Collective; equal on all ranks. */
double advance_dt(const struct state *state);

/* Takes one step of at most `dt_most`; t, dt, step and the counts move on. On STATUS_RUN the
 * state is the last good one and the message names cell, material, field and stage. Collective. */
int advance_step(struct state *state, double dt_most);

#endif
