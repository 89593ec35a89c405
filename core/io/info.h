/* info.h - what is inside a snapshot, a checkpoint or a dump, as text for people (`bulla info FILE`). */
#ifndef INFO_H
#define INFO_H

#include <stdio.h>

/* Describes a file: case, time, step, cells, domain, fields with unit and extremes. STATUS_RUN with
 * a clear message for files of others and broken ones. */
int info_print(FILE *out, const char *path);

#endif
