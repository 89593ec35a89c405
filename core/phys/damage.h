/* damage.h - solids break: their damage D grows on batches of points, at constant mass, momentum and total energy.
 *
 * D goes towards the aim of the law (bulla/damage.h) at its rate, at most 1/time: D <- D + min(aim - D, dt min(rate,
 * 1/time)), and never back. The elastic energy of the solid is (1 - D)^2 of what it would be (bearing.h); what D frees
 * of it is heat, as total energy stays. A broken solid, D = 1, bears no shear: it is a fluid of its equation of state,
 * which still bears tension, and its stretch means nothing: where nothing else carries it, it is 1. */
#ifndef DAMAGE_H
#define DAMAGE_H

#include "phys/model.h"

#include <stddef.h>

/* Damage nearer to 1 than this is 1: a millionth of the stress does not matter. */
#define DAMAGE_NEARLY 1e-3

/* n points after dt. w: their primitives, u: conserved fields; grown: what the plastic strain has grown by in dt, NULL
 * where no solid of the path flows. Points at which nothing breaks keep their bits. */
void damage_grow(const struct model *model, size_t n, size_t stride, double dt, const double *w, const double *grown,
                 double *u);

/* The state of a solid at n <= DAMAGE_BATCH points as its law sees it, from primitives: [DAMAGE_ROWS] rows in the order
 * of bulla_damage_state, those that it does not need 0; rows of dt 0 know no rate. */
enum { DAMAGE_BATCH = 128, DAMAGE_ROWS = 9 };
void damage_look(const struct model *model, unsigned s, size_t n, size_t stride, double dt, const double *w,
                 const double *grown, double (*ret)[DAMAGE_BATCH]);

#endif
