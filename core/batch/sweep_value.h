/* sweep_value.h - values that a sweep asks of every combination: "min(V)/first(V)", "t_c = argmin(R)".
 *
 * Expressions over the histories and probes of a run, as in `expect:` (case/formula.h). */
#ifndef SWEEP_VALUE_H
#define SWEEP_VALUE_H

#include "case/scene.h"
#include "cli/cli.h"

struct sweep_value {
    char *label; /* the name before `=`, or the expression */
    const char *text;
};

/* Reads --value of the command line; *ret_values is an array of *ret_count. Release with sweep_value_done. */
void sweep_value_read(const struct cli_given *given, struct sweep_value **ret_values, unsigned *ret_count);
void sweep_value_done(struct sweep_value *values, unsigned count);

/* Would a run of the scene have such a value? STATUS_CASE with what is wrong. */
int sweep_value_check(const struct sweep_value *value, const struct scene *scene);

#endif
