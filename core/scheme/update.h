/* update.h - from fluxes to the rate of change of a tile, and from rates to a new state.
 *
 * Rates are blocks of components of n_cell: n_field for the evolved fields, one for div u, for the
 * Kapila closure 2 n_alpha for the pressure and the strain that volume brings along, and with a solid
 * n_velocity * dim for the velocity gradient and, in mixtures, dim for that of its fraction (update_rates in all). Geometry enters here
 * alone (model.md 4): exact areas and volumes of metric.h; the radial momentum sees p relative to
 * the cell's own pressure, so that the hoop term beta p / r is balanced and a state at rest
 * stays at rest to round-off. */
#ifndef UPDATE_H
#define UPDATE_H

#include "mesh/metric.h"
#include "scheme/face.h"

/* First component of the velocity gradient: -d_k u_i stands i dim + k further. */
static inline unsigned update_gradient(const struct model *model)
{
    return model->n_field + 1 + (model->kapila ? 2 * model->n_alpha : 0);
}

/* Components of the rates of a model. */
static inline unsigned update_rates(const struct model *model)
{
    unsigned dim = (unsigned)model->dim;
    return update_gradient(model) + (model->n_stretch ? model->n_velocity * dim + (model->n_alpha ? dim : 0) : 0);
}

/* Adds the divergence of the fluxes of one piece to the rates of its cells. hoop: what the radial momentum is taken relative
 * to in curved geometry, a row of n_cell: the tile's pressure, or elastic_hoop. */
void update_add(const struct model *model, const struct level *level, const struct metric *metric,
                const struct frame *frame, const struct face_work *work, size_t n_cell, const double *hoop,
                double *rates);

/* Longest side of the cells of a level in `dim` dimensions [m]. */
double update_length(const struct level *level, int dim);

/* Blocks of a tile that a stage combines. */
struct update_input {
    const double *u_old;
    const double *w;      /* primitives at which the rates were taken */
    const double *K;      /* K_l of mix_closure, blocks of n_alpha (Kapila closure only) */
    const double *rho_c2; /* rho_l c_l^2 of mix_stiffness, likewise */
    const double *rates;
    double h; /* size of a cell, the longest side [m] */
};

/* u_new = u_old + dt * rates, the non-conservative terms of alpha included (model.md 2). Volume
 * fractions are kept in [0, 1] and at sum 1; the closure may not push one below UPDATE_LEAST
 * or UPDATE_SHRINK of what transport left.
 *
 * K div u keeps the materials at one pressure while a cell is compressed. Two more things drive their
 * pressures apart, both at the faces that fluid enters through: it comes from a cell of another
 * pressure, and it was compressed on the way to the face with its fractions frozen (that is what
 * the frozen speed in the Riemann solver means). Linearised relaxation, as in K, brings them together,
 *   d alpha_l = e_l - s_l/S sum_k e_k,   s_l = alpha_l/(rho_l c_l^2),   S = sum s_l,
 *   e_l = dt/V sum_faces A (alpha* u*) [ (p_K - p)/(rho_l c_l^2) + strain_K ],
 * with K the side upwind. Without it the linearised scheme is unstable in a mixture that moves fast
 * against Wood's speed, |u| c_f > 4 c_w^2 (1 - q)/q^2 with q = c_A^2/c_f^2 and rho c_A^2 = (rho e + p)/
 * (d rho e/dp): round-off grows in a gas-liquid front at uniform p and u (docs/decisions). In slower
 * flow mechanics gain nothing from it, so it is made with the weight f = r^2/(r^2 + UPDATE_FAST^2), r = |u| c_f/c_w^2.
 * Temperatures do: what a material brings from a higher pressure and does not give back is density that its own
 * isentrope has not, and of water near 4 C 0.1 % of that is 7 K. In thermal models (model.h) the weight is therefore
 *   f + (1 - f)/(1 + (X/UPDATE_STEEP)^4),   |u| X/h = |sum_l sum_faces A (alpha* u*)(p_K - p)|/(V K) + |strain|,
 * K the largest rho_l c_l^2: all of it, but where pressure differs from cell to cell by more than a few per cent of K. There
 * linear relaxation would overshoot.
 * It would also where gas near vacuum meets pressure: d alpha then means nothing. No material loses more than UPDATE_MOST
 * of its volume by it or gains more than that and UPDATE_TRACE of the cell; where one would, all exchange so much less.
 *
 * Returns the number of cells in which a bound acted. */
size_t update_apply(const struct model *model, size_t n_cell, double dt, const struct update_input *in, double *u_new);

#define UPDATE_LEAST 1e-9
#define UPDATE_SHRINK 0.25
#define UPDATE_FAST 25.0
#define UPDATE_STEEP 0.03
#define UPDATE_MOST 0.25
#define UPDATE_TRACE 1e-4

#endif
