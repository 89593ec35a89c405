/* writers.h - which ranks write the rows of a large file: `n` of them, each for the ranks that follow it.
 *
 * Ranks are dealt to writers in runs of (nearly) equal length, in their order, which is that of machines where a
 * launcher fills one after the other. The first rank of a run writes for all of it; rank 0 is always one.
 * (docs/decisions/writers.md) */
#ifndef WRITERS_H
#define WRITERS_H

#include "case/scene.h"

/* How many writers a run has: those of the case, else one per machine; never more than ranks. Collective. */
int writers_count(const struct scene *scene);

/* The writer, 0 to n - 1, that a rank hands its rows to; and the first rank that does so, which is the writer
 * (writer n: one behind the last rank). */
int writers_of(int n, int rank);
int writers_first(int n, int writer);

/* Is this rank a writer? */
bool writers_here(int n);

#endif
