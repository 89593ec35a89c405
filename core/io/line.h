/* line.h - where a material ends on the axis: the position behind `penetration`. */
#ifndef LINE_H
#define LINE_H

#include "solve/state.h"

/* Position [m] along `axis` where the volume fraction of a material is 0.5, linear between the centres of leaves.
 * The line runs through the cells next to an axis or symmetry boundary, else through the middle of
 * the domain. Of several such places: the end of the piece of material that touches an end of the
 * line (the lower one, if both do), else the lowest place. NaN if there is none. *ret_into:
 * which way the material lies from there, 1 (up the axis) or -1. Collective. */
double line_crossing(const struct state *state, unsigned material, int axis, int *ret_into);

#endif
