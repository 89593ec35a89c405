/* formula.c - numbers, units and the expressions of `expect`: over a run, and over one to come. */
#include "base/text.h"
#include "case/formula.h"
#include "case/script_host.h"
#include "case/unit.h"
#include "fuzz.h"

static const double formula_t[] = {0.0, 1.0, 2.5}, formula_v[] = {3.0, -1.0, 7.0};

/* A fault is within the text, and one that is no fault has a value. */
static void formula_try(struct formula *formula, const char *text)
{
    struct formula_fault fault;
    double value;
    bool wrong = formula_value(formula, text, &value, &fault) != 0;
    if (wrong != (fault.said != NULL) || fault.at + fault.length > strlen(text)) abort();
    formula_fault_done(&fault);
}

static void formula_try_all(const char *text)
{
    static const char *const names[] = {"t", "V", "wall.pressure", "wall.density", "none"};
    struct script_host *host = script_host_new();
    struct formula *run = formula_new(host, false), *plan = formula_new(host, true);
    script_set_number(host, "R0", 2.0);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        formula_add(run, names[i], &(struct trace){i < 4 ? 3 : 0, formula_t, i ? formula_v : formula_t});
        formula_plan(plan, names[i]);
    }
    formula_try(run, text);
    formula_try(plan, text);
    formula_free(run);
    formula_free(plan);
    script_host_free(host);
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
    char *text = fuzz_text(data, size);
    double value, again;
    formula_try_all(text);
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
