/* exchange.h - volume that moves between the materials of a cell because its faces brought unlike pressures.
 *
 * K div u (closure.h) keeps the materials at one pressure while a cell is compressed. Two more things drive their
 * pressures apart, both at the faces that fluid enters through: it comes from a cell of another
 * pressure, and it was compressed on the way to the face with its fractions frozen (that is what
 * the frozen speed in the Riemann solver means). Linearised relaxation, as in K, brings them together,
 *   d alpha_l = e_l - s_l/S sum_k e_k,   s_l = alpha_l/(rho_l c_l^2),   S = sum s_l,
 *   e_l = dt/V sum_faces A (alpha* u*) [ (p_K - p)/(rho_l c_l^2) + strain_K ],
 * with K the side upwind. Without it the linearised scheme is unstable in a mixture that moves fast
 * against Wood's speed, |u| c_f > 4 c_w^2 (1 - q)/q^2 with q = c_A^2/c_f^2 and rho c_A^2 = (rho e + p)/
 * (d rho e/dp): round-off grows in a gas-liquid front at uniform p and u (docs/decisions). In slower
 * flow mechanics gain nothing from it, so it is made with the weight f = r^2/(r^2 + EXCHANGE_FAST^2), r = |u|
 * c_f/c_w^2. Temperatures do: what a material brings from a higher pressure and does not give back is density that its
 * own isentrope has not, and of water near 4 C 0.1 % of that is 7 K. In thermal models (model.h) the weight is
 * therefore f + (1 - f)/(1 + (X/EXCHANGE_STEEP)^4),   |u| X/h = |sum_l sum_faces A (alpha* u*)(p_K - p)|/(V K) +
 * |strain|, K the largest rho_l c_l^2: all of it, but where pressure differs from cell to cell by more than a few per
 * cent of K. There linear relaxation would overshoot. It would also where gas near vacuum meets pressure: d alpha then
 * means nothing. No material loses more than EXCHANGE_MOST of its volume by it or gains more than that and
 * EXCHANGE_TRACE of the cell; where one would, all exchange so much less. */
#ifndef EXCHANGE_H
#define EXCHANGE_H

#include "scheme/term.h"

#define EXCHANGE_FAST 25.0
#define EXCHANGE_STEEP 0.03
#define EXCHANGE_MOST 0.25
#define EXCHANGE_TRACE 1e-4

/* Owns 2 n_alpha rows: the pressure and the strain that the volume of each material brings along. Sources that move
 * volume add theirs to the first n_alpha (source.h). */
extern const struct term exchange_term;

/* After its `apply`: d alpha_l of a step, [n_alpha] rows. */
const double *exchange_volume(const struct term_tile *tile);

#endif
