/* convection.h - the conserved fields through the faces: d u/dt = -div F, masses, momentum and total energy. */
#ifndef CONVECTION_H
#define CONVECTION_H

#include "scheme/term.h"

/* Owns one row where something moves with the flow without being conserved: -div u*. */
extern const struct term convection_term;

#endif
