/* operator.h - what acts on a state beside the rates of the terms: after every stage, after the step, or between the
 * stages.
 *
 * A term (term.h) says how fast a state changes; an operator changes it at once, cell by cell: plastic flow that puts a
 * stretch back on its yield surface, a reaction, a relaxation. Where it stands in the step:
 *     every stage:  rates, the new conserved fields; OPERATOR_STAGE; primitives, the guard
 *     all but the last: OPERATOR_STAGE, OPERATOR_BETWEEN
 *     the last one: rates, the new conserved fields; OPERATOR_STAGE, OPERATOR_STEP; primitives, the guard, the signal
 * It acts on what the attempt makes, never on the state that the step began with: an attempt that is repeated or
 * halved begins again from that, so what an operator did is undone with everything else, to the bit. Each level calls
 * it with its own steps; averages of finer levels and refluxing come later, and do not call it.
 *
 * An operator sees one cell at a time: no neighbours, no other tiles, but for what the stage has marked of them
 * (shore.h). So numbers depend neither on ranks nor on the order of tiles. Mass, momentum and energy stay conserved if
 * it conserves them in a cell. docs/extending.md adds one. */
#ifndef OPERATOR_H
#define OPERATOR_H

#include "base/text.h"
#include "mesh/metric.h"
#include "phys/model.h"

enum operator_when { OPERATOR_STAGE, OPERATOR_BETWEEN, OPERATOR_STEP, OPERATOR_TIMES };

/* The first failure of a script that an operator asked. */
struct operator_fault {
    int status;
    char message[512];
};

/* One tile whose new state stands. Blocks are [rows][n_cell]; only the active fields of `model` mean anything. */
struct operator_tile {
    const struct model *model; /* the path that the tile was advanced with */
    const struct mesh *mesh;
    const struct level *level;
    const struct tile *tile;
    size_t n_cell;
    double t;             /* of the state [s] */
    double dt;            /* that it has gone through since the step began [s] */
    double *u;            /* conserved fields, which it may change */
    double *w;            /* primitives of u, for operators that ask for them; core makes them anew afterwards */
    const double *before; /* [n_cell] the pressures that stand in w before any operator acts */
    double *grown; /* [n_solid][n_cell] what plastic strains have grown by in this step: from plastic.c to rupture.c; or
                      NULL */
    const unsigned char *shore;   /* [n_phase][n_cell] where liquids end (shore.h); NULL: no pair of the scene asks */
    struct operator_fault *fault; /* for who asks scripts: the step is not taken. NULL: nobody looks */
};

struct operator
{
    const char *name;
    const char *owner;    /* the file it lives in */
    const char *equation; /* one line for people */
    enum operator_when when;

    bool (*wanted)(const struct model *path); /* has a path of a scene this operator? NULL: every path */
    bool moves; /* may it change what is uniform and at rest? Then no tile of a path that has it is skipped */

    /* What may bring a material to tiles of a path without it: `spreads`, then no tile is narrowed to that path; or
     * `waits`, then `wakes` is asked whether it would change one of n cells with primitives w at q * stride, in which
     * case the scene's model takes the path's place. NULL: no. */
    bool (*spreads)(const struct model *path);
    bool (*waits)(const struct model *path);
    bool (*wakes)(const struct model *path, size_t n, size_t stride, const double *w);

    bool (*reads)(const struct model *path); /* does it read w there? NULL: no */

    void (*acts)(const struct operator_tile *tile);
    void (*say)(const struct scene *scene, struct text *text); /* what the scene asks of it, for the plan; or NULL */
};

#endif
