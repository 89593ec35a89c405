/* derive.h - named fields of a state, for snapshots, probes, histories and pictures.
 *
 * This folder, derive: named fields made of the primitives, for everything that people or criteria look at. */
#ifndef DERIVE_H
#define DERIVE_H

#include "mesh/mesh.h"
#include "phys/model.h"

struct derive {
    char name[SCENE_NAME];
    const char *unit;    /* SI, "1" for pure numbers */
    unsigned components; /* 1, or 3 for velocity and vorticity (always three: unused ones are 0) */
    int what, index;     /* how derive.c finds it again: quantity and material or axis */
    double scale;        /* set by derive_prepare where the field needs a global value (schlieren, temperature_M) */
    double scales[SCRIPT_ARGUMENTS]; /* of an expression: those of its arguments */
};

/* Looks a name up. Unknown: STATUS_CASE, the message lists the nearest. Component names
 * (velocity_x) are fields of one component. */
int derive_find(const struct model *model, const char *name, struct derive *ret_field);

/* The material of a field that says nothing where the material is absent, so that between cells it counts with the
 * volume fraction; -1: other fields. It is 0 there: density_M where there is none at all, temperature_M where the
 * material is not felt (presence.h). */
int derive_material(const struct derive *field);

/* NULL-terminated list of all names this scene offers; valid as long as the model. */
const char *const *derive_names(const struct model *model);

/* A moment at which fields are looked at: what has been brought for one of them is there for all. It is over as soon as
 * any primitive changes; then a new one is begun. */
struct derive_moment {
    const struct model *model;
    const struct mesh *mesh;
    double t;
    int base; /* the coarsest level that stands at t: a coarser one may be in the middle of its step (solve/regrid.c) */
    unsigned exchanges; /* times that the layers of neighbours were brought: 0 or 1 */
    bool has_around;    /* edges and corners of tiles are there too */
    bool has_steepest, has_presence[SCENE_MATERIALS];
    double steepest, presence[SCENE_MATERIALS]; /* global values, once somebody has asked */
};

/* Begins one; nothing to release. */
struct derive_moment derive_moment(const struct model *model, const struct mesh *mesh, double t);

/* Before tiles are derived: brings what the field needs and the moment does not have yet. Collective. */
void derive_prepare(struct derive_moment *moment, struct derive *field);

/* Values in the cells of a local tile of any level: out[component][cell], cells x fastest; under finer tiles those
 * of the averages. Gradients are central differences; beside a coarser level they see what the solver sees there
 * (prolong.h). Not collective (after a completed step and derive_prepare all neighbour data is at hand). */
void derive_tile(const struct model *model, const struct mesh *mesh, int level, unsigned local, double t,
                 const struct derive *field, double *out);

#endif
