/* pieces.h - what the ranks of a run would do at a regrid, each with its piece of the tile sets: the program's own functions
 * are called for one virtual rank after the other, with what the others would have sent it. */
#ifndef PIECES_H
#define PIECES_H

#include "study.h"

struct pieces {
    double mean, most;      /* CPU seconds of a rank: its own piece of all levels */
    double whole;           /* and of what every rank still does with all tiles */
    double cut;             /* of rank 0, which cuts all levels while the others wait */
    double bytes, messages; /* sent by the rank that sends most */
    double joined;          /* bytes that come to every rank with the joined pieces, and runs and tables of the cut */
    double held;            /* bytes of lists and tables that every rank holds */
};

/* A regrid from level 0 that replaces all levels by what they are, on `size` ranks. */
struct pieces pieces_regrid(struct study *study, int size);

#endif
