/* run.h - `bulla run`: from a case file to its output directory and an exit code.
 *
 * This folder, run: one run from its case to its end, and the commands that look at one case. */
#ifndef RUN_H
#define RUN_H

#include "cli/cli.h"

int run_command(const struct cli_given *given);

#endif
