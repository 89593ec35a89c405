/* place.c - see place.h. */
#include "io/place.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/room.h"
#include "io/seal.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int place_make(const char *path)
{
    struct stat there;
    if (!mkdir(path, 0777)) return STATUS_OK;
    int reason = errno;
    if (reason == EEXIST && !stat(path, &there) && S_ISDIR(there.st_mode)) return STATUS_OK;
    return status_fail(STATUS_RUN, "%s: cannot make this folder: %s", path, strerror(reason));
}

static int place_make_all(const char *path)
{
    char *part = mem_text(path);
    int code = STATUS_OK;
    for (char *end = part + 1; !code && *end; end++) {
        if (*end != '/') continue;
        *end = '\0';
        code = place_make(part);
        *end = '/';
    }
    if (!code) code = place_make(part);
    mem_free(part);
    return code;
}

int place_folder(const char *path)
{
    return comm_agree(comm_rank() == 0 ? place_make_all(path) : STATUS_OK);
}

char *place_draft(const char *path)
{
    return mem_print("%s.tmp", path);
}

static int place_write(const char *path, const char *text)
{
    FILE *stream = fopen(path, "w");
    if (!stream) return room_fail(path, "write");
    int bad = fputs(text, stream) < 0;
    bad = fclose(stream) || bad;
    return bad ? room_fail(path, "write") : STATUS_OK;
}

/* Without it a power failure may leave the new name and no content. */
static int place_last(const char *draft, const char *path)
{
    int file = open(draft, O_RDONLY | O_CLOEXEC);
    if (file < 0) return room_fail(path, "open");
    int bad = fsync(file);
    return close(file) || bad ? room_fail(path, "make it lasting") : STATUS_OK;
}

static int place_rename(const char *draft, const char *path)
{
    TRY(place_last(draft, path));
    if (rename(draft, path)) return room_fail(path, "rename to it");
    const char *slash = strrchr(path, '/');
    char *folder = slash ? mem_text_n(path, (size_t)(slash - path)) : mem_text(".");
    int code = seal_sync_folder(folder);
    mem_free(folder);
    return code;
}

void place_reject(const char *path)
{
    if (comm_rank() != 0) return;
    char *draft = place_draft(path);
    int kept = truncate(draft, 0); /* HDF5 may hold it open after a failure: its space is wanted back now */
    (void)kept;
    remove(draft);
    mem_free(draft);
}

int place_accept_here(const char *path)
{
    char *draft = place_draft(path);
    int code = place_rename(draft, path);
    mem_free(draft);
    return code;
}

int place_accept(const char *path)
{
    int code = comm_agree(comm_rank() == 0 ? place_accept_here(path) : STATUS_OK);
    if (code) place_reject(path);
    return code;
}

static int place_write_draft(const char *path, const char *text)
{
    char *draft = place_draft(path);
    int code = place_write(draft, text);
    mem_free(draft);
    return code;
}

int place_text_here(const char *path, const char *text)
{
    TRY(place_write_draft(path, text));
    return place_accept_here(path);
}

int place_text(const char *path, const char *text)
{
    int code = comm_agree(comm_rank() == 0 ? place_write_draft(path, text) : STATUS_OK);
    if (!code) return place_accept(path);
    place_reject(path);
    return code;
}
