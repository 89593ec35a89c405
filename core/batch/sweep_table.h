/* sweep_table.h - the result table of a sweep: a line per combination, in the order of the matrix.
 *
 * Columns: the combination, its settings, exit code, wall and CPU time, cells updated, each expectation and whether it
 * holds, each value that was asked for. */
#ifndef SWEEP_TABLE_H
#define SWEEP_TABLE_H

#include "base/text.h"
#include "batch/study_row.h"
#include "batch/sweep_plan.h"
#include "batch/sweep_value.h"

enum { SWEEP_TABLE_WAITING = -1 }; /* exit code of a combination that has not ended */

struct sweep_table_row {
    struct study_row run;
    double *values; /* [n_value]; NaN: none */
};

struct sweep_table {
    const struct sweep_plan *plan;
    const struct sweep_value *values;
    unsigned n_value;
    const struct sweep_table_row *rows; /* [plan->matrix.n_row] */
};

/* CSV: settings that are quantities in SI units, others as texts; 1 or 0 for expectations; what there is not is
 * empty. */
void sweep_table_csv(const struct sweep_table *table, struct text *out);

/* For people: settings as they stand in the matrix, columns one under the other. */
void sweep_table_print(const struct sweep_table *table, struct text *out);

#endif
