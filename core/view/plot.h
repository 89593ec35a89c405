/* plot.h - `bulla plot`: pictures of the snapshots and the histories of a run. */
#ifndef PLOT_H
#define PLOT_H

#include "cli/cli.h"

/* bulla plot DIR FIELD[,FIELD...] | history [COLUMN...]; options in plot_option.h. Prints the paths written. */
int plot_command(const struct cli_given *given);

#endif
