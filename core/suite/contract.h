/* contract.h - what a contract suite has found about a module: one row per check with the worst
 * value and where it was met. The same suites judge built-in laws in the tests and foreign ones
 * in `bulla module check`.
 *
 * A suite runs once per set of parameters; rows of the same name are one row.
 *
 * This folder, suite: contract suites of modules, and the commands for their authors. */
#ifndef CONTRACT_H
#define CONTRACT_H

#include "base/text.h"
#include "bulla/module.h"

#include <stdbool.h>
#include <stdint.h>

enum {
    CONTRACT_PROBE = 4,
    CONTRACT_WHERE = 160,
    CONTRACT_ROWS = 40,
    CONTRACT_FACTS = 8,
    CONTRACT_COSTS = 16,
    CONTRACT_NAME = 64
};

struct contract_row {
    const char *check;          /* what must hold; static text */
    long points;                /* values compared; 0: the module does not offer it */
    double worst, limit;        /* holds where worst <= limit; of a bitwise check: 0 or 1 */
    char where[CONTRACT_WHERE]; /* the worst value's inputs */
    bool compared;              /* the worst value is the difference of these two: */
    double got, want;
};

/* A property that modules may have or not. */
struct contract_fact {
    const char *what;
    bool holds;
};

struct contract_cost {
    const char *call;
    double ns; /* per point, in rows of a tile's length */
};

/* Start from {.module = ..., .strict = ...}; self and preset change from run to run. */
struct contract {
    const struct bulla_module *module;
    const void *self;   /* the instance under test */
    const char *preset; /* what it was opened with, for messages; "" */
    bool strict;        /* built-in laws: exact where others need round-off only */
    char *progress;     /* CONTRACT_NAME bytes that get what is being done, or NULL */
    unsigned n_row, n_fact, n_cost, at;
    struct contract_row rows[CONTRACT_ROWS];
    struct contract_fact facts[CONTRACT_FACTS];
    struct contract_cost costs[CONTRACT_COSTS];
};

/* Tells a watcher what the module is about to be asked. */
void contract_doing(struct contract *contract, const char *what);

/* The check that the following errors belong to. */
void contract_begin(struct contract *contract, const char *check, double limit);

/* One value of the check at work: its error (NaN is infinite) and, printf style, where. */
void contract_error(struct contract *contract, double error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* |got - want|/scale, kept with both. `where` says at which inputs. */
void contract_near(struct contract *contract, double got, double want, double scale, const char *where);

/* One value of a check that holds or not. */
void contract_holds(struct contract *contract, bool holds, const char *where);

void contract_fact(struct contract *contract, const char *what, bool holds);
void contract_cost(struct contract *contract, const char *call, double ns);

/* How many checks fail. */
unsigned contract_failed(const struct contract *contract);

/* The table: checks, properties, costs. */
void contract_table(const struct contract *contract, struct text *text);

/* Bit by bit the same, or both not a number. */
bool contract_same(double a, double b);

/* Uniform in [low, high): a linear congruential stream, the same on every machine. */
double contract_random(uint64_t *state, double low, double high);

/* The same with as many in each decade; 0 < low. */
double contract_decades(uint64_t *state, double low, double high);

#endif
