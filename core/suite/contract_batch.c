/* contract_batch.c - see contract_batch.h.
 *
 * Rows lie in a block with guard bands on both sides: a known pattern, looked at after each call.
 * Before a call its outputs hold another pattern, so that a point that is not written differs. */
#include "suite/contract_batch.h"

#include "base/mem.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { BATCH_ROW = 41, BATCH_BAND = 16, BATCH_SPAN = BATCH_ROW + 2 * BATCH_BAND, BATCH_TIMED = 288, BATCH_CALLS = 40 };

#define BATCH_GUARD (-0x1.badbadbadp+300)
#define BATCH_UNSET (-0x1.5e75e75e7p+301)

struct batch {
    struct contract *contract;
    const struct contract_call *call;
    double in[CONTRACT_BATCH_IN][BATCH_SPAN], kept[CONTRACT_BATCH_IN][BATCH_SPAN];
    double out[CONTRACT_BATCH_OUT][BATCH_SPAN], want[CONTRACT_BATCH_OUT][BATCH_ROW];
};

void contract_batch_one(const struct contract *contract, const struct contract_call *call, const double *in,
                        double *out)
{
    const double *inputs[CONTRACT_BATCH_IN];
    double *outputs[CONTRACT_BATCH_OUT];
    for (unsigned k = 0; k < call->n_in; k++) inputs[k] = &in[k];
    for (unsigned k = 0; k < call->n_out; k++) outputs[k] = &out[k];
    call->run(contract, call, 1, inputs, outputs);
}

/* Runs points first ... first + n - 1 of the inputs; results begin behind the outputs' guard band. */
static void contract_batch_row(struct batch *batch, size_t first, size_t n)
{
    const double *in[CONTRACT_BATCH_IN];
    double *out[CONTRACT_BATCH_OUT];
    for (unsigned k = 0; k < batch->call->n_in; k++) in[k] = batch->in[k] + BATCH_BAND + first;
    for (unsigned k = 0; k < batch->call->n_out; k++) {
        out[k] = batch->out[k] + BATCH_BAND + first % 4;
        for (int i = 0; i < BATCH_SPAN; i++) batch->out[k][i] = BATCH_GUARD;
        for (size_t i = 0; i < n; i++) out[k][i] = BATCH_UNSET;
    }
    memcpy(batch->kept, batch->in, sizeof batch->in);
    batch->call->run(batch->contract, batch->call, n, in, out);
}

static void contract_batch_look(struct batch *batch, size_t first, size_t n)
{
    char where[CONTRACT_WHERE];
    snprintf(where, sizeof where, "%s, row of %zu", batch->call->name, n);
    size_t begin = BATCH_BAND + first % 4;
    bool clean = true;
    for (unsigned k = 0; k < batch->call->n_out; k++)
        for (size_t i = 0; i < BATCH_SPAN; i++)
            if (i < begin || i >= begin + n) clean &= contract_same(batch->out[k][i], BATCH_GUARD);
    contract_begin(batch->contract, "nothing written outside the row", 0.0);
    contract_holds(batch->contract, clean, where);
    contract_begin(batch->contract, "inputs unchanged", 0.0);
    contract_holds(batch->contract, memcmp(batch->kept, batch->in, sizeof batch->in) == 0, where);
}

static void contract_batch_compare(struct batch *batch, size_t first, size_t n, size_t skip, const char *check)
{
    contract_begin(batch->contract, check, 0.0);
    for (unsigned k = 0; k < batch->call->n_out; k++)
        for (size_t i = 0; i < n; i++) {
            double got = batch->out[k][BATCH_BAND + first % 4 + i], want = batch->want[k][first + i];
            if (first + i == skip) continue;
            contract_error(batch->contract, !contract_same(got, want), "%s, output %u, point %zu of %zu: %.17g, %.17g",
                           batch->call->name, k + 1, i, n, got, want);
        }
}

/* Every start, and lengths from one to the whole row. */
static void contract_batch_places(struct batch *batch)
{
    for (size_t first = 0; first < 9; first++)
        for (size_t n = 1; first + n <= BATCH_ROW; n += n < 18 ? 1 : 7) {
            contract_batch_row(batch, first, n);
            contract_batch_compare(batch, first, n, BATCH_ROW, "a row gives what single points give, bitwise");
            contract_batch_look(batch, first, n);
        }
}

/* A point that no solver should produce: it may come out as anything, but alone. */
static void contract_batch_bad(struct batch *batch)
{
    static const double bad[] = {NAN, INFINITY, -INFINITY, 0.0, -1.0, 1e300};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        for (unsigned k = 0; k < batch->call->n_in; k++) {
            size_t at = (7 * i + 3 * k) % BATCH_ROW;
            double good = batch->in[k][BATCH_BAND + at];
            batch->in[k][BATCH_BAND + at] = bad[i];
            contract_batch_row(batch, 0, BATCH_ROW);
            contract_batch_compare(batch, 0, BATCH_ROW, at, "bad numbers (NaN, inf, 0, -1) leave other points alone");
            contract_batch_look(batch, 0, BATCH_ROW);
            batch->in[k][BATCH_BAND + at] = good;
        }
}

static double contract_batch_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

/* The least of a few rounds: what else the machine does only adds. */
static void contract_batch_time(struct batch *batch)
{
    const struct contract_call *call = batch->call;
    double *block = mem_new((size_t)(CONTRACT_BATCH_IN + CONTRACT_BATCH_OUT) * BATCH_TIMED, sizeof *block);
    double *out[CONTRACT_BATCH_OUT], least = INFINITY;
    const double *in[CONTRACT_BATCH_IN];
    for (unsigned k = 0; k < call->n_out; k++) out[k] = block + (CONTRACT_BATCH_IN + k) * BATCH_TIMED;
    for (unsigned k = 0; k < call->n_in; k++) {
        in[k] = block + k * BATCH_TIMED;
        for (size_t i = 0; i < BATCH_TIMED; i++) block[k * BATCH_TIMED + i] = batch->in[k][BATCH_BAND + i % BATCH_ROW];
    }
    for (int round = 0; round < 5; round++) {
        double start = contract_batch_now();
        for (int i = 0; i < BATCH_CALLS; i++) call->run(batch->contract, call, BATCH_TIMED, in, out);
        double spent = (contract_batch_now() - start) / BATCH_CALLS / BATCH_TIMED;
        if (spent < least) least = spent;
    }
    contract_cost(batch->contract, call->name, least);
    mem_free(block);
}

void contract_batch_run(struct contract *contract, const struct contract_call *call)
{
    struct batch *batch = mem_new(1, sizeof *batch);
    *batch = (struct batch){.contract = contract, .call = call};
    uint64_t seed = 3;
    char what[CONTRACT_NAME];
    snprintf(what, sizeof what, "rows of %s", call->name);
    contract_doing(contract, what);
    for (unsigned k = 0; k < CONTRACT_BATCH_IN; k++)
        for (int i = 0; i < BATCH_SPAN; i++) batch->in[k][i] = BATCH_GUARD;
    for (int i = 0; i < BATCH_ROW; i++) {
        double in[CONTRACT_BATCH_IN] = {0}, out[CONTRACT_BATCH_OUT] = {0};
        call->draw(contract, call, &seed, in);
        for (unsigned k = 0; k < call->n_in; k++) batch->in[k][BATCH_BAND + i] = in[k];
        contract_batch_one(contract, call, in, out);
        for (unsigned k = 0; k < call->n_out; k++) batch->want[k][i] = out[k];
    }
    contract_batch_places(batch);
    contract_batch_bad(batch);
    contract_batch_time(batch);
    mem_free(batch);
}
