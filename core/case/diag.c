/* diag.c - see diag.h. Messages are kept as text as soon as they are made, so that trees and
 * scenes may go before they are printed; only the sources must live on. Sorting by place makes
 * the report follow the file, whatever the order in which the sections were checked. */
#include "case/diag.h"

#include "base/file.h"
#include "base/mem.h"
#include "base/text.h"

#include <ctype.h>
#include <errno.h>
#include <jansson.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum {
    DIAG_MOST = 100,
    DIAG_WINDOW = 110,
    DIAG_LINE = 1000
}; /* entries printed; characters of a source line, bytes of a message */

struct diag_entry {
    bool error;
    unsigned order;
    struct mark mark;
    struct text message, help; /* help: lines, each ended by a newline */
    char *context;             /* a last line of help, or NULL */
};

struct diag {
    struct source **sources;
    struct diag_entry *entries;
    unsigned n_source, n_entry, n_error;
    char *context;
    bool dropped; /* the last message was not kept: nor is its help */
};

struct diag *diag_new(void)
{
    return mem_new(1, sizeof(struct diag));
}

void diag_free(struct diag *diag)
{
    if (!diag) return;
    for (unsigned i = 0; i < diag->n_source; i++) {
        mem_free(diag->sources[i]->name);
        mem_free(diag->sources[i]->label);
        mem_free(diag->sources[i]->text);
        mem_free(diag->sources[i]);
    }
    for (unsigned i = 0; i < diag->n_entry; i++) {
        text_done(&diag->entries[i].message);
        text_done(&diag->entries[i].help);
        mem_free(diag->entries[i].context);
    }
    mem_free(diag->sources);
    mem_free(diag->entries);
    mem_free(diag->context);
    mem_free(diag);
}

static void *diag_larger(void *list, unsigned count, size_t size)
{
    if (count & (count - 1)) return list; /* room up to the next power of two */
    void *larger = mem_grow(list, count, count ? 2 * (size_t)count : 1, size);
    return larger;
}

static struct source *diag_source(struct diag *diag, const char *name, bool is_file)
{
    diag->sources = diag_larger(diag->sources, diag->n_source, sizeof *diag->sources);
    struct source *source = mem_new(1, sizeof *source);
    diag->sources[diag->n_source++] = source;
    source->name = mem_text(name);
    source->label = mem_text(name);
    text_line(source->label, is_file ? DIAG_LINE : DIAG_WINDOW);
    source->is_file = is_file;
    return source;
}

const struct source *diag_text(struct diag *diag, const char *name, const char *text)
{
    struct source *source = diag_source(diag, name, false);
    source->text = mem_text(text);
    source->length = strlen(text);
    return source;
}

/* The bytes of a stream, at most `most` + 1 of them. */
static void diag_slurp(FILE *stream, size_t most, struct text *text)
{
    char block[65536];
    size_t got;
    text_add_n(text, "", 0);
    while (text->length <= most && (got = fread(block, 1, sizeof block, stream)) > 0) text_add_n(text, block, got);
}

const struct source *diag_file(struct diag *diag, const char *path, size_t most, const struct mark *from)
{
    const char *why;
    FILE *stream = file_open(path, &why);
    if (!stream) {
        diag_error(diag, from, "cannot read '%s': %s", path, why);
        return NULL;
    }
    struct text text = {0};
    errno = 0;
    diag_slurp(stream, most, &text);
    bool failed = ferror(stream);
    fclose(stream);
    if (failed || text.length > most) {
        if (failed) diag_error(diag, from, "cannot read '%s': %s", path, strerror(errno));
        else diag_error(diag, from, "'%s' is larger than %zu bytes", path, most);
        text_done(&text);
        return NULL;
    }
    struct source *source = diag_source(diag, path, true);
    source->text = text.at;
    source->length = text.length;
    return source;
}

void diag_context(struct diag *diag, const char *context)
{
    mem_free(diag->context);
    diag->context = mem_text(context);
}

