/* lemmon_air_terms.h - dry air as one fluid: Lemmon, Jacobsen, Penoncello & Friend, J. Phys. Chem. Ref. Data 29
 * (2000) 331-385, tables 12 and 13. Zeros of e and s as in IAPWS G8-10; the molar mass is that of the same
 * guideline. */
#ifndef LEMMON_AIR_TERMS_H
#define LEMMON_AIR_TERMS_H

#include "helmholtz.h"

static const struct helmholtz_ideal lemmon_air_ideals[] = {
    {HELMHOLTZ_LOG, 2.490888032, 0.0},           {HELMHOLTZ_POWER, 6.057194e-08, -3.0},
    {HELMHOLTZ_POWER, -2.10274769e-05, -2.0},    {HELMHOLTZ_POWER, -0.000158860716, -1.0},
    {HELMHOLTZ_POWER, 9.7450251743948, 0.0},     {HELMHOLTZ_POWER, 10.0986147428912, 1.0},
    {HELMHOLTZ_POWER, -0.00019536342, 1.5},      {HELMHOLTZ_EINSTEIN, 0.791309509, 25.36365},
    {HELMHOLTZ_EINSTEIN, 0.212236768, 16.90741}, {HELMHOLTZ_MIXED, -0.197938904, 87.31279},
};

/* n, d, t, c */
static const struct helmholtz_term lemmon_air_terms[] = {
    {0.118160747229, 1, 0.0, 0, 0, 0, 0, 0},      {0.713116392079, 1, 0.33, 0, 0, 0, 0, 0},
    {-1.61824192067, 1, 1.01, 0, 0, 0, 0, 0},     {0.0714140178971, 2, 0.0, 0, 0, 0, 0, 0},
    {-0.0865421396646, 3, 0.0, 0, 0, 0, 0, 0},    {0.134211176704, 3, 0.15, 0, 0, 0, 0, 0},
    {0.0112626704218, 4, 0.0, 0, 0, 0, 0, 0},     {-0.0420533228842, 4, 0.2, 0, 0, 0, 0, 0},
    {0.0349008431982, 4, 0.35, 0, 0, 0, 0, 0},    {0.000164957183186, 6, 1.35, 0, 0, 0, 0, 0},
    {-0.101365037912, 1, 1.6, 1, 0, 0, 0, 0},     {-0.17381369097, 3, 0.8, 1, 0, 0, 0, 0},
    {-0.0472103183731, 5, 0.95, 1, 0, 0, 0, 0},   {-0.0122523554253, 6, 1.25, 1, 0, 0, 0, 0},
    {-0.146629609713, 1, 3.6, 2, 0, 0, 0, 0},     {-0.0316055879821, 3, 6.0, 2, 0, 0, 0, 0},
    {0.000233594806142, 11, 3.25, 2, 0, 0, 0, 0}, {0.0148287891978, 1, 3.5, 3, 0, 0, 0, 0},
    {-0.00938782884667, 3, 15.0, 3, 0, 0, 0, 0},
};

static const struct helmholtz_fluid lemmon_air_fluid = {
    .R = 8.31451 / 0.02896546,
    .rho_c = 10447.7 * 0.02896546,
    .T_c = 132.6312,
    .terms = lemmon_air_terms,
    .ideals = lemmon_air_ideals,
    .n_term = sizeof lemmon_air_terms / sizeof *lemmon_air_terms,
    .n_ideal = sizeof lemmon_air_ideals / sizeof *lemmon_air_ideals,
};

#endif
