/* advance.h - one accepted time step. */
#ifndef ADVANCE_H
#define ADVANCE_H

#include "solve/state.h"

/* The step that the CFL condition (or the case's fixed dt) allows from the present state [s].
 * Collective; equal on all ranks. */
double advance_dt(const struct state *state);

/* A step may be longer than the condition allows by this factor, so that an output time a hair
 * away needs no step of its own. */
#define ADVANCE_STRETCH 1.0001

/* Takes one step of at most `dt_most` (and at most ADVANCE_STRETCH times what is allowed); t, dt,
 * step and the counts move on. On STATUS_RUN the state is the last good one and the message names
 * cell, material, field and stage. Collective. */
int advance_step(struct state *state, double dt_most);

#endif
