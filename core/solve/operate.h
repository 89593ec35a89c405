/* operate.h - the operators (scheme/operator.h) on a tile of a stage, between its new fields and their judgement. */
#ifndef OPERATE_H
#define OPERATE_H

#include "solve/stage.h"

/* What the stage under way has made of a tile: u, and w, which holds pressures from which an iterated closure starts.
 * Does nothing on a path without operators. */
void operate_tile(struct stage *stage, unsigned local, double *u, double *w);

#endif
