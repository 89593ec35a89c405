/* text.c - see text.h. strtod and printf are only used under the "C" locale, which the
 * program never leaves (nothing calls setlocale). */
#include "base/text.h"

#include "base/mem.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { TEXT_WORD = 64 };

static void text_reserve(struct text *text, size_t more)
{
    size_t needed = text->length + more + 1;
    if (needed <= text->capacity) return;
    size_t capacity = text->capacity ? text->capacity : 256;
    while (capacity < needed) capacity *= 2;
    text->at = mem_grow(text->at, text->length, capacity, 1);
    text->capacity = capacity;
}

void text_add_n(struct text *text, const char *bytes, size_t length)
{
    text_reserve(text, length);
    memcpy(text->at + text->length, bytes, length);
    text->length += length;
    text->at[text->length] = '\0';
}

void text_add(struct text *text, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    text_reserve(text, (size_t)length);
    vsnprintf(text->at + text->length, (size_t)length + 1, format, again);
    va_end(again);
    text->length += (size_t)length;
}

void text_done(struct text *text)
{
    mem_free(text->at);
    *text = (struct text){0};
}

static size_t text_digits(const char *from)
{
    size_t count = 0;
    while (isdigit((unsigned char)from[count])) count++;
    return count;
}

size_t text_number(const char *from, double *ret_value)
{
    size_t at = 0;
    if (from[at] == '+' || from[at] == '-') at++;
    size_t whole = text_digits(from + at), part = 0;
    if (whole > 1 && from[at] == '0') return 0; /* 012 is octal to some readers: refused */
    at += whole;
    if (from[at] == '.') {
        part = text_digits(from + at + 1);
        if (whole + part == 0) return 0;
        at += 1 + part;
    }
    if (whole + part == 0) return 0;
    if (from[at] == 'e' || from[at] == 'E') {
        size_t sign = from[at + 1] == '+' || from[at + 1] == '-';
        size_t digits = text_digits(from + at + 1 + sign);
        if (digits) at += 1 + sign + digits;
    }
    *ret_value = strtod(from, NULL);
    return at;
}

void text_double(struct text *text, double value)
{
    char digits[40];
    for (int precision = 1; precision <= 17; precision++) {
        snprintf(digits, sizeof digits, "%.*g", precision, value);
        if (strtod(digits, NULL) == value) break;
    }
    text_add(text, "%s", digits);
}

static unsigned text_least(unsigned a, unsigned b)
{
    return a < b ? a : b;
}

unsigned text_distance(const char *a, const char *b)
{
    size_t la = strlen(a), lb = strlen(b);
    if (la >= TEXT_WORD || lb >= TEXT_WORD) return TEXT_WORD;
    unsigned row[3][TEXT_WORD + 1]; /* the two rows before and this one: optimal string alignment */
    for (size_t j = 0; j <= lb; j++) row[0][j] = (unsigned)j;
    for (size_t i = 1; i <= la; i++) {
        unsigned *now = row[i % 3], *last = row[(i + 2) % 3], *older = row[(i + 1) % 3];
        now[0] = (unsigned)i;
        for (size_t j = 1; j <= lb; j++) {
            now[j] = text_least(text_least(last[j] + 1, now[j - 1] + 1), last[j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                now[j] = text_least(now[j], older[j - 2] + 1);
        }
    }
    return row[la % 3][lb];
}

const char *text_nearest(const char *word, const char *const *names)
{
    const char *best = NULL;
    unsigned length = (unsigned)strlen(word), least = length / 3 + 2;
    if (least > length) least = length; /* nothing of the word would be left */
    for (; *names; names++) {
        if (strcasecmp(word, *names) == 0) return *names;
        unsigned distance = text_distance(word, *names);
        if (distance < least) {
            least = distance;
            best = *names;
        }
    }
    return best;
}

bool text_is_identifier(const char *word)
{
    if (!isalpha((unsigned char)*word) && *word != '_') return false;
    for (; *word; word++)
        if (!isalnum((unsigned char)*word) && *word != '_') return false;
    return true;
}

/* Bytes of the UTF-8 character at `from`; 0 if there is none (Unicode 15, table 3-7). */
static size_t text_character(const unsigned char *from)
{
    if (*from < 0x80) return 1;
    size_t length = *from >= 0xc2 && *from < 0xe0 ? 2 : (*from & 0xf0) == 0xe0 ? 3 : (*from & 0xf8) == 0xf0 ? 4 : 0;
    for (size_t i = 1; i < length; i++)
        if ((from[i] & 0xc0) != 0x80) return 0;
    bool narrow = (*from == 0xe0 && from[1] < 0xa0) || (*from == 0xf0 && from[1] < 0x90);
    bool beyond = (*from == 0xed && from[1] > 0x9f) || (*from == 0xf4 && from[1] > 0x8f) || *from > 0xf4;
    return narrow || beyond ? 0 : length;
}

void text_line(char *text, size_t most)
{
    size_t length = strlen(text), end = 0;
    for (size_t at = 0, step; at < length; at += step) {
        unsigned char *byte = (unsigned char *)text + at;
        step = text_character(byte);
        bool odd = !step || *byte < 0x20 || *byte == 0x7f || (*byte == 0xc2 && byte[1] < 0xa0);
        if (odd) {
            memset(byte, '?', step ? step : 1);
            step = step ? step : 1;
        }
        if (at + step <= most - 3) end = at + step;
    }
    if (length > most) memcpy(text + end, "...", 4);
}
