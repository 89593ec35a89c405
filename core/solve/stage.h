/* stage.h - what one rank does in a stage of the midpoint rule on one level, tile by tile.
 *
 * The verbs are the stages of the plan: exchange primitives with other ranks; ghosts (what the next
 * finer level sees at the beginning of the step); half (from u to the primitives of the midpoint); full (from u to
 * the new u with the rates at the midpoint); close (new primitives, admissibility, signal speed). This is the page
 * to read first.
 *
 * Three arrays serve both stages: the conserved midpoint u* lives only as long as its tile is
 * worked on; its primitives go to the memory that u_new needs later, and the arrays change names. */
#ifndef STAGE_H
#define STAGE_H

#include "levels/prolong.h"
#include "levels/reflux.h"
#include "phys/mix_pressure.h"
#include "scheme/bound.h"
#include "scheme/face.h"
#include "scheme/source.h"
#include "solve/blame.h"
#include "solve/census.h"
#include "solve/cost.h"
#include "solve/guard.h"

/* Scratch of one rank, used by its levels in turn. */
struct stage_work {
    struct face_work *faces;
    struct face_work *faces_pure;   /* of paths of one material; NULL if the scene has no more */
    struct face_work *faces_fluids; /* of the path of all fluids, or NULL */
    struct prolong *prolong;
    struct source *source;                    /* NULL: the scene has none */
    double *rates, *K, *rho_c2, *c2, *u_star; /* of one tile */
    double *hoop;                             /* likewise, in curved scenes with a solid; else NULL */
    struct cost cost;                         /* where the time goes, of all levels */
};

struct stage_work *stage_work_new(const struct model *model, const struct mesh *mesh);
void stage_work_free(struct stage_work *work);

struct stage {
    const struct model *model;
    struct mesh *mesh;
    int l;
    struct level *level;
    struct stage_work *work;
    struct bound *bound;
    struct guard *guard;
    struct reflux *reflux;
    struct census census;
    int blind;           /* tile whose boundary values a script could not give, times 3 plus the axis; -1: none */
    struct blame *blame; /* a tile being watched while a failed attempt is repeated, and what was seen; or NULL */
    double t, dt;        /* of the step under way */
    double from, part;   /* where it begins in the step of the coarser level, and how much of that it takes */
    double signal;       /* largest of the local tiles */
    bool fluxes;         /* the stage under way makes the step: coarse-fine fluxes are kept */
    long long cells, carried, clipped; /* work done, rank-local */
    struct mix_effort effort;          /* of iterated closures, likewise */
};

struct stage *stage_new(const struct model *model, struct mesh *mesh, int l, struct stage_work *work);
void stage_free(struct stage *stage);

/* After mesh_replace of this level or a neighbour of it: `from` as in mesh_change (NULL: the tiles are the same, only
 * links have changed); `born` (mesh_change, all tiles of the level). Tiles that came from other ranks are counted
 * anew, born ones get their primitives. Not collective. */
void stage_adopt(struct stage *stage, const int *from, const bool *born);

/* Takes the boundary references from the present primitives (tests set states by hand). */
void stage_bind(struct stage *stage);

/* Sends slabs of w (and of the guard's marks) to other ranks. Collective. */
void stage_exchange(struct stage *stage);

/* Waits for the exchange and writes the strips for the next finer level, if there is one. */
void stage_ghosts(struct stage *stage);

/* w = primitives of u* = u_old + dt/2 L(w), boundary values at t; judged as stage 0. Waits for the exchange. */
void stage_half(struct stage *stage);

/* u_new = u_old + dt L(w), boundary values at t + dt/2. Waits for the exchange. */
void stage_full(struct stage *stage);

/* w = primitives of u_new; judged as stage 1, measures the signal speed. */
void stage_close(struct stage *stage);

/* w = primitives of u_old: before the first step and before a step is repeated. */
void stage_reset(struct stage *stage);

/* An initial state in u_old: primitives, judgement without repair, signal. STATUS_CASE: inadmissible. Not collective. */
int stage_start(struct stage *stage);

/* Tile `local` after its u_old was changed from outside (averages, refluxing; u_new holds an earlier admissible
 * state): primitives, the guard's judgement as stage 1, signal. */
void stage_touch(struct stage *stage, unsigned local);

/* The largest signal of the tiles, anew. */
void stage_survey(struct stage *stage);

#endif
