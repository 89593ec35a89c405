/* again.h - the command line that goes on with a run, for people to copy. */
#ifndef AGAIN_H
#define AGAIN_H

#include "cli/cli.h"

/* "bulla run CASE.yaml -o DIR --restart": the options that were given, but for those that only a new run or
 * another checkpoint needs. Release with mem_free. */
char *again_command(const struct cli_given *given);

#endif
