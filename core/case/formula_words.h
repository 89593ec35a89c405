/* formula_words.h - a Lua text as a list of words, each with its place. */
#ifndef FORMULA_WORDS_H
#define FORMULA_WORDS_H

#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* A name, number, string or operator. */
struct formula_word {
    const char *at;
    size_t length;
};

struct formula_words {
    unsigned n;
    struct formula_word *list;
};

/* Takes a text apart; white space and comments are left out. The words point into it. Release with
 * formula_words_done. */
struct formula_words formula_words(const char *text);
void formula_words_done(struct formula_words *words);

/* Is word i, if there is one, this one? Is it a name, and none of Lua's own? */
bool formula_words_is(const struct formula_words *words, unsigned i, const char *what);
bool formula_words_is_name(const struct formula_words *words, unsigned i);

/* Appends the words, each on a line of its own, the first after a line break. */
void formula_words_lines(const struct formula_words *words, struct text *chunk);

/* The word that stands on a line of a text whose first line was there before formula_words_lines; the last one if it
 * has no such line. There must be words. */
const struct formula_word *formula_words_at(const struct formula_words *words, long line);

#endif
