/* contract_inelastic.c - see contract_inelastic.h.
 *
 * Points reach from a body that has never flowed to a plastic strain of 100, from rest to 1e9 1/s, from deep tension to
 * 1 TPa, from cold to 1e5 K, and through a thousandfold of densities: whatever a solver can produce. What an instance
 * does not ask for core does not tell it: then nothing may depend on it. */
#include "suite/contract_inelastic.h"

#include "bulla/inelastic.h"
#include "suite/contract_batch.h"

#include <math.h>
#include <stdio.h>

enum { INELASTIC_STATES = 4000, INELASTIC_INPUTS = 5 };

static double contract_inelastic_at(const struct contract *contract, const double in[static INELASTIC_INPUTS])
{
    const struct bulla_inelastic *law = contract->module->table;
    double Y = NAN;
    law->strength(contract->self, 1, &in[0], &in[1], &in[2], &in[3], &in[4], &Y);
    return Y;
}

static void contract_inelastic_draw(const struct contract *contract, const struct contract_call *call, uint64_t *seed,
                                    double *in)
{
    (void)contract, (void)call;
    bool young = contract_random(seed, 0.0, 1.0) < 0.1, still = contract_random(seed, 0.0, 1.0) < 0.1;
    double pressed = pow(10.0, contract_random(seed, 3.0, 12.0));
    in[0] = young ? 0.0 : pow(10.0, contract_random(seed, -12.0, 2.0));
    in[1] = still ? 0.0 : pow(10.0, contract_random(seed, -6.0, 9.0));
    in[2] = contract_random(seed, 0.0, 1.0) < 0.3 ? -0.01 * pressed : pressed;
    in[3] = pow(10.0, contract_random(seed, 0.0, 5.0));
    in[4] = pow(10.0, contract_random(seed, 2.0, 5.0));
}

/* Which of the inputs an instance looks at. */
static bool contract_inelastic_looks(uint32_t needs, int input)
{
    static const uint32_t bits[INELASTIC_INPUTS] = {BULLA_INELASTIC_STRAIN, BULLA_INELASTIC_RATE,
                                                    BULLA_INELASTIC_PRESSURE | BULLA_INELASTIC_TEMPERATURE,
                                                    BULLA_INELASTIC_TEMPERATURE,
                                                    BULLA_INELASTIC_PRESSURE | BULLA_INELASTIC_TEMPERATURE};
    return needs & bits[input];
}

static void contract_inelastic_say(const double in[static INELASTIC_INPUTS], char where[static CONTRACT_WHERE])
{
    snprintf(where, CONTRACT_WHERE, "eps %.6g, rate %.6g, p %.6g, T %.6g, rho %.6g", in[0], in[1], in[2], in[3], in[4]);
}

/* One state, what another rate makes of it, and what the law should not see. */
static void contract_inelastic_state(struct contract *contract, uint32_t needs, uint64_t *seed)
{
    double in[INELASTIC_INPUTS], other[INELASTIC_INPUTS], Y, faster;
    char where[CONTRACT_WHERE];
    contract_inelastic_draw(contract, NULL, seed, in);
    contract_inelastic_draw(contract, NULL, seed, other);
    contract_inelastic_say(in, where);
    Y = contract_inelastic_at(contract, in);
    contract_begin(contract, "the strength is finite and not negative", 0.0);
    contract_holds(contract, isfinite(Y) && Y >= 0.0, where);
    for (int i = 0; i < INELASTIC_INPUTS; i++)
        if (contract_inelastic_looks(needs, i)) other[i] = in[i];
    contract_begin(contract, "nothing depends on what `needs` does not ask for, bitwise", 0.0);
    contract_holds(contract, contract_inelastic_at(contract, other) == Y, where);
    in[1] *= contract_random(seed, 1.0, 100.0);
    faster = contract_inelastic_at(contract, in);
    contract_begin(contract, "the strength never falls with the rate", 1e-14);
    contract_error(contract, faster < Y ? (Y - faster) / Y : 0.0, "%s", where);
}

