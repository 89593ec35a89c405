/* room.h - a failed file call in words: with the room that is left where room seems to be the reason. */
#ifndef ROOM_H
#define ROOM_H

#include <stddef.h>

enum { ROOM_TEXT = 1024 };

/* "; 12.3 MB are free in FOLDER" for a file that could not be written for `reason` (words of the system), if the
 * disk seems to be full; else "". */
void room_left(const char *path, const char *reason, char ret_text[ROOM_TEXT]);

/* STATUS_RUN: "PATH: cannot WHAT: reason of errno", with the room. */
int room_fail(const char *path, const char *what);

#endif
