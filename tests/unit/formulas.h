/* formulas.h - the Helmholtz energy of a fluid at (rho, T), without a module, for tests that compare formulas with
 * published numbers. */
#ifndef FORMULAS_H
#define FORMULAS_H

#include "../../modules/eos/helmholtz/helmholtz.h"

struct exact {
    double p, e, s, cv, c2, h;
    double p_r, p_T; /* slopes of p in rho and T */
};

static inline struct exact exact_at(const struct helmholtz_fluid *fluid, double rho, double T)
{
    double a[HELMHOLTZ_R][HELMHOLTZ_L], RT = fluid->R * T, lift = RT * log(rho / fluid->rho_c);
    helmholtz_potential(fluid, rho, log(T), a);
    double p_l = rho * rho * a[1][1] + rho * RT, e_l = a[0][1] - a[0][2];
    struct exact exact = {.p = rho * rho * a[1][0] + rho * RT, .e = a[0][0] - a[0][1], .s = -(a[0][1] + lift) / T};
    exact.p_r = 2 * rho * (a[1][0] + RT / rho) + rho * rho * (a[2][0] - RT / rho / rho);
    exact.p_T = p_l / T;
    exact.cv = e_l / T;
    exact.c2 = exact.p_r + p_l * p_l / (rho * rho * e_l);
    exact.h = exact.e + exact.p / rho;
    return exact;
}

#endif
