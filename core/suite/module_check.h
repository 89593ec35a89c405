/* module_check.h - `bulla module check FILE.so`: the contract suite on a module, as a table. */
#ifndef MODULE_CHECK_H
#define MODULE_CHECK_H

#include "cli/cli.h"

/* 0: every check holds; 1: some fail; 2: no module, refused in one line. */
int module_check_command(const struct cli_given *given);

#endif
