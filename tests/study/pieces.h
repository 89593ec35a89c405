/* pieces.h - what the ranks of a run would do at a regrid, each with its piece of the tile sets: the program's own
 * functions are called for one virtual rank after the other, with what the others would have sent it. */
#ifndef PIECES_H
#define PIECES_H

#include "study.h"

struct pieces {
    double mean, most;       /* CPU seconds of a rank: its own piece of all levels, and what it knows around it */
    double cut[MESH_LEVELS]; /* of rank 0 at a regrid from each level: it cuts those above while the others wait */
    double bytes, messages;  /* sent by the rank that sends most */
    double joined;           /* bytes that come to every rank: runs and tables of the cut, first keys */
    double held;             /* bytes of the lists of the rank that knows most */
    double table;            /* and of the first keys that every rank holds */
    double files;            /* bytes of lists while a snapshot is written, of the rank that has most */
    double files_of_all;     /* and of a rank that lists all tiles for that */
};

/* A regrid from level 0 that replaces all levels by what they are, on `size` ranks. */
struct pieces pieces_regrid(struct study *study, int size);

#endif
