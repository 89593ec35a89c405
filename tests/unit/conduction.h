/* conduction.h - water and air that conduct, for the tests of heat. */
#ifndef CONDUCTION_TEST_H
#define CONDUCTION_TEST_H

#include "flow.h"

static const double P = 101325.0, CV_WATER = 590.0, CV_AIR = 717.5, K_WATER = 0.607, K_AIR = 0.0262;

#define WATER "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa, cv: 590}, conductivity: 0.607 W/m/K}\n"
#define AIR "  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}, conductivity: 0.0262 W/m/K}\n"

static inline double rho_water(double T)
{
    return (P + 6e8) / (3.4 * CV_WATER * T);
}

static inline double rho_air(double T)
{
    return P / (0.4 * CV_AIR * T);
}

static inline void start(struct flow *flow, const char *domain, const char *mesh, const char *materials,
                         const char *scheme)
{
    flow_start(flow, mem_print("bulla: 1\ntitle: heat\ndomain: {%s}\n%smaterials:\n%sinitial:\n  - {everywhere: true, "
                               "material: air, density: 1.2, pressure: 1 atm}\nscheme: {%s}\nrun: {until: 1}\n",
                               domain, mesh, materials, scheme));
}

#endif
