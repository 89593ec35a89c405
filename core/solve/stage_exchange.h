/* stage_exchange.h - what one rank says to others in a stage on one level, and to the next finer level.
 *
 * The primitives of tiles at a rank's border travel while tiles inside are computed; a tile that looks across the
 * border waits. The order of tiles never changes a value. */
#ifndef STAGE_EXCHANGE_H
#define STAGE_EXCHANGE_H

#include "solve/stage.h"

/* Sends slabs of w (and of the guard's marks) to other ranks, for the moment stage->at. Collective. */
void stage_exchange_start(struct stage *stage);

/* Waits for them. */
void stage_exchange_finish(struct stage *stage);

/* Does tile `local` need what the exchange brings? */
bool stage_exchange_waits(const struct stage *stage, unsigned local);

/* Waits for the primitives and writes the strips for the next finer level, if there is one. */
void stage_exchange_ghosts(struct stage *stage);

#endif
