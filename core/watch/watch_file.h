/* watch_file.h - files of runs, which may be missing, growing, damaged or no files at all: what is there of them, read
 * in bounds and without waiting. */
#ifndef WATCH_FILE_H
#define WATCH_FILE_H

#include <jansson.h>
#include <stddef.h>
#include <time.h>

/* The last lines of DIR/NAME, whole ones, at most `most` of them and of the file's last 64 KiB, in new memory; "" if
 * there are none. A last line without its end is still being written and left out. */
char *watch_file_tail(const char *directory, const char *name, unsigned most);

/* The first line without its end, in new memory; "" if there is none. */
char *watch_file_head(const char *directory, const char *name);

/* The first MiB of the file in new memory; "" if there is none. */
char *watch_file_whole(const char *directory, const char *name);

/* A JSON file of at most so much; NULL if it is none. */
json_t *watch_file_json(const char *directory, const char *name);

/* When the file was changed last; 0: it is not there. */
time_t watch_file_time(const char *directory, const char *name);

/* A text as JSON, made one line of UTF-8 of at most `most` bytes: names of files may hold anything. NULL is null. */
json_t *watch_file_word(const char *text, size_t most);

#endif
