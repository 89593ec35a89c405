/* guard_name.h - what is wrong with a cell that the guard refuses: the field, its value, and the material or law that
 * it comes from. Worked out for one cell of a failed attempt; nothing here judges. */
#ifndef GUARD_NAME_H
#define GUARD_NAME_H

#include "solve/guard.h"

/* What the words say where surface tension is behind a pressure. */
#define GUARD_NAME_TENSION ", off which surface tension takes"

struct guard_name {
    char field[SCENE_NAME + 32]; /* as in snapshots; of a law that gives no number, what it was asked for */
    double value;
    char words[600]; /* unit, and what else there is to say */
};

/* Of one of the n_cell cells of a tile that was judged. The first that applies: an evolved field that is no number; an
 * elastic law that gives none; a material that lost its mass, or cannot bear its pressure; the mixture. */
void guard_name_find(const struct guard_tile *tile, size_t n_cell, size_t cell, struct guard_name *ret_name);

#endif
