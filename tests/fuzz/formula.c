/* formula.c - numbers, units and the expressions of `expect`. */
#include "base/text.h"
#include "case/unit.h"
#include "judge/formula.h"
#include "fuzz.h"

static const double formula_t[] = {0.0, 1.0, 2.5}, formula_v[] = {3.0, -1.0, 7.0};

static bool formula_column(void *context, const char *name, struct trace *ret_trace)
{
    (void)context;
    *ret_trace = (struct trace){3, formula_t, formula_v};
    return strcmp(name, "V") == 0 || strcmp(name, "wall.pressure") == 0;
}

static bool formula_number(void *context, const char *name, double *ret_value)
{
    (void)context;
    *ret_value = 2.0;
    return strcmp(name, "R0") == 0;
}

static void formula_try_unit(const char *text)
{
    struct unit unit, wanted = {.factor = 1, .power = {-1, 1, -2, 0, 0}};
    char bad[32], guess[32], words[80];
    double value;
    if (unit_quantity(text, &value, &unit, bad) == UNIT_UNKNOWN) unit_guess(bad, &wanted, guess);
    if (unit_parse(text, &unit, bad)) {
        unit_kind(&unit, words, sizeof words);
        unit_examples(&unit);
    }
}

FUZZ(data, size)
{
    static const char *const known[] = {"V", "wall.pressure", "R0", NULL};
    const struct formula_names names = {NULL, formula_column, formula_number, known};
    char *text = fuzz_text(data, size);
    double value, again;
    formula_evaluate(text, &names, &value);
    formula_try_unit(text);
    if (text_number(text, &value) && value - value == 0) { /* finite numbers survive writing */
        struct text out = {0};
        text_double(&out, value);
        if (!text_number(out.at, &again) || memcmp(&value, &again, sizeof value)) abort();
        text_done(&out);
    }
    text_line(text, 40);
    free(text);
    return 0;
}
