/* guard.h - is a state admissible, and what is done when it is not.
 *
 * First, a mixed cell whose energy and fractions contradict each other is softened (phys/soft.h).
 * Admissible: everything finite, rho > 0, no partial density below round-off, every present
 * material well-posed at its pressure (c_l^2 > 0). A mixed cell that fails gets its volume
 * fractions from pressure relaxation (phys/relax.h). The ladder for a step that still leaves
 * an inadmissible cell: redo the step with first-order states and the robust solver at the faces
 * of the troubled cells (conservative: both sides see the same flux), at most GUARD_ROUNDS times;
 * then halve the time step, at most GUARD_RETRIES times, the last time as one explicit step (tableau.h);
 * then stop with the place and the cause.
 * Cells under finer tiles are not judged: one that fails and cannot be repaired keeps the state from before the step
 * until the next average of the finer level. Nothing is floored. (MOOD: Clain, Diot & Loubere 2011; retry as in
 * Castro.) */
#ifndef GUARD_H
#define GUARD_H

#include "mesh/mesh.h"
#include "phys/model.h"
#include "solve/tableau.h"

enum { GUARD_ROUNDS = 3, GUARD_RETRIES = 6, GUARD_WORDS = 1024 };

/* A partial density this far below zero, relative to rho or to the material's own density, is what two stages leave
 * behind a front of traces (the midpoint rule keeps no sign); the material counts as absent there. */
#define GUARD_ROUND_OFF 1e-8

/* Present enough that its state matters: below it a material rides along. */
#define GUARD_PRESENT 1e-6

/* The first bad cell of an attempt: in the tile that comes first in the list, whatever the order of work. */
struct guard_place {
    unsigned local;
    int stage,
        pure; /* stage: of the tableau, or as in blame.h; pure: model_number of the path the tile was advanced with */
    size_t cell;
    char field[SCENE_NAME + 32]; /* which field is wrong */
    double value;
    char words[GUARD_WORDS]; /* as `cause`, but kept when the next attempt begins */
};

struct guard {
    const struct model *model;
    const struct mesh *mesh;
    const struct level *level;
    int l; /* its number, for messages */
    unsigned n_local;
    double **mask;         /* [n_local][n_cell]: 1 in troubled cells of this step; NULL until a run has had one */
    unsigned char **fresh; /* likewise: 1 + the stage that found it bad in this attempt. No mask until the attempt is
                              over: which tiles come before it in a stage must not matter */
    bool marked;           /* masks are there and may hold marks */
    struct halo *halo;     /* exchange of the masks */
    bool masked;           /* some cell of some rank is marked */
    bool repair;           /* relaxation is allowed (several materials, guard not strict) */
    long long relaxed;     /* cells repaired in the present attempt */
    long long bad[TABLEAU_STAGES]; /* inadmissible cells found after each stage of the present attempt */
    char cause[GUARD_WORDS];       /* the first of them, in words (rank-local) */
    struct guard_place found;      /* and in numbers; only valid after something was found */
    bool last; /* no attempt follows that would use marks: none are made, so that this one can be repeated as it was */
    double debt;  /* so far below zero a partial density may be: GUARD_ROUND_OFF, or more in sync.c */
    double *kept; /* [2][n_field][n_cell]: u and w of the tile of `found` as they came to be judged */
};

/* Of level l, for steps of any integrator: the last try of a step has one of its own (advance.c). */
struct guard *guard_new(const struct model *model, const struct mesh *mesh, int l);
void guard_free(struct guard *guard);

enum { GUARD_WHERE = 256 };

/* "the cell at (x, y, z) m of level 2 (cell (i, j, k) of tile (I, J, K))". */
void guard_where(const struct guard *guard, unsigned local, size_t cell, char ret_text[GUARD_WHERE]);

/* Forgets marks (a new step or a smaller time step). */
void guard_clear(struct guard *guard);

/* Starts an attempt: forgets what was found, keeps the marks. */
void guard_attempt(struct guard *guard);

/* A tile that has been closed: blocks of n_cell. u_old is the state at the start of the step. */
struct guard_tile {
    const struct model *model; /* the guard's, or the pure model the tile was advanced with */
    unsigned local;
    int stage; /* of the integrator, from 0 */
    const double *u_old;
    const double *p_before; /* pressures before the stage, of cells that may be softened (phys/soft.h); or NULL */
    double *u, *w;          /* conserved and primitives now; the fractions of repaired cells change */
    double *rho_c2, *c2;    /* rho_l c_l^2 and frozen c^2 (mix_stiffness), likewise */
};

/* Checks a tile; repairs, notes and marks bad leaf cells; after a bad stage the later ones are not judged. */
void guard_check(struct guard *guard, const struct guard_tile *tile);

/* After an attempt with bad cells, on all ranks: `first` is the first stage in which any rank found one; what others
 * found in later ones is forgotten, so that marks do not depend on the ranks. */
void guard_settle(struct guard *guard, int first);

/* Bad cells of this attempt, of all stages. */
long long guard_bad(const struct guard *guard);

#endif
