/* contract_suite.h - which kinds there are and the suite of each: a new kind is one row of its table. */
#ifndef CONTRACT_SUITE_H
#define CONTRACT_SUITE_H

#include "suite/contract.h"

/* Runs the suite of contract->module's kind on contract->self. */
void contract_suite_run(struct contract *contract);

/* A few values of contract->self, by which instances are told apart. */
void contract_suite_probe(const struct contract *contract, double out[static CONTRACT_PROBE]);

/* All kinds, NULL-terminated. */
const char *const *contract_suite_kinds(void);

#endif
