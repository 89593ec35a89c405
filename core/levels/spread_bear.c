/* spread_bear.c - see spread_bear.h. Scalar code: it runs where refluxing is spread. */
#include "levels/spread_bear.h"

#include "phys/mix.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Fractions above this one are judged, as by the guard. */
#define SPREAD_BEAR_PRESENT 1e-6

/* What a cell that cannot bear everything keeps of what it could: at the edge it would have no pressure left. */
#define SPREAD_BEAR_PART 0.5

/* Bisections of the part: 1e-6 of it is near enough. */
enum { SPREAD_BEAR_ROUNDS = 20 };

/* Materials with a pressure of their own beside a solid need not bear what the solid does. */
static bool spread_bear_asked(const struct model *model, unsigned l)
{
    return !model->split || model_is_solid(model, l);
}

/* Written so that a NaN counts as bad. */
static bool spread_bear_state(const struct model *model, const double *u)
{
    double w[MODEL_FIELDS] = {0}, stiffness[SCENE_MATERIALS], c2;
    mix_primitives(model, 1, 1, u, w);
    mix_stiffness(model, 1, 1, w, stiffness);
    mix_speed2(model, 1, 1, w, stiffness, &c2);
    if (!(c2 > 0.0 && c2 < HUGE_VAL && fabs(w[model->i_E]) < HUGE_VAL)) return false;
    for (unsigned l = 0; l < model->n_alpha; l++)
        if (w[model->i_alpha + l] > SPREAD_BEAR_PRESENT && spread_bear_asked(model, l) && !(stiffness[l] > 0.0))
            return false;
    return true;
}

double spread_bear(const struct model *model, size_t stride, const double *u, const double *delta, unsigned n,
                   double factor, const double *change, double most)
{
    double now[MODEL_FIELDS], then[MODEL_FIELDS], low = 0.0, high = most;
    for (unsigned q = 0; q < model->n_field; q++) then[q] = now[q] = u[q * stride] + delta[q * stride];
    for (int round = 0; round <= SPREAD_BEAR_ROUNDS; round++) {
        double part = round ? 0.5 * (low + high) : most;
        for (unsigned q = 0; q < n; q++) then[q] = now[q] + part * factor * change[q];
        bool borne = spread_bear_state(model, then);
        if (borne && !round) return most;
        if (borne) low = part;
        else high = part;
    }
    return SPREAD_BEAR_PART * low;
}
