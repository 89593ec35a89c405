/* contract_damage.c - see contract_damage.h.
 *
 * Points reach from whole to broken, from compression by 1 TPa to as much tension, from no stretch to a thousandfold,
 * from no plastic strain to 100, from cold to 1e5 K: whatever a solver can produce. What an instance does not ask for
 * core does not tell it: then nothing may depend on it. */
#include "suite/contract_damage.h"

#include "bulla/damage.h"
#include "suite/contract_batch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { DAMAGE_STATES = 4000, DAMAGE_INPUTS = 9, DAMAGE_LOADS = 6 };

/* In the order of bulla_damage_state. */
static const char *const contract_damage_names[DAMAGE_INPUTS] = {"D",     "tension", "principal", "stretch", "energy",
                                                                 "mises", "strain",  "rate",      "T"};

static struct bulla_damage_state contract_damage_rows(const double *const in[DAMAGE_INPUTS])
{
    return (struct bulla_damage_state){
        sizeof(struct bulla_damage_state), in[0], in[1], in[2], in[3], in[4], in[5], in[6], in[7], in[8]};
}

struct contract_damage_answer {
    double aim, rate;
};

static struct contract_damage_answer contract_damage_at(const struct contract *contract,
                                                        const double in[static DAMAGE_INPUTS])
{
    const struct bulla_damage *law = contract->module->table;
    const double *rows[DAMAGE_INPUTS];
    struct contract_damage_answer answer = {NAN, NAN};
    for (int i = 0; i < DAMAGE_INPUTS; i++) rows[i] = &in[i];
    const struct bulla_damage_state state = contract_damage_rows(rows);
    law->grow(contract->self, 1, &state, &answer.aim, &answer.rate);
    return answer;
}

static double contract_damage_stress(uint64_t *seed)
{
    double size = pow(10.0, contract_random(seed, 0.0, 12.0));
    return contract_random(seed, 0.0, 1.0) < 0.3 ? -size : size;
}

static void contract_damage_draw(const struct contract *contract, const struct contract_call *call, uint64_t *seed,
                                 double *in)
{
    (void)contract, (void)call;
    double whole = contract_random(seed, 0.0, 1.0);
    in[0] = whole < 0.1 ? 0.0 : whole > 0.9 ? 1.0 : whole;
    in[1] = contract_damage_stress(seed);
    in[2] = in[1] + pow(10.0, contract_random(seed, 0.0, 12.0));
    in[3] = 1.0 + pow(10.0, contract_random(seed, -6.0, 3.0));
    in[4] = pow(10.0, contract_random(seed, -3.0, 12.0));
    in[5] = pow(10.0, contract_random(seed, 0.0, 12.0));
    in[6] = contract_random(seed, 0.0, 1.0) < 0.2 ? 0.0 : pow(10.0, contract_random(seed, -9.0, 2.0));
    in[7] = contract_random(seed, 0.0, 1.0) < 0.2 ? 0.0 : pow(10.0, contract_random(seed, -6.0, 9.0));
    in[8] = pow(10.0, contract_random(seed, 0.0, 5.0));
}

/* Which of the inputs an instance looks at: D always, the others by bit. */
static bool contract_damage_looks(uint32_t needs, int input)
{
    return input == 0 || needs & 1u << (input - 1);
}

static void contract_damage_say(const double in[static DAMAGE_INPUTS], char where[static CONTRACT_WHERE])
{
    int at = 0;
    for (int i = 0; i < DAMAGE_INPUTS && at < CONTRACT_WHERE; i++)
        at += snprintf(where + at, (size_t)(CONTRACT_WHERE - at), "%s%s %.4g", i ? ", " : "", contract_damage_names[i],
                       in[i]);
}

/* How fast damage grows from `in`. */
static double contract_damage_pace(const struct contract_damage_answer *answer, double D)
{
    return answer->aim > D ? answer->rate : 0.0;
}

/* Pulled harder in one way, everything else the same, it breaks no later. */
static void contract_damage_harder(struct contract *contract, const double in[static DAMAGE_INPUTS], uint64_t *seed)
{
    static const int loads[DAMAGE_LOADS - 1] = {1, 2, 3, 4, 6}; /* stress without tension breaks no solid by itself */
    const struct contract_damage_answer answer = contract_damage_at(contract, in);
    char where[CONTRACT_WHERE];
    contract_damage_say(in, where);
    contract_begin(contract, "what is pulled harder does not break later", 1e-13);
    for (size_t k = 0; k < sizeof loads / sizeof *loads; k++) {
        double more[DAMAGE_INPUTS];
        memcpy(more, in, sizeof more);
        more[loads[k]] += fabs(more[loads[k]]) * contract_random(seed, 0.0, 10.0);
        const struct contract_damage_answer harder = contract_damage_at(contract, more);
        double pace = contract_damage_pace(&answer, in[0]), then = contract_damage_pace(&harder, in[0]);
        contract_error(contract, harder.aim < answer.aim ? answer.aim - harder.aim : 0.0, "%s: more %s", where,
                       contract_damage_names[loads[k]]);
        contract_error(contract, then < pace ? (pace - then) / pace : 0.0, "%s: more %s", where,
                       contract_damage_names[loads[k]]);
    }
}

