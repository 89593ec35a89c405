/* resume_runs.h - which part of a checkpoint has a tile, where several writers have written it (parts.h): rank 0 knows
 * all runs of tiles and all parts, any other rank those of its own tiles. */
#ifndef RESUME_RUNS_H
#define RESUME_RUNS_H

#include "io/parts.h"
#include "io/resume.h"

/* The run that a tile is in, of those that this rank knows. */
const struct resume_run *resume_runs_find(const struct resume *resume, size_t tile);

/* Tells the other ranks the runs that their tiles are in; each then looks at the headers of the parts of `list` that
 * these are in. STATUS_RUN on all if one cannot. Collective. */
int resume_runs_deal(struct resume *resume, const struct parts_list *list);

#endif
