/* resume.h - taking a run up again from a checkpoint (checkpoint.h).
 *
 * A file is believed only after all its checksums have been compared (seal.h), and then still checked against
 * the scene and against itself: lengths, places of tiles. Every rank reads what it needs at its place in
 * the file; no HDF5 is involved. Refusals are STATUS_CASE with one clear line. Calls are collective. */
#ifndef RESUME_H
#define RESUME_H

#include "io/notes.h"
#include "solve/state.h"

#include <stdio.h>

struct resume;

/* Opens and verifies a file. */
int resume_open(const char *path, struct resume **ret_resume);

/* Opens the newest whole file of <directory>/checkpoints; says in a warning which ones are damaged. */
int resume_newest(const char *directory, struct resume **ret_resume);

void resume_close(struct resume *resume); /* NULL is fine */

/* The state that was saved, for a scene that has enough in common with it (facts.h). */
int resume_state(struct resume *resume, const struct scene *scene, struct state **ret_state);

/* What the state and the outputs left for the continued run; belongs to `resume`. */
const struct notes *resume_notes(const struct resume *resume);
const char *resume_path(const struct resume *resume);

/* Describes a file for people; verifies it first. Of this process alone. */
int resume_info(FILE *out, const char *path);

#endif
