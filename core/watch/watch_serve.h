/* watch_serve.h - `bulla watch DIR...`: serves the page on 127.0.0.1 until Ctrl-C. */
#ifndef WATCH_SERVE_H
#define WATCH_SERVE_H

#include "cli/cli.h"

extern const struct cli_option *const watch_serve_option_table[];

/* Prints the address, once, on stdout. STATUS_CASE: no such directory, no such port; STATUS_RUN: the port is taken. */
int watch_serve_command(const struct cli_given *given);

#endif
