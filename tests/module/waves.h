/* waves.h - isentropes, shocks and shock tubes of any one law, from its functions alone: what the tests compare with
 * solutions that another program found. */
#ifndef WAVES_H
#define WAVES_H

#include "law.h"

struct wave_state {
    double rho, p, T, c;
};

static inline struct wave_state wave_state(const struct law *law, double rho, double p)
{
    struct law_point at = law_at(law, rho, p);
    return (struct wave_state){rho, p, at.T, sqrt(at.c2)};
}

static inline struct wave_state wave_start(const struct law *law, double p, double T)
{
    return wave_state(law, law_density(law, p, T), p);
}

/* At p, where the entropy is that of another state: it falls with rho at constant p. */
static inline struct wave_state wave_isentrope_within(const struct law *law, struct wave_state from, double p,
                                                      double low, double high)
{
    double s = law_at(law, from.rho, from.p).s, at;
    for (int i = 0; i < 100 && high - low > 1e-15 * high; i++) {
        double mean = 0.5 * (low + high);
        law->eos->entropy(law->instance.self, 1, &mean, &p, &at);
        if (at > s) low = mean;
        else high = mean;
    }
    return wave_state(law, 0.5 * (low + high), p);
}

/* Of a liquid. */
static inline struct wave_state wave_isentrope(const struct law *law, struct wave_state from, double p)
{
    return wave_isentrope_within(law, from, p, 0.05 * from.rho, 20.0 * from.rho);
}

/* Behind a shock that goes to p: e - e0 = (p + p0)(v0 - v)/2. It is no slower than sound, which bounds the density. */
static inline struct wave_state wave_shock(const struct law *law, struct wave_state from, double p)
{
    double squeeze = (p - from.p) / (from.rho * from.c * from.c), low = from.rho;
    double high = from.rho / (squeeze < 0.95 ? 1.0 - squeeze : 0.05), e0 = law_at(law, low, from.p).rho_e / low;
    for (int i = 0; i < 100 && high - low > 1e-15 * high; i++) {
        double mean = 0.5 * (low + high), rho_e, stiffness;
        law->eos->state(law->instance.self, 1, &mean, &p, &rho_e, &stiffness);
        if (rho_e / mean - e0 > 0.5 * (p + from.p) * (1.0 / from.rho - 1.0 / mean)) low = mean;
        else high = mean;
    }
    return wave_state(law, 0.5 * (low + high), p);
}

/* Its speed and that of what is behind it, into the state at rest. */
static inline void wave_shock_speeds(struct wave_state from, struct wave_state to, double *ret_shock, double *ret_flow)
{
    double per = 1.0 / from.rho - 1.0 / to.rho, flow = sqrt((to.p - from.p) * per);
    *ret_flow = flow;
    *ret_shock = flow / (from.rho * per);
}

/* Speed of what a rarefaction from rest has expanded to p: the integral of dp/(rho c), Gauss with eight points in each
 * of four pieces. */
static inline double wave_rarefaction_speed(const struct law *law, struct wave_state from, double p)
{
    static const double x[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    static const double w[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    double sum = 0.0, half = (from.p - p) / 8.0;
    for (int piece = 0; piece < 4; piece++)
        for (int i = 0; i < 8; i++) {
            double at = p + half * (2 * piece + 1 + (i % 2 ? x[i / 2] : -x[i / 2]));
            struct wave_state state = wave_isentrope(law, from, at);
            sum += half * w[i / 2] / (state.rho * state.c);
        }
    return sum;
}

/* A tube of one law, high pressure on the left, at rest: rarefaction to the left, shock to the right. */
struct wave_tube {
    struct wave_state left, right, star[2];
    double u, shock;
};

static inline struct wave_tube wave_tube(const struct law *law, double p_left, double p_right, double T)
{
    struct wave_tube tube = {.left = wave_start(law, p_left, T), .right = wave_start(law, p_right, T)};
    double low = p_right, high = p_left;
    for (int i = 0; i < 60 && high - low > 1e-13 * high; i++) {
        double p = 0.5 * (low + high);
        tube.star[1] = wave_shock(law, tube.right, p);
        wave_shock_speeds(tube.right, tube.star[1], &tube.shock, &tube.u);
        if (wave_rarefaction_speed(law, tube.left, p) > tube.u) low = p;
        else high = p;
    }
    tube.star[0] = wave_isentrope(law, tube.left, tube.star[1].p);
    return tube;
}

#endif
