/* around.h - what terms see across edges and corners of the tiles of a level: gathering, messages, the coarser level.
 *
 * Of a scene with such terms (model->n_around) the chosen components of the primitives, one layer around every tile.
 * They are sent with the layers of the frames and waited for with them; what lies on the coarser level is linear in
 * time between the ends of its step, as in strips. Characteristic boundaries are copies here: what they compose of
 * invariants is no state whose gradients mean anything; inflows and moving walls are what they give. */
#ifndef AROUND_H
#define AROUND_H

#include "phys/model.h"
#include "scheme/bound.h"

struct around;

/* NULL: no term of the scene looks across edges. */
struct around *around_new(const struct model *model, const struct mesh *mesh);
void around_free(struct around *around);

/* Starts the exchange of the primitives of a level, and waits for it. `bound`: of the level, its time set.
 * Collective. */
void around_start(struct around *around, int l, struct bound *bound);
void around_finish(struct around *around, int l, struct bound *bound);

/* What the next finer level sees of this one, whose exchange is finished: slot 0 at the beginning of its step, 1 at its
 * end. Not collective. */
void around_finer(struct around *around, int l, struct bound *bound, int slot);

/* Sends both slots to the finer level l. Collective. */
void around_down(const struct around *around, int l);

/* Does what lies around a tile come from another rank? */
bool around_is_remote(const struct around *around, int l, unsigned local);

/* The block of a local tile, as term_tile.around; good until the next call. */
const double *around_gather(struct around *around, int l, struct bound *bound, unsigned local);

/* Local tiles across edges and corners of a tile: how many there are, and which; -1 if some lie elsewhere. Behind
 * boundaries there are none. */
int around_diagonal(const struct around *around, int l, unsigned local, unsigned ret_tiles[static 26]);

#endif
