/* sweep_value.c - see sweep_value.h. */
#include "batch/sweep_value.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "judge/formula.h"

#include <ctype.h>
#include <string.h>

enum { SWEEP_VALUE_FIXED = 7 };

/* Columns of every history.csv. */
static const char *const sweep_value_fixed[SWEEP_VALUE_FIXED] = {
    "step", "t", "dt", "guard_fallback", "guard_relaxed", "guard_clipped", "guard_retries"};

/* "NAME = EXPRESSION": an expression has no '=' of its own. */
static struct sweep_value sweep_value_split(const char *given)
{
    const char *equals = strchr(given, '='), *text = equals ? equals + 1 : given;
    size_t length = equals ? (size_t)(equals - given) : strlen(given);
    while (length && isspace((unsigned char)given[length - 1])) length--;
    text += strspn(text, " \t");
    return (struct sweep_value){.label = mem_text_n(given, length), .text = text};
}

void sweep_value_read(const struct cli_given *given, struct sweep_value **ret_values, unsigned *ret_count)
{
    struct sweep_value *values = mem_new((size_t)given->n_option, sizeof *values);
    unsigned n = 0;
    for (int i = 0; i < given->n_option; i++)
        if (!strcmp(given->options[i]->name, "--value")) values[n++] = sweep_value_split(given->values[i]);
    *ret_values = values;
    *ret_count = n;
}

void sweep_value_done(struct sweep_value *values, unsigned count)
{
    for (unsigned i = 0; i < count; i++) mem_free(values[i].label);
    mem_free(values);
}

/* The columns that a run will write: two rows stand for those to come. */
static bool sweep_value_column(void *context, const char *name, struct trace *ret_trace)
{
    static const double t[2] = {0, 1}, v[2] = {1, 1};
    const struct scene *scene = context;
    bool found = false;
    for (int i = 0; i < SWEEP_VALUE_FIXED; i++) found = found || strcmp(name, sweep_value_fixed[i]) == 0;
    for (unsigned i = 0; i < scene->n_column; i++) found = found || strcmp(name, scene->columns[i].name) == 0;
    for (unsigned i = 0; i < scene->n_probe; i++) {
        size_t length = strlen(scene->probes[i].name);
        found = found || (strncmp(name, scene->probes[i].name, length) == 0 && name[length] == '.');
    }
    *ret_trace = (struct trace){2, t, v};
    return found;
}

static bool sweep_value_number(void *context, const char *name, double *ret_value)
{
    const struct scene *scene = context;
    return scene->host && text_is_identifier(name) &&
           script_evaluate(scene->host, name, scene->path, 0, ret_value) == STATUS_OK;
}

int sweep_value_check(const struct sweep_value *value, const struct scene *scene)
{
    const char **known = mem_new(SWEEP_VALUE_FIXED + scene->n_column + 1, sizeof *known);
    for (unsigned i = 0; i < SWEEP_VALUE_FIXED; i++) known[scene->n_column + i] = sweep_value_fixed[i];
    for (unsigned i = 0; i < scene->n_column; i++) known[i] = scene->columns[i].name;
    struct scene copy = *scene;
    struct formula_names names = {&copy, sweep_value_column, sweep_value_number, known};
    int code = formula_check(value->text, &names);
    if (code) status_wrap(code, "--value: ");
    mem_free(known);
    return code;
}
