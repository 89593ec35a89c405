/* start.h - initial states out of checkpoints of other runs: `initial: - checkpoint: {file: ...}`. */
#ifndef START_H
#define START_H

#include "case/scene.h"

/* Reads the checkpoints that layers of the scene name, and looks whether they go with it: geometry, materials by their
 * names, laws by their numbers. STATUS_CASE with the line of the case. Every process reads for itself. */
int start_load(struct scene *scene);

#endif
