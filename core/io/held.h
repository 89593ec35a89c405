/* held.h - a file that is made in memory and goes to the disk later, beside the run (aside.h).
 *
 * It is an anonymous file of the system (memfd), so whoever writes it needs to know nothing: it has a path. Where the
 * system gives none, the path is that on the disk, and nothing is left to do later. */
#ifndef HELD_H
#define HELD_H

#include <stdbool.h>

struct held;

/* A file that will be at `path`, in memory, or (`in_memory` false) on the disk at once. */
struct held *held_new(const char *path, bool in_memory);
void held_free(struct held *held); /* NULL is fine */

/* What to write to. Valid until held_free. */
const char *held_path(const struct held *held);

/* Is this the path of a file in memory? */
bool held_is(const char *path);

/* Brings the file to the disk and makes it lasting; nothing to do for one that is there. STATUS_RUN with file, reason
 * and room. No rank has a part in it, nor has any library: for work beside the run. */
int held_store(const struct held *held);

#endif
