/* restrict.h - from a level to the next coarser one: volume averages of the conserved fields.
 *
 * Children are added in an order that mirrors and exchanges of axes leave unchanged (diagonal pairs),
 * so that symmetric states stay symmetric to the bit; in curved geometry weighted by exact volumes, with their lever
 * for what turns. */
#ifndef RESTRICT_H
#define RESTRICT_H

#include "mesh/link.h"

/* Averages of the local tiles of level l >= 1 (their u_old) whose coarse tile sleeps `depth` levels deep (0: does not):
 * into the link's `children`, or where the coarse tile is local straight into its u_old. Not collective; then link_up,
 * or link_up_late, then restrict_take. */
void restrict_averages(const struct mesh *mesh, int l, int depth);

/* Such averages that came from other ranks (the link's `octants`), into u_old of local tiles of level l - 1. */
void restrict_take(const struct mesh *mesh, int l, int depth);

/* All that for tiles of level l - 1 that sleep, depth > 0. Collective. */
void restrict_late(const struct mesh *mesh, int l, int depth);

/* Mean over the sub-faces of a fine tile's face, of the flux of field q: fine[n^(d-1)] -> coarse[(n/2)^(d-1)], lower
 * axes fastest, weighted by area (axis 0 of curved geometry is no tangent of faces normal to it). */
void restrict_face(const struct mesh *mesh, const struct level *level, const struct tile *tile, int axis, unsigned q,
                   const double *fine, double *ret_coarse);

#endif
