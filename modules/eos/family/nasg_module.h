/* nasg_module.h - what nasg.c and mnasg.c share beyond the formulas: how values become an instance,
 * and the range. They differ in their fitted numbers alone. */
#ifndef NASG_MODULE_H
#define NASG_MODULE_H

#define FAMILY_ROOM family_room_left
#include "family_rows.h"

/* The parameter table, with the defaults of one fit for water. */
#define NASG_PARAMS(gamma_, p_inf_, covolume_, heat_bond_, cv_)                                                          \
    {                                                                                                                    \
        {"gamma", "1", 1.0001, 100.0, gamma_, "exponent", BULLA_NUMBER, NULL},                                           \
            {"p-inf",      "Pa", 0.0, 1e13, p_inf_, "attraction: at the pressure -p-inf the sound speed is zero",        \
             BULLA_NUMBER, NULL},                                                                                        \
            {"covolume",   "m3/kg", 0.0, 1.0, covolume_, "volume of the molecules: densities end near 1/covolume",       \
             BULLA_NUMBER, NULL},                                                                                        \
            {"heat-bond",  "J/kg", -1e12, 1e12, heat_bond_, "energy at zero temperature; shifts the zero of energy",     \
             BULLA_NUMBER, NULL},                                                                                        \
            {"cv",         "J/kg/K", 1e-3, 1e9, cv_, "specific heat at constant volume; only temperatures depend on it", \
             BULLA_NUMBER, NULL},                                                                                        \
            {"entropy-zero", "J/kg/K", -1e12, 1e12, 0.0, FAMILY_ENTROPY_ZERO, BULLA_NUMBER, NULL}, {0},                  \
    }

static int nasg_module_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    struct family par = {.gamma = values[0].number,
                         .p_inf = values[1].number,
                         .b = values[2].number,
                         .q = values[3].number,
                         .cv = values[4].number,
                         .q_s = values[5].number};
    return family_rows_open(host, par, ret_self);
}

/* Fitted to liquid water; densities up to where the continuation of the co-volume begins. */
static void nasg_module_range(const void *self, struct bulla_eos_range *ret_range)
{
    const struct family *par = self;
    *ret_range = (struct bulla_eos_range){.rho_min = 0.0,
                                          .rho_max = par->b > 0.0 ? FAMILY_EDGE / par->b : 3000.0,
                                          .p_min = -par->p_inf,
                                          .p_max = 4e9,
                                          .T_min = 300.0,
                                          .T_max = 500.0};
}

static const struct bulla_eos nasg_module_table = FAMILY_TABLE(nasg_module_range);

#endif
