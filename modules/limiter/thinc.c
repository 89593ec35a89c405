/* thinc.c - a step between two materials as a hyperbolic tangent: sharper than any slope. For volume fractions.
 *
 * THINC (Xiao, Honma & Kono 2005) lays (1 + tanh(beta (x - x0)))/2, x in cells, through the mean of a cell between the
 * values of its neighbours. With the jump d = near + far and q = (far - near)/d from -1 to 1, the step from the cell's
 * value to an edge is a function of the differences alone:
 *     e = (near - far)/2 + d/2 (h + H/h)/(1 + H),    H = T(beta q/2),   h = T(beta/2),   T = tanh,
 * the two-sided form of the usual one with exponentials, and the same for fractions that rise and fall. T is taken as
 * x (15 + x^2)/(15 + 6 x^2), within 1e-3 of tanh for beta <= 2.4 and 3e-3 for 3: no library, the same bits everywhere,
 * a vector loop. h from the same T ends the step at the neighbour. Steps may be longer than `far`: an edge may hold
 * more than twice what its cell has of a material (docs/decisions/edges.md). */
#include <stddef.h>
#include <stdlib.h>

/* What an instance holds, in this order. */
enum { THINC_HALF, THINC_H, THINC_ONE_OVER_H, THINC_VALUES };

#define LIMITER_STEPS(values, below, above) thinc_steps(values, below, above)

static inline double thinc_tanh(double x)
{
    double square = x * x;
    return x * (15.0 + square) / (15.0 + 6.0 * square);
}

static inline double thinc_step(const double *values, double near, double far, double jump, double H)
{
    double share = (values[THINC_H] + H * values[THINC_ONE_OVER_H]) / (1.0 + H);
    double step = 0.5 * ((near - far) + jump * share);
    step = step > 0.0 ? step : 0.0;
    return step < near ? step : near;
}

static inline struct sides_steps thinc_steps(const double *values, double below, double above);

#include "sides.h"

/* H of the other side is -H. */
static inline struct sides_steps thinc_steps(const double *values, double below, double above)
{
    double jump = below + above, H = thinc_tanh(values[THINC_HALF] * ((above - below) / jump));
    return (struct sides_steps){thinc_step(values, below, above, jump, H), thinc_step(values, above, below, jump, -H)};
}

static const struct bulla_limiter thinc_table = SIDES_TABLE(BULLA_SURFACES);

static const struct bulla_param thinc_params[] = {
    {"beta", "1", 1.0, 3.0, 1.6, "steepness of the tangent per cell: more is sharper, and keeps the guard busier",
     BULLA_NUMBER, 0},
    {0},
};

static int thinc_open(const struct bulla_host *host, const struct bulla_value *values, void **ret_self)
{
    double *self = malloc(THINC_VALUES * sizeof *self);
    if (!self) {
        host->fail("out of memory");
        return 1;
    }
    self[THINC_HALF] = 0.5 * values[0].number;
    self[THINC_H] = thinc_tanh(self[THINC_HALF]);
    self[THINC_ONE_OVER_H] = 1.0 / self[THINC_H];
    *ret_self = self;
    return 0;
}

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "limiter",
    .name = "thinc",
    .version = "1.0",
    .doc =
        "THINC: hyperbolic tangents, for volume fractions (`interface-limiter`). Surfaces about as sharp as superbee "
        "gives with twice the cells. Not for densities, velocities or pressure: it makes steps of waves.",
    .cite = "Xiao, Honma & Kono, Int. J. Numer. Methods Fluids 48 (2005) 1023-1040; in this model: Shyue & Xiao, "
            "J. Comput. Phys. 268 (2014) 326-354",
    .params = thinc_params,
    .open = thinc_open,
    .close = free,
    .table = &thinc_table,
};
