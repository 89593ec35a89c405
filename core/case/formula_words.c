/* formula_words.c - see formula_words.h. As coarse as Lua's own reader allows: what is no word of Lua is a word here,
 * and left to it to complain about. */
#include "case/formula_words.h"

#include "base/mem.h"

#include <ctype.h>
#include <string.h>

/* Bytes of "[[", "[==[" and so on with what they enclose; 0: none begins here. */
static size_t formula_words_long(const char *at)
{
    if (*at != '[') return 0;
    size_t level = strspn(at + 1, "=");
    if (at[1 + level] != '[') return 0;
    for (const char *end = at + 2 + level; (end = strchr(end, ']')) != NULL; end++)
        if (strspn(end + 1, "=") == level && end[1 + level] == ']') return (size_t)(end - at) + 2 + level;
    return strlen(at);
}

/* White space and comments. */
static size_t formula_words_blank(const char *at)
{
    const char *from = at;
    for (;;) {
        at += strspn(at, " \t\r\n\f\v");
        if (at[0] != '-' || at[1] != '-') return (size_t)(at - from);
        size_t comment = formula_words_long(at + 2);
        at += 2 + (comment ? comment : strcspn(at + 2, "\n"));
    }
}

static size_t formula_words_string(const char *at)
{
    const char *end = at + 1;
    while (*end && *end != *at) end += *end == '\\' && end[1] ? 2 : 1;
    return (size_t)(end - at) + (*end != '\0');
}

static bool formula_words_is_letter(char byte)
{
    return isalnum((unsigned char)byte) || byte == '_';
}

static size_t formula_words_number(const char *at)
{
    const char *end = at;
    bool hex = at[0] == '0' && (at[1] == 'x' || at[1] == 'X');
    while (formula_words_is_letter(*end) || *end == '.' ||
           ((*end == '+' || *end == '-') && strchr(hex ? "pP" : "eE", end[-1])))
        end++;
    return (size_t)(end - at);
}

static size_t formula_words_operator(const char *at)
{
    static const char *const wide[] = {"...", "..", "==", "~=", "<=", ">=", "//", "::", "<<", ">>", NULL};
    for (const char *const *sign = wide; *sign; sign++)
        if (strncmp(at, *sign, strlen(*sign)) == 0) return strlen(*sign);
    return 1;
}

/* Bytes of the word that begins here. */
static size_t formula_words_length(const char *at)
{
    size_t length = 0;
    if (isdigit((unsigned char)*at) || (*at == '.' && isdigit((unsigned char)at[1]))) return formula_words_number(at);
    if (*at == '"' || *at == '\'') return formula_words_string(at);
    while (formula_words_is_letter(at[length])) length++;
    if (!length) length = formula_words_long(at);
    return length ? length : formula_words_operator(at);
}

struct formula_words formula_words(const char *text)
{
    struct formula_words words = {0};
    for (text += formula_words_blank(text); *text; text += formula_words_blank(text)) {
        struct formula_word word = {text, formula_words_length(text)};
        words.list = mem_grow(words.list, words.n, words.n + 1, sizeof *words.list);
        words.list[words.n++] = word;
        text += word.length;
    }
    return words;
}

void formula_words_done(struct formula_words *words)
{
    mem_free(words->list);
    *words = (struct formula_words){0};
}

bool formula_words_is(const struct formula_words *words, unsigned i, const char *what)
{
    return i < words->n && words->list[i].length == strlen(what) &&
           strncmp(words->list[i].at, what, words->list[i].length) == 0;
}

static bool formula_words_is_keyword(const struct formula_word *word)
{
    static const char *const keywords[] = {"and",      "break",  "do",   "else", "elseif", "end",  "false", "for",
                                           "function", "goto",   "if",   "in",   "local",  "nil",  "not",   "or",
                                           "repeat",   "return", "then", "true", "until",  "while"};
    for (size_t i = 0; i < sizeof keywords / sizeof *keywords; i++)
        if (strlen(keywords[i]) == word->length && strncmp(word->at, keywords[i], word->length) == 0) return true;
    return false;
}

bool formula_words_is_name(const struct formula_words *words, unsigned i)
{
    const struct formula_word *word = &words->list[i];
    return formula_words_is_letter(*word->at) && !isdigit((unsigned char)*word->at) && !formula_words_is_keyword(word);
}

void formula_words_lines(const struct formula_words *words, struct text *chunk)
{
    for (unsigned i = 0; i < words->n; i++) {
        text_add_n(chunk, "\n", 1);
        text_add_n(chunk, words->list[i].at, words->list[i].length);
    }
}

const struct formula_word *formula_words_at(const struct formula_words *words, long line)
{
    long at = 1;
    for (unsigned i = 0; i < words->n; i++) {
        at++;
        for (size_t k = 0; k < words->list[i].length; k++) at += words->list[i].at[k] == '\n';
        if (at >= line) return &words->list[i];
    }
    return &words->list[words->n - 1];
}
