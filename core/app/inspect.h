/* inspect.h - commands that read and print, and run nothing: show, plan. */
#ifndef INSPECT_H
#define INSPECT_H

#include "app/cli.h"

/* `bulla show`: the resolved case on stdout. */
int inspect_show(const struct cli_given *given);

#endif
