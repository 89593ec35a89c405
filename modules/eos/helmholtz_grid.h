/* helmholtz_grid.h - a table of the Helmholtz energy: local biquintic Hermite interpolation of a(rho, l), l = ln T.
 *
 * A node holds a and its derivatives up to twice in rho and twice in l, exact values all, so that one potential
 * describes the fluid: pressure, energy, entropy and sound speed fit each other by construction, p is continuously
 * differentiable and c continuous. Nodes outside the fluid's domain hold whatever its formulas give; no cell of the
 * domain needs them (a spline through all nodes would).
 *
 * Beside it lies what makes the inversion (rho, p) -> l short: per row of densities the pressures at both ends of the
 * domain, and l over y = sqrt((p - p_low)/(p_high - p_low)), in which even the square root of the density maximum is
 * smooth. At fixed rho the table is six numbers in l: Newton steps on them cost nothing beside fetching them. */
#ifndef HELMHOLTZ_GRID_H
#define HELMHOLTZ_GRID_H

#include "helmholtz_state.h"

#include <stdbool.h>
#include <stdlib.h>

enum { HELMHOLTZ_NODE = 9, HELMHOLTZ_STARTS = 128, HELMHOLTZ_EDGES = 512, HELMHOLTZ_SAMPLES = 1500 };

/* The domain of a fluid and its table, fixed per law. */
struct helmholtz_law {
    const char *name;
    const struct helmholtz_fluid *fluid;
    double rho_low, rho_high, T_high;     /* domain */
    double grid_rho, grid_T, grid_T_high; /* lower ends of the table and its highest T; rho ends at rho_high */
    double gamma, pull, p_min, T_min;     /* thin rule, lowest p and T of the continuations */
    int gas;                              /* R T ln rho is kept apart; T_low is constant, no thin rule */
    double (*T_low)(const struct helmholtz_law *law, double rho);
};

struct helmholtz_grid {
    int n;                           /* nodes in each direction */
    double rho_0, per_rho, step_rho; /* first node, 1/spacing, spacing */
    double l_0, per_l, step_l;
    double l_low, l_high, edge_0, per_edge, R; /* l_low: of the lower edge where that is constant */
    double last_cell, last_start, last_edge;   /* numbers of the last intervals */
    double *node;   /* n x n x 9: [rho][l][3 kl + kr], scaled by the spacings to the powers kr, kl */
    double *T;      /* n: temperatures of the nodes */
    double *ends;   /* n x 2: p/rho at both ends of the domain */
    double *start;  /* n x (HELMHOLTZ_STARTS + 1): l over y */
    double *edge;   /* (HELMHOLTZ_EDGES + 1) x 2: l of the lower edge and its slope per interval */
    double *misses; /* HELMHOLTZ_SAMPLES x 2: relative errors of T and c that were measured */
};

/* Quintic in x from 0 to 1 with given value and two derivatives at both ends. */
struct helmholtz_six {
    double c0, c1, c2, c3, c4, c5;
};

HELMHOLTZ_INLINE struct helmholtz_six helmholtz_quintic(struct helmholtz_six f)
{
    double half = 0.5 * f.c2, d0 = f.c3 - (f.c0 + f.c1 + half), d1 = f.c4 - (f.c1 + f.c2), d2 = f.c5 - f.c2;
    return (struct helmholtz_six){
        f.c0, f.c1, half, 10.0 * d0 - 4.0 * d1 + 0.5 * d2, 7.0 * d1 - 15.0 * d0 - d2, 6.0 * d0 - 3.0 * d1 + 0.5 * d2};
}

HELMHOLTZ_INLINE double helmholtz_value(struct helmholtz_six f, double x)
{
    return f.c0 + x * (f.c1 + x * (f.c2 + x * (f.c3 + x * (f.c4 + x * f.c5))));
}

