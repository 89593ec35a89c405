/* notes.h - named numbers and texts, one `name = value` a line: what a checkpoint says about a run beside
 * its fields, readable by people. Numbers are written so that they read back to the same bits. */
#ifndef NOTES_H
#define NOTES_H

#include "base/text.h"

#include <stdbool.h>

/* Start from {0}; free with text_done(&notes->text). */
struct notes {
    struct text text;
};

/* Adds a line; `name` has no blanks, a text no line break. A name is used once. */
void notes_put(struct notes *notes, const char *name, unsigned n, const double *values);
void notes_put_one(struct notes *notes, const char *name, double value);
void notes_put_text(struct notes *notes, const char *name, const char *value);

/* Exactly n numbers; false (nothing stored) if there is no such line or another number of them. */
bool notes_get(const struct notes *notes, const char *name, unsigned n, double *ret_values);

/* The text of a line, released with mem_free; NULL if there is none. */
char *notes_get_text(const struct notes *notes, const char *name);

#endif
