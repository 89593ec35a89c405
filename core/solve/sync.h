/* sync.h - two neighbouring levels, before and after the finer one takes its steps. */
#ifndef SYNC_H
#define SYNC_H

#include "solve/stage.h"

/* After a step of `coarse` was accepted (u_old is the new state): the ghosts of `fine` at its end join those of its
 * beginning (stage_exchange_ghosts), and travel; registers are emptied. Collective. */
void sync_down(struct stage *coarse, struct stage *fine);

/* After the finer level (and all above it) has reached the time of `coarse`: averages over the covered cells but of
 * tiles that sleep (solve/wake.h: wake_above comes before), refluxing of those beside, primitives anew. *spread counts
 * the tiles where refluxing had to be spread over several cells (levels/spread.h). STATUS_RUN: a cell is inadmissible
 * even so. The recorded message names it. Collective. */
int sync_up(struct stage *coarse, struct stage *fine, long long *spread);

#endif
