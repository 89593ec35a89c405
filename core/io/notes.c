/* notes.c - see notes.h. A few dozen lines, searched from the start: no index is needed. */
#include "io/notes.h"

#include "base/mem.h"

#include <stdlib.h>
#include <string.h>

void notes_put(struct notes *notes, const char *name, unsigned n, const double *values)
{
    text_add(&notes->text, "%s =", name);
    for (unsigned i = 0; i < n; i++) text_add(&notes->text, " %.17g", values[i]);
    text_add(&notes->text, "\n");
}

void notes_put_one(struct notes *notes, const char *name, double value)
{
    notes_put(notes, name, 1, &value);
}

void notes_put_text(struct notes *notes, const char *name, const char *value)
{
    text_add(&notes->text, "%s = %s\n", name, value);
}

/* What stands behind "name =" up to the end of the line, or NULL. */
static const char *notes_find(const struct notes *notes, const char *name)
{
    size_t length = strlen(name);
    for (const char *line = notes->text.at; line && *line;) {
        if (!strncmp(line, name, length) && !strncmp(line + length, " =", 2)) return line + length + 2;
        line = strchr(line, '\n');
        line = line ? line + 1 : NULL;
    }
    return NULL;
}

bool notes_get(const struct notes *notes, const char *name, unsigned n, double *ret_values)
{
    const char *at = notes_find(notes, name);
    if (!at) return false;
    double *values = mem_new(n, sizeof *values);
    bool good = true;
    for (unsigned i = 0; good && i < n; i++) {
        char *end;
        good = *at == ' ';
        values[i] = strtod(at, &end);
        good = good && end > at + 1;
        at = end;
    }
    good = good && *at == '\n';
    if (good) memcpy(ret_values, values, n * sizeof *values);
    mem_free(values);
    return good;
}

char *notes_get_text(const struct notes *notes, const char *name)
{
    const char *at = notes_find(notes, name);
    if (!at) return NULL;
    at += *at == ' ';
    return mem_text_n(at, strcspn(at, "\n"));
}
