/* traction_rate.h - how the normal traction of the solids of a cell answers to a strain.
 *
 * In a mixed cell all materials have the velocity gradient L of the cell, but for a strain x_l n n^T of their own along
 * the normal n of the interface, sum alpha_l x_l = 0. The traction -p_l + s'_l,nn that they share stays common if M_l
 * x_l + rho_l c_l^2 div u + d s'_l,nn/dt (L) = the same for all,    M_l = rho_l c_l^2 + stiff_l, stiff_l the stiffness
 * of s'_nn against a strain along n: 4/3 mu of an unstretched solid, 0 of a fluid. */
#ifndef TRACTION_RATE_H
#define TRACTION_RATE_H

#include "phys/model.h"

#include <stddef.h>

/* What strains n cells, all rows with the same stride: `div`, -div u; `gradient`, [n_velocity * dim] rows of -d_k u_i
 * at i * dim + k, as in elastic.h. */
struct traction_strain {
    const double *div, *gradient;
};

/* Of each material, rows l at l * pitch: stiff_l [Pa], and pull_l = stiff_l (-div u) - (d s'_l,nn/dt)(-L) [Pa/s], which
 * is what the answer of a solid differs by from that of a fluid of the stiffness M_l. 0 for fluids. w: primitives. */
void traction_rate(const struct model *model, size_t n, size_t stride, const double *w,
                   const struct traction_strain *strain, size_t pitch, double *stiff, double *pull);

#endif
