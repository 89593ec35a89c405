/* provenance.h - provenance.json: what made these results, and what it cost.
 *
 * Written when a run begins (exit_reason "running") and again when it ends, by draft and rename:
 * a file that says "running" belongs to a run that was killed. */
#ifndef PROVENANCE_H
#define PROVENANCE_H

#include "io/notes.h"
#include "solve/state.h"

struct provenance;

/* Takes stock of a state that is about to run and writes the first file. `argv` must outlive it. Collective. */
int provenance_new(const struct state *state, int argc, char *const *argv, struct provenance **ret_provenance);
void provenance_free(struct provenance *provenance); /* NULL is fine */

/* To be called with the initial state and after every step: notes how many tiles there were at most. */
void provenance_watch(struct provenance *provenance, const struct state *state);

/* Writes the file again with the present figures; `reason`: "running", "finished", "interrupted by
 * SIGTERM", or the message of the failure. Collective. */
int provenance_write(struct provenance *provenance, const struct state *state, const char *reason, int exit_code);

/* CPU time that this rank has spent on writing files [s]. */
void provenance_output(struct provenance *provenance, double seconds);

/* Notes what has been used and what there was at the start, and goes on counting from there: the figures are those
 * of all runs that follow each other. Collective. */
void provenance_keep(const struct provenance *provenance, const struct state *state, struct notes *notes);
int provenance_recall(struct provenance *provenance, const struct state *state, const struct notes *notes);

/* The text as last written, equal on all ranks; valid until the next write. */
const char *provenance_text(const struct provenance *provenance);

#endif
