/* record.h - everything a run writes while it goes: snapshots, history, probes, provenance. */
#ifndef RECORD_H
#define RECORD_H

#include "solve/state.h"

struct record;

/* Opens the files in the scene's directory, which exists. Collective, as all calls here. */
int record_open(const struct state *state, struct record **ret_record);

/* The next time at which something must be written, or `until`. */
double record_target(const struct record *record, double t, double until);

/* Writes what is due at this state. */
int record_due(struct record *record, const struct state *state);

/* Writes whatever this state lacks: the end of a run, whatever ended it. */
int record_last(struct record *record, const struct state *state);

/* Closes the files and writes provenance.json with the reason why the run ended. NULL is fine. */
int record_close(struct record *record, const struct state *state, const char *reason);

#endif
