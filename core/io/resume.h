/* resume.h - a checkpoint (checkpoint.h) being read: verified, with its notes and its lists of tiles.
 *
 * A file is believed only after all its checksums have been compared (seal.h). No HDF5 is involved: parts are
 * read at their places in the file. */
#ifndef RESUME_H
#define RESUME_H

#include "io/notes.h"
#include "io/seal.h"
#include "mesh/mesh.h"

/* Tiles that follow each other in one file. */
struct resume_run {
    unsigned part;
    size_t first, n, local; /* tiles; place of the first one in that file */
};

/* A file that holds tiles. */
struct resume_file {
    char *path;
    int file; /* open for reading, or -1: nobody has asked for a tile yet */
    struct seal seal;
    size_t n_tile; /* known to rank 0 */
};

struct resume {
    char *path;
    int file; /* open for reading */
    struct seal seal;
    unsigned n_part; /* files with tiles: 1, the checkpoint itself, or its parts: on ranks above 0 those of own tiles */
    struct resume_file *parts;
    size_t n_run; /* alike (resume_runs.h) */
    struct resume_run *runs;
    struct notes notes; /* what the state and the outputs left for the continued run */
    int rank, size;     /* who shares the lists of tiles: this rank of all, or 0 of 1, which has all of each */
    int n_level;
    unsigned n_tile[MESH_LEVELS], first[MESH_LEVELS], n_own[MESH_LEVELS]; /* the piece of a level (partition_equal) */
    size_t n_all, n_here;                                                 /* tiles of all levels; of these pieces */
    struct tile *tiles;                /* [n_here] `at`, `key` and `unwanted`; by level, sorted along the curve */
    uint64_t *first_keys[MESH_LEVELS]; /* [size] where the pieces begin */
};

/* Opens and verifies a file for a restart. STATUS_CASE with one line that says what is wrong. Collective. */
int resume_open(const char *path, struct resume **ret_resume);

/* Opens the newest whole file of <directory>/checkpoints; says in a warning which ones are damaged. Collective. */
int resume_newest(const char *directory, struct resume **ret_resume);

/* Opens and verifies a file to look at, in this process alone. STATUS_RUN. */
int resume_look(const char *path, struct resume **ret_resume);

void resume_close(struct resume *resume); /* NULL is fine */

/* Has each tile a row of so many bytes in the part `name` of the file? Else STATUS_RUN. Collective where lists are
 * shared
 * (`size`). */
int resume_has_rows(const struct resume *resume, const char *name, uint64_t bytes);

/* Reads the row of a tile (its number among all; one of this rank's) that has so many bytes. */
int resume_row(const struct resume *resume, const char *name, size_t tile, uint64_t bytes, void *out);

/* STATUS_RUN: right checksums, but content that no run can have written. */
int resume_damaged(const struct resume *resume, const char *what);

#endif
