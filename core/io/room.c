/* room.c - see room.h. */
#include "io/room.h"

#include "base/status.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/statvfs.h>

/* The folder of a path, for asking how full its disk is. */
static void room_folder(const char *path, char folder[ROOM_TEXT / 2])
{
    snprintf(folder, ROOM_TEXT / 2, "%s", path);
    char *slash = strrchr(folder, '/');
    if (slash) *(slash == folder ? slash + 1 : slash) = '\0';
    else snprintf(folder, ROOM_TEXT / 2, ".");
}

void room_left(const char *path, const char *reason, char ret_text[ROOM_TEXT])
{
    char folder[ROOM_TEXT / 2];
    struct statvfs disk;
    room_folder(path, folder);
    *ret_text = '\0';
    if (statvfs(folder, &disk)) return;
    double free_bytes = (double)disk.f_bavail * (double)disk.f_frsize;
    if (strstr(reason, "No space") || strstr(reason, "quota") || strstr(reason, "NO_SPACE") || free_bytes < 1e6)
        snprintf(ret_text, ROOM_TEXT, "; %.3g MB are free in %s", free_bytes / 1e6, folder);
}

int room_fail(const char *path, const char *what)
{
    const char *reason = strerror(errno);
    char room[ROOM_TEXT];
    room_left(path, reason, room);
    return status_fail(STATUS_RUN, "%s: cannot %s: %s%s", path, what, reason, room);
}
