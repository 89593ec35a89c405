/* record.h - everything a run writes while it goes: snapshots, history, probes, checkpoints, provenance. */
#ifndef RECORD_H
#define RECORD_H

#include "solve/state.h"

#include <stdbool.h>

struct record;
struct resume;

/* Opens the files in the scene's directory, which exists; `argv` must outlive the record. `from` is the checkpoint
 * that the state was read from, or NULL: the files go on where they were then. Collective, as all calls here. */
int record_open(const struct state *state, int argc, char *const *argv, const struct resume *from,
                struct record **ret_record);

/* Has the state call back at moments inside a step of level 0, if the case wants the steps of the finest level in its
 * history. The record must outlive the steps of the state. */
void record_follow(struct record *record, struct state *state);

/* The next time at which something must be written, or `until`. */
double record_target(const struct record *record, double t, double until);

/* To be called with the initial state and after every step: writes what is due. */
int record_due(struct record *record, const struct state *state);

/* Writes a snapshot that nobody planned, unless this state has one. */
int record_now(struct record *record, const struct state *state);

/* Writes a checkpoint, unless this state has one. */
int record_save(struct record *record, const struct state *state);

/* Has so much wall time passed without a checkpoint that one is due? `clock`: seconds since the run began. Not
 * collective: one rank asks. */
bool record_late(struct record *record, double clock);

/* Writes the checkpoint that is late. If that fails it is a warning, and the next one comes after as much time again:
 * nobody has asked for it, and the run is whole without it. */
void record_rescue(struct record *record, const struct state *state);

/* The checkpoint written last, or NULL. */
const char *record_saved(const struct record *record);

/* After a step that could not be completed: writes a dump (io/dump.h); *ret_path, to be released with mem_free, is NULL
 * if there is nothing to dump. */
int record_dump(const struct record *record, const struct state *state, char **ret_path);

/* Is this rank at work beside the run, bringing a file to the disk? Not collective. */
bool record_busy(const struct record *record);

/* If no rank is (`is_busy`, agreed on): looks what became of such a file. Waits for it, whoever is. */
int record_settle(struct record *record, bool is_busy);
int record_finish(struct record *record);

/* Writes whatever this state lacks: the end of a run, whatever ended it. */
int record_last(struct record *record, const struct state *state);

/* Writes provenance.json with the reason why the run ended and its exit code. */
int record_conclude(struct record *record, const struct state *state, const char *reason, int exit_code);

/* Closes the files; NULL is fine. */
void record_close(struct record *record);

#endif
