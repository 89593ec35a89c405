/* hand.h - brings the tiles of new sets to those who will own them.
 *
 * Who makes a piece of a set is who answers for its keys as the curve is cut now (mesh/nest.h); who owns it is said by
 * the new cut (mesh/deal.h), in numbers of tiles. Each rank knows what lies before its pieces, and sends its tiles;
 * those that were there are its own, so that both ends know which blocks move. */
#ifndef HAND_H
#define HAND_H

#include "mesh/deal.h"
#include "mesh/nest.h"

/* What mesh_replace needs of the levels `lowest` to `highest`, of which this rank has made made[l], all ranks
 * n_tile[l], those below it before[l]; cut by `deal`, which one rank does not need. Collective. */
void hand_sets(const struct mesh *mesh, int lowest, int highest, const struct nest_set *made, const long long *n_tile,
               const long long *before, const struct deal *deal, struct mesh_set *ret_sets);

/* From the first keys of all ranks' pieces, UINT64_MAX where they are empty, those of a span: in place. */
void hand_fill(uint64_t *first_keys, int size);

#endif
