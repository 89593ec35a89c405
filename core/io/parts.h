/* parts.h - a file whose rows were written by several writers, each into a file of its own beside it.
 *
 * NAME (a snapshot or checkpoint) is small: it holds all tables and texts, the rows as virtual data sets, and a list
 * of its parts NAME.a1, NAME.a2, ... (b where NAME is being replaced: then the old one is whole until the new one is).
 * A part is an HDF5 file behind a seal (seal.h). It has its name before NAME has, so that a NAME without a part tells
 * of a part that was lost, not of a run that was killed. The list has a line for each part,
 *   name bytes seal
 * whose seal is the checksum of its header, 16 hexadecimal digits: a part of another file is told from a broken one.
 * (docs/decisions/writers.md) */
#ifndef PARTS_H
#define PARTS_H

#include "io/h5.h"
#include "io/seal.h"

struct parts;

/* Prepares a file `path` to be written by n writers (writers.h); 1: an ordinary one, and what follows concerns that
 * file alone. `in_memory`: drafts are made there first (held.h). Collective. */
struct parts *parts_new(const char *path, int n, bool in_memory);
void parts_free(struct parts *parts); /* NULL is fine */

/* Creates the drafts (place.h) of the file, behind `head` bytes that are left to others, and of its parts.
 * Collective. */
int parts_create(const struct parts *parts, size_t head, struct h5 **ret_file);

/* Finishes and seals the parts, of which each writer's `seal` says what is in its own; notes them in the file, as text
 * `where` (noted in *ret_hash, the text's checksum, if not NULL). `seals`: seal_close or seal_stamp. Collective. */
int parts_seal(const struct parts *parts, struct h5 *file, const char *where, int (*seals)(const char *, struct seal *),
               struct seal *seal, uint64_t *ret_hash);

/* Brings the drafts of this rank to the disk, if they are in memory. Of this rank alone, and beside the run
 * (aside.h). */
int parts_store(const struct parts *parts);

/* Gives the parts their names; the file itself comes after them. Collective. */
int parts_accept(const struct parts *parts);

/* After a failure: removes the parts, drafts or not. When the file has its name: removes those of the one that it has
 * replaced. Collective, keep the recorded message. */
void parts_reject(const struct parts *parts);
void parts_clean(const struct parts *parts);

/* Is this the name of a part? */
bool parts_is(const char *name);

/* Removes all parts of a file. Of this process alone, as what follows. */
void parts_remove(const char *path);

/* A list of parts, read back. */
struct parts_entry {
    char *path;
    uint64_t bytes, hash;
};
struct parts_list {
    unsigned n;
    struct parts_entry *at;
};

/* Reads the list `text` of a file; STATUS_RUN if it is none. */
int parts_read(const char *path, const char *text, struct parts_list *ret_list);
void parts_done(struct parts_list *list);

/* Is part i there, and the one that is meant? `looks`: seal_read or seal_check. STATUS_RUN with what is wrong. */
int parts_check(const char *path, const struct parts_list *list, unsigned i, int (*looks)(const char *, struct seal *),
                struct seal *ret_seal);

#endif
