/* conduction_pace.h - the time step that conduction asks for, and what asks for it (conduction_channel.h). */
#ifndef CONDUCTION_PACE_H
#define CONDUCTION_PACE_H

#include "scheme/term.h"

/* Density of n cells with primitives w: that of the only material, or made in room[n]. */
const double *conduction_pace_density(const struct model *path, size_t n, size_t stride, const double *w, double *room);

/* The slot `pace` of the term. */
void conduction_pace_add(const struct term_pace *pace, double *rate);

#endif
