/* curvature_grid.h - blocks of numbers around a tile, in its cells or between them: for curvature.c and heights.c. */
#ifndef CURVATURE_GRID_H
#define CURVATURE_GRID_H

#include "mesh/mesh.h"

/* A block of numbers, x fastest; a stride is 0 along axes that are not used. */
struct curvature_grid {
    size_t n[3], stride[3];
};

/* `more` places more along each axis than a tile has cells. */
static inline struct curvature_grid curvature_grid(const struct mesh *mesh, int more)
{
    struct curvature_grid grid = {{1, 1, 1}, {0, 0, 0}};
    size_t stride = 1;
    for (int d = 0; d < mesh->dim; d++) {
        grid.n[d] = (size_t)(mesh->n[d] + more);
        grid.stride[d] = stride;
        stride *= grid.n[d];
    }
    return grid;
}

/* Numbers of a block from place (0, j, k) on, `layers` within it. */
static inline size_t curvature_grid_at(const struct curvature_grid *grid, size_t layers, size_t j, size_t k)
{
    return layers * (grid->stride[0] + grid->stride[1] + grid->stride[2]) + j * grid->stride[1] + k * grid->stride[2];
}

#endif
