/* seal.c - see seal.h.
 *
 * The pages of a file that was just written are dropped from the cache before it is read back, so that
 * the comparison sees the disk (where the system follows the advice). */
#include "io/seal.h"

#include "base/mem.h"
#include "base/status.h"
#include "io/room.h"

#include <assert.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

enum { SEAL_FORMATS = 2, SEAL_ORDER = 0x01020304, SEAL_BUFFER = 1 << 20, SEAL_MAGIC = 16 };

static const char seal_magic[][SEAL_MAGIC + 1] = {
    [SEAL_WHOLE] = "bulla checkpoint", [SEAL_HEAD] = "bulla checkpoint", [SEAL_PIECE] = "bulla part file."};

/* Older programs refuse a checkpoint with part files by its format. */
static const uint32_t seal_format[] = {[SEAL_WHOLE] = 1, [SEAL_HEAD] = 2, [SEAL_PIECE] = 1};

/* The header as it stands in the file. */
union seal_block {
    struct {
        char magic[SEAL_MAGIC];
        uint32_t order, format;
        uint64_t bytes, number, rest; /* rest: checksum of what belongs to no part */
        uint64_t n;
        struct seal_part parts[SEAL_MOST];
    } is;
    struct {
        unsigned char all[SEAL_BYTES - sizeof(uint64_t)];
        uint64_t hash; /* of `all` */
    } sealed;
};

uint64_t seal_hash(const void *bytes, uint64_t length)
{
    return XXH64(bytes, length, 0);
}

void seal_add(struct seal *seal, const char *name, uint64_t offset, uint64_t length, uint64_t hash)
{
    struct seal_part part = {.offset = offset, .length = length, .hash = hash};
    unsigned at = seal->n++;
    assert(seal->n <= SEAL_MOST && strlen(name) < SEAL_NAME);
    memcpy(part.name, name, strlen(name));
    for (; at > 0 && seal->parts[at - 1].offset > offset; at--) seal->parts[at] = seal->parts[at - 1];
    seal->parts[at] = part;
}

const struct seal_part *seal_find(const struct seal *seal, const char *name)
{
    for (unsigned i = 0; i < seal->n; i++)
        if (!strncmp(seal->parts[i].name, name, SEAL_NAME)) return &seal->parts[i];
    return NULL;
}

