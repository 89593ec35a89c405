/* stage.h - what one rank does in a stage of the integrator on one level, tile by tile.
 *
 * The verbs are steps of the plan: take (from the state to that of the next stage, with the rates of all terms); close
 * (new primitives, admissibility, signal speed). What travels between them is in stage_exchange.h, what a tile that is
 * not computed keeps in keep.h. This is the page to read first.
 *
 * Three arrays serve all stages: the conserved fields of a stage live only as long as its tile is worked on; its
 * primitives go to the memory that u_new needs later, and the arrays change names. An integrator that goes on from a
 * stage's conserved fields has a fourth. */
#ifndef STAGE_H
#define STAGE_H

#include "levels/reflux.h"
#include "phys/mix_pressure.h"
#include "scheme/bound.h"
#include "solve/blame.h"
#include "solve/census.h"
#include "solve/guard.h"
#include "solve/tableau.h"
#include "solve/work.h"

struct rkl;

struct stage {
    const struct model *model;
    const struct tableau *tableau;
    struct mesh *mesh;
    int l;
    struct level *level;
    struct work *work;
    struct bound *bound;
    struct guard *guard;
    struct reflux *reflux;
    struct census census;
    double *previous; /* [n_local][n_field][n_cell]: conserved fields of the stage before (tableau_keeps), or NULL */
    unsigned char *shore;        /* [n_local][shore_marks]: of the stage under way (scheme/shore.h), or NULL */
    double *evaporated;          /* masses that change phase in the step under way (evaporate.h), or NULL */
    struct operator_fault fault; /* of the attempt under way */
    double at;       /* when its rates are taken, in dt: set by who runs the plan, and by stages within it (rkl.h) */
    int turn;        /* stage under way: its row of the tableau, set by who runs the plan */
    int blind;       /* tile whose boundary values a script could not give, times 3 plus the axis; -1: none */
    struct rkl *rkl; /* what diffuses takes super steps, or NULL */
    struct blame *blame; /* a tile being watched while a failed attempt is repeated, and what was seen; or NULL */
    double t, dt;        /* of the step under way */
    double from, part;   /* where it begins in the step of the coarser level, and how much of that it takes */
    long steps;          /* that the level took before the one under way */
    double signal;       /* largest of the local tiles */
    long long cells, carried, clipped; /* work done, rank-local */
    struct mix_effort effort;          /* of iterated closures, likewise */
};

struct stage *stage_new(const struct model *model, struct mesh *mesh, int l, struct work *work);
void stage_free(struct stage *stage);

/* Stage `turn`, in all tiles; waits for the exchange. Of all but the last w becomes the primitives of what
 * it made, judged as that stage; the last one leaves u_new. */
void stage_take(struct stage *stage);

/* w = primitives of u_new; judged as the last stage, measures the signal speed. */
void stage_close(struct stage *stage);

/* One tile while its rates are taken. */
struct stage_tile_work {
    struct term_tile tile;
    struct metric metric;
};

/* Rates of the terms of `part` of a tile on its path, into work->rates; dt: what ret->tile says of it; counts: its
 * fluxes count in registers. ret stays valid until the next call. */
void stage_rates(struct stage *stage, unsigned local, enum term_part part, double dt, bool counts,
                 struct stage_tile_work *ret);

/* Marks of a tile, made with its rates: where liquids of its path end (scheme/shore.h). NULL: no pair asks. */
unsigned char *stage_shore(const struct stage *stage, unsigned local);

/* `work` for all tiles, at stage->at; those that need the exchange under way when it is finished. */
void stage_tiles(struct stage *stage, void (*work)(struct stage *stage, unsigned local));

static inline const struct tile *stage_tile(const struct stage *stage, unsigned local)
{
    return &stage->level->tiles[stage->level->first + local];
}

#endif
