/* carry.h - one number per tile, carried from levels to new sets of their tiles: those that were there keep theirs,
 * born ones get that of the finest tile below them that was there. Every rank has the numbers of its own pieces and
 * asks the others for what is below, of all levels at once. */
#ifndef CARRY_H
#define CARRY_H

#include "mesh/nest.h"

/* The numbers of this rank's piece of a level as it is; tiles sorted. */
struct carry {
    unsigned n;
    const struct tile *tiles;
    const double *values;
};

/* Numbers for this rank's pieces sets[l] of the new levels base + 1 to `highest`: new arrays ret_values[l] (mem_free).
 * before[l]: of the levels as they are, from `base` on (n 0: not there). The new sets nest in each other and in level
 * `base`. Collective. */
void carry_values(const struct mesh *mesh, int base, int highest, const struct nest_set *sets,
                  const struct carry *before, double **ret_values);

#endif