/* The density at which the unstrained body is strongest: a law may know the one of its metal, and melt below it. */
static double contract_inelastic_density(const struct contract *contract)
{
    double best = 1e2, most = 0.0;
    for (int i = 0; i <= 60; i++) {
        double rho = pow(10.0, 2.0 + i / 20.0), in[INELASTIC_INPUTS] = {0.0, 0.0, 1e5, 300.0, rho};
        double Y = contract_inelastic_at(contract, in);
        if (Y > most) best = rho;
        if (Y > most) most = Y;
    }
    return best;
}

/* A number that is none, where the law looks at it, must not come out as a strength. */
static void contract_inelastic_nan(struct contract *contract, uint32_t needs, double rho)
{
    static const char *const names[INELASTIC_INPUTS] = {"eps", "rate", "p", "T", "rho"};
    contract_begin(contract, "NaN does not become a good strength", 0.0);
    for (int i = 0; i < INELASTIC_INPUTS; i++) {
        double in[INELASTIC_INPUTS] = {0.01, 1.0, 1e5, 300.0, rho};
        bool alone = i == 0 || i == 1 || i == 3; /* p and rho come together with T: a law may use one of them */
        in[i] = NAN;
        if (alone && contract_inelastic_looks(needs, i))
            contract_error(contract, isfinite(contract_inelastic_at(contract, in)), "%s = NaN", names[i]);
    }
}

/* Told, not asked: how the strength goes with strain and heat. */
static void contract_inelastic_facts(struct contract *contract, double rho)
{
    const double rest[INELASTIC_INPUTS] = {0.0, 0.0, 1e5, 300.0, rho},
                 aged[INELASTIC_INPUTS] = {1.0, 0.0, 1e5, 300.0, rho};
    const double hot[INELASTIC_INPUTS] = {0.0, 0.0, 1e5, 900.0, rho};
    double Y = contract_inelastic_at(contract, rest);
    contract_begin(contract, "an unstrained body at rest, at 300 K, bears something", 0.0);
    contract_error(contract, !(Y > 0.0), "Y = %g Pa", Y);
    contract_fact(contract, "the strength grows with plastic strain", contract_inelastic_at(contract, aged) > Y);
    contract_fact(contract, "the strength falls with temperature", contract_inelastic_at(contract, hot) < Y);
}

static void contract_inelastic_run_strength(const struct contract *contract, const struct contract_call *call, size_t n,
                                            const double *const *in, double *const *out)
{
    const struct bulla_inelastic *law = contract->module->table;
    (void)call;
    law->strength(contract->self, n, in[0], in[1], in[2], in[3], in[4], out[0]);
}

void contract_inelastic_run(struct contract *contract)
{
    const struct bulla_inelastic *law = contract->module->table;
    const struct contract_call strength = {
        "strength", INELASTIC_INPUTS, 1, contract_inelastic_run_strength, contract_inelastic_draw, NULL};
    uint32_t needs = law->needs(contract->self);
    double rho = contract_inelastic_density(contract);
    uint64_t seed = 1;
    contract_doing(contract, "what it needs");
    contract_begin(contract, "`needs` asks for nothing that core does not know", 0.0);
    contract_error(contract, (needs & ~(uint32_t)BULLA_INELASTIC_ALL) != 0, "needs = %u", needs);
    contract_doing(contract, "rest");
    contract_inelastic_facts(contract, rho);
    contract_doing(contract, "states");
    for (int i = 0; i < INELASTIC_STATES; i++) contract_inelastic_state(contract, needs, &seed);
    contract_doing(contract, "NaN");
    contract_inelastic_nan(contract, needs, rho);
    contract_batch_run(contract, &strength);
}

void contract_inelastic_probe(const struct contract *contract, double out[static CONTRACT_PROBE])
{
    const struct bulla_inelastic *law = contract->module->table;
    const double rest[INELASTIC_INPUTS] = {0.0, 0.0, 1e5, 300.0, 5e3},
                 run[INELASTIC_INPUTS] = {0.2, 1e4, 1e9, 500.0, 6e3};
    out[0] = contract_inelastic_at(contract, rest);
    out[1] = contract_inelastic_at(contract, run);
    out[2] = law->needs(contract->self);
}
