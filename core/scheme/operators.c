/* operators.c - see operators.h. The list below is the page that shows what acts beside the equations. */
#include "scheme/operators.h"

#include "phys/mix.h"
#include "scheme/phase_change.h"
#include "scheme/plastic.h"
#include "scheme/rupture.h"

#include <assert.h>
#include <string.h>

const struct operator* operators_all[OPERATORS_MOST + 1] = {
    &phase_change_operator, /* liquids evaporate, vapours condense */
    &plastic_between_operator,
    &plastic_operator, /* stresses beyond the strength of solids flow off */
    &rupture_operator, /* solids break */
    NULL,
};

static bool operators_has(const struct operator* operator, const struct model * path)
{
    return !operator->wanted || operator->wanted(path);
}

void operators_of(const struct model *path, struct operators *ret_operators)
{
    *ret_operators = (struct operators){0};
    for (unsigned i = 0; operators_all[i]; i++) {
        const struct operator* operator= operators_all[i];
        assert(i < OPERATORS_MOST);
        if (operator->waits && operator->waits(path)) ret_operators->waiting[ret_operators->n_waiting++] = operator;
        if (!operators_has(operator, path)) continue;
        ret_operators->at[operator->when][ret_operators->n[operator->when]++] = operator;
        ret_operators->moves = ret_operators->moves || operator->moves;
        ret_operators->reads = ret_operators->reads || (operator->reads && operator->reads(path));
    }
}

bool operators_spread(const struct model *path)
{
    bool spread = false;
    for (unsigned i = 0; operators_all[i]; i++)
        spread = spread || (operators_all[i]->spreads && operators_all[i]->spreads(path));
    return spread;
}

bool operators_wake(const struct operators *operators, const struct model *path, size_t n, size_t stride,
                    const double *w)
{
    bool wake = false;
    for (unsigned i = 0; i < operators->n_waiting; i++) wake = wake || operators->waiting[i]->wakes(path, n, stride, w);
    return wake;
}

static struct mix_effort operators_act_when(const struct operators *operators, enum operator_when when,
                                            const struct operator_tile *tile)
{
    struct mix_effort effort = {0};
    for (unsigned i = 0; i < operators->n[when]; i++) {
        const struct operator* operator= operators->at[when][i];
        if (operator->reads && operator->reads(tile->model))
            mix_pressure_sum(&effort, mix_primitives(tile->model, tile->n_cell, tile->n_cell, tile->u, tile->w));
        operator->acts(tile);
    }
    return effort;
}

struct mix_effort operators_act(const struct operators *operators, bool last, const struct operator_tile *tile)
{
    struct mix_effort effort = operators_act_when(operators, OPERATOR_STAGE, tile);
    mix_pressure_sum(&effort, operators_act_when(operators, last ? OPERATOR_STEP : OPERATOR_BETWEEN, tile));
    if (operators->reads)
        memcpy(tile->w + tile->model->i_E * tile->n_cell, tile->before, tile->n_cell * sizeof *tile->before);
    return effort;
}

void operators_say(const struct model *model, enum operator_when when, struct text *text)
{
    for (unsigned i = 0; operators_all[i]; i++) {
        const struct operator* operator= operators_all[i];
        if (operator->when != when || !operators_has(operator, model)) continue;
        text_add(text, "  %-10s  %s", operator->name, operator->equation);
        if (operator->say) operator->say(model->scene, text);
        text_add(text, "  [%s]\n", operator->owner);
    }
}
