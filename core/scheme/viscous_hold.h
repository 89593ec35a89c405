/* viscous_hold.h - what the cells around a corner hold of what is viscous, and what each of them counts there.
 *
 * The cells around a corner have one bit per axis: 0 below it, 1 above. Pairs across an axis have those of the other
 * axes. Rows are of n corners, packed (phys/pick.h). */
#ifndef VISCOUS_HOLD_H
#define VISCOUS_HOLD_H

#include "scheme/viscous_slopes.h"

enum { HOLD_PAIRS = 4, HOLD_CORNERS = 8 };

struct viscous_hold {
    double mu[HOLD_CORNERS][STRAIN_POINTS];    /* sum alpha_l mu_l of a cell [Pa s] */
    double film[HOLD_CORNERS][STRAIN_POINTS];  /* that, less 1/(sum alpha_l/mu_l); 0 of one material alone */
    double alone[HOLD_CORNERS][STRAIN_POINTS]; /* 1 + the number of the only material; 0: a mixture */
};

/* The lower cell of pair p across an axis; the upper one has that bit, too. */
static inline unsigned viscous_hold_low(unsigned p, int axis)
{
    return (p & ((1u << axis) - 1u)) | (p >> axis << (axis + 1));
}

/* The fraction of material l of the scene in the cells `around` behind the cells `at` of the patch: not below 0, also
 * where those of three that a coarser level gives sum to more than 1. */
void viscous_hold_fraction(const struct viscous_slopes *slopes, size_t n, const unsigned *at, size_t around, unsigned l,
                           double *alpha);

/* Cell c of n corners, `around` behind the cells `at` of the patch. mu: a row for each material of the path. */
void viscous_hold_make(const struct viscous_slopes *slopes, size_t n, const unsigned *at, size_t around,
                       const double *const *mu, unsigned c, struct viscous_hold *ret);

/* Weights of the pairs across an axis: by what the emptier cell of each holds, 1 in sum. Where that is little beside
 * the fullest cell of them, no pair can bear the stress, and all have less. Two cells of one material alone: 0. */
void viscous_hold_weigh(const struct viscous_hold *hold, size_t n, int axis, unsigned pairs,
                        double (*weight)[STRAIN_POINTS]);

/* Weights of the cells, at most 4: by what they hold, those of one material alone 0. hold NULL: all alike. */
void viscous_hold_ring(const struct viscous_hold *hold, size_t n, unsigned corners, double (*weight)[STRAIN_POINTS]);

#endif
