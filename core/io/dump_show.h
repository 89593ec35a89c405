/* dump_show.h - the dump of a failed step for people, and its replay (`bulla info [--replay] DUMP`). */
#ifndef DUMP_SHOW_H
#define DUMP_SHOW_H

#include <stdio.h>

/* Describes a dump; needs nothing but the file. */
int dump_show(FILE *out, const char *path);

/* Reads the case in a dump, computes the tile again and says what came out: STATUS_OK if every bit and the verdict are
 * the same, STATUS_EXPECT if not. */
int dump_show_replay(FILE *out, const char *path);

#endif
