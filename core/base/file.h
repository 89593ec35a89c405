/* file.h - opening files whose names come from outside. */
#ifndef FILE_H
#define FILE_H

#include <stdio.h>

/* Opens a regular file for reading. Everything else, a folder, a pipe, a device, is refused: it could keep the
 * reader waiting or never end. On failure NULL, and the reason in `ret_why` (valid until the next call of
 * strerror). */
FILE *file_open(const char *path, const char **ret_why);

#endif
