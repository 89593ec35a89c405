/* dump.h - the file that a failed step leaves: one tile and all that its update needed (solve/blame.h), one
 * file, complete in itself. Reading: dump_read.h; showing and replaying: dump_show.h. Layout: docs/output.md, reasons:
 * docs/decisions/dump.md. */
#ifndef DUMP_H
#define DUMP_H

#include "solve/state.h"

/* The group of the file that holds everything, and the version of its layout. */
#define DUMP_GROUP "/dump"
enum { DUMP_FORMAT = 1 };

/* After a step that could not be completed: writes <directory>/dump_<step>.h5, with the provenance as text. *ret_path
 * (release with mem_free) is NULL if the failure has no cell to show. Collective. */
int dump_write(const struct state *state, const char *provenance, char **ret_path);

#endif
