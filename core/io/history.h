/* history.h - history.csv: `step,t,dt,<columns>` and what the guard did so far, one row per call.
 *
 * The columns are those of the case (measure.h); after them stand guard_fallback, guard_relaxed,
 * guard_clipped, guard_retries: totals since the start (state.h). `value` columns are scripts of
 * t and columns before them. Rows are the same on any number of ranks. */
#ifndef HISTORY_H
#define HISTORY_H

#include "derive/derive.h"
#include "io/notes.h"
#include "solve/state.h"

struct history;

/* Opens <directory>/history.csv. A state with steps behind it goes on with the rows up to its step.
 * STATUS_CASE for an unknown field. Collective, as all calls here. */
int history_new(const struct state *state, struct history **ret_history);
void history_free(struct history *history); /* NULL is fine */

/* Notes where the file is and what columns carry from step to step, and goes back there (csv.h); `origin` is the
 * directory that the rows of the past may be copied from. */
int history_keep(struct history *history, struct notes *notes);
int history_recall(struct history *history, const struct notes *notes, const char *origin);

/* Appends the row of the present state, unless this step was the last written. A `value` that
 * cannot be computed (0/0, a column that is NaN) is NaN; one that does not end is STATUS_RUN. */
int history_write(struct history *history, const struct state *state, struct derive_moment *moment);

#endif