static void contract_damage_state(struct contract *contract, uint32_t needs, uint64_t *seed)
{
    double in[DAMAGE_INPUTS], other[DAMAGE_INPUTS];
    char where[CONTRACT_WHERE];
    contract_damage_draw(contract, NULL, seed, in);
    contract_damage_draw(contract, NULL, seed, other);
    contract_damage_say(in, where);
    const struct contract_damage_answer answer = contract_damage_at(contract, in);
    contract_begin(contract, "the aim is from 0 to 1, the rate not negative", 0.0);
    contract_holds(contract, answer.aim >= 0.0 && answer.aim <= 1.0 && answer.rate >= 0.0, where);
    for (int i = 0; i < DAMAGE_INPUTS; i++)
        if (contract_damage_looks(needs, i)) other[i] = in[i];
    const struct contract_damage_answer blind = contract_damage_at(contract, other);
    contract_begin(contract, "nothing depends on what `needs` does not ask for, bitwise", 0.0);
    contract_holds(contract, blind.aim == answer.aim && blind.rate == answer.rate, where);
    contract_damage_harder(contract, in, seed);
}

/* A number that is none, where the law looks at it alone, must not break a solid. */
static void contract_damage_nan(struct contract *contract, uint32_t needs)
{
    contract_begin(contract, "NaN breaks nothing", 0.0);
    for (int i = 1; i < DAMAGE_INPUTS; i++) {
        double in[DAMAGE_INPUTS] = {0.0, -1e5, -1e5, 1.0, 0.0, 0.0, 0.0, 0.0, 300.0};
        in[i] = NAN;
        if (!contract_damage_looks(needs, i)) continue;
        const struct contract_damage_answer answer = contract_damage_at(contract, in);
        contract_error(contract, answer.aim > 0.0 && answer.rate > 0.0, "%s = NaN", contract_damage_names[i]);
    }
}

/* Told, not asked: does it take time, and does it look at temperatures? */
static void contract_damage_facts(struct contract *contract, uint32_t needs)
{
    const double rest[DAMAGE_INPUTS] = {0.0, -101325.0, -101325.0, 1.0, 0.0, 0.0, 0.0, 0.0, 300.0};
    const double torn[DAMAGE_INPUTS] = {0.0, 1e12, 1e12, 1e3, 1e15, 1e9, 1e2, 1e9, 300.0};
    const struct contract_damage_answer calm = contract_damage_at(contract, rest),
                                        pulled = contract_damage_at(contract, torn);
    contract_begin(contract, "an unstressed solid at 300 K does not break", 0.0);
    contract_error(contract, contract_damage_pace(&calm, 0.0) > 0.0, "aim %g at %g 1/s", calm.aim, calm.rate);
    contract_begin(contract, "something breaks it", 0.0);
    contract_error(contract, !(contract_damage_pace(&pulled, 0.0) > 0.0), "aim %g at %g 1/s", pulled.aim, pulled.rate);
    contract_fact(contract, "it takes time by itself", pulled.rate < BULLA_DAMAGE_AT_ONCE);
    contract_fact(contract, "it looks at temperature", needs & BULLA_DAMAGE_TEMPERATURE);
}

static void contract_damage_run_grow(const struct contract *contract, const struct contract_call *call, size_t n,
                                     const double *const *in, double *const *out)
{
    const struct bulla_damage *law = contract->module->table;
    const struct bulla_damage_state state = contract_damage_rows(in);
    (void)call;
    law->grow(contract->self, n, &state, out[0], out[1]);
}

void contract_damage_run(struct contract *contract)
{
    const struct bulla_damage *law = contract->module->table;
    const struct contract_call grow = {"grow", DAMAGE_INPUTS, 2, contract_damage_run_grow, contract_damage_draw, NULL};
    uint32_t needs = law->needs(contract->self);
    uint64_t seed = 1;
    contract_doing(contract, "what it needs");
    contract_begin(contract, "`needs` asks for nothing that core does not know", 0.0);
    contract_error(contract, (needs & ~(uint32_t)BULLA_DAMAGE_ALL) != 0, "needs = %u", needs);
    contract_doing(contract, "rest");
    contract_damage_facts(contract, needs);
    contract_doing(contract, "states");
    for (int i = 0; i < DAMAGE_STATES; i++) contract_damage_state(contract, needs, &seed);
    contract_doing(contract, "NaN");
    contract_damage_nan(contract, needs);
    contract_batch_run(contract, &grow);
}

void contract_damage_probe(const struct contract *contract, double out[static CONTRACT_PROBE])
{
    const struct bulla_damage *law = contract->module->table;
    const double mild[DAMAGE_INPUTS] = {0.0, 1e6, 2e6, 1.6, 1e5, 1e6, 0.2, 1e4, 300.0},
                 hard[DAMAGE_INPUTS] = {0.5, 3e9, 4e9, 3.0, 1e9, 1e9, 1.0, 1e6, 600.0};
    out[0] = contract_damage_at(contract, mild).aim;
    out[1] = contract_damage_at(contract, hard).rate;
    out[2] = contract_damage_at(contract, mild).rate + contract_damage_at(contract, hard).aim;
    out[3] = law->needs(contract->self);
}
