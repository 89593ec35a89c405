/* text.h - strings: locale-free numbers, suggestions, growing buffers. */
#ifndef TEXT_H
#define TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* A growing string. Start from {0}; free with text_done. `at` is always terminated once used. */
struct text {
    char *at;
    size_t length, capacity;
};

void text_add(struct text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
void text_add_n(struct text *text, const char *bytes, size_t length);
void text_done(struct text *text);

/* Reads a plain decimal number (YAML 1.2 core: optional sign, digits, fraction, exponent;
 * also .inf and .nan are refused) at the start of `from`; returns the number of bytes read, 0
 * if there is none. Independent of the locale; overflow gives infinity. */
size_t text_number(const char *from, double *ret_value);

/* Writes the shortest decimal form that reads back to the same double. */
void text_double(struct text *text, double value);

/* Edit distance (insert, delete, replace, swap of neighbours), for "did you mean". */
unsigned text_distance(const char *a, const char *b);

/* The name closest to `word` out of a NULL-terminated list, or NULL if none is close. */
const char *text_nearest(const char *word, const char *const *names);

/* Is it an identifier: [A-Za-z_][A-Za-z0-9_]* ? */
bool text_is_identifier(const char *word);

/* Makes one line of a text that people and terminals can read, in place: control bytes and what is not UTF-8 become
 * '?', and what is longer than `most` (> 3) bytes ends in "...". */
void text_line(char *text, size_t most);

#endif
