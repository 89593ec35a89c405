/* contract_batch.h - what holds for every function of every kind: it maps rows of inputs to rows of
 * outputs point by point, and touches nothing else. */
#ifndef CONTRACT_BATCH_H
#define CONTRACT_BATCH_H

#include "suite/contract.h"

enum { CONTRACT_BATCH_IN = 40, CONTRACT_BATCH_OUT = 20 };

/* One function of a module as rows in, rows out. */
struct contract_call {
    const char *name;
    unsigned n_in, n_out; /* at most CONTRACT_BATCH_IN and CONTRACT_BATCH_OUT */
    /* Calls the module for n points. Outputs that it does not fill are set to 0. */
    void (*run)(const struct contract *contract, const struct contract_call *call, size_t n, const double *const *in,
                double *const *out);
    /* The n_in inputs of a random point. */
    void (*draw)(const struct contract *contract, const struct contract_call *call, uint64_t *seed, double *in);
    const void *context; /* for the two above */
};

/* Rows against single points at every place and length, guard bands around all rows, bad numbers
 * beside good ones; and the cost per point. */
void contract_batch_run(struct contract *contract, const struct contract_call *call);

/* One point. */
void contract_batch_one(const struct contract *contract, const struct contract_call *call, const double *in,
                        double *out);

#endif
