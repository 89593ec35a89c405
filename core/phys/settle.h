/* settle.h - whose heat it is: mixed cells of solids and fluids in which the solid took or lost energy by itself.
 *
 * A mixed cell has one energy, and the closure finds the one traction at which all materials hold it. What a solid
 * turns into heat (plastic work), and what its elastic energy and the work of its stress miss each other by, would so
 * be shared with the gas beside it: a metal of 300 MPa that flows by 0.1 % gives a gas of 1 bar thrice its energy. Here
 * fluids keep the pressure that is theirs, p_l at strain 0, and all other energy is the solids'. Materials strain by
 * x_l across the interface, n, until the traction is common: p_l + q_l - rho_l c_l^2 x_l - s'_l,nn(x_l) = the same for
 * all,   sum alpha_l x_l = 0, s'_l,nn(x_l) of the stretch that is strained by x_l n n^T, q_l = 0 in fluids and what
 * energy is left in solids. Mass, momentum and total energy stay; fractions and stretches move. Cells of solids or
 * fluids alone keep their bits. */
#ifndef SETTLE_H
#define SETTLE_H

#include "phys/model.h"

#include <stdbool.h>
#include <stddef.h>

/* Fluids that fill less of a cell of solids are traces: they share the strain of the solid and are let be. Behind
 * surfaces that lie as they like more is left (docs/decisions/shells.md). */
static inline double settle_trace(const struct model *model)
{
    return model->n_normal ? 5e-2 : 1e-2;
}

/* Has a path cells of this kind, with solids that flow or relax? */
bool settle_wanted(const struct model *path);

/* Is a cell, whose conserved fields begin at u, one of them? */
bool settle_is(const struct model *model, size_t stride, const double *u);

/* The cells among n that are: their fluids have the pressures p (rows l at l * stride; not looked at for solids),
 * materials the stiffness `stiff` along n (rows likewise) [Pa]. u: conserved fields; the normals are read there. */
void settle_fluids(const struct model *model, size_t n, size_t stride, const double *p, const double *stiff, double *u);

/* flow_return() in the cells that are: the trial stretch, strained by x_l, flows. w: primitives of u; grown: as
 * there. */
void settle_flow(const struct model *model, size_t n, size_t stride, double dt, const double *w, double *u,
                 double *grown);

#endif
