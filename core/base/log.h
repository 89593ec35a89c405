/* log.h - lines for people: to the terminal (stderr) and, once opened, to log.txt.
 *
 * Only rank 0 writes. Warnings are always shown on the terminal; notes only when not quiet. */
#ifndef LOG_H
#define LOG_H

#include <stdbool.h>

/* Opens `path` for the lines that follow (appends); returns 0 or STATUS_RUN. */
int log_open(const char *path, bool append);
void log_close(void);
void log_set_quiet(bool quiet);

/* A line without its newline; printf formats. */
void log_note(const char *format, ...) __attribute__((format(printf, 1, 2)));  /* terminal + file */
void log_warn(const char *format, ...) __attribute__((format(printf, 1, 2)));  /* "warning: " + line */
void log_error(const char *format, ...) __attribute__((format(printf, 1, 2))); /* "error: " + line */
void log_file(const char *format, ...) __attribute__((format(printf, 1, 2)));  /* file only */

#endif
