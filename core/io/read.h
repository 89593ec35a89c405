/* read.h - a snapshot file back in memory, as plain arrays (for pictures, reports, `bulla info`).
 *
 * Nothing here needs a scene, a mesh or MPI: one process reads whole files that `bulla run` has
 * written. Values are float64 whatever the file holds. Files of others, and truncated ones, are
 * STATUS_RUN with a message that names the file and says what is missing. */
#ifndef READ_H
#define READ_H

#include <stddef.h>

enum { READ_NAME = 64, READ_UNIT = 32 };

struct snapshot_field {
    char name[READ_NAME]; /* "pressure", "velocity", "alpha_air" */
    char unit[READ_UNIT]; /* SI, "1" for pure numbers */
    unsigned components;  /* 1, or 3 (velocity): the components of a cell lie side by side */
    double *data;         /* [n_cell * components] */
    double least, most;   /* extremes of the finite values (of the magnitude when there are 3 components) */
};

/* A tile of the mesh and its leaves, which follow each other. */
struct snapshot_tile {
    int level, rank;
    size_t first, n_cell; /* n_cell 0: it lies under finer tiles */
};

/* The cells of a snapshot, its leaves, do not overlap and fill the domain; their order is the file's
 * (leaves.h). A mesh of one level has equal cells. */
struct snapshot {
    char *title, *name; /* of the case; name: base name of the case file */
    char *version;      /* of the bulla that wrote it */
    double time;        /* [s] */
    long step;
    int dim;             /* 1, 2, 3 */
    int beta;            /* 0 cartesian, 1 axisymmetric (x = r, y = z), 2 spherical (x = r) */
    double domain[2][3]; /* [0] lower, [1] upper corner [m]; 0 beyond dim */
    size_t n_cell;
    size_t n_tile;
    struct snapshot_tile *tiles; /* [n_tile] of all levels */
    int n_level;
    double (*lower)[3]; /* [n_cell] corners of each cell [m]; 0 beyond dim */
    double (*upper)[3];
    unsigned n_material;
    char (*materials)[READ_NAME];
    unsigned n_field;
    struct snapshot_field *fields;
};

/* Reads a file. `names`: NULL-terminated list of the fields wanted, or NULL for all; a name that is
 * not in the file is STATUS_CASE with the names that are. Release with read_free. */
int read_snapshot(const char *path, const char *const *names, struct snapshot **ret_snapshot);
void read_free(struct snapshot *snapshot); /* NULL is fine */

/* The names of the fields of a file alone, sorted; release each and the list with mem_free. */
int read_names(const char *path, unsigned *ret_n, char ***ret_names);

/* The field `name`; NULL if it was not read. */
const struct snapshot_field *read_field(const struct snapshot *snapshot, const char *name);

/* The snapshots of an output directory, ascending in time, from its fields/<case>.hdf.series. */
struct snapshot_series {
    size_t n;
    char **paths;
    double *times; /* [s] */
};

int read_series(const char *directory, struct snapshot_series *ret_series);
void read_series_done(struct snapshot_series *series);

#endif
