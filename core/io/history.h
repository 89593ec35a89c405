/* history.h - history.csv: `step,t,dt,<columns>` and what the guard did so far.
 *
 * The columns are those of the case (measure.h); after them stand guard_fallback, guard_relaxed,
 * guard_clipped, guard_retries: totals since the start (state.h). `value` columns are scripts of
 * t and columns before them; `min-between` and `max-between` are extremes over all looks since the row before. Rows are
 * the same on any number of ranks.
 *
 * Moments inside a step of level 0 (state.h, `look`) have rows too, if the caller wants them: with the number of the
 * step under way. They are kept in memory until the step is whole, so that the table has no rows that a run taken up
 * again would not know of, and a failure to write is that of a whole step. */
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

/* Takes note of extremes at the present moment, without a row of its own. */
int history_look(struct history *history, const struct state *state, struct derive_moment *moment);

/* Do any columns want looks between rows? */
bool history_looks(const struct history *history);

/* Appends the row of the present state, unless this step was the last written. A `value` that
 * cannot be computed (0/0, a column that is NaN) is NaN; one that does not end is STATUS_RUN. */
int history_write(struct history *history, const struct state *state, struct derive_moment *moment);

/* Writes rows that are still in memory: of a step that will not become whole. */
int history_flush(struct history *history);

#endif
