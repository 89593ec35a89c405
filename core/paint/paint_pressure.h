/* paint_pressure.h - the pressure of an initial state that is given by density and temperature. */
#ifndef PAINT_PRESSURE_H
#define PAINT_PRESSURE_H

#include "phys/model.h"

#include <stdbool.h>

/* The pressure [Pa] at which the law has temperature T [K] at density rho [kg/m3], to round-off; the highest where the
 * temperature has a floor. False: there is none between the law's p_min and 1e15 Pa. */
bool paint_pressure(const struct model_eos *eos, double rho, double T, double *ret_p);

#endif
