/* coefficient.h - viscosities (and whatever else follows bulla/coefficient.h) of a material at rows of points. */
#ifndef COEFFICIENT_H
#define COEFFICIENT_H

#include "phys/model.h"

enum { COEFFICIENT_BATCH = 256 };

/* Between these temperatures laws are asked [K]. Beside a liquid in tension a gas has none above 0, and a trace of gas
 * in an interface may have any: heated by its own viscosity it would, with a law that grows with T, become hotter and
 * more viscous still. */
#define COEFFICIENT_COLDEST 1.0
#define COEFFICIENT_HOTTEST 1e4

/* T[n] within these bounds. */
void coefficient_temper(size_t n, const double *T, double *tempered);

/* States of one material: rate of shear [1/s], p, rho. Rows that its law does not need may be NULL. At most
 * COEFFICIENT_BATCH points. */
struct coefficient_points {
    size_t n;
    const double *rate, *p, *rho;
};

/* Does the law look at anything but the rate? Then p and rho are needed. */
static inline bool coefficient_sees_state(const struct model_coefficient *coefficient)
{
    return coefficient->law && (coefficient->law->needs & ~(uint32_t)BULLA_NEEDS_RATE);
}

static inline bool coefficient_sees_rate(const struct model_coefficient *coefficient)
{
    return coefficient->law && (coefficient->law->needs & BULLA_NEEDS_RATE);
}

/* Is it one number, or nothing? */
static inline bool coefficient_is_number(const struct model_coefficient *coefficient)
{
    return !coefficient->law || !coefficient->law->needs;
}

/* value[n]: what the law says; 0 without one. `eos`: of the material, for its temperature. */
void coefficient_values(const struct model_coefficient *coefficient, const struct model_eos *eos,
                        const struct coefficient_points *points, double *value);

/* mu and zeta [n] of a material. */
void coefficient_viscosities(const struct model_viscosity *viscosity, const struct model_eos *eos,
                             const struct coefficient_points *points, double *mu, double *zeta);

/* The most that mu may be whatever the rate, and zeta: what a time step goes by. points->rate is not looked at. */
void coefficient_viscosities_most(const struct model_viscosity *viscosity, const struct model_eos *eos,
                                  const struct coefficient_points *points, double *mu, double *zeta);

#endif
