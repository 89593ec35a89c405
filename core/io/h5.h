/* h5.h - HDF5 files, checked: opening, closing, groups and attributes.
 *
 * HDF5 is called by h5.c, h5out.c and h5view.c (data sets out), h5in.c (back in) and h5join.c only. Every call is
 * checked; a failure becomes one status message (STATUS_RUN) with the file, what was being
 * done, the innermost reason that HDF5 gives and, when the disk is full, the free space.
 * A file being written is written by rank 0, and each of its parts by a writer; all ranks make the same calls in the
 * same order, the others taking part where their data are needed (h5out.h). What fails is known to its writer
 * alone until h5out_write or h5_close tell all, so the other calls return nothing. Files being read
 * are read by this process alone. */
#ifndef H5_H
#define H5_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* What the numbers of a data set or attribute are, in memory and in the file alike. */
enum h5_type { H5_F32, H5_F64, H5_I32, H5_I64, H5_U8 };

struct h5 {
    int64_t id; /* HDF5's handle of the file */
    char *path;
    bool idle; /* being written by another rank */
    int code;  /* the first failure; later calls keep its message */
    /* Of a file whose rows lie in other files, its parts, one per writer (writers.h); else 1, NULL, NULL. */
    int writers;
    char *stem;      /* parts are STEM1, STEM2, ... beside the file */
    struct h5 *part; /* that of this rank's writer */
};

/* Before MPI is started and before all other calls: HDF5 must not clean up by itself at the end, neither at exit nor
 * when MPI ends. It would close a file again whose closing has failed on a full disk, and crash (seen with 1.10.8). */
void h5_begin(void);

/* Creates (replaces) a file for writing. Collective. */
int h5_create(const char *path, struct h5 **ret_file);

/* The same behind `head` bytes that are left to others (0, or a power of two from 512 on). */
int h5_create_behind(const char *path, size_t head, struct h5 **ret_file);

/* The same for a file with parts (parts.h): their number, the stem of their names, the path that the part of this
 * rank's writer is written under, and the bytes before it that are left to others. */
struct h5_parts {
    int writers;
    const char *stem, *path;
    size_t head;
};
int h5_create_parts(const char *path, size_t head, const struct h5_parts *parts, struct h5 **ret_file);

/* Opens a file for reading. */
int h5_open(const char *path, struct h5 **ret_file);

/* Closes; what could not be written until then fails here. Collective for created files. */
int h5_close(struct h5 *file);

/* Closes the parts before the file that they belong to. Collective. */
int h5_close_part(struct h5 *file);

/* Closes after a failure, without looking; NULL is fine. */
void h5_abandon(struct h5 *file);

/* Makes a group. Collective. */
void h5_group(struct h5 *file, const char *path);

/* Makes the groups above an object that are not there yet. Of the rank that writes. */
void h5_parents(struct h5 *file, const char *path);

/* Attributes of the object `object` ("/": the file). Numbers: n values, n = 0: one scalar. Text: a
 * null-padded string of exactly its length, ASCII where it is. Record: one compound of n named i32.
 * Collective: every rank gives the same values. */
void h5_attribute(struct h5 *file, const char *object, const char *name, enum h5_type type, unsigned n, const void *in);
void h5_attribute_text(struct h5 *file, const char *object, const char *name, const char *text);
void h5_attribute_record(struct h5 *file, const char *object, const char *name, const char *const *members, unsigned n,
                         const int32_t *values);

/* For h5out.c, h5view.c and h5in.c: notes a failed HDF5 call (a negative `id`) and returns `id`; HDF5's
 * reason is only known right after the call. `what` completes "cannot write FILE: ...". */
int64_t h5_check(struct h5 *file, int64_t id, const char *what);

/* For h5out.c, h5view.c and h5in.c: HDF5's handle of a type, and its size in bytes. */
int64_t h5_type_id(enum h5_type type);
size_t h5_type_size(enum h5_type type);

/* For h5out.c: a string type of `length` bytes; a compound of n named i32 (release with H5Tclose). */
int64_t h5_string_type(struct h5 *file, const char *text, size_t length);
int64_t h5_record_type(struct h5 *file, const char *const *members, unsigned n);

#endif