int seal_bytes(int file, const char *path, uint64_t offset, uint64_t length, void *out)
{
    for (uint64_t done = 0; done < length;) {
        ssize_t got = pread(file, (char *)out + done, length - done, (off_t)(offset + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return room_fail(path, "read");
        if (got == 0) return status_fail(STATUS_RUN, "%s: it ends too early: it was cut", path);
        done += (uint64_t)got;
    }
    return STATUS_OK;
}

/* Adds the bytes [from, to) of a file to a checksum. */
static int seal_sum(int file, const char *path, const uint64_t range[2], XXH64_state_t *sum)
{
    uint64_t most = range[1] - range[0] < SEAL_BUFFER ? range[1] - range[0] : SEAL_BUFFER;
    char *piece = mem_new(most, 1);
    int code = STATUS_OK;
    for (uint64_t at = range[0]; !code && at < range[1]; at += most) {
        uint64_t length = range[1] - at < most ? range[1] - at : most;
        code = seal_bytes(file, path, at, length, piece);
        if (!code) XXH64_update(sum, piece, length);
    }
    mem_free(piece);
    return code;
}

static int seal_check_part(int file, const char *path, const struct seal_part *part)
{
    XXH64_state_t *sum = XXH64_createState();
    XXH64_reset(sum, 0);
    int code = seal_sum(file, path, (uint64_t[2]){part->offset, part->offset + part->length}, sum);
    if (!code && XXH64_digest(sum) != part->hash)
        code = status_fail(STATUS_RUN, "%s: damaged: the checksum of '%.*s' is wrong", path, SEAL_NAME, part->name);
    XXH64_freeState(sum);
    return code;
}

/* Compares all parts and sums up what lies between them. */
static int seal_survey(int file, const char *path, const struct seal *seal, uint64_t *ret_rest)
{
    XXH64_state_t *sum = XXH64_createState();
    XXH64_reset(sum, 0);
    uint64_t at = SEAL_BYTES;
    int code = STATUS_OK;
    for (unsigned i = 0; !code && i < seal->n; i++) {
        const struct seal_part *part = &seal->parts[i];
        code = seal_sum(file, path, (uint64_t[2]){at, part->offset}, sum);
        if (!code) code = seal_check_part(file, path, part);
        at = part->offset + part->length;
    }
    if (!code) code = seal_sum(file, path, (uint64_t[2]){at, seal->bytes}, sum);
    *ret_rest = XXH64_digest(sum);
    XXH64_freeState(sum);
    return code;
}

static int seal_length(int file, const char *path, uint64_t *ret_bytes)
{
    struct stat info;
    if (fstat(file, &info)) return room_fail(path, "look at");
    if (!S_ISREG(info.st_mode)) return status_fail(STATUS_RUN, "%s: not a file", path);
    *ret_bytes = (uint64_t)info.st_size;
    return STATUS_OK;
}

static void seal_compose(const struct seal *seal, uint64_t rest, union seal_block *block)
{
    memset(block, 0, sizeof *block);
    memcpy(block->is.magic, seal_magic[seal->kind], SEAL_MAGIC);
    block->is.order = SEAL_ORDER;
    block->is.format = seal_format[seal->kind];
    block->is.bytes = seal->bytes;
    block->is.number = seal->number;
    block->is.rest = rest;
    block->is.n = seal->n;
    memcpy(block->is.parts, seal->parts, sizeof block->is.parts);
    block->sealed.hash = seal_hash(block->sealed.all, sizeof block->sealed.all);
}

/* Lasting, and out of the cache. */
static int seal_settle(int file, const char *path)
{
    if (fsync(file)) return room_fail(path, "make it lasting");
    posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED);
    return STATUS_OK;
}

/* The header is the last that is written. */
static int seal_write(int file, const char *path, struct seal *seal, union seal_block *ret_block)
{
    uint64_t rest = 0;
    TRY(seal_length(file, path, &seal->bytes));
    TRY(seal_survey(file, path, seal, &rest));
    seal_compose(seal, rest, ret_block);
    seal->hash = ret_block->sealed.hash;
    ssize_t put = pwrite(file, ret_block, sizeof *ret_block, 0);
    if (put >= 0 && put < (ssize_t)sizeof *ret_block) errno = ENOSPC;
    if (put < (ssize_t)sizeof *ret_block) return room_fail(path, "write");
    return seal_settle(file, path);
}

static int seal_put(int file, const char *path, bool is_read_back, struct seal *seal)
{
    union seal_block block, again;
    if (!is_read_back) return seal_write(file, path, seal, &block);
    TRY(seal_settle(file, path));
    TRY(seal_write(file, path, seal, &block));
    TRY(seal_bytes(file, path, 0, sizeof again, &again));
    if (memcmp(&block, &again, sizeof block))
        return status_fail(STATUS_RUN, "%s: the disk does not give back what was written", path);
    return STATUS_OK;
}

static int seal_finish(const char *path, bool is_read_back, struct seal *seal)
{
    int file = open(path, O_RDWR | O_CLOEXEC);
    if (file < 0) return room_fail(path, "open");
    int code = seal_put(file, path, is_read_back, seal);
    if (close(file) && !code) code = room_fail(path, "finish");
    return code;
}

int seal_close(const char *path, struct seal *seal)
{
    return seal_finish(path, true, seal);
}

int seal_stamp(const char *path, struct seal *seal)
{
    return seal_finish(path, false, seal);
}

/* Do the parts lie in order, apart, in the file? A header with a right checksum may still be forged. */
static bool seal_is_sound(const union seal_block *block)
{
    uint64_t at = SEAL_BYTES;
    if (block->is.n > SEAL_MOST || block->is.bytes < SEAL_BYTES) return false;
    for (uint64_t i = 0; i < block->is.n; i++) {
        const struct seal_part *part = &block->is.parts[i];
        if (part->offset < at || part->offset > block->is.bytes) return false;
        if (part->length > block->is.bytes - part->offset) return false;
        at = part->offset + part->length;
    }
    return true;
}

/* What a header says that its file is; false: nothing that we know. */
static bool seal_kind(const union seal_block *block, enum seal_kind *ret_kind)
{
    *ret_kind = SEAL_WHOLE;
    if (!memcmp(block->is.magic, seal_magic[SEAL_PIECE], SEAL_MAGIC)) *ret_kind = SEAL_PIECE;
    else if (block->is.format == seal_format[SEAL_HEAD]) *ret_kind = SEAL_HEAD;
    return !memcmp(block->is.magic, seal_magic[*ret_kind], SEAL_MAGIC);
}

static int seal_judge(const char *path, const union seal_block *block, uint64_t bytes)
{
    enum seal_kind kind;
    if (!seal_kind(block, &kind))
        return status_fail(STATUS_RUN, "%s: not a checkpoint of bulla, or one that was not finished", path);
    if (block->sealed.hash != seal_hash(block->sealed.all, sizeof block->sealed.all))
        return status_fail(STATUS_RUN, "%s: damaged: the checksum of its header is wrong", path);
    if (block->is.order != SEAL_ORDER)
        return status_fail(STATUS_RUN, "%s: written by a machine with another order of bytes", path);
    if (block->is.format != seal_format[kind])
        return status_fail(STATUS_RUN, "%s: a checkpoint of format %u; this version reads formats 1 to %d", path,
                           block->is.format, SEAL_FORMATS);
    if (!seal_is_sound(block)) return status_fail(STATUS_RUN, "%s: damaged: its list of parts is impossible", path);
    if (block->is.bytes != bytes)
        return status_fail(STATUS_RUN, "%s: damaged: %llu bytes long, not %llu: it was cut or grew", path,
                           (unsigned long long)bytes, (unsigned long long)block->is.bytes);
    return STATUS_OK;
}

static int seal_take(int file, const char *path, bool whole, struct seal *ret_seal)
{
    union seal_block block;
    uint64_t bytes = 0, rest = 0;
    TRY(seal_length(file, path, &bytes));
    if (bytes < SEAL_BYTES) return status_fail(STATUS_RUN, "%s: not a checkpoint of bulla, or one that was cut", path);
    TRY(seal_bytes(file, path, 0, sizeof block, &block));
    TRY(seal_judge(path, &block, bytes));
    *ret_seal =
        (struct seal){.hash = block.sealed.hash, .bytes = bytes, .number = block.is.number, .n = (unsigned)block.is.n};
    seal_kind(&block, &ret_seal->kind);
    memcpy(ret_seal->parts, block.is.parts, sizeof ret_seal->parts);
    if (!whole) return STATUS_OK;
    TRY(seal_survey(file, path, ret_seal, &rest));
    if (rest != block.is.rest)
        return status_fail(STATUS_RUN, "%s: damaged: the checksum of its structure is wrong", path);
    return STATUS_OK;
}

static int seal_open(const char *path, bool whole, struct seal *ret_seal)
{
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return room_fail(path, "open");
    int code = seal_take(file, path, whole, ret_seal);
    close(file);
    return code;
}

int seal_read(const char *path, struct seal *ret_seal)
{
    return seal_open(path, false, ret_seal);
}

int seal_check(const char *path, struct seal *ret_seal)
{
    return seal_open(path, true, ret_seal);
}

static bool seal_begins(const char *path, enum seal_kind kind)
{
    char magic[SEAL_MAGIC];
    int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    bool is = file >= 0 && pread(file, magic, sizeof magic, 0) == SEAL_MAGIC;
    if (file >= 0) close(file);
    return is && !memcmp(magic, seal_magic[kind], SEAL_MAGIC);
}

bool seal_is(const char *path)
{
    return seal_begins(path, SEAL_WHOLE);
}

bool seal_is_piece(const char *path)
{
    return seal_begins(path, SEAL_PIECE);
}

int seal_sync_folder(const char *folder)
{
    int entry = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (entry < 0) return room_fail(folder, "open");
    int bad = fsync(entry);
    if (close(entry) || bad) return room_fail(folder, "make its entries lasting");
    return STATUS_OK;
}
