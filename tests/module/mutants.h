/* mutants.h - what the tests of seeded faults share: a good module with one function replaced must fail in the check
 * that is there for the fault. */
#ifndef MUTANTS_H
#define MUTANTS_H

#include "support.h"

#include "suite/contract_module.h"

/* A copy of a module with another table of functions fails in a check that begins with `check`. */
static inline void finds_in(const struct bulla_module *of, const void *table, const char *check)
{
    struct bulla_module module = *of;
    module.table = table;
    struct contract contract = {.module = &module};
    assert_int_equal(contract_module_run(&contract, NULL), 0);
    for (unsigned i = 0; i < contract.n_row; i++) {
        const struct contract_row *row = &contract.rows[i];
        if (strncmp(row->check, check, strlen(check)) != 0) continue;
        if (row->points > 0 && !(row->worst <= row->limit) && *row->where) return;
    }
    struct text text = {0};
    contract_table(&contract, &text);
    fail_msg("nothing wrong found with '%s':\n%s", check, text.at);
}

/* The same of a built-in one. */
static inline void finds(const char *kind, const char *name, const void *table, const char *check)
{
    finds_in(support_module(kind, name), table, check);
}

#define IN const double *BULLA_RESTRICT
#define OUT double *BULLA_RESTRICT

#endif
