/* rigid.h - what rigid bodies leave of the cells and faces around a tile to fluids.
 *
 * A cell has a part of its volume, theta, and each of its faces a part of its area, a. What closes the rest of a cell
 * is the wall: the vector sum of its faces, W_d = (a_d- - a_d+)/h_d [area over the cell's whole volume, 1/m], into the
 * body, so that a uniform pressure pushes nobody, whatever the shape (Pember et al. 1995, J. Comput. Phys. 120, 278).
 * theta is the exact fraction of shape.h; a is found on lines in the face. Bodies that move have parts in the middle of
 * a step: theta is the mean of its two ends, a that of the face's way through the body. Slivers below RIGID_LEAST are
 * closed. */
#ifndef RIGID_H
#define RIGID_H

#include "mesh/mesh.h"

#include <stdbool.h>
#include <stddef.h>

#define RIGID_LEAST 1e-6

/* Around a tile: its cells and `pad` layers on all sides that exist, x fastest. Cells outside of the domain are
 * open. */
struct rigid_cells {
    bool any; /* some cell is cut or covered; else nothing below means anything */
    int pad;
    size_t size[3], count;
    const double *part;     /* theta; 0: covered all the time */
    const double *was;      /* theta at the first time; 0: covered then */
    const double *now;      /* theta at the time of the primitives; 0: covered then */
    const double *open[3];  /* a of the lower face along an axis */
    const double *wall[3];  /* W_d of the cells inside the outermost layer; 0 elsewhere */
    const double *speed[3]; /* of the wall [m/s]; NULL: no body moves */
    const double *plane;    /* theta with the weight r^(beta - 1), where geometry is curved; else NULL */
    const double *body;     /* number of the body that cuts or covers the cell */
};

/* From one time to another [s], seen at `now` in between. All the same for a state. */
struct rigid_times {
    double from, to, now;
};

struct rigid;

/* NULL for a scene without bodies. */
struct rigid *rigid_new(const struct scene *scene);
void rigid_free(struct rigid *rigid);

/* Of a tile; NULL where no body is near. Valid until the next call, in scenes whose bodies all rest until the end. */
const struct rigid_cells *rigid_at(const struct mesh *mesh, const struct level *level, const struct tile *tile,
                                   struct rigid_times times);

/* Offset in the block of a cell of the tile, counted from -pad. */
static inline size_t rigid_offset(const struct rigid_cells *cells, const int at[3])
{
    size_t offset = 0;
    for (int d = 2; d >= 0; d--)
        offset = offset * cells->size[d] + (size_t)(at[d] + (cells->size[d] > 1 ? cells->pad : 0));
    return offset;
}

/* Has cell number i of the tile a wall, or is it covered in part? */
bool rigid_is_wall(const struct rigid_cells *cells, const struct mesh *mesh, size_t i);

/* Multiplies theta at a time into a value per cell of the tile. Does nothing without bodies. */
void rigid_weigh(const struct mesh *mesh, const struct level *level, const struct tile *tile, double t, double *value);

/* What bodies at a time add to the signals of a level [1/s]: the fastest point of them over each side of a cell. 0
 * without bodies that move. */
double rigid_pace(const struct mesh *mesh, const struct level *level, double t);

/* First failure of a script that says where a body is, or STATUS_OK; its message. */
int rigid_failure(const struct rigid *rigid, const char **ret_message);

#endif
