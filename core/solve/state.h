/* state.h - a run in memory: scene, mesh, model, time, and what has been counted.
 *
 * This folder, solve: steps of a level and of all levels, new meshes, the guard, and what is kept of a failure. */
#ifndef STATE_H
#define STATE_H

#include "base/account.h"
#include "case/scene.h"
#include "mesh/mesh.h"
#include "phys/mix_pressure.h"
#include "phys/model.h"

/* Everything the guard did, and the work done, on this rank; state_counts_total sums the ranks. */
struct state_counts {
    /* all but retries and regrids are sums over ranks */
    long long cells;            /* cell-stages advanced */
    long long carried;          /* of these: in resting tiles, which are only copied on */
    long long fallback;         /* cell-steps redone with first-order fluxes */
    long long relaxed;          /* cell-stages whose volume fractions came from pressure relaxation */
    long long clipped;          /* cell-stages with a volume fraction clipped into its range */
    long long retries;          /* steps repeated with half the time step */
    long long regrids;          /* times that a level's tiles changed */
    long long limited;          /* coarse cells whose children got less than the full slopes */
    long long spread;           /* tiles where refluxing was more than one cell could take (spread.h) */
    struct mix_effort closures; /* iterated mixture pressures; `most` over all ranks */
    /* per material, both the same on all ranks (beyond.h): */
    long long outside[SCENE_MATERIALS];      /* cell-steps in which a continuation stood in for its law */
    long long outside_most[SCENE_MATERIALS]; /* most such cells at the end of a step */
    /* per pair of liquid and vapour, likewise: */
    long long past[SCENE_PHASES];      /* cell-steps past the end of the saturation curve (phys/phase_pair.h) */
    long long past_most[SCENE_PHASES]; /* most such cells at the end of a step */
    double regrid_seconds;             /* CPU time of this rank spent on regridding */
};

struct stage;
struct work;

struct state {
    const struct scene *scene;
    struct mesh *mesh;
    struct model *model;
    double t, dt;                  /* time reached and the last step's size [s] */
    double dt_last;                /* size of the step accepted last, of whatever level [s]; 0: none was */
    long step;                     /* steps of level 0 done */
    long level_steps[MESH_LEVELS]; /* steps of each level done: they say when it is time to regrid */
    struct state_counts counts;
    double dt_shrink;            /* 1, or the factor that the start and retries left on the time step */
    double dt_longest;           /* the longest step of level 0 so far [s] */
    double signal;               /* largest sum over axes of (|u_a| + c) / h_a in the present state, of all levels; with
                            subcycling that of level l counts 2^-l [1/s] */
    double signals[MESH_LEVELS]; /* of each level, over all ranks */
    bool whole;                  /* all levels stand at t: false after a step that failed half way */
    struct stage *stages[MESH_LEVELS]; /* work on each level (stage.h); NULL above the finest in use */
    struct work *work;                 /* scratch of this rank */
    struct account
        evaporated[SCENE_PHASES]; /* net mass of each vapour that this rank's tiles have made (evaporate.h) */
    double starved;               /* tiles that a regrid asked for and memory_limit forbids; 0: none */
    long long *tagged;            /* [n_refine] cells that each criterion has tagged on this rank so far */

    /* Who looks at the moments inside a step of level 0 (NULL: nobody): called whenever the levels from `base` on have
     * reached t, with that t. Those below `base` stand at the end of the steps that they have under way. Changes
     * nothing but outputs. Collective. */
    int (*look)(void *data, const struct state *state, int base);
    void *look_data;
};

/* Builds model and mesh of a scene and paints the initial state, with as many levels as it asks for. Collective. */
int state_new(const struct scene *scene, struct state **ret_state);

/* A state to go on from (a checkpoint), read piece by piece. All values as struct state had them after a step. */
struct state_source {
    double t, dt, dt_shrink, dt_longest;
    long step, level_steps[MESH_LEVELS];
    int n_level;
    unsigned n_tile[MESH_LEVELS], first[MESH_LEVELS], n_own[MESH_LEVELS]; /* of all ranks; pieces: partition_equal() */
    const struct tile *tiles[MESH_LEVELS];   /* [n_own] of this rank, in Morton order: at, key, unwanted; copied */
    const uint64_t *first_keys[MESH_LEVELS]; /* [ranks] where their pieces begin (mesh/span.h); copied */
    /* Fills the conserved fields u[n_field][n_cell] of a tile of a level (its place in the list), its pressure
     * p[n_cell], from which iterated closures start, and what outputs keep, kept[n_kept][n_cell] (NULL: nothing).
     * Called for local tiles only. */
    int (*fill)(void *data, int level, unsigned tile, double *u, double *p, double *kept);
    void *data;
};

/* Like state_new, from a source: bitwise the state that was saved, on any number of ranks. Collective. */
int state_resume(const struct scene *scene, const struct state_source *source, struct state **ret_state);
void state_free(struct state *state);

/* Sums of all ranks. Collective. */
struct state_counts state_counts_total(const struct state *state);

#endif
