/* checkpoint.h - exact states to go on from: <directory>/checkpoints/<case>_<step>.chk.
 *
 * One file holds all that a run needs: time, steps and counts, the tiles of every level, their conserved
 * fields (and pressures, where a closure is iterated), what outputs carry from step to step, and the
 * resolved case. It does not depend on the ranks. It is an HDF5 file behind a seal (seal.h):
 *   /case.yaml  text      the resolved case
 *   /notes      text      notes.h: state, counts, facts (facts.h), outputs, who wrote it and when
 *   /tiles      i32 [n_tile, 5]        level, i, j, k, unwanted; level by level, in Morton order
 *   /u          f64 [n_tile, n_field * n_cell]  conserved fields, as in memory
 *   /p          f64 [n_tile, n_cell]   pressures; only where a closure is iterated
 *   /kept       f64 [n_tile, n_kept * n_cell]   peaks over time (solve/peak.h); only where a scene has them
 * With several writers (writers.h) /u, /p and /kept lie in parts beside the file (parts.h), tile by tile in the same
 * order; in the file they are views, and there are besides:
 *   /parts      text      the list of the parts
 *   /runs       i32 [n, 2]             which part has how many tiles, run by run in the order of /tiles
 * A file gets its name when it is whole, lasting and verified; only then do older ones go. */
#ifndef CHECKPOINT_H
#define CHECKPOINT_H

#include "io/notes.h"
#include "solve/state.h"

enum { CHECKPOINT_TILE = 5, CHECKPOINT_RUN = 2 }; /* columns of /tiles and /runs */

struct checkpoints;

/* Where the checkpoints of a scene go, and how many are kept. Nothing is written yet. Collective. */
struct checkpoints *checkpoint_new(const struct scene *scene);
void checkpoint_free(struct checkpoints *checkpoints); /* NULL is fine */

/* Writes the present state, with the notes that outputs want back, unless this step was the last written;
 * then removes what is older than the case wants to keep. STATUS_RUN with file and reason: what was
 * there before is still there. Collective; the notes of rank 0 count. */
int checkpoint_write(struct checkpoints *checkpoints, const struct state *state, const struct notes *outputs);

/* The file written last, or NULL. */
const char *checkpoint_last(const struct checkpoints *checkpoints);

/* The checkpoints of a folder, the newest first, before them those whose header is damaged. Release each and the
 * list with mem_free. Of this process alone. */
void checkpoint_list(const char *folder, unsigned *ret_n, char ***ret_paths);

#endif
