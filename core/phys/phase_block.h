/* phase_block.h - the cells of a tile in which a pair may act (phase.h): gathered, with what the solver wants to know
 * of them, those that stay moved up, and the answers put back.
 *
 * Components and materials are rows of the cells of a block. Traces that fluxes do not see are left out. */
#ifndef PHASE_BLOCK_H
#define PHASE_BLOCK_H

#include "phys/equilibrium.h"

typedef double phase_block_row[EQUILIBRIUM_BLOCK];

/* Cells that may act. */
struct phase_block {
    const struct model *model;
    const struct model_phase *phase;
    const unsigned char *shore; /* of the tile, or NULL */
    struct equilibrium_family family;
    double h; /* size of the cells [m] */
    size_t n;
    size_t at[EQUILIBRIUM_BLOCK]; /* place in the tile */
    phase_block_row u[MODEL_FIELDS], w[MODEL_FIELDS], T[SCENE_MATERIALS], blur;
    phase_block_row slow;            /* 1/c of sound in the mixture (Wood) [s/m], for pairs that condense over cells */
    bool warm[EQUILIBRIUM_BLOCK];    /* temperatures fit */
    bool thermal[EQUILIBRIUM_BLOCK]; /* no exchange: beyond the end of the curve, or held */
    bool alone[EQUILIBRIUM_BLOCK];   /* liquid without vapour, which has to nucleate */
    bool left[EQUILIBRIUM_BLOCK];    /* the liquid has taken volume that had no vapour left */
    struct equilibrium_cells cells, start;
    int status; /* of scripts */
};

/* The materials of a pair that share a temperature, as the solver wants them. */
void phase_block_family(const struct model *model, const struct model_phase *phase, struct equilibrium_family *ret);

/* Fills u, w and left from cells `at` of a tile whose components lie at q * stride. */
void phase_block_gather(struct phase_block *block, size_t stride, const double *u, const double *w);

/* Fills T, blur, slow and the cells of the solver: masses, volumes, temperatures and energy of the family, and the
 * others. */
void phase_block_fill(struct phase_block *block);

/* Cell i, of which the liquid has taken what the vapour had left, into the tile, before it is judged. */
void phase_block_settle(const struct phase_block *block, size_t i, size_t stride, double *w, double *u);

/* Cell i takes place `to`. */
void phase_block_move(struct phase_block *block, size_t i, size_t to);

/* The answer for cell i into the tile: masses of liquid and vapour, all fractions, pressure; nothing if there is none,
 * if it is what was there, or a bubble that would not be felt. */
void phase_block_scatter(const struct phase_block *block, size_t i, size_t stride, double *w, double *u);

#endif
