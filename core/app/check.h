/* check.h - `bulla check`: is a case right, and what will it need? */
#ifndef CHECK_H
#define CHECK_H

#include "app/cli.h"

int check_command(const struct cli_given *given);

#endif
