/* seal.h - a file behind a seal: a header of our own that says what the file must be, to the bit.
 *
 * The first SEAL_BYTES of the file hold: a magic text, byte order, format, the length of the file, a
 * serial number, a list of parts (name, offset, length, checksum), the checksum of all bytes that
 * belong to no part, and the checksum of the header itself. So a file that was cut, or in which any
 * bit changed, is refused before anything in it is believed; and the parts can be read at their
 * offsets without a library that would have to trust the rest. The header is written last: a file that
 * was not finished has none. Checksums are XXH64. (docs/decisions/checkpoint.md) */
#ifndef SEAL_H
#define SEAL_H

#include <stdbool.h>
#include <stdint.h>

enum { SEAL_BYTES = 4096, SEAL_NAME = 24, SEAL_MOST = 32 };

struct seal_part {
    char name[SEAL_NAME]; /* null-padded */
    uint64_t offset, length, hash;
};

/* What a sealed file is: a checkpoint; one whose fields lie in part files (parts.h); such a part file. */
enum seal_kind { SEAL_WHOLE, SEAL_HEAD, SEAL_PIECE };

/* Parts in the order of their offsets, apart, behind the header. */
struct seal {
    enum seal_kind kind;
    uint64_t
        hash; /* of the header, and so of the file: by this another file knows it; set by those that write or read it */
    uint64_t bytes;  /* of the whole file */
    uint64_t number; /* rises from one file of a run to the next */
    unsigned n;
    struct seal_part parts[SEAL_MOST];
};

/* Adds a part; the list is kept in order. Too many are our mistake. */
void seal_add(struct seal *seal, const char *name, uint64_t offset, uint64_t length, uint64_t hash);

/* Checksum of bytes in memory. */
uint64_t seal_hash(const void *bytes, uint64_t length);

/* Finishes a file whose parts are on their way to the disk: makes them lasting (fsync), reads the
 * file back from the disk and compares every part with its checksum, then writes the header, makes it lasting
 * and reads it back. `bytes` is set. STATUS_RUN with file and reason. Of this process alone, as all here. */
int seal_close(const char *path, struct seal *seal);

/* The same for what can be had again: the file is summed up and sealed, and made lasting, but not read back from the
 * disk. */
int seal_stamp(const char *path, struct seal *seal);

/* Reads the header, and compares the length of the file with it: cheap. Anything else than a sealed,
 * whole file is STATUS_RUN with one clear line. */
int seal_read(const char *path, struct seal *ret_seal);

/* Reads the header and then the whole file, comparing all checksums. */
int seal_check(const char *path, struct seal *ret_seal);

/* Does the file begin like a checkpoint (else it may be of another kind)? Like a part file? */
bool seal_is(const char *path);
bool seal_is_piece(const char *path);

/* The part of this name, or NULL. */
const struct seal_part *seal_find(const struct seal *seal, const char *name);

/* Reads `length` bytes from `offset` on of an open file; `path` is for the message. */
int seal_bytes(int file, const char *path, uint64_t offset, uint64_t length, void *out);

/* Makes the entries of a folder lasting, after a rename in it. */
int seal_sync_folder(const char *folder);

#endif
