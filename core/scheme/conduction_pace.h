/* conduction_pace.h - the time step that conduction asks for, of what heed.h lets ask. */
#ifndef CONDUCTION_PACE_H
#define CONDUCTION_PACE_H

#include "scheme/term.h"

/* The slot `pace` of the term. */
void conduction_pace_add(const struct term_pace *pace, double *rate);

#endif
