/* rigid_part.h - how much of one cell and of one face rigid bodies cover. Used by rigid.c alone. */
#ifndef RIGID_PART_H
#define RIGID_PART_H

#include "case/pose.h"

/* Bodies in one pose each [n_rigid]. */
struct rigid_part {
    const struct scene *scene;
    const struct pose *poses;
};

/* A box of space: a cell, or with lower = upper along an axis a face. */
struct rigid_part_box {
    double lower[3], upper[3];
};

/* Part of a cell's volume, with the weight x^beta, that a body covers. */
double rigid_part_body(const struct rigid_part *part, unsigned body, const struct rigid_part_box *cell, int beta);

/* Part of a face across `axis` that no body covers, with the same weight; surfaces in the face close it. */
double rigid_part_open(const struct rigid_part *part, int axis, const struct rigid_part_box *face, double h, int beta);

/* May a body reach into a box? */
bool rigid_part_reaches(const struct rigid_part *part, const struct rigid_part_box *box);

#endif
