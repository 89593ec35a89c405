/* probes.h - probes.csv: fields at points over time, `t,<probe>.<field>...` (velocity as
 * <probe>.velocity_x, ...).
 *
 * In space, values are those of sample.h. In time, rows stand at the times that the
 * case asks for (multiples of `every`), linear between the steps around them; with `every: N
 * steps` at every N-th step. Without `every` each step makes a row. */
#ifndef PROBES_H
#define PROBES_H

#include "derive/derive.h"
#include "io/notes.h"
#include "solve/state.h"

struct probes;

/* Opens <directory>/probes.csv if the case has probes (else *ret_probes is NULL, which all calls
 * accept). STATUS_CASE for unknown fields and points outside the domain. Collective, as all calls here. */
int probes_new(const struct state *state, struct probes **ret_probes);
void probes_free(struct probes *probes);

/* Notes where the file is and the last sample, and goes back there (csv.h); `origin` is the directory that the rows
 * of the past may be copied from. */
int probes_keep(struct probes *probes, struct notes *notes);
int probes_recall(struct probes *probes, const struct notes *notes, const char *origin);

/* To be called with the initial state and after every step: writes the rows that fall between the
 * last call and this state. */
int probes_record(struct probes *probes, const struct state *state, struct derive_moment *moment);

/* Writes a row for this state if the last row lies before it: the end of a run. */
int probes_finish(struct probes *probes, const struct state *state, struct derive_moment *moment);

#endif
