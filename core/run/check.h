/* check.h - `bulla check`: is a case right, and what will it need? And the same of a run at its start. */
#ifndef CHECK_H
#define CHECK_H

#include "cli/cli.h"
#include "solve/state.h"

int check_command(const struct cli_given *given);

/* Prints what a run needs whose state is in memory, ready for its first step. Collective; rank 0 prints. */
void check_ready(const struct scene *scene, const struct state *state);

#endif
