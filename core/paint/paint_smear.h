/* paint_smear.h - how the surface between a liquid and its vapour begins, for pairs with an `onset`.
 *
 * Painted surfaces are sharp: a cell of liquid beside one of vapour. Liquid evaporates where vapour fills nearly all of
 * a cell and in the cells beside such (scheme/shore.h). Beside a sharp surface that is a cell of liquid, so heavy and
 * stiff that it does not let out what it makes: its pressure stays that of saturation while that of the vapour falls,
 * until the surface has moved by half a cell. So a run begins with a little of each side in the cell beside it. Two
 * neighbours that hold nothing but liquid, vapour and the gases beside it, and not the same shares of them, change
 * PAINT_SMEAR_PART of the smaller one, along each axis. Volume, mass, momentum and energy of all materials stay,
 * whatever the geometry. */
#ifndef PAINT_SMEAR_H
#define PAINT_SMEAR_H

#include "phys/model.h"

#include <stdbool.h>
#include <stddef.h>

enum { PAINT_SMEAR_PAD = 1 }; /* layers of cells around a tile that its own may change something with */

/* Has a scene such surfaces? They need an `onset` and conduction; what begins with the state of another run has its
 * surfaces from there. */
bool paint_smear_is(const struct model *model);

/* A box of cells, x fastest. */
struct paint_smear {
    const struct model *model;
    int dim, beta;        /* as in mesh.h */
    int n[3];             /* cells along each axis */
    size_t n_cell;        /* all of them */
    double *const *edges; /* [dim] where cells begin and end: [n + 1] [m] */
    double *u;            /* conserved fields, [n_field][n_cell] */
};

/* Changes contents within a box; nothing goes through its ends. */
void paint_smear(const struct paint_smear *box);

#endif
