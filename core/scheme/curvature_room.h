/* curvature_room.h - what curvature.c and curvature_carry.c share: blocks of numbers and what is taken of them. */
#ifndef CURVATURE_ROOM_H
#define CURVATURE_ROOM_H

#include "scheme/curvature.h"
#include "scheme/curvature_grid.h"

/* Least difference of psi over a cell that says where the surface looks. */
#define CURVATURE_FLAT 1e-3

/* m: roots of fractions that straighten a front; curvature_straighten takes them. */
#define CURVATURE_POWER 0.125

/* Blocks around a tile, with room for the layers of a patch each; what each holds is said where it is made. */
struct curvature {
    const struct mesh *mesh;
    int g;
    double *rows, *psi, *other, *kappa, *kept, *trust, *spare;
    double *normal[3];
};

/* The four rows along x around a place: those one step along y, along z and along both. */
struct curvature_around {
    const double *here, *y, *z, *yz;
};

static inline struct curvature_around curvature_room_around(const struct curvature_grid *of, const double *from,
                                                            size_t j, size_t k)
{
    const double *at = from + j * of->stride[1] + k * of->stride[2];
    return (struct curvature_around){at, at + of->stride[1], at + of->stride[2], at + of->stride[1] + of->stride[2]};
}

static inline size_t curvature_room_cells(const struct mesh *mesh, int more)
{
    const struct curvature_grid grid = curvature_grid(mesh, more);
    return grid.n[0] * grid.n[1] * grid.n[2];
}

/* Means of what lies around each place of a block with one place less: from cells to corners, from corners to cells. */
void curvature_room_between(const struct mesh *mesh, int more, const double *from, double *ret);

/* Differences of a block along its axes, times h_0/h_d, at what lies between its places: from the 2 x 2 x 2 around. */
void curvature_room_rise(size_t n, const struct curvature_around *around, const double per[3], double *restrict x,
                         double *restrict y, double *restrict z);

/* h_0/h_d of a level; 0 along axes that are not used. */
void curvature_room_per(const struct mesh *mesh, const struct level *level, double ret_per[3]);

#endif
