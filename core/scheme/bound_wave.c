/* bound_wave.c - see bound_wave.h. */
#include "scheme/bound_wave.h"

#include <math.h>

enum { BOUND_WAVE_POINTS = 5, BOUND_WAVE_STEPS = 40 };

#define BOUND_WAVE_LEAST -20.0 /* of the logarithm of the softest K_l: nothing is left */

/* ln(1 + y)/y and (e^s - 1)/s. */
static double bound_wave_slope(double y)
{
    return y == 0.0 ? 1.0 : log1p(y) / y;
}

static double bound_wave_growth(double s)
{
    return s == 0.0 ? 1.0 : expm1(s) / s;
}

double bound_wave_ratio(double x, double y)
{
    return exp(x * bound_wave_slope(y));
}

/* Z of the materials of a wave after a step of pressure. */
static double bound_wave_impedance(const struct bound_wave *wave, double dp)
{
    double volume = 0.0, give = 0.0;
    for (unsigned k = 0; k < wave->n; k++) {
        double x = dp / wave->part_K[k], y = wave->part_gamma[k] * x;
        double v = wave->share[k] / bound_wave_ratio(x, y);
        volume += v;
        give += v / (wave->part_K[k] * (1.0 + y));
    }
    return sqrt(wave->rho / volume * (volume / give + wave->rest));
}

/* How far the pressure may fall until the first of the materials has no stiffness. */
static double bound_wave_depth(const struct bound_wave *wave)
{
    double depth = HUGE_VAL;
    for (unsigned k = 0; k < wave->n; k++)
        if (wave->part_gamma[k] > 0.0 && wave->part_K[k] < depth * wave->part_gamma[k])
            depth = wave->part_K[k] / wave->part_gamma[k];
    return depth;
}

/* U over the step depth (e^t - 1). */
static double bound_wave_sum(const struct bound_wave *wave, double depth, double t)
{
    static const double at[BOUND_WAVE_POINTS] = {0.046910077030668004, 0.23076534494715845, 0.5, 0.76923465505284155,
                                                 0.953089922969332};
    static const double weight[BOUND_WAVE_POINTS] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                                     0.23931433524968324, 0.11846344252809454};
    double sum = 0.0;
    for (int i = 0; i < BOUND_WAVE_POINTS; i++)
        sum += weight[i] * exp(t * at[i]) / bound_wave_impedance(wave, depth * expm1(t * at[i]));
    return t * depth * sum;
}

double bound_wave_reach(const struct bound_wave *wave, double dp)
{
    double depth = bound_wave_depth(wave);
    if (wave->n && depth < HUGE_VAL && dp > -0.999 * depth) return bound_wave_sum(wave, depth, log1p(dp / depth));
    double x = dp / wave->K, y = wave->gamma * x;
    if (!(y > -1.0)) return (double)NAN;
    return dp / wave->Z * bound_wave_slope(y) * bound_wave_growth(0.5 * (y - x) * bound_wave_slope(y));
}

/* Newton's rule for bound_wave_sum(t) = du, steps no longer than 1. NAN: the materials bear no such wave together. */
static double bound_wave_solve(const struct bound_wave *wave, double depth, double du)
{
    double t = 0.0;
    for (int i = 0; i < BOUND_WAVE_STEPS && t > BOUND_WAVE_LEAST; i++) {
        double slope = depth * exp(t) / bound_wave_impedance(wave, depth * expm1(t));
        double step = (du - bound_wave_sum(wave, depth, t)) / slope;
        t += step > 1.0 ? 1.0 : step < -1.0 ? -1.0 : step;
        if (!(fabs(step) > 1e-14 * fabs(t))) return depth * expm1(t);
    }
    return (double)NAN;
}

double bound_wave_push(const struct bound_wave *wave, double du)
{
    double depth = bound_wave_depth(wave), x = du * wave->Z / wave->K, q = 0.5 * (wave->gamma - 1.0) * x;
    double dp = wave->n && depth < HUGE_VAL ? bound_wave_solve(wave, depth, du) : (double)NAN;
    if (isfinite(dp)) return dp;
    if (!(q > -1.0)) return (double)NAN;
    return du * wave->Z * bound_wave_slope(q) * bound_wave_growth(wave->gamma * x * bound_wave_slope(q));
}
