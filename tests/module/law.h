/* law.h - what the tests of single equations of state share: all functions at one point, rows of reference
 * files, and the properties that every law has wherever it is asked. */
#ifndef LAW_H
#define LAW_H

#include "support.h"

#include "bulla/eos.h"
#include "suite/contract_eos.h"
#include "suite/contract_module.h"
#include "suite/module_values.h"

struct law {
    struct instance instance;
    const struct bulla_eos *eos;
};

struct law_point {
    double rho_e, stiffness, c2, de_dp, de_drho, T, s, p_min;
};

static inline struct law law_preset(const char *module, const char *preset)
{
    struct law law = {.instance = support_open_preset(support_module("eos", module), preset)};
    law.eos = law.instance.module->table;
    return law;
}

/* With settings as of `bulla module check --set`, NULL behind the last. */
static inline struct law law_open(const char *name, const char *const *sets)
{
    const struct bulla_module *module = support_module("eos", name);
    struct law law = {.eos = module->table};
    struct bulla_value *values;
    if (module_values(module, sets, &values) || instance_open(module, values, &law.instance))
        fail_msg("%s", status_text());
    module_values_free(module, values);
    return law;
}

/* Each function as a batch of one. */
static inline struct law_point law_at(const struct law *law, double rho, double p)
{
    struct law_point point;
    const void *self = law->instance.self;
    law->eos->state(self, 1, &rho, &p, &point.rho_e, &point.stiffness);
    point.c2 = point.stiffness / rho;
    law->eos->derivatives(self, 1, &rho, &p, &point.de_dp, &point.de_drho);
    law->eos->temperature(self, 1, &rho, &p, &point.T);
    law->eos->entropy(self, 1, &rho, &p, &point.s);
    law->eos->p_min(self, 1, &rho, &point.p_min);
    return point;
}

static inline double law_density(const struct law *law, double p, double T)
{
    double rho;
    law->eos->density(law->instance.self, 1, &p, &T, &rho);
    return rho;
}

/* Calls `use` with the numbers of every row of a file of tests/data/eos; returns how many there were. */
static inline int law_rows(const char *name, size_t n_column, void (*use)(const struct law *law, const double *column),
                           const struct law *law)
{
    char line[1024];
    snprintf(line, sizeof line, "tests/data/eos/%s", name);
    FILE *file = fopen(line, "r");
    if (!file) fail_msg("no file %s", line);
    int count = 0;
    while (fgets(line, sizeof line, file)) {
        if (line[0] == '#') continue;
        double column[16] = {0};
        char *at = line;
        for (size_t i = 0; i < n_column; i++) {
            column[i] = strtod(at, &at);
            if (*at == ',') at++;
        }
        use(law, column);
        count++;
    }
    fclose(file);
    return count;
}

/* The pressure of an energy by a bracketed Newton iteration from a guess, as core closes mixtures. */
static inline double law_pressure(const struct law *law, double rho, double rho_e, double guess)
{
    double p = guess, low, high = INFINITY;
    law->eos->p_min(law->instance.self, 1, &rho, &low);
    for (int i = 0; i < 60; i++) {
        struct law_point at = law_at(law, rho, p);
        double step = (at.rho_e - rho_e) / at.de_dp, next = p - step;
        if (fabs(step) <= 1e-14 * fabs(p) + 4.4e-16 * fabs(rho_e) / at.de_dp) return next;
        if (step > 0.0) high = p;
        else low = p;
        if (!(next > low && next < high)) next = isfinite(high) ? 0.5 * (low + high) : 2.0 * fabs(p) + 1e5;
        p = next;
    }
    return p;
}

/* (rho, p) -> e -> p from a guess that is off by a factor: to 1e-12 of p and what the energies resolve, 4 eps S/F' with
 * S their sum and F' their slope, and 1 + `slack` units in the last place of rho c^2 (that at 1 bar at least), where
 * large terms cancel in p. */
