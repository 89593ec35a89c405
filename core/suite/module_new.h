/* module_new.h - `bulla new module KIND NAME`: a project of one module outside the tree. */
#ifndef MODULE_NEW_H
#define MODULE_NEW_H

#include "cli/cli.h"

/* 0; 2: bad kind or name, or the folder is there already; 3: the SDK is not there, or it cannot be written. */
int module_new_command(const struct cli_given *given);

#endif
