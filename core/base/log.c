/* log.c - see log.h. */
#include "base/log.h"

#include "base/comm.h"
#include "base/status.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static FILE *log_stream;
static bool log_is_quiet;

int log_open(const char *path, bool append)
{
    log_close();
    if (comm_rank() != 0) return STATUS_OK;
    log_stream = fopen(path, append ? "a" : "w");
    if (!log_stream) return status_fail(STATUS_RUN, "cannot write %s: %s", path, strerror(errno));
    return STATUS_OK;
}

void log_close(void)
{
    if (log_stream) fclose(log_stream);
    log_stream = NULL;
}

void log_set_quiet(bool quiet)
{
    log_is_quiet = quiet;
}

static void log_put(FILE *stream, const char *head, const char *format, va_list args)
{
    if (!stream || comm_rank() != 0) return;
    va_list copy;
    va_copy(copy, args);
    fputs(head, stream);
    vfprintf(stream, format, copy);
    fputc('\n', stream);
    fflush(stream);
    va_end(copy);
}

#define LOG_BOTH(terminal, head)                 \
    do {                                         \
        va_list args;                            \
        va_start(args, format);                  \
        log_put(terminal, head, format, args);   \
        log_put(log_stream, head, format, args); \
        va_end(args);                            \
    } while (0)

void log_note(const char *format, ...)
{
    LOG_BOTH(log_is_quiet ? NULL : stderr, "");
}

void log_warn(const char *format, ...)
{
    LOG_BOTH(stderr, "warning: ");
}

void log_error(const char *format, ...)
{
    LOG_BOTH(stderr, "error: ");
}

void log_file(const char *format, ...)
{
    LOG_BOTH(NULL, "");
}
