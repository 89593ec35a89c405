/* balance.h - how evenly the ranks share the work of each level: as the weights say that tiles are cut by
 * (regrid_cost()), and as it is seen in CPU time. Of the steps that cost.h samples, so that both are about the same
 * ones. Nothing is decided by it: times differ from run to run, owners do not. */
#ifndef BALANCE_H
#define BALANCE_H

#include "mesh/mesh.h"

struct stage;

/* Sums over the sampled steps of a level, of this rank. */
struct balance_level {
    double predicted; /* weights of its tiles */
    double seen;      /* CPU time but for messages [s] */
};

struct balance {
    struct balance_level level[MESH_LEVELS];
};

/* Notes a sampled step of a level, which took this rank so long without messages [s]. */
void balance_note(struct balance *balance, const struct stage *stage, double seconds);

/* Mean over largest of all ranks, 1 where all have the same; NAN where no step of a level was sampled. Collective. */
void balance_take(const struct balance *balance, struct balance_level ret_share[MESH_LEVELS]);

#endif
