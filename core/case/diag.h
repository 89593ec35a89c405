/* diag.h - everything that is wrong with a case, collected in one pass and printed together.
 *
 * A message points into a source: a file, or a piece of the command line ("--set ..."). It is
 * printed as `file:line:col: error: ...`, the line itself, a caret, and lines of help. */
#ifndef DIAG_H
#define DIAG_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* A text that was read: `name` is its path; messages show it as `label`, one readable line. */
struct source {
    char *name, *label;
    char *text; /* terminated; `length` bytes without the terminator */
    size_t length;
    bool is_file; /* else a piece of the command line: messages give no line number */
};

/* A place in a source; line and column count from 1, columns are characters, not bytes.
 * `width`: characters to underline. A zeroed mark points nowhere. */
struct mark {
    const struct source *source;
    int line, column, width;
};

/* The place of `length` bytes from `at` on in the text of a scalar that begins at `mark`: where the same piece stands
 * for the same time in the source, whatever quotes and line breaks are around it; `mark` if it does not. */
struct mark diag_within(const struct mark *mark, const char *text, size_t at, size_t length);

struct diag;

struct diag *diag_new(void);
void diag_free(struct diag *diag); /* its sources too; NULL is fine */

/* Reads a file as a source, or makes one of a text (copied). Owned by `diag`. A file that
 * cannot be read or is larger than `most` bytes gives NULL and a recorded error at `from`. */
const struct source *diag_file(struct diag *diag, const char *path, size_t most, const struct mark *from);
const struct source *diag_text(struct diag *diag, const char *name, const char *text);

/* Adds an error or a warning at a place; printf formats. */
void diag_error(struct diag *diag, const struct mark *mark, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void diag_warn(struct diag *diag, const struct mark *mark, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Adds a `help:` line to the message added last. */
void diag_help(struct diag *diag, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* help: "did you mean 'x'?" if one of the names is close to `word`, else "allowed: a, b, c". */
void diag_suggest(struct diag *diag, const char *word, const char *const *names);

/* Until the next call every error gets this line of help and warnings are dropped: for readings of the
 * same files in another way. NULL ends it. */
void diag_context(struct diag *diag, const char *context);

unsigned diag_errors(const struct diag *diag);

/* Prints all messages in the order of their places; `json`: one object per line. */
void diag_print(struct diag *diag, FILE *to, bool json);

#endif
