/* snapshot.h - plot files: one HDF5 file per output time that ParaView and yt open as it is.
 *
 * <directory>/fields/<case>_<step>.hdf holds, stored once, two views of the same arrays:
 *   /VTKHDF            an unstructured grid (VTKHDF 1.0) of the leaves: lines, quads or hexahedra with
 *                      shared points; CellData/<name> [n_cell] or [n_cell, 3], float32 or float64
 *   /level_<l>, ...    the Chombo layout of the same leaves, as virtual data sets (2D and 3D);
 *                      it knows one cell width: where cells are not square its lengths are off
 *   /bulla             case.yaml, blocks (level, i, j, k, rank, covered octants), provenance.json, and what
 *                      read.h needs: title, case, dim, beta, domain, materials
 * With several writers (writers.h) the rows lie in parts beside the file (parts.h), and /bulla/parts lists these.
 * The order of cells is that of leaves.h. <case>.hdf.series lists all
 * files with their times. Files get their names when complete. The numbers do not depend on the
 * ranks (but for the rank column of blocks and provenance.json).
 *
 * This folder, io: every file that a run writes or reads, and what is measured for it. */
#ifndef SNAPSHOT_H
#define SNAPSHOT_H

#include "derive/derive.h"
#include "io/notes.h"
#include "solve/state.h"

struct snapshots;

/* Prepares the folder and looks the fields up (STATUS_CASE for an unknown one). A state with steps
 * behind it goes on with the list of files up to its time; a new one starts it. Collective. */
int snapshot_new(const struct state *state, struct snapshots **ret_snapshots);
void snapshot_free(struct snapshots *snapshots); /* NULL is fine */

/* Notes how many files are listed, and goes back to that: files listed after them, which the continued run
 * may write again, are removed. */
void snapshot_keep(const struct snapshots *snapshots, struct notes *notes);
void snapshot_recall(struct snapshots *snapshots, const struct notes *notes);

/* From now on files that are small enough (output.snapshots.memory) are made in memory and go to the disk beside the
 * run: they are complete after snapshot_wait, or when snapshot_settle has ended them. */
void snapshot_beside(struct snapshots *snapshots);

/* Bytes that a single writer may take for that, of so many cells (output.snapshots.memory, if it is enough; else 0): a
 * file and the points and connections of the one before, all counted as they are before they are packed. */
double snapshot_memory(const struct model *model, double cells);

/* Is a file on its way (the same on all ranks)? Is this rank still at work for it? */
bool snapshot_pending(const struct snapshots *snapshots);
bool snapshot_busy(const struct snapshots *snapshots);

/* Takes the file on its way one stage further, waiting for it where a rank is still at work; to its end. STATUS_RUN if
 * it could not be written: it is gone, those before are whole. Collective. */
int snapshot_settle(struct snapshots *snapshots);
int snapshot_wait(struct snapshots *snapshots);

/* Writes the present state unless this step was the last written; `provenance` is the text of
 * provenance.json, equal on all ranks. Says what became of the file before, too. Collective. */
int snapshot_write(struct snapshots *snapshots, const struct state *state, struct derive_moment *moment,
                   const char *provenance);

#endif
