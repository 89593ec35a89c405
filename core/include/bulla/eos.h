/* bulla/eos.h - functions of a module of kind "eos".
 *
 * One material's equation of state, hydrodynamic part only (elastic energy is added by
 * core). Coordinates are density rho and pressure p. Every call is a batch over n points:
 * [any thread; pure; no allocation; n >= 1; arrays do not overlap; unit stride; SI units].
 * The value at a point must not depend on its place in the row or on n.
 *
 * Well-posed means, for every rho > 0 and p > p_min(rho) that a solver can produce:
 * d(rho_e)/dp > 0, rho c^2 > 0, T > 0, nothing infinite. Outside its stated range a module
 * continues its formulas so that this still holds; a state at or below p_min shows in the
 * value (rho c^2 <= 0), never by a
 * trap. */
#ifndef BULLA_EOS_H
#define BULLA_EOS_H

#include "bulla/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where the formulas are backed by data; beyond it the continuation rules. A box: of a vapour the dome is cut off it,
 * which count_outside says. */
struct bulla_eos_range {
    double rho_min, rho_max; /* kg/m3 */
    double p_min, p_max;     /* Pa */
    double T_min, T_max;     /* K */
};

struct bulla_eos {
    uint32_t size; /* sizeof(struct bulla_eos) */

    /* The hot call: energy per volume rho e [J/m3] and stiffness rho c^2 [Pa], the adiabatic bulk
     * modulus: it is what Wood's formula, the closure and the frozen speed are made of. */
    void (*state)(const void *self, size_t n, const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                  double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT rho_c2);

    /* Derivatives of the energy per volume: d(rho e)/dp at constant rho [1], d(rho e)/drho at constant p [J/kg]. */
    void (*derivatives)(const void *self, size_t n, const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                        double *BULLA_RESTRICT de_dp, double *BULLA_RESTRICT de_drho);

    /* Temperature [K]. */
    void (*temperature)(const void *self, size_t n, const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                        double *BULLA_RESTRICT T);

    /* Specific entropy [J/(kg K)], up to a constant that is common to the phases of one substance. */
    void (*entropy)(const void *self, size_t n, const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                    double *BULLA_RESTRICT s);

    /* Density from pressure and temperature [kg/m3]: initial states. */
    void (*density)(const void *self, size_t n, const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT T,
                    double *BULLA_RESTRICT rho);

    /* Lowest pressure at which the state is still well-posed [Pa]. */
    void (*p_min)(const void *self, size_t n, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT p);

    /* Optional (NULL: core iterates): rho e = a p + b at fixed rho, exactly the function that
     * `state` gives. With it on all materials core closes the mixture pressure in closed form. */
    void (*linear)(const void *self, size_t n, const double *BULLA_RESTRICT rho, double *BULLA_RESTRICT a,
                   double *BULLA_RESTRICT b);

    /* Validity of the formulas as given. */
    void (*range)(const void *self, struct bulla_eos_range *ret_range);

    /* Slots from here on came later: a table whose `size` ends before them has none of them. */

    /* Optional (NULL: core calls state and derivatives): rho e and d(rho e)/dp in one pass, bit by bit what
     * those two give. It is what Newton's method for the mixture pressure asks for. */
    void (*energy)(const void *self, size_t n, const double *BULLA_RESTRICT rho, const double *BULLA_RESTRICT p,
                   double *BULLA_RESTRICT rho_e, double *BULLA_RESTRICT de_dp);

    /* Optional (NULL: nothing is counted): at how many of the n points a continuation stands in for the formulas.
     * Those may reach farther than `range`, which says where data back them. */
    size_t (*count_outside)(const void *self, size_t n, const double *BULLA_RESTRICT rho,
                            const double *BULLA_RESTRICT p);

    /* Optional (NULL: the material can have no partner in `phase-change:`). From pressure and temperature: specific
     * volume v [m3/kg], enthalpy h [J/kg], entropy s [J/(kg K)], dv/dT at constant p, dv/dp at constant T, and the heat
     * capacity c_p [J/(kg K)]. rho: a density to start a search from, or 0; out: 1/v. They are one potential g = h - T
     * s (g_p = v, g_T = -s), and the zeros of h and s are those of `state` and `entropy`: what h and s differ by
     * between the phases of one substance decides where it boils. Where there is no state, something is not finite, or
     * v <= 0; where `count_outside` counts, there need be none. */
    void (*thermal)(const void *self, size_t n, const double *BULLA_RESTRICT p, const double *BULLA_RESTRICT T,
                    double *BULLA_RESTRICT rho, double *BULLA_RESTRICT v, double *BULLA_RESTRICT h,
                    double *BULLA_RESTRICT s, double *BULLA_RESTRICT v_T, double *BULLA_RESTRICT v_p,
                    double *BULLA_RESTRICT c_p);

    /* Optional (NULL: 0). The gas constant R [J/(kg K)] of the dilute gas, p v -> R T; 0 for what does not become one.
     * With it the mole fraction of a vapour among other gases is counted. */
    double (*gas_constant)(const void *self);
};

/* Whether a law has a slot that came later. */
#define BULLA_EOS_HAS(eos, slot) ((eos)->size > offsetof(struct bulla_eos, slot) && (eos)->slot)

#ifdef __cplusplus
}
#endif
#endif
