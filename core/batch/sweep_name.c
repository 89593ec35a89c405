/* sweep_name.c - see sweep_name.h. Only characters that need no quotes anywhere: letters, digits, . + - _ = and the
 * comma. Everything else is left out or becomes a dash. */
#include "batch/sweep_name.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"

#include <ctype.h>
#include <stdint.h>
#include <string.h>
#include <xxhash.h>

enum { SWEEP_NAME_VALUE = 40, SWEEP_NAME_MOST = 160 };

/* The key of a "path=value" without its first steps: of "a.b.c" the part "c" for 1, "b.c" for 2. */
static const char *sweep_name_tail(const char *set, unsigned steps)
{
    const char *at = set + strcspn(set, "=");
    while (at > set && (at[-1] != '.' || --steps > 0)) at--;
    return at;
}

static bool sweep_name_same(const char *a, const char *b)
{
    size_t length = strcspn(a, "=");
    return length == strcspn(b, "=") && strncmp(a, b, length) == 0;
}

const char *sweep_name_key(const struct matrix *matrix, unsigned k)
{
    char *const *sets = matrix->rows[0].sets;
    for (unsigned steps = 1;; steps++) {
        const char *key = sweep_name_tail(sets[k], steps);
        bool alone = true;
        for (unsigned other = 0; other < matrix->n_set; other++)
            if (other != k && sweep_name_same(key, sweep_name_tail(sets[other], steps))) alone = false;
        if (alone || key == sets[k]) return key;
    }
}

/* "[64, 32]" -> "64x32", "10 um" -> "10um", "= 2 * R0" -> "2-R0" */
static void sweep_name_value(struct text *name, const char *value)
{
    const char *between = *value == '[' ? "x" : "-";
    size_t begin = name->length;
    for (const char *at = value; *at && name->length - begin < SWEEP_NAME_VALUE; at++) {
        bool first = name->length == begin;
        if (isalnum((unsigned char)*at) || strchr(".+-_", *at)) text_add_n(name, at, 1);
        else if (*at == ',' && !first) text_add(name, "%s", between);
        else if (strchr("*/:", *at) && !first) text_add(name, "-");
    }
    if (name->length == begin) text_add(name, "-");
}

/* Is there more than one value of setting `k`? */
static bool sweep_name_varies(const struct matrix *matrix, unsigned k)
{
    for (unsigned i = 1; i < matrix->n_row; i++)
        if (strcmp(matrix->rows[i].sets[k], matrix->rows[0].sets[k]) != 0) return true;
    return false;
}

static char *sweep_name_row(const struct matrix *matrix, unsigned index, bool varied)
{
    struct text name = {0};
    text_add(&name, "%s", "");
    for (unsigned k = 0; k < matrix->n_set; k++) {
        const char *key = sweep_name_key(matrix, k);
        if (varied && !sweep_name_varies(matrix, k)) continue;
        text_add(&name, "%s", name.length ? "," : "");
        for (; *key != '='; key++)
            text_add(&name, "%c", isalnum((unsigned char)*key) || strchr(".-_", *key) ? *key : '-');
        text_add(&name, "=");
        sweep_name_value(&name, strchr(matrix->rows[index].sets[k], '=') + 1);
    }
    if (name.length > SWEEP_NAME_MOST) name.at[SWEEP_NAME_MOST] = '\0';
    return name.at;
}

char *sweep_name_varied(const struct matrix *matrix, unsigned index)
{
    return sweep_name_row(matrix, index, true);
}

static uint64_t sweep_name_sum(const struct matrix_row *row)
{
    struct text all = {0};
    for (unsigned k = 0; row->sets[k]; k++) text_add(&all, "%s\n", row->sets[k]);
    uint64_t sum = XXH64(all.at, all.length, 0);
    text_done(&all);
    return sum;
}

/* Rows before `index` that are called the same. */
static bool sweep_name_taken(char *const *names, unsigned index, unsigned n)
{
    for (unsigned i = 0; i < n; i++)
        if (i != index && strcmp(names[i], names[index]) == 0) return true;
    return false;
}

static int sweep_name_equal(const struct matrix *matrix, unsigned a, unsigned b)
{
    for (unsigned k = 0; k < matrix->n_set; k++)
        if (strcmp(matrix->rows[a].sets[k], matrix->rows[b].sets[k]) != 0) return STATUS_OK;
    return status_fail(STATUS_CASE, "matrix: the combinations %u and %u are the same: a value stands twice in a list",
                       a + 1, b + 1);
}

int sweep_name_all(const struct matrix *matrix, char ***ret_names)
{
    unsigned n = matrix->n_row;
    char **names = mem_new(n, sizeof *names);
    bool *taken = mem_new(n, sizeof *taken);
    int code = STATUS_OK;
    for (unsigned i = 0; i < n; i++) names[i] = sweep_name_row(matrix, i, false);
    for (unsigned i = 0; i < n; i++) taken[i] = sweep_name_taken(names, i, n);
    for (unsigned i = 0; i < n; i++) {
        for (unsigned b = i + 1; taken[i] && b < n && !code; b++) code = sweep_name_equal(matrix, i, b);
        if (!taken[i]) continue;
        char *longer = mem_print("%s~%08x", names[i], (unsigned)(sweep_name_sum(&matrix->rows[i]) >> 32));
        mem_free(names[i]);
        names[i] = longer;
    }
    mem_free(taken);
    if (!code) *ret_names = names;
    for (unsigned i = 0; code && i < n; i++) mem_free(names[i]);
    if (code) mem_free(names);
    return code;
}
