/* carry.h - one number per tile, carried from a level to a new set of its tiles: those that were there keep theirs, born
 * ones get that of the tile below. Every rank has the numbers of its own pieces and asks the others for what is below. */
#ifndef CARRY_H
#define CARRY_H

#include "mesh/nest.h"

/* The numbers of this rank's piece of a level or of a new set; tiles sorted. */
struct carry {
    unsigned n;
    const struct tile *tiles;
    const double *values;
};

/* Numbers for this rank's piece `set` of a new level l: new array (mem_free). `before`: of level l as it is (n 0: it is
 * not there); `below`: of level l - 1 as it will be, in which the set nests. Collective. */
double *carry_values(const struct mesh *mesh, int l, const struct nest_set *set, const struct carry *before,
                     const struct carry *below);

#endif
