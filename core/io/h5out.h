/* h5out.h - data sets of a file being written: rows that the ranks hold, small arrays and texts. Rows of a file with
 * parts go into these, and the file itself gets a view of them; all else goes into the file. All calls are
 * collective. */
#ifndef H5OUT_H
#define H5OUT_H

#include "io/h5.h"

struct h5out_range {
    size_t first, count;
};

/* Bytes of a table's rows that travel together. */
enum { H5OUT_TABLE = 1 << 16 };

/* Chunks as they were packed, kept by their writer to be written once more: start from {0}. */
struct h5out_kept {
    unsigned n;
    size_t *sizes;
    char **chunks;
};
void h5out_forget(struct h5out_kept *kept);

/* A data set of `total` rows, of which this rank writes some ranges (ascending, apart); together
 * the ranks write each row once, each rank with the same n_range. `fill` is asked for runs of these
 * rows, ascending, each inside a range and a chunk, and writes them to `out` as `type`. */
struct h5out_rows {
    enum h5_type type;
    unsigned columns; /* 0: shape [total], else [total, columns] */
    size_t total;
    size_t chunk;   /* rows that are compressed together (shuffle + deflate 1), or travel together if they are not */
    uint64_t *hash; /* not NULL: the rows are stored as they are, in one piece; a writer gets the XXH64 of its rows */
    bool central;   /* in the file itself, even if it has parts, and stored as they are */
    const char *const *members; /* not NULL, of central rows: each is a record of `columns` i32 with these names */
    struct h5out_kept
        *kept;  /* not NULL: where the packed chunks are kept; `again`: nobody is asked, they are written */
    bool again; /* as they were. For rows that are compressed; the same on all ranks */
    unsigned n_range;
    const struct h5out_range *ranges;
    void (*fill)(void *context, size_t first, size_t count, void *out);
    void *context;
};

/* Returns what has failed so far on any rank, this data set not included. */
int h5out_write(struct h5 *file, const char *path, const struct h5out_rows *rows);

/* A small array that rank 0 knows and writes (the others may give NULL). Shape as above. */
void h5out_array(struct h5 *file, const char *path, enum h5_type type, size_t n, unsigned columns, const void *values);

/* One text that every rank knows. */
void h5out_text(struct h5 *file, const char *path, const char *text);

/* Where in the file (a part, too) the numbers of a data set lie that was not compressed [bytes]; its writer gets it. */
void h5out_place(struct h5 *file, const char *path, uint64_t *ret_offset, uint64_t *ret_length);

/* Has a data set been written to this file? Of the rank that writes it. */
bool h5out_has(struct h5 *file, const char *path);

/* Names the unit of a data set (attribute `units`). */
void h5out_unit(struct h5 *file, const char *path, const char *unit);

#endif
