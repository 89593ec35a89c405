/* blend.h - ghosts on a coarser level between the beginning and the end of its step (frame.c, patch.c). */
#ifndef BLEND_H
#define BLEND_H

#include <stddef.h>

/* A row between the values at the beginning and at the end of the coarse step. */
static inline void blend_row(size_t n, double theta, const double *restrict begin, const double *restrict end,
                             double *restrict target)
{
    for (size_t i = 0; i < n; i++) target[i] = begin[i] + theta * (end[i] - begin[i]); /* equal values stay */
}

/* The same for the density of a material that moves in or out meanwhile: alpha and alpha rho are linear in time. A
 * density that belongs to a trace alone does not meet the fraction of the other end. */
static inline void blend_density(size_t n, double theta, const double *restrict begin, const double *restrict end,
                                 const double *restrict alpha_begin, const double *restrict alpha_end,
                                 double *restrict target)
{
    for (size_t i = 0; i < n; i++) {
        double late = theta * alpha_end[i], all = (1.0 - theta) * alpha_begin[i] + late;
        target[i] = begin[i] + (all > 0.0 ? late / all : theta) * (end[i] - begin[i]);
    }
}

#endif
