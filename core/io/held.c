/* held.c - see held.h. */
#include "io/held.h"

#include "base/mem.h"
#include "base/status.h"
#include "io/room.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

enum { HELD_PIECE = 1 << 20 };

static const char held_folder[] = "/proc/self/fd/";

struct held {
    int file; /* or -1: on the disk */
    char *path, *to;
};

struct held *held_new(const char *path, bool in_memory)
{
    struct held *held = mem_new(1, sizeof *held);
    held->to = mem_text(path);
    held->file = in_memory ? memfd_create("bulla", MFD_CLOEXEC) : -1;
    held->path = held->file < 0 ? mem_text(path) : mem_print("%s%d", held_folder, held->file);
    return held;
}

void held_free(struct held *held)
{
    if (!held) return;
    if (held->file >= 0) close(held->file);
    mem_free(held->path);
    mem_free(held->to);
    mem_free(held);
}

bool held_is(const char *path)
{
    return strncmp(path, held_folder, strlen(held_folder)) == 0;
}

const char *held_path(const struct held *held)
{
    return held->path;
}

static int held_put(const struct held *held, int to, const char *bytes, size_t length)
{
    while (length) {
        ssize_t put = write(to, bytes, length);
        if (put < 0 && errno == EINTR) continue;
        if (put <= 0) return room_fail(held->to, "write");
        bytes += put;
        length -= (size_t)put;
    }
    return STATUS_OK;
}

static int held_copy(const struct held *held, int to, char *piece)
{
    off_t at = 0;
    for (;;) {
        ssize_t got = pread(held->file, piece, HELD_PIECE, at);
        if (got < 0) return room_fail(held->to, "read it back from memory");
        if (got == 0) return fsync(to) ? room_fail(held->to, "make it lasting") : STATUS_OK;
        TRY(held_put(held, to, piece, (size_t)got));
        at += got;
    }
}

int held_store(const struct held *held)
{
    if (held->file < 0) return STATUS_OK;
    int to = open(held->to, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (to < 0) return room_fail(held->to, "create it");
    char *piece = mem_new(HELD_PIECE, 1);
    int code = held_copy(held, to, piece);
    mem_free(piece);
    if (close(to) && !code) code = room_fail(held->to, "finish");
    return code;
}
