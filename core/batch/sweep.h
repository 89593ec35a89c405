/* sweep.h - `bulla sweep`: all combinations of a case's matrix, each in its own directory, and one table.
 *
 * This folder, batch: many runs: sweeps, studies, `verify`. */
#ifndef SWEEP_H
#define SWEEP_H

#include "cli/cli.h"

/* Exit codes: that of the worst combination, 3 for any that failed; 2: nothing was run; 4: interrupted, a later call
 * goes on. Failures have been printed. */
int sweep_command(const struct cli_given *given);

#endif
