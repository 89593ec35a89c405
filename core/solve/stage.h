/* stage.h - what one rank does in a stage of the midpoint rule, tile by tile.
 *
 * The verbs are the stages of the plan: exchange primitives with other ranks; half (from u to the
 * primitives of the midpoint); full (from u to the new u with the rates at the midpoint); close (new
 * primitives, admissibility, signal speed). This is the page to read first.
 *
 * Three arrays serve both stages: the conserved midpoint u* lives only as long as its tile is
 * worked on; its primitives go to the memory that u_new needs later, and the arrays change names. */
#ifndef STAGE_H
#define STAGE_H

#include "phys/bound.h"
#include "phys/face.h"
#include "solve/guard.h"

struct stage {
    const struct model *model;
    struct mesh *mesh;
    struct level *level;
    struct bound *bound;
    struct guard *guard;
    struct face_work *faces;
    /* Tiles that hold one material only, with neighbours that hold the same, are advanced without the others:
     * half the work or less, bitwise the same result. */
    struct face_work *faces_pure;     /* NULL for one material */
    unsigned *present, *present_next; /* [n_local] bit l: material l is in the tile now; after this stage */
    unsigned *streak; /* [n_local] stages in a row that a tile was pure, up to 3: then the fractions of all three
                         arrays are in place */
    /* Tiles that are uniform and at rest, with neighbours in the same state, have a rate of exactly zero: they are
     * copied on. */
    bool *still, *still_next, *skipped;       /* [n_local] uniform and at rest now; after this stage; copied in it */
    double *tile_signal;                      /* [n_local] the signal of each tile at the last close */
    const struct model **path;                /* [n_local] the model each tile was last advanced with */
    double *rates, *K, *rho_c2, *c2, *u_star; /* of one tile */
    double t, dt;                             /* of the step under way */
    double signal; /* largest sum over axes of (|u_a| + c) / h_a [1/s], rank-local, of the last close */
    long long cells, carried, clipped; /* work done, rank-local */
};

struct stage *stage_new(const struct model *model, struct mesh *mesh, struct level *level);
void stage_free(struct stage *stage);

/* Takes the boundary references from the present primitives (once, after the first close). */
void stage_bind(struct stage *stage);

/* Sends slabs of w (and of the guard's marks) to other ranks. Collective. */
void stage_exchange(struct stage *stage);

/* w = primitives of u* = u_old + dt/2 L(w), boundary values at t; judged as stage 0. Waits for the exchange. */
void stage_half(struct stage *stage);

/* u_new = u_old + dt L(w), boundary values at t + dt/2. Waits for the exchange. */
void stage_full(struct stage *stage);

/* w = primitives of u_new; judged as stage 1, measures the signal speed. */
void stage_close(struct stage *stage);

/* w = primitives of u_old: before the first step and before a step is repeated. */
void stage_reset(struct stage *stage);

#endif
