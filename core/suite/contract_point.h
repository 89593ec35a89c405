/* contract_point.h - states of a law under test: what the law says at one, and random ones of its box.
 *
 * The contract of kind "eos" (contract_eos.h) and its lines (contract_line.h) ask here. */
#ifndef CONTRACT_POINT_H
#define CONTRACT_POINT_H

#include "bulla/eos.h"
#include "suite/contract.h"
#include "suite/contract_eos.h"

/* The instance under test and where: the box that states are drawn from, the range that the module states. */
struct contract_points {
    struct contract *contract;
    const struct bulla_eos *eos;
    const void *self;
    const struct contract_eos_box *box;
    struct bulla_eos_range range;
};

/* What a law says at (rho, p): rho e [J/m3], rho c^2 [Pa], c^2 [m2/s2], d(rho e)/dp [1], d(rho e)/drho [J/kg], T [K],
 * s [J/(kg K)]. */
struct contract_point {
    double rho_e, stiffness, c2, de_dp, de_drho, T, s;
};

/* All of them at rho [kg/m3] and p [Pa]. */
struct contract_point contract_point_at(const struct contract_points *suite, double rho, double p);

/* The lowest pressure [Pa] of rho [kg/m3]. */
double contract_point_p_min(const struct contract_points *suite, double rho);

/* T [K] at rho [kg/m3] and p [Pa]. */
double contract_point_temperature(const struct contract_points *suite, double rho, double p);

/* A random state of the box into `ret_rho` [kg/m3] and `ret_p` [Pa]; false if none was found, then they are of no
 * use. */
bool contract_point_draw(const struct contract_points *suite, uint64_t *seed, double *ret_rho, double *ret_p);

#endif
