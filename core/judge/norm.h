/* norm.h - how far a run is from a reference: L1, L2 and Linf of the difference.
 *
 * Of a field: the mean over the domain of the last snapshot (cells weighted by their extents)
 * against `exact-riemann` (exact cell averages of the scene's own Riemann problem), `initial`
 * (the snapshot at t = 0: waves that return after a period; where the two are refined differently, on the coarser
 * cells), `mirror-x`, `-y`, `-z` (each cell's mirror image about the middle of the domain: 0 if the scene has stayed
 * symmetric to the bit), or a CSV profile along x (1D), averaged over each cell. Of a history or probe column: the mean
 * over time against a CSV column, over the time span that both cover. */
#ifndef NORM_H
#define NORM_H

#include "case/scene.h"
#include "case/trace.h"

/* Before the run: has the scene an exact solution, where one is asked for, and does it have that field? STATUS_CASE
 * with the line of the case. (CSV files are looked at when the case is read.) */
int norm_check(const struct scene *scene);

/* The norm that `expect` asks for, divided by its scale, for a field of the snapshots in `directory`. */
int norm_of_field(const struct scene *scene, const struct scene_expect *expect, const char *directory,
                  double *ret_norm);

/* The same for a column over time. */
int norm_of_trace(const struct scene_expect *expect, const struct trace *trace, double *ret_norm);

#endif
