/* equilibrium_search.h - the equilibrium of one cell by its ends and bisection: what cannot fail, for cells in which
 * Newton's method does not converge (equilibrium.c). */
#ifndef EQUILIBRIUM_SEARCH_H
#define EQUILIBRIUM_SEARCH_H

#include "phys/equilibrium_point.h"

/* Masses, p, T and volumes of the equilibrium from those that the point has. Without exchange: p and T at its
 * masses. */
enum equilibrium_regime equilibrium_search(struct equilibrium_point *point);

#endif
