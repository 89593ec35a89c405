/* hancock.h - half a step on from the slopes of the cells alone: the first stage of `integrator: hancock`.
 *
 * A stage that is only there to know where the cells will be in the middle of the step need not conserve anything.
 * After Hancock (in van Leer, SIAM J. Sci. Stat. Comput. 5 (1984) 1; Toro 2009, 14.4), but of all axes at once and in
 * primitives, with s_a the difference of the two edges of a cell along axis a (edges.h) over its width, rho c_w^2
 * Wood's stiffness, f forces, and tau half a step: div      = sum_a s_a(u_a)                     in curved geometry
 * along r (A+ u+ - A- u-)/V alpha_l* = [alpha_l - tau sum_a u_a s_a(alpha_l)] (1 + y/(1 + |y|)),  y = tau div (rho
 * c_w^2/(rho_l c_l^2) - 1) rho_l*   = [rho_l   - tau sum_a u_a s_a(rho_l)]   (1 + x/(1 + |x|)),  x = -tau div rho
 * c_w^2/(rho_l c_l^2) u*       = u - tau [sum_a u_a s_a(u) + s(p)/rho - f/rho],   p* = p - tau [sum_a u_a s_a(p) + rho
 * c_w^2 div] then alpha* in 0 to 1, without traces, at sum 1. No edge is completed, there is no Riemann problem and no
 * pressure is looked for. Where p and u are uniform they stay so; what is not there does not come. A cell whose state
 * would not be admissible keeps the one that it has. What acts at faces alone (shock-fronts, low-mach, mixture-speed)
 * and the exchange of volume (exchange.h) wait for the second stage.
 *
 * A jump of the initial state has no slope, so nothing here would move it, and a strong one at a surface goes wrong for
 * good: the first HANCOCK_AFTER steps of a level have the half stage of the midpoint rule (docs/decisions/hancock.md).
 * So have steps that are repeated because of troubled cells. */
#ifndef HANCOCK_H
#define HANCOCK_H

#include "scheme/rate.h"

enum { HANCOCK_AFTER = 8 };

struct hancock;

/* Memory for one tile at a time of a scene of fluids. */
struct hancock *hancock_new(const struct model *model, const struct mesh *mesh);
void hancock_free(struct hancock *hancock); /* NULL is fine */

/* w_new = primitives of a tile after tile->dt, active components alone. Writes tile->rates and tile->rho_c2. */
void hancock_take(struct hancock *hancock, struct term_tile *tile, void *const *own, const struct rate_watch *watch,
                  double *w_new);

#endif
