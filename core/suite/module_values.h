/* module_values.h - the parameters of a module without a case: its defaults, changed by words of the command line. */
#ifndef MODULE_VALUES_H
#define MODULE_VALUES_H

#include "bulla/module.h"

/* The values that a case without keys would give, NaN and NULL where a key is required, changed by `sets`
 * (NULL-terminated, or NULL): "name=value" with units, "preset=name". Free with module_values_free. STATUS_CASE: a bad
 * setting. */
int module_values(const struct bulla_module *module, const char *const *sets, struct bulla_value **ret_values);
void module_values_free(const struct bulla_module *module, struct bulla_value *values);

/* The first parameter that has no value, or NULL. */
const char *module_values_missing(const struct bulla_module *module, const struct bulla_value *values);

/* STATUS_CASE, naming that parameter, if there is one. */
int module_values_check(const struct bulla_module *module, const struct bulla_value *values);

#endif
