/* bound.h - the states behind the domain's boundaries (model.md 8).
 *
 * Every boundary gives the layers next to a face from the primitives inside, the time and,
 * for non-reflecting and incoming-wave boundaries, the pressure and normal velocity that stood
 * there at the start (kept here per boundary cell). What a type of boundary means to others: case/scene_boundary.h. */
#ifndef BOUND_H
#define BOUND_H

#include "mesh/mesh.h"
#include "phys/model.h"
#include "scheme/frame.h"

struct bound {
    const struct model *model;
    const struct mesh *mesh;
    const struct level *level;
    double t; /* [s] at which time-dependent values are taken; set before each stage */
    unsigned n_local;
    double **reference;           /* [n_local * MESH_FACES]: of the boundary cells p, u outwards and, where waves leave
                                     from a point, u along the other axes; or NULL */
    struct source_value *sources; /* forces, which pressure goes on holding behind a boundary; NULL without */
    int status;                   /* first failure of a script since bound_new */
    char *message;                /* of it; NULL: none */
    char blind[192];              /* of what and where it was: "pressure at (0, 0.1) m, beside cell (0, 3, 0)" */
};

/* For one level; takes the references from the level's primitives w as they are. */
struct bound *bound_new(const struct model *model, const struct mesh *mesh, const struct level *level);

/* For one level; takes the references from the initial condition, so that they are the same for a tile that was
 * there from the start, one that comes later, and after a restart. Tiles with from[local] >= 0 (mesh_change.from;
 * NULL: none) take over those of `before`, which is freed. A script's failure is in bound->status. */
struct bound *bound_paint(const struct model *model, const struct mesh *mesh, const struct level *level,
                          struct bound *before, const int *from);
void bound_free(struct bound *bound);

/* Do waves leave through this face from a point (bound_ray.h)? Not where there are solids: pressure alone does not say
 * what leaves them. */
bool bound_has_rays(const struct model *model, int face);

/* Callback for frame_source: primitives of all fields. `data` is a struct bound. Where a script fails they are NaN. */
void bound_fill(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w);

/* The same at a face with rays: copies of what lies inside, but velocities as viscous stress wants them
 * (bound_ray_flow). */
void bound_fill_flow(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w);

/* Callback for fields that only need a neighbour of the same value (masks): copies. */
void bound_copy(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w);

#endif
