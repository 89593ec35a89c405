/* paint_press.c - see paint_press.h. */
#include "paint/paint_press.h"

#include "phys/mix.h"

#include <math.h>

/* Where a pressure is looked for from [Pa]. */
#define PAINT_PRESS_START 1e5

/* Of the pressures: that far outside of them is round-off, or the noise of a table. */
#define PAINT_PRESS_NOISE 1e-6

static double paint_press_of(const struct model *model, const double *u, double w[MODEL_FIELDS])
{
    w[model->i_E] = PAINT_PRESS_START;
    mix_primitives(model, 1, 1, u, w);
    return w[model->i_E];
}

void paint_press(const struct model *model, const double *u_a, const double *u_b, double part, double *u)
{
    double w[MODEL_FIELDS] = {0.0}, again[MODEL_FIELDS] = {0.0};
    double a = paint_press_of(model, u_a, w), b = paint_press_of(model, u_b, w), p = paint_press_of(model, u, w);
    double low = a < b ? a : b, high = a < b ? b : a, blur = PAINT_PRESS_NOISE * (fabs(low) + fabs(high));
    if ((p >= low - blur && p <= high + blur) || !isfinite(low + high)) return;
    w[model->i_E] = (1.0 - part) * a + part * b;
    mix_conserved(model, 1, 1, w, again);
    if (isfinite(again[model->i_E])) u[model->i_E] = again[model->i_E];
}
