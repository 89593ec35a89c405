/* inspect.h - commands that look at files and print, and run nothing. */
#ifndef INSPECT_H
#define INSPECT_H

#include "cli/cli.h"

int inspect_show(const struct cli_given *given);    /* the resolved case */
int inspect_plan(const struct cli_given *given);    /* the stages that will run */
int inspect_modules(const struct cli_given *given); /* the laws there are */
int inspect_info(const struct cli_given *given);    /* what is inside an output file, or what a run was */
int inspect_join(const struct cli_given *given);    /* one file instead of a file and its parts */
int inspect_schema(const struct cli_given *given);  /* the JSON Schema of case files */

#endif
