/* resume.h - a checkpoint (checkpoint.h) being read: verified, with its notes and its lists of tiles.
 *
 * A file is believed only after all its checksums have been compared (seal.h). No HDF5 is involved: parts are
 * read at their places in the file. */
#ifndef RESUME_H
#define RESUME_H

#include "io/notes.h"
#include "io/seal.h"
#include "mesh/mesh.h"

struct resume {
    char *path;
    int file; /* open for reading */
    struct seal seal;
    struct notes notes; /* what the state and the outputs left for the continued run */
    int n_level;
    unsigned n_tile[MESH_LEVELS];
    size_t n_all;       /* tiles of all levels */
    struct tile *tiles; /* [n_all] `at`, `key` and `unwanted`; by level, sorted along the curve */
};

/* Opens and verifies a file for a restart. STATUS_CASE with one line that says what is wrong. Collective. */
int resume_open(const char *path, struct resume **ret_resume);

/* Opens the newest whole file of <directory>/checkpoints; says in a warning which ones are damaged. Collective. */
int resume_newest(const char *directory, struct resume **ret_resume);

/* Opens and verifies a file to look at, in this process alone. STATUS_RUN. */
int resume_look(const char *path, struct resume **ret_resume);

void resume_close(struct resume *resume); /* NULL is fine */

/* A part of the file; STATUS_RUN if it is not there. */
int resume_part(const struct resume *resume, const char *name, const struct seal_part **ret_part);

/* STATUS_RUN: right checksums, but content that no run can have written. */
int resume_damaged(const struct resume *resume, const char *what);

#endif
