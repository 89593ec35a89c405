/* verify.h - `bulla verify [ID...]`: how far the verification scenes are from what is known.
 *
 * Scenes are the files cases/verify/ID.yaml, or any case file given by its path. Each runs once
 * per row of its `matrix:`; the table shows cells, CPU time, errors and observed orders. `bulla verify hard` is another
 * table (verify_hard.h). */
#ifndef VERIFY_H
#define VERIFY_H

#include "cli/cli.h"

extern const struct cli_option *const verify_option_table[];

/* The command. Returns the exit code: STATUS_EXPECT if a scene does not show what it expects.
 * Failures have been printed. */
int verify_command(const struct cli_given *given);

#endif
