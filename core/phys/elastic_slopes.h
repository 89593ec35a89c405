/* elastic_slopes.h - how the moduli of a solid change with its invariants, for wave speeds and tractions. */
#ifndef ELASTIC_SLOPES_H
#define ELASTIC_SLOPES_H

#include "phys/elastic_tensor.h"

/* G1, G2 and 2 m e_11, e_12, e_22 at one point (elastic.c). */
struct elastic_slopes {
    double G1, G2, H11, H12, H22, I1;
};

/* Change of s'_ij and of the moduli with it, for the part that all directions share: changes of I1, I2 at dev B, dev
 * C. */
static ELASTIC_BODY double elastic_slopes_stiffen(struct elastic_slopes g, double dI1, double dI2, double dev_B,
                                                  double dev_C)
{
    double k1 = g.H11 + g.I1 * g.H12 + g.G2, k2 = g.H12 + g.I1 * g.H22; /* d G1 = k1 d I1 + k2 d I2 */
    return (k1 * dI1 + k2 * dI2) * dev_B - (g.H12 * dI1 + g.H22 * dI2) * dev_C;
}

#endif
