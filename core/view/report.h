/* report.h - `bulla report`: one self-contained HTML page about a run. */
#ifndef REPORT_H
#define REPORT_H

#include "cli/cli.h"

/* bulla report DIR [-o FILE.html]: title, figures of the run, expectations, pictures, histories and the case, all
 * inside one file (DIR/report.html by default). Prints its path. */
int report_command(const struct cli_given *given);

extern const struct cli_option *const report_option_table[];

#endif
