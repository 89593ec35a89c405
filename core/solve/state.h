/* state.h - a run in memory: scene, mesh, model, time, and what has been counted. */
#ifndef STATE_H
#define STATE_H

#include "case/scene.h"
#include "mesh/mesh.h"
#include "phys/model.h"

/* Everything the guard did, and the work done, on this rank; state_counts_total sums the ranks. */
struct state_counts {
    long long cells;    /* cell-stages advanced */
    long long carried;  /* of these: in resting tiles, which are only copied on */
    long long fallback; /* cell-steps redone with first-order fluxes */
    long long relaxed;  /* cell-stages whose volume fractions came from pressure relaxation */
    long long clipped;  /* cell-stages with a volume fraction clipped into its range */
    long long retries;  /* steps repeated with half the time step */
};

struct stage;

struct state {
    const struct scene *scene;
    struct mesh *mesh;
    struct model *model;
    double t, dt; /* time reached and the last step's size [s] */
    long step;    /* steps done */
    struct state_counts counts;
    double dt_shrink;    /* 1, or the factor that retries left on the time step */
    double signal;       /* largest sum over axes of (|u_a| + c) / h_a in the present state [1/s] */
    struct stage *stage; /* work space of this rank (stage.h) */
};

/* Builds model and mesh of a scene and paints the initial state. Collective. */
int state_new(const struct scene *scene, struct state **ret_state);
void state_free(struct state *state);

/* Sums of all ranks. Collective. */
struct state_counts state_counts_total(const struct state *state);

#endif