static inline void law_round_trip(const struct law *law, double rho, double p, double slack)
{
    struct law_point at = law_at(law, rho, p);
    if (!(p > at.p_min)) return;
    double back = law_pressure(law, rho, at.rho_e, at.p_min + 3.0 * (p - at.p_min) + 1e5), eps = 2.3e-16;
    double stiffness = law_at(law, rho, p > 1e5 ? p : 1e5).stiffness;
    double allowed = 1e-12 * fabs(p) + eps * (8.0 * fabs(at.rho_e) / at.de_dp + (1.0 + slack) * stiffness);
    if (!(fabs(back - p) <= allowed))
        fail_msg("rho %.17g, p %.17g: p comes back off by %g, allowed is %g", rho, p, back - p, allowed);
}

/* Round trips from 1e-3 kg/m3 and 1 Pa up. */
static inline void law_round_trips(const struct law *law, double rho_most, double slack)
{
    for (double rho = 1e-3; rho < rho_most; rho *= 1.31)
        for (double p = 1.0; p < 1e11; p *= 7.3) law_round_trip(law, rho, p, slack);
}

/* Along dp/drho = c^2 the entropy stays, to `drift` of `scale`; `span` is the ratio of the last density to the
 * first. */
static inline void law_isentrope(const struct law *law, double rho, double p, double span, double drift, double scale)
{
    enum { STEPS = 4000 };
    double s = law_at(law, rho, p).s, h = log(span) / STEPS;
    for (int i = 0; i < STEPS; i++) {
        double half = rho * exp(0.5 * h), full = rho * exp(h);
        double k1 = h * law_at(law, rho, p).stiffness, k2 = h * law_at(law, half, p + 0.5 * k1).stiffness;
        double k3 = h * law_at(law, half, p + 0.5 * k2).stiffness, k4 = h * law_at(law, full, p + k3).stiffness;
        p += (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
        rho = full;
    }
    support_near("entropy along an isentrope", law_at(law, rho, p).s, s, drift, scale);
}

/* Nothing infinite, d(rho e)/dp > 0, c^2 > 0, T > 0 for densities from 1e-3 and pressures from p_min to 1e11; rho e
 * grows with p. */
static inline void law_sweep(const struct law *law, double rho_most)
{
    for (double rho = 1e-3; rho < rho_most; rho *= 1.01) {
        double least = law_at(law, rho, 1e5).p_min, last = -INFINITY;
        for (double above = 1e-2; above <= 1.001e11; above *= 3.7) {
            double p = least + above;
            if (above <= 1e-9 * fabs(least)) continue;
            struct law_point at = law_at(law, rho, p);
            if (isfinite(at.rho_e) && isfinite(at.s) && isfinite(at.de_drho) && at.de_dp > 0.0 && at.c2 > 0.0 &&
                isfinite(at.c2) && at.T > 0.0 && isfinite(at.T) && at.rho_e >= last) {
                last = at.rho_e;
                continue;
            }
            fail_msg("rho %.17g, p %.17g: rho e %.17g after %.17g, de/dp %g, c2 %g, T %g, s %g", rho, p, at.rho_e, last,
                     at.de_dp, at.c2, at.T, at.s);
        }
    }
}

/* rho e, c^2, T and s have no jump in p at a density, beyond what steps of 1e-6 explain. */
static inline void law_no_jump(const struct law *law, double rho, double p, double cv)
{
    double h = 1e-7 * (fabs(p) + 1e5);
    struct law_point here = law_at(law, rho, p - h), there = law_at(law, rho, p + h);
    support_near("rho e across", there.rho_e - here.rho_e, here.de_dp * 2.0 * h, 1e-3,
                 here.de_dp * 2.0 * h + 1e-9 * fabs(here.rho_e));
    support_near("c2 across", there.c2, here.c2, 1e-4, here.c2);
    support_near("T across", there.T, here.T, 1e-4, here.T);
    support_near("s across", there.s, here.s, 1e-4, cv);
}

#endif
