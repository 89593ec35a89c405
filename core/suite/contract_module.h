/* contract_module.h - the contract suite on a whole module: with its defaults, with every preset, and
 * what its parameter table promises. */
#ifndef CONTRACT_MODULE_H
#define CONTRACT_MODULE_H

#include "suite/contract.h"

/* Runs everything on contract->module. `sets` (NULL-terminated, or NULL) gives parameters as "name=value", with
 * units; then only they and the defaults are tried, and no preset. STATUS_CASE with a message if nothing can be
 * opened: a parameter without a value, a bad setting, or the module's own refusal. */
int contract_module_run(struct contract *contract, const char *const *sets);

#endif
