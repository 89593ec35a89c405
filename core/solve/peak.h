/* peak.h - peaks over time: what cells keep of fields from step to step (`max_pressure`, `when_min_pressure`, ...).
 *
 * Every level looks at its leaves after each of its own steps, once what finer levels have to say is in, so that a
 * front that moves a cell per step leaves no gaps; attempts that are repeated leave nothing. Cells of new tiles take
 * over what the cell below them has kept, cells that are left again the largest (least) of what lay over them: a peak
 * never gets lost, and counts for the whole of the cell that is left. Of equal values the earliest time is kept. */
#ifndef PEAK_H
#define PEAK_H

#include "solve/state.h"

/* The present values of level l, at time t. Collective, as all calls here; nothing happens in scenes without peaks. */
void peak_take(const struct state *state, int l, double t);

/* Gives the cells of levels `base` and finer that lie under finer tiles what those have kept: before they go. */
void peak_up(const struct mesh *mesh, const struct scene_output *output, int base);

/* Gives the tiles of level l that are marked in born[n_known] what the cells below them have kept. */
void peak_down(const struct mesh *mesh, int l, const bool *born);

#endif
