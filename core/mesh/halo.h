/* halo.h - slabs of cells from tiles on other ranks.
 *
 * A slab is the mesh's ghosts layers next to a face, of all fields: [n_field][outer][ghosts][inner],
 * where inner and outer are the products of the tile's extents before and after the axis.
 * Both sides derive the list of slabs from what they know of each other's tiles; there is one message per
 * pair of ranks, with persistent requests made once per topology. */
#ifndef HALO_H
#define HALO_H

#include "mesh/mesh.h"

struct halo;

/* Plan and buffers for arrays of `n_field` components per cell on a level. Collective. */
struct halo *halo_new(const struct mesh *mesh, const struct level *level, unsigned n_field);
void halo_free(struct halo *halo);

/* Packs and sends the slabs of `arrays` ([n_local] tiles, [n_field][n_cell] each) that other ranks need, and
 * starts receiving. halo_finish waits; only then may halo_slab be read. Collective. */
void halo_start(struct halo *halo, double *const *arrays);
void halo_finish(struct halo *halo);

/* The received slab `index` (struct neighbour). */
const double *halo_slab(const struct halo *halo, unsigned index);

/* Does this local tile touch another rank (its frames must wait for halo_finish)? */
bool halo_is_remote(const struct level *level, unsigned local);

#endif
