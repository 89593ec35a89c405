/* saturation.c - see saturation.h. Bracketed Newton in ln p and in T; once per pair, and where outputs ask. */
#include "case/saturation.h"

#include "bulla/eos.h"

#include <math.h>
#include <string.h>
#include <stddef.h>

enum { SATURATION_ROUNDS = 100 };

#define SATURATION_COLD 200.0
#define SATURATION_HOT 2000.0
#define SATURATION_STEP 4.0   /* SATURATION_POINTS of them from cold to hot */
#define SATURATION_LEAST 1e-6 /* [Pa] */
#define SATURATION_MOST 1e10
#define SATURATION_REAL 1e4 /* a curve that ends below this [Pa] is that of energies without a common zero */

bool saturation_of(const struct instance *liquid, const struct instance *vapour, struct saturation *ret_pair)
{
    const struct instance *both[2] = {liquid, vapour};
    ret_pair->jump = 0.0;
    for (int k = 0; k < 2; k++) {
        const struct bulla_eos *law = both[k]->module ? both[k]->module->table : NULL;
        if (!law || !BULLA_EOS_HAS(law, thermal)) return false;
        ret_pair->law[k] = law;
        ret_pair->self[k] = both[k]->self;
        ret_pair->rho[k] = 0.0;
    }
    return true;
}

struct saturation_state saturation_at(const struct saturation *pair, double p, double T)
{
    struct saturation_state at;
    for (int k = 0; k < 2; k++) {
        double rho = pair->rho[k], own = k == 0 ? p + pair->jump : p, v_T, v_p, c_p;
        pair->law[k]->thermal(pair->self[k], 1, &own, &T, &rho, &at.v[k], &at.h[k], &at.s[k], &v_T, &v_p, &c_p);
    }
    at.drive = at.h[1] - at.h[0] - T * (at.s[1] - at.s[0]);
    return at;
}

/* Is the vapour thin enough to be one, and does it take heat to make it? */
static bool saturation_thin(const struct saturation_state *at)
{
    return at->v[1] > 2.0 * at->v[0] && at->v[0] > 0.0 && at->h[1] > at->h[0];
}

double saturation_pressure(const struct saturation *pair, double T)
{
    double low = log(SATURATION_LEAST), high = log(SATURATION_MOST), x = log(1e5);
    for (int i = 0; i < SATURATION_ROUNDS; i++) {
        double p = exp(x);
        struct saturation_state at = saturation_at(pair, p, T);
        if (isnan(at.v[0])) low = x; /* a liquid torn apart; a vapour without a state is too dense */
        else if (!saturation_thin(&at) || at.drive > 0.0) high = x;
        else low = x;
        double step = -at.drive / (p * (at.v[1] - at.v[0])), next = x + step;
        if (saturation_thin(&at) && fabs(step) <= 4e-16 * (1.0 + fabs(x))) return p;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (next == x) break;
        x = next;
    }
    struct saturation_state at = saturation_at(pair, exp(x), T);
    double RT = exp(x) * at.v[1];
    return saturation_thin(&at) && fabs(at.drive) <= 1e-9 * RT ? exp(x) : (double)NAN;
}

double saturation_temperature(const struct saturation *pair, double p)
{
    double low = SATURATION_COLD, high = SATURATION_HOT, T = 400.0;
    if (!(p > 0.0)) return (double)NAN;
    for (int i = 0; i < SATURATION_ROUNDS; i++) {
        struct saturation_state at = saturation_at(pair, p, T);
        double step = at.drive / (at.s[1] - at.s[0]), next = T + step;
        if (at.drive > 0.0) low = T;
        else high = T;
        if (fabs(step) <= 4e-16 * T) break;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        if (next == T) break;
        T = next;
    }
    struct saturation_state at = saturation_at(pair, p, T);
    return saturation_thin(&at) && fabs(at.drive) <= 1e-9 * p * at.v[1] ? T : (double)NAN;
}

double saturation_water(double T)
{
    double rest = 1.0 - T / 647.096, root = sqrt(rest), cube = rest * rest * rest;
    double sum = rest * (-7.85951783 + 1.84408259 * root) + cube * (-11.7866497 + 22.6807411 * root) -
                 15.9618719 * cube * rest + 1.80122502 * cube * cube * rest * root;
    return T > 273.0 && T < 647.0 ? 22.064e6 * exp(647.096 / T * sum) : (double)NAN;
}

bool saturation_ends(const struct saturation *pair, struct saturation_range *ret_range)
{
    *ret_range = (struct saturation_range){.T_min = NAN};
    for (unsigned i = 0; i < SATURATION_POINTS; i++) {
        double T = SATURATION_COLD + i * SATURATION_STEP, p = saturation_pressure(pair, T);
        if (isnan(p) && !isnan(ret_range->T_min)) break;
        if (isnan(p)) continue;
        if (isnan(ret_range->T_min)) ret_range->T_min = T, ret_range->p_min = p;
        ret_range->T_max = T;
        ret_range->p_max = ret_range->p[ret_range->n++] = p;
    }
    return ret_range->T_max > ret_range->T_min && ret_range->p_max > SATURATION_REAL;
}

double saturation_ceiling(const struct saturation_range *range, double T)
{
    if (!(T >= range->T_min && T < range->T_max)) return HUGE_VAL;
    return range->p[(unsigned)((T - range->T_min) / SATURATION_STEP) + 1];
}

bool saturation_is_water(const struct saturation *pair, const char *name)
{
    if (strcmp(name, "water") == 0) return true;
    double T = saturation_temperature(pair, 101325.0);
    if (!(T > 300.0 && T < 450.0)) return false;
    struct saturation_state at = saturation_at(pair, 101325.0, T);
    double latent = at.h[1] - at.h[0];
    return latent > 1.9e6 && latent < 2.6e6;
}
