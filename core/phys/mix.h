/* mix.h - mixture rules on batches of points: primitives from conserved, speeds, the K term.
 *
 * Arrays are blocks of components: component q of a block lies at block + q * stride. Order of
 * components as in model.h. Batches of any length n <= stride. Equations: model.md 2 and 6. */
#ifndef MIX_H
#define MIX_H

#include "phys/mix_pressure.h"
#include "phys/model.h"

#include <stddef.h>

/* Volume fractions at or below this count as absent: their flux is zero and their density is
 * the fill value. Keeps numerical fronts of 1e-300 from spreading. */
#define MIX_ABSENT 1e-12

/* Primitives (alpha_l, rho_l, u_i, p, V) from conserved fields (alpha_l, m_l, rho u_i, rho E, V): the
 * pressure that solves sum_l alpha_l rho_l e_l(rho_l, p) = rho E - rho |u|^2/2 - sum_l m_l e_l^s(V). Closed form when
 * all laws are linear in p, else a safeguarded Newton started from the pressures already in w (mix_pressure.h).
 * Returns what that took. */
struct mix_effort mix_primitives(const struct model *model, size_t n, size_t stride, const double *u, double *w);

/* Conserved fields from primitives. */
void mix_conserved(const struct model *model, size_t n, size_t stride, const double *w, double *u);

/* Per material rho_l c_l^2: block of n_material components; where a material is absent its own or 0. Inadmissible
 * states show as values <= 0. */
void mix_stiffness(const struct model *model, size_t n, size_t stride, const double *w, double *rho_c2);

/* The same, and where a material is absent that of its fill density: what flows in has some stiffness there. */
void mix_stiffness_everywhere(const struct model *model, size_t n, size_t stride, const double *w, double *rho_c2);

/* Square of the fastest signal: the frozen sound speed of the mixture, c_f^2 = sum_l Y_l c_l^2 =
 * sum_l alpha_l rho_l c_l^2 / rho, and with a solid the largest of the elastic speeds along the axes (elastic.h). */
void mix_speed2(const struct model *model, size_t n, size_t stride, const double *w, const double *rho_c2, double *c2);

/* The closure's K_l = alpha_l (rho c_w^2 / (rho_l c_l^2) - 1), 1/(rho c_w^2) = sum alpha_l/(rho_l c_l^2);
 * rho_c2 from either of the above; K: block of n_alpha components. */
void mix_closure(const struct model *model, size_t n, size_t stride, const double *w, const double *rho_c2, double *K);

/* Temperature of each material (block of n_material) where it is present, else 0. */
void mix_temperatures(const struct model *model, size_t n, size_t stride, const double *w, double *T);

/* -s_thth = p - s'_thth of cells in curved geometry (model.md 4) [Pa]; for models with a stretch. */
void mix_hoop(const struct model *model, size_t n, size_t stride, const double *w, double *ret);

#endif
