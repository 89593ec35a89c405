/* h5join.h - one ordinary file of a file with parts (parts.h): all objects and attributes are copied, and the views of
 * rows in parts become data sets, packed as the parts are. */
#ifndef H5JOIN_H
#define H5JOIN_H

#include "io/h5.h"

/* What is told of each data set whose rows were in parts: its path, and the XXH64 of its numbers. */
typedef void h5join_told(void *context, const char *path, uint64_t hash);

/* Copies everything of `from`, which is open for reading, but the objects `without` (NULL-terminated paths), into `to`,
 * which is open for writing. STATUS_RUN. Of one process. */
int h5join_copy(struct h5 *from, struct h5 *to, const char *const *without, h5join_told *told, void *context);

#endif
