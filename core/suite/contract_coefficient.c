/* contract_coefficient.c - see contract_coefficient.h. States are drawn from far beyond any fit: what solvers produce
 * in traces and at limited faces is no fluid that anybody has measured. */
#include "suite/contract_coefficient.h"

#include "suite/contract_batch.h"

#include <math.h>
#include <stdio.h>

enum { COEFFICIENT_STATES = 4000, COEFFICIENT_ROWS = 4 };

#define COEFFICIENT_STEP 1e-9 /* of a difference, relative */

/* By how much a value may change over such a step: as the 100th power of what it looks at. */
#define COEFFICIENT_STEEP 1e-7

static const char *const contract_coefficient_names[COEFFICIENT_ROWS] = {"rate", "T", "p", "rho"};

static void contract_coefficient_call(const struct contract *contract, const struct bulla_coefficient *law, size_t n,
                                      const double *const *in, double *out)
{
    const double *row[COEFFICIENT_ROWS];
    for (unsigned k = 0; k < COEFFICIENT_ROWS; k++) row[k] = law->needs >> k & 1 ? in[k] : NULL;
    law->value(contract->self, n, row[0], row[1], row[2], row[3], out);
}

static double contract_coefficient_at(const struct contract *contract, const struct bulla_coefficient *law,
                                      const double at[static COEFFICIENT_ROWS])
{
    const double *in[COEFFICIENT_ROWS] = {&at[0], &at[1], &at[2], &at[3]};
    double value = (double)NAN;
    contract_coefficient_call(contract, law, 1, in, &value);
    return value;
}

/* Rest among the rates, tension among the pressures. */
static void contract_coefficient_draw(uint64_t *seed, double at[static COEFFICIENT_ROWS])
{
    double rests = contract_random(seed, 0.0, 1.0), pulled = contract_random(seed, 0.0, 1.0);
    at[0] = rests < 0.05 ? 0.0 : contract_decades(seed, 1e-12, 1e15);
    at[1] = contract_decades(seed, 1.0, 1e6);
    at[2] = (pulled < 0.2 ? -1.0 : 1.0) * contract_decades(seed, 1e-3, 1e12);
    at[3] = contract_decades(seed, 1e-9, 1e5);
}

static void contract_coefficient_say(const double at[static COEFFICIENT_ROWS], char where[static CONTRACT_WHERE])
{
    snprintf(where, CONTRACT_WHERE, "rate %.6g, T %.6g, p %.6g, rho %.6g", at[0], at[1], at[2], at[3]);
}

/* What the time step goes by. */
static void contract_coefficient_most(struct contract *contract, const struct bulla_coefficient *law, double value,
                                      const char *where)
{
    double most = law->most ? law->most(contract->self) : (double)NAN;
    contract_begin(contract, "a law that looks at the rate says the most that it gives, and keeps to it", 0.0);
    if (!(law->needs & BULLA_NEEDS_RATE)) return;
    contract_error(contract, !(isfinite(most) && most >= 0.0 && value <= most * (1.0 + 1e-12)), "%s: %.9g, most %.9g",
                   where, value, most);
}

/* No jumps: where a fit ends its continuation goes on. */
static void contract_coefficient_jumps(struct contract *contract, const struct bulla_coefficient *law,
                                       const double at[static COEFFICIENT_ROWS], double value)
{
    contract_begin(contract, "no jumps", 0.0);
    for (unsigned k = 0; k < COEFFICIENT_ROWS; k++) {
        double beside[COEFFICIENT_ROWS] = {at[0], at[1], at[2], at[3]};
        if (!(law->needs >> k & 1)) continue;
        beside[k] *= 1.0 + COEFFICIENT_STEP;
        double other = contract_coefficient_at(contract, law, beside);
        contract_error(contract, !(fabs(other - value) <= COEFFICIENT_STEEP * (fabs(value) + fabs(other))),
                       "%s %.17g: %.17g, beside it %.17g", contract_coefficient_names[k], at[k], value, other);
    }
}

static void contract_coefficient_states(struct contract *contract, const struct bulla_coefficient *law)
{
    uint64_t seed = 11;
    for (int i = 0; i < COEFFICIENT_STATES; i++) {
        double at[COEFFICIENT_ROWS];
        char where[CONTRACT_WHERE];
        contract_coefficient_draw(&seed, at);
        contract_coefficient_say(at, where);
        double value = contract_coefficient_at(contract, law, at);
        contract_begin(contract, "finite and not negative in any state", 0.0);
        contract_error(contract, !(isfinite(value) && value >= 0.0), "%s: %g", where, value);
        contract_coefficient_most(contract, law, value, where);
        contract_coefficient_jumps(contract, law, at, value);
    }
}

/* A state that is none must not come out as a good one. */
static void contract_coefficient_nan(struct contract *contract, const struct bulla_coefficient *law)
{
    contract_begin(contract, "NaN does not become a good value", 0.0);
    for (unsigned k = 0; k < COEFFICIENT_ROWS; k++) {
        double at[COEFFICIENT_ROWS] = {100.0, 300.0, 1e5, 1000.0};
        if (!(law->needs >> k & 1)) continue;
        at[k] = (double)NAN;
        double value = contract_coefficient_at(contract, law, at);
        contract_error(contract, isfinite(value), "%s = NaN: %g", contract_coefficient_names[k], value);
    }
}

static void contract_coefficient_draw_row(const struct contract *contract, const struct contract_call *call,
                                          uint64_t *seed, double *in)
{
    (void)contract, (void)call;
    contract_coefficient_draw(seed, in);
}

static void contract_coefficient_run_row(const struct contract *contract, const struct contract_call *call, size_t n,
                                         const double *const *in, double *const *out)
{
    contract_coefficient_call(contract, call->context, n, in, out[0]);
}

void contract_coefficient_run(struct contract *contract, const struct bulla_coefficient *law, const char *name)
{
    const struct contract_call call = {
        name, COEFFICIENT_ROWS, 1, contract_coefficient_run_row, contract_coefficient_draw_row, law};
    contract_begin(contract, "`needs` names rows that there are", 0.0);
    contract_error(contract, law->needs >> COEFFICIENT_ROWS, "needs = %u", law->needs);
    contract_doing(contract, "states");
    contract_coefficient_states(contract, law);
    contract_doing(contract, "NaN");
    contract_coefficient_nan(contract, law);
    contract_batch_run(contract, &call);
}

void contract_coefficient_probe(const struct contract *contract, const struct bulla_coefficient *law,
                                double out[static CONTRACT_PROBE])
{
    static const double at[CONTRACT_PROBE - 1][COEFFICIENT_ROWS] = {{0.0, 300.0, 1e5, 1000.0},
                                                                    {1.0, 350.0, 1e6, 900.0},
                                                                    {1e3, 400.0, 1e7, 1.2}};
    for (int i = 0; i < CONTRACT_PROBE - 1; i++) out[i] = contract_coefficient_at(contract, law, at[i]);
}