static void diag_add(struct diag *diag, bool error, const struct mark *mark, const char *format, va_list args)
{
    diag->entries = diag_larger(diag->entries, diag->n_entry, sizeof *diag->entries);
    struct diag_entry *entry = &diag->entries[diag->n_entry];
    *entry = (struct diag_entry){.error = error, .order = diag->n_entry++};
    if (mark) entry->mark = *mark;
    va_list again;
    va_copy(again, args);
    int length = vsnprintf(NULL, 0, format, args);
    char *message = mem_new((size_t)length + 1, 1);
    vsnprintf(message, (size_t)length + 1, format, again);
    va_end(again);
    text_line(message, DIAG_LINE);
    text_add_n(&entry->message, message, strlen(message));
    mem_free(message);
    diag->n_error += error;
    diag->dropped = false;
    entry->context = mem_text(diag->context);
}

void diag_error(struct diag *diag, const struct mark *mark, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    diag_add(diag, true, mark, format, args);
    va_end(args);
}

void diag_warn(struct diag *diag, const struct mark *mark, const char *format, ...)
{
    diag->dropped = diag->context != NULL;
    if (diag->dropped) return;
    va_list args;
    va_start(args, format);
    diag_add(diag, false, mark, format, args);
    va_end(args);
}

void diag_help(struct diag *diag, const char *format, ...)
{
    char line[2048];
    va_list args;
    if (diag->dropped || diag->n_entry == 0) return;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    text_line(line, DIAG_LINE);
    text_add(&diag->entries[diag->n_entry - 1].help, "%s\n", line);
}

void diag_suggest(struct diag *diag, const char *word, const char *const *names)
{
    const char *nearest = text_nearest(word, names);
    if (nearest) {
        diag_help(diag, "did you mean '%s'?", nearest);
        return;
    }
    struct text list = {0};
    for (unsigned i = 0; names[i]; i++) text_add(&list, "%s%s", i ? ", " : "", names[i]);
    if (list.length) diag_help(diag, "allowed: %s", list.at);
    text_done(&list);
}

unsigned diag_errors(const struct diag *diag)
{
    return diag->n_error;
}

static int diag_compare(const void *a, const void *b)
{
    const struct diag_entry *p = a, *q = b;
    int files = 0;
    if (p->mark.source && q->mark.source) files = strcmp(p->mark.source->name, q->mark.source->name);
    else files = (p->mark.source != NULL) - (q->mark.source != NULL);
    if (files) return files;
    if (p->mark.line != q->mark.line) return p->mark.line - q->mark.line;
    if (p->mark.column != q->mark.column) return p->mark.column - q->mark.column;
    return p->order < q->order ? -1 : 1;
}

static bool diag_continues(char byte)
{
    return ((unsigned char)byte & 0xc0) == 0x80; /* not the first byte of a UTF-8 character */
}

/* Bytes of the first `characters` characters of a line. */
static size_t diag_bytes(const char *line, size_t length, int characters)
{
    size_t at = 0;
    for (int i = 0; i < characters && at < length; i++) {
        at++;
        while (at < length && diag_continues(line[at])) at++;
    }
    return at;
}

/* One line of the source, with odd bytes made visible, at most DIAG_WINDOW characters. */
static void diag_clean(FILE *to, const char *line, size_t length)
{
    char shown[4 * DIAG_WINDOW + 1];
    size_t end = diag_bytes(line, length, DIAG_WINDOW);
    if (end > sizeof shown - 1) end = sizeof shown - 1;
    for (size_t i = 0; i < end; i++) shown[i] = line[i] == '\t' ? ' ' : line[i] ? line[i] : '?';
    shown[end] = '\0';
    text_line(shown, sizeof shown);
    fputs(shown, to);
}

static const char *diag_line(const struct source *source, int number, size_t *ret_length)
{
    const char *line = source->text, *end = source->text + source->length;
    for (int i = 1; i < number && line < end; i++) {
        const char *next = memchr(line, '\n', (size_t)(end - line));
        line = next ? next + 1 : end;
    }
    const char *stop = memchr(line, '\n', (size_t)(end - line));
    *ret_length = (size_t)((stop ? stop : end) - line);
    if (*ret_length && line[*ret_length - 1] == '\r') --*ret_length;
    return line;
}

