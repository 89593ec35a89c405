/* sweep_value.c - see sweep_value.h. */
#include "batch/sweep_value.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/scene_columns.h"

#include <ctype.h>
#include <string.h>

/* The '=' of "NAME = EXPRESSION", which is no "==", "<=" and so on; NULL: there is none. */
static const char *sweep_value_equals(const char *given)
{
    for (const char *at = strchr(given, '='); at; at = strchr(at + 1 + (at[1] == '='), '='))
        if (at[1] != '=' && !(at > given && strchr("<>~", at[-1]))) return at;
    return NULL;
}

static struct sweep_value sweep_value_split(const char *given)
{
    const char *equals = sweep_value_equals(given), *text = equals ? equals + 1 : given;
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

int sweep_value_check(const struct sweep_value *value, const struct scene *scene)
{
    struct formula *plan = scene_columns_plan(scene);
    double number;
    int code = formula_value(plan, value->text, &number, NULL);
    if (code) status_wrap(code, "--value: ");
    formula_free(plan);
    return code;
}
