/* sets.h - tile sets around geometric features, for the partition study.
 *
 * An octant is wished for where its box, widened by the buffer, meets a feature: what nest_wish makes of tags on
 * that feature, without the cells. The sets themselves are made by nest_sets from all levels' wishes. */
#ifndef SETS_H
#define SETS_H

#include "mesh/mesh.h"
#include "mesh/nest.h"

enum { SETS_FEATURES = 3, SETS_BUFFER = 4 };

struct sets_feature {
    enum { SETS_SHELL, SETS_BALL, SETS_PLANE } kind; /* surface of a sphere, its inside, a plane x = radius */
    double centre[3], radius;
    int finest; /* level that it asks for */
    bool mixed; /* cells on it hold two materials */
};

struct sets_scene {
    const char *name;
    int dim, n; /* cells of a tile per axis */
    int base;   /* tiles of level 0 per axis, over [0, 2]^dim */
    int levels; /* above level 0 */
    int n_feature;
    struct sets_feature features[SETS_FEATURES];
};

/* A mesh without blocks that holds the scene's sets; level_drop frees its levels. */
void sets_make(const struct sets_scene *scene, struct mesh *ret_mesh);

/* The wishes for level l, sorted. */
struct nest_keys sets_wishes(const struct sets_scene *scene, const struct mesh *mesh, int l);

/* Costs of the tiles of a level: 1, or 2.4 where materials mix; 0.05 of that where a tile is hidden. */
double *sets_costs(const struct sets_scene *scene, const struct mesh *mesh, int l);

#endif
