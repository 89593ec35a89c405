/* koren.c - the edges of a parabola, where they keep to the region of slopes: third order in smooth flow, without a
 * third layer of neighbours.
 *
 * Through a cell and its neighbours as means goes one parabola. At an edge it is (2 near + far)/6 away from the cell
 * (kappa = 1/3). Koren's limiter cuts that to at most the nearer neighbour, so its two edges are as bounded as those of
 * MC or superbee. */

#define LIMITER_STEP(values, near, far) koren(near, far)

static inline double koren(double near, double far)
{
    double parabola = (2.0 * near + far) / 6.0, least = near < far ? near : far;
    return parabola < least ? parabola : least;
}

#include "sides.h"

static const struct bulla_limiter koren_table = SIDES_TABLE(0u);

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "limiter",
    .name = "koren",
    .version = "1.0",
    .doc = "Koren: the parabola through three cells, at most as far as the nearer neighbour. Third order at edges in "
           "smooth flow: a third to a half of the error of mc in sound and entropy waves.",
    .cite = "Koren, in: Numerical Methods for Advection-Diffusion Problems, Notes Numer. Fluid Mech. 45 (1993) 117-138",
    .table = &koren_table,
};
