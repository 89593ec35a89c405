/* tag_pair.h - cells that differ from a face neighbour of the same level by more than a rule allows. */
#ifndef TAG_PAIR_H
#define TAG_PAIR_H

#include "mesh/halo.h"
#include "mesh/mesh.h"

/* Where pairs are looked for. */
struct tag_pair {
    const struct mesh *mesh;
    const struct level *level;
    const struct halo *halo; /* finished exchange of the values, one component */
    double *step;            /* [n_cell] work space */
};

/* What a difference must exceed. */
struct tag_pair_rule {
    double above[3]; /* per axis */
    bool relative;   /* then in units of the larger magnitude of the pair */
};

/* Least and largest value of a tile. */
struct tag_pair_bounds {
    double least, most;
};

struct tag_pair_bounds tag_pair_bounds_of(size_t n, const double *values);

/* Can no two values within the bounds exceed the rule, along any axis? */
bool tag_pair_is_smooth(const struct tag_pair *pair, const struct tag_pair_rule *rule, struct tag_pair_bounds bounds);

/* Sets need[n_local] for those tiles whose values tag_pair_differ would read for tile `local`. */
void tag_pair_needs(const struct tag_pair *pair, unsigned local, const struct tag_pair_rule *rule,
                    const struct tag_pair_bounds *bounds, bool *need);

/* Adds to found[n_cell] where a cell of local tile `local` differs from one of its neighbours; behind boundaries and
 * coarse-fine faces there are none. values[n_local][n_cell] of the tiles it needs, bounds[n_local] of all. False:
 * nowhere. */
bool tag_pair_differ(const struct tag_pair *pair, unsigned local, const struct tag_pair_rule *rule,
                     double *const *values, const struct tag_pair_bounds *bounds, double *found);

#endif
