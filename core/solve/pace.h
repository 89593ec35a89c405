/* pace.h - does a run still get on? The least time step, and the cell that asks for less.
 *
 * Steps follow the fastest signal of all cells. One cell whose law has come to its end, with a sound speed of 1e12 m/s,
 * would keep a run busy for ever: from a step on that is so short the run is over, like one whose guard gives up, and
 * says which cell it was. Signals differ by far less in one run: 1e6 lies between a cold gas and light. */
#ifndef PACE_H
#define PACE_H

#include "solve/guard.h"
#include "solve/state.h"

/* The least step without run.smallest-step, relative to the longest so far. */
#define PACE_LEAST 1e-6

/* Signals may have grown by so much since a step was chosen: what comes in through a boundary, or is new on a finer
 * level, shortens it only beyond that. */
#define PACE_EXCESS 1.25

/* The least step of level l [s]. */
double pace_least(const struct state *state, int l);

/* May level l take a step dt at time t? Of level 0 it must also move t by more than round-off. NaN: no. */
bool pace_allows(const struct state *state, int l, double t, double dt);

/* The cell with the fastest signal on this rank, of all levels whose steps follow that of level l. Returns the stage
 * that it lies on, or NULL where the fastest cell is another rank's. Collective. */
struct stage *pace_find(const struct state *state, int l, struct guard_place *ret_place);

/* What makes a cell fast, from the primitives of its tile: field, value and words of the place. */
void pace_judge(const struct guard *guard, const struct model *path, const double *w, struct guard_place *place);

#endif