/* The source line and a caret below the place; a long line is shown from near the place on. */
static void diag_excerpt(FILE *to, const struct mark *mark)
{
    size_t length;
    const char *line = diag_line(mark->source, mark->line, &length);
    int skip = mark->column > DIAG_WINDOW - 30 ? mark->column - 40 : 0;
    size_t start = diag_bytes(line, length, skip);
    if (length == 0) return;
    int rest = 0;
    for (size_t i = diag_bytes(line, length, mark->column - 1); i < length; i++) rest += !diag_continues(line[i]);
    int width = mark->width < rest ? mark->width : rest;
    int column = mark->column - skip;
    if (width > DIAG_WINDOW - column) width = DIAG_WINDOW - column;
    fprintf(to, "%6d | ", mark->line);
    diag_clean(to, line + start, length - start);
    fprintf(to, "\n       | %*s^", column - 1, "");
    for (int i = 1; i < width; i++) fputc('~', to);
    fputc('\n', to);
}

static bool diag_is_word(char byte)
{
    return isalnum((unsigned char)byte) || byte == '_';
}

/* Is it the piece, and not a part of a longer word? `from`: where the text begins. */
static bool diag_matches(const char *from, const char *at, const char *piece, size_t length)
{
    if (strncmp(at, piece, length) != 0) return false;
    if (at > from && diag_is_word(at[-1]) && diag_is_word(*piece)) return false;
    return !(diag_is_word(piece[length - 1]) && diag_is_word(at[length]));
}

struct mark diag_within(const struct mark *mark, const char *text, size_t at, size_t length)
{
    unsigned before = 0;
    size_t line_length;
    if (!mark->source || length == 0) return *mark;
    for (size_t i = 0; i < at; i++) before += diag_matches(text, text + i, text + at, length);
    const char *line = diag_line(mark->source, mark->line, &line_length);
    const char *from = line + diag_bytes(line, line_length, mark->column - 1);
    struct mark place = {mark->source, mark->line, mark->column, 0};
    for (const char *byte = from; *byte; byte++) {
        if (diag_matches(from, byte, text + at, length) && before-- == 0) {
            for (size_t i = 0; i < length; i++) place.width += !diag_continues(text[at + i]);
            return place;
        }
        place.column = *byte == '\n' ? 1 : place.column + !diag_continues(byte[1]);
        place.line += *byte == '\n';
    }
    return *mark;
}

static void diag_print_entry(const struct diag_entry *entry, FILE *to)
{
    const struct mark *mark = &entry->mark;
    const char *kind = entry->error ? "error" : "warning";
    if (!mark->source) fprintf(to, "%s: %s\n", kind, entry->message.at);
    else if (!mark->source->is_file) fprintf(to, "%s: %s: %s\n", mark->source->label, kind, entry->message.at);
    else fprintf(to, "%s:%d:%d: %s: %s\n", mark->source->label, mark->line, mark->column, kind, entry->message.at);
    if (mark->source && mark->source->is_file) diag_excerpt(to, mark);
    const char *help = entry->help.at ? entry->help.at : "";
    while (*help) {
        int length = (int)strcspn(help, "\n");
        fprintf(to, "  help: %.*s\n", length, help);
        help += length + 1;
    }
    if (entry->context) fprintf(to, "  help: %s\n", entry->context);
}

static void diag_print_json(const struct diag_entry *entry, FILE *to)
{
    json_t *object = json_object();
    json_object_set_new(object, "severity", json_string(entry->error ? "error" : "warning"));
    if (entry->mark.source) {
        json_object_set_new(object, "file", json_string(entry->mark.source->label));
        json_object_set_new(object, "line", json_integer(entry->mark.line));
        json_object_set_new(object, "column", json_integer(entry->mark.column));
    }
    json_object_set_new(object, "message", json_string(entry->message.at));
    const char *context = entry->context ? entry->context : "";
    if (entry->help.length || *context)
        json_object_set_new(object, "help", json_sprintf("%s%s", entry->help.at ? entry->help.at : "", context));
    json_dumpf(object, to, JSON_COMPACT);
    fputc('\n', to);
    json_decref(object);
}

void diag_print(struct diag *diag, FILE *to, bool json)
{
    if (diag->n_entry) qsort(diag->entries, diag->n_entry, sizeof *diag->entries, diag_compare);
    for (unsigned i = 0; i < diag->n_entry; i++) {
        if (i == DIAG_MOST) {
            if (!json) fprintf(to, "... and %u more\n", diag->n_entry - i);
            break;
        }
        if (json) diag_print_json(&diag->entries[i], to);
        else diag_print_entry(&diag->entries[i], to);
    }
    fflush(to);
}
