/* join.h - one ordinary file instead of a file and its parts (parts.h), for mailing and archives (`bulla join`). */
#ifndef JOIN_H
#define JOIN_H

#include <stdio.h>

/* Joins a snapshot or checkpoint, or all of the output directory `path` (also of its fields/ or checkpoints/). Each
 * keeps its name, and its parts go when it is whole; what has no parts is left alone. Says on `out` what was done.
 * STATUS_RUN, and the file is as it was: a part that is lost, broken or another file's; no room. Of one process. */
int join_path(FILE *out, const char *path);

#endif
