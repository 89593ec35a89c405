/* status.c - the one place where the text of the last failure lives.
 *
 * Each thread has its own (aside.h), so a static buffer serves. */
#include "base/status.h"

#include "base/text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { STATUS_LINE = 4000 }; /* longest message: one line, whatever names and values are in it */

static _Thread_local char status_buffer[4096];

int status_fail(int code, const char *format, ...)
{
    char text[sizeof status_buffer]; /* the arguments may point into the old message */
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    text_line(text, STATUS_LINE);
    memcpy(status_buffer, text, sizeof text);
    return code;
}

int status_wrap(int code, const char *format, ...)
{
    char head[1024], text[sizeof status_buffer];
    va_list args;
    va_start(args, format);
    vsnprintf(head, sizeof head, format, args);
    va_end(args);
    size_t length = strlen(head);
    memcpy(text, head, length);
    snprintf(text + length, sizeof text - length, "%s", status_buffer);
    text_line(text, STATUS_LINE);
    memcpy(status_buffer, text, sizeof text);
    return code;
}

const char *status_text(void)
{
    return status_buffer;
}
