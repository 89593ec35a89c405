/* dump_read.h - reading the dump of a failed step back (dump.h). Of this process alone. */
#ifndef DUMP_READ_H
#define DUMP_READ_H

#include "io/notes.h"
#include "solve/blame.h"

/* A dump that was read; without its scene nothing but notes and texts. */
struct dump {
    char *path, *resolved, *provenance;
    struct notes notes;
    struct blame_facts facts;
    unsigned n_field, dim;
    double *block[BLAME_BLOCKS]; /* NULL: not in the file */
    struct blame_shape shape[BLAME_BLOCKS];
};

/* Is the file a dump? False for what is no HDF5 file, too. */
bool dump_read_is(const char *path);

/* Reads one; STATUS_RUN with a clear line if it is something else, or broken. */
int dump_read(const char *path, struct dump **ret_dump);
void dump_read_free(struct dump *dump); /* NULL is fine */

#endif
