/* derive_stress.h - derived fields of scenes with a solid: stresses, stretches, invariants, elastic energy.
 *
 * s is the Cauchy stress -p I + s' (tension positive) of the mixture in a cell, s' its elastic, deviatoric part
 * (elastic.h), which fades with the fraction of solid; V the stretch. Axes as everywhere: in axisymmetric scenes
 * x = r, y = z and zz is the hoop component; in spherical ones x = r and yy = zz is it. Components that a scene does
 * not have are 0. Fluid shows -p, V = 1 and I1 = I2 = 3. */
#ifndef DERIVE_STRESS_H
#define DERIVE_STRESS_H

#include "derive/derive_view.h"

/* Component field->index (elastic.h's order) of s [Pa] or V [1]. */
void derive_stress_cauchy(const struct derive_view *tile, double *out);
void derive_stress_stretch(const struct derive_view *tile, double *out);

/* Largest principal stretch: the largest eigenvalue of V [1]. */
void derive_stress_stretch_max(const struct derive_view *tile, double *out);

/* Parts of a pair of principal values, by field->index: the larger, the smaller, half their difference; of s, or (_DEV)
 * of s'. */
enum derive_stress_part {
    DERIVE_STRESS_MAX,
    DERIVE_STRESS_MIN,
    DERIVE_STRESS_SHEAR,
    DERIVE_STRESS_MAX_DEV,
    DERIVE_STRESS_MIN_DEV
};

/* In the plane of x and y (thesis eq. 41-43): (s_xx + s_yy)/2 +- R, R = sqrt(((s_xx - s_yy)/2)^2 + s_xy^2) [Pa]. */
void derive_stress_sigma(const struct derive_view *tile, double *out);

/* The largest and the least of all three principal values, the hoop stress among them [Pa]. */
void derive_stress_principal(const struct derive_view *tile, double *out);

/* sqrt(3/2 s':s') [Pa]. */
void derive_stress_von_mises(const struct derive_view *tile, double *out);

/* The same of what Maxwell branches bear, which will relax [Pa]. */
void derive_stress_over(const struct derive_view *tile, double *out);

/* Elastic energy per volume of the mixture [J/m3]; invariant I1 or I2 (field->index 0 or 1) of B = V V [1]. */
void derive_stress_energy(const struct derive_view *tile, double *out);
void derive_stress_invariant(const struct derive_view *tile, double *out);

/* Static strength, summed by volume as the stress is, beside which von_mises stands (flow.h) [Pa]. */
void derive_stress_strength(const struct derive_view *tile, double *out);

/* Accumulated plastic strain, the mean by mass of the solids that have one [1]. */
void derive_stress_plastic(const struct derive_view *tile, double *out);

/* Damage from 0 to 1, the mean by mass of the solids that can break; 0 where they fill less than a thousandth of a
 * cell, as what is torn off a surface says nothing of the solid. */
void derive_stress_damage(const struct derive_view *tile, double *out);

#endif
