/* blame_replay.h - a tile that failed, computed again from what was kept of it alone (blame.h).
 *
 * The same bits mean that the failure lies in the numbers and the laws that are in the file; others, that
 * the program or a module is not the one it was, or that memory was damaged. */
#ifndef BLAME_REPLAY_H
#define BLAME_REPLAY_H

#include "solve/blame.h"

struct blame_outcome {
    size_t faces, cells; /* numbers of the troubled cell's faces, and cells of the tile, that differ in any bit; of
                            faces: quantities (columns) that do */
    double value;        /* of the field in the cell, 0 if no cell is wrong any more */
    bool same_value, same_verdict;
    char verdict[GUARD_WORDS]; /* empty: the guard has nothing to say */
};

/* Faces, update, primitives, the guard's judgement. Of this process alone. `model`: of the scene that failed. */
void blame_replay(const struct model *model, const struct blame *blame, struct blame_outcome *ret_outcome);

#endif
