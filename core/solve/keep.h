/* keep.h - what a stage keeps of a tile instead of computing it.
 *
 * All of a tile at rest; the rows that a narrowed path leaves alone; what a stage has made, where the integrator goes
 * on from it. Every value kept is the one that would have been computed: skipping changes no bit (docs/numerics.md). */
#ifndef KEEP_H
#define KEEP_H

#include "solve/stage.h"

/* Is tile `local` skipped in the stage under way, hidden or at rest with all around it? Noted in its census. Repeated
 * steps, tiles whose fluxes another level asks for and paths with terms or operators that move what rests are not
 * skipped; nor is a tile that has already moved, where stages build on each other. */
bool keep_skips(struct stage *stage, unsigned local);

/* Carries a skipped tile on: the whole block `from` [n_field][n_cell] as it is into `to`. */
void keep_tile(struct stage *stage, unsigned local, const double *from, double *to);

/* Copies the rows that the path of tile `local` leaves alone, `from` and `to` as above. A narrowed path has no normals.
 * Its fractions and stretch are the same constants in all three arrays of a level, so that after a stage more than a
 * step has they need no copying; densities are not. */
void keep_rows(struct stage *stage, unsigned local, const double *from, double *to);

/* Block of tile `local` in the fourth array, the conserved fields of the stage before; NULL: the integrator has
 * none. */
double *keep_previous(const struct stage *stage, unsigned local);

/* Writes that block: `made`, active rows of what this stage has made, over the old state; without `made` the old state,
 * in which a skipped tile rests. */
void keep_stage(const struct stage *stage, unsigned local, const double *made);

#endif
