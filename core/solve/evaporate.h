/* evaporate.h - how much liquid has become vapour: the mass that the operators of a step have moved from one phase to
 * the other, in leaves, for `evaporated:` of a history.
 *
 * Each tile notes what its operators have changed in every stage, weighed by what that stage counts for in the whole
 * step (a state that later stages begin from anew leaves nothing). An attempt that is repeated forgets it; a step that
 * is accepted puts it into accounts (base/account.h) that know no order: the same bits on any ranks and after a
 * restart. A scene without such a column notes nothing. */
#ifndef EVAPORATE_H
#define EVAPORATE_H

#include "solve/stage.h"
#include "solve/state.h"

/* Room for the tiles of a level, instead of that of its tiles before. */
void evaporate_renew(struct stage *stage);

/* An attempt begins: nothing has evaporated. */
void evaporate_forget(struct stage *stage);

/* Around the operators on a tile: masses of vapour before, and what has become of them after stage `turn`. */
void evaporate_before(const struct stage *stage, unsigned local, const double *u);
void evaporate_after(struct stage *stage, unsigned local, double t, const double *u);

/* The step counts. */
void evaporate_accept(struct state *state, const struct stage *stage);

/* Net mass that a material, the vapour of a pair, has gained from its liquid since the run began [kg; per metre of
 * depth in 2D, per square metre in 1D]. The same on all ranks. Collective. */
double evaporate_total(const struct state *state, unsigned vapour);

/* The accounts of all ranks in one, carried. Collective. */
struct account evaporate_account(const struct state *state, unsigned pair);

#endif