HELMHOLTZ_INLINE double helmholtz_slope(struct helmholtz_six f, double x)
{
    return f.c1 + x * (2.0 * f.c2 + x * (3.0 * f.c3 + x * (4.0 * f.c4 + x * (5.0 * f.c5))));
}

HELMHOLTZ_INLINE double helmholtz_curve(struct helmholtz_six f, double x)
{
    return 2.0 * f.c2 + x * (6.0 * f.c3 + x * (12.0 * f.c4 + x * (20.0 * f.c5)));
}

HELMHOLTZ_INLINE double helmholtz_third(struct helmholtz_six f, double x)
{
    return 6.0 * f.c3 + x * (24.0 * f.c4 + x * (60.0 * f.c5));
}

/* Weights of the six data (value, slope, curve at both ends) in the value of the quintic at x ... */
HELMHOLTZ_INLINE struct helmholtz_six helmholtz_weights(double x)
{
    double y = 1.0 - x, cube = x * x * x, far = y * y * y;
    return (struct helmholtz_six){far * (1.0 + x * (3.0 + 6.0 * x)),  far * x * (1.0 + 3.0 * x),   0.5 * far * x * x,
                                  cube * (1.0 + y * (3.0 + 6.0 * y)), -cube * y * (1.0 + 3.0 * y), 0.5 * cube * y * y};
}

/* ... in its slope ... */
HELMHOLTZ_INLINE struct helmholtz_six helmholtz_slope_weights(double x)
{
    double y = 1.0 - x, xx = x * x, yy = y * y, mid = 30.0 * xx * yy;
    return (struct helmholtz_six){-mid, yy * (1.0 + x * (2.0 - 15.0 * x)), 0.5 * yy * x * (2.0 - 5.0 * x),
                                  mid,  xx * (1.0 + y * (2.0 - 15.0 * y)), -0.5 * xx * y * (2.0 - 5.0 * y)};
}

/* ... and in its curve. */
HELMHOLTZ_INLINE struct helmholtz_six helmholtz_curve_weights(double x)
{
    double y = 1.0 - x, odd = 60.0 * x * y * (x - y);
    return (struct helmholtz_six){odd,  -12.0 * x * y * (3.0 - 5.0 * x), y * (1.0 + x * (10.0 * x - 8.0)),
                                  -odd, 12.0 * x * y * (3.0 - 5.0 * y),  x * (1.0 + y * (10.0 * y - 8.0))};
}

HELMHOLTZ_INLINE double helmholtz_dot(struct helmholtz_six f, struct helmholtz_six w)
{
    return (f.c0 * w.c0 + f.c1 * w.c1 + f.c2 * w.c2) + (f.c3 * w.c3 + f.c4 * w.c4 + f.c5 * w.c5);
}

/* Whole part of `at`, within 0 .. most; NaN gives 0. `most` comes from memory on purpose: with a constant gcc knows the
 * outcome of one comparison from the other, makes branches of them and leaves the loop scalar. */
HELMHOLTZ_INLINE int helmholtz_cell(double at, double most)
{
    double held = at > 0.0 ? at : 0.0;
    held = held < most ? held : most;
    return (int)held;
}

/* Lower edge of the domain, ln T over rho (within the domain), and its slope. */
HELMHOLTZ_INLINE double helmholtz_edge(const struct helmholtz_grid *grid, double rho, double *ret_slope)
{
    double at = (rho - grid->edge_0) * grid->per_edge;
    int i = helmholtz_cell(at, grid->last_edge);
    double x = at - i, y = 1.0 - x, l = grid->edge[2 * i], m = grid->edge[2 * i + 1];
    double up = grid->edge[2 * i + 2], m_up = grid->edge[2 * i + 3];
    *ret_slope = (6.0 * x * y * (up - l) + y * (1.0 - 3.0 * x) * m + x * (3.0 * x - 2.0) * m_up) * grid->per_edge;
    return l * y * y * (1.0 + 2.0 * x) + up * x * x * (3.0 - 2.0 * x) + x * y * (y * m - x * m_up);
}

#endif
