/* wake.h - tiles that sleep (mesh/doze.h) get what covers them, when somebody is about to read them.
 *
 * Steps of their level leave their averages out (solve/sync.h); their cells hold nothing that means anything until
 * then. Readers are coarser tiles after their own steps; regrids, which look for cells to refine everywhere and hand
 * tiles on; checkpoints, and whoever else looks at cells that are no leaves. What a tile is given follows from the
 * state of now alone, not from when it was woken before: a run's numbers do not depend on how often it is saved. */
#ifndef WAKE_H
#define WAKE_H

#include "solve/state.h"

/* What the tiles of a level that sleep hold means nothing from here on: before a step of the level (its arrays change
 * places, theirs unwritten), and where averages pass them by. */
void wake_leave(struct stage *stage);

/* After a step of level l, which the finer ones have followed: the tiles whose turn it is, those of each finer level
 * that sleep down to l. From the finest level to the coarsest; averages, and primitives. Collective. */
void wake_above(struct stage *const *stages, int l);

/* All other tiles that sleep on the levels from `base` on, which all stand at the same time, level `base` at the end of
 * a step. Does nothing where no step was taken since. Collective. */
void wake_levels(const struct state *state, int base);

#endif
