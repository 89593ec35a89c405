/* helmholtz_grid.h - a table of the Helmholtz energy: local biquintic Hermite interpolation of a(rho, l), l = ln T.
 *
 * A node has a and its derivatives up to twice in rho and twice in l, exact values all, so that one potential
 * describes the fluid: pressure, energy, entropy and sound speed fit each other by construction, p is continuously
 * differentiable and c continuous. Nodes outside the fluid's domain have whatever its formulas give; no cell of the
 * domain needs them (a spline through all nodes would). What is kept is the polynomial of each cell, 36 numbers: a
 * point asks one cell alone, and its neighbours mostly the same.
 *
 * Beside it lies where the inversion (rho, p) -> l starts: l over the coordinates of helmholtz_band.h. */
#ifndef HELMHOLTZ_GRID_H
#define HELMHOLTZ_GRID_H

#include "helmholtz_band.h"

#include <stdbool.h>
#include <stdlib.h>

enum { HELMHOLTZ_NODE = 9, HELMHOLTZ_CELL = 36 };
enum { HELMHOLTZ_STARTS = 256, HELMHOLTZ_EDGES = 512 };

/* The lower edge of the domain is an isotherm. */
#define HELMHOLTZ_FLAT (HELMHOLTZ_GAS && !(HELMHOLTZ_SKEW > 0.0))

#define HELMHOLTZ_NEAR (2.0 * HELMHOLTZ_COLD) /* y^2 up to which a search is held on the lower edge, ... */
#define HELMHOLTZ_FAR 0.99                    /* ... and from which on the upper one */

/* The domain of a fluid and its table, fixed per law. */
struct helmholtz_law {
    const char *name;
    const struct helmholtz_fluid *fluid;
    double rho_low, rho_high, T_high; /* domain; tables have its densities */
    double grid_T, grid_T_high;       /* lowest and highest T of the table of a */
    double blur;                      /* kg/m3 over which the cold edge is rounded for direct tables */
    double gamma, pull, p_min, T_min; /* thin rule, lowest p and T of the continuations */
    int gas; /* R T ln rho is kept apart, no thin rule; T_low is constant if rows are no logarithms */
    double (*T_low)(const struct helmholtz_law *law, double rho);
};

struct helmholtz_grid {
    int n; /* nodes in each direction */
    struct helmholtz_band band;
    double l_0, per_l, step_l, last_cell;
    double l_low, l_high, edge_0, per_edge, R; /* l_low: of the lower edge where that is constant */
    double last_edge;
    struct helmholtz_steps steps; /* of the starts */
    double *cell;  /* (n - 1) x (n - 1) x 36: [rho][l][power of the part in rho][power of the part in l] */
    double *T;     /* n: temperatures of the nodes */
    double *start; /* n x (HELMHOLTZ_STARTS + 1): l over y */
    double *edge;  /* (HELMHOLTZ_EDGES + 1) x 2: l of the lower edge and its slope per interval */
};

/* Six numbers: a quintic by powers of x. */
struct helmholtz_six {
    double c0, c1, c2, c3, c4, c5;
};

/* A quintic at x: value, slope, half of the second and a sixth of the third derivative. */
struct helmholtz_jet {
    double f0, f1, f2, f3;
};

PATCH_INLINE struct helmholtz_jet helmholtz_jet(struct helmholtz_six f, double x)
{
    double b4 = f.c4 + x * f.c5, b3 = f.c3 + x * b4, b2 = f.c2 + x * b3, b1 = f.c1 + x * b2, b0 = f.c0 + x * b1;
    double d4 = b4 + x * f.c5, d3 = b3 + x * d4, d2 = b2 + x * d3, d1 = b1 + x * d2;
    double e4 = d4 + x * f.c5, e3 = d3 + x * e4, e2 = d2 + x * e3;
    double g4 = e4 + x * f.c5, g3 = e3 + x * g4;
    return (struct helmholtz_jet){b0, d1, e2, g3};
}

/* Where the numbers of the cell (i, j) begin. */
PATCH_INLINE int helmholtz_grid_cell(const struct helmholtz_grid *grid, int i, int j)
{
    return (i * (grid->n - 1) + j) * HELMHOLTZ_CELL;
}

/* The coefficient of one power of l over rho, at the part x of the cell. */
PATCH_INLINE struct helmholtz_jet helmholtz_across(const double *cells, int at, double x)
{
    return helmholtz_jet((struct helmholtz_six){cells[at], cells[at + 6], cells[at + 12], cells[at + 18],
                                                cells[at + 24], cells[at + 30]},
                         x);
}

/* a, a_r (per spacing) and a_rr/2 at one rho as polynomials over one cell of l. */
struct helmholtz_line {
    struct helmholtz_six a, r, rr;
};

PATCH_INLINE struct helmholtz_line helmholtz_line(const double *cells, int at, double x)
{
    struct helmholtz_jet k0 = helmholtz_across(cells, at, x), k1 = helmholtz_across(cells, at + 1, x);
    struct helmholtz_jet k2 = helmholtz_across(cells, at + 2, x), k3 = helmholtz_across(cells, at + 3, x);
    struct helmholtz_jet k4 = helmholtz_across(cells, at + 4, x), k5 = helmholtz_across(cells, at + 5, x);
    return (struct helmholtz_line){{k0.f0, k1.f0, k2.f0, k3.f0, k4.f0, k5.f0},
                                   {k0.f1, k1.f1, k2.f1, k3.f1, k4.f1, k5.f1},
                                   {k0.f2, k1.f2, k2.f2, k3.f2, k4.f2, k5.f2}};
}

/* Lower edge of the domain, ln T over rho (within the domain), and its slope. */
PATCH_INLINE double helmholtz_edge(const struct helmholtz_grid *grid, double rho, double *ret_slope)
{
    double at = (helmholtz_along(rho) - grid->edge_0) * grid->per_edge;
    int i = patch_cell(at, grid->last_edge);
    double per = HELMHOLTZ_SKEW > 0.0 ? grid->per_edge / (rho + HELMHOLTZ_SKEW) : grid->per_edge;
    double x = at - i, y = 1.0 - x, l = grid->edge[2 * i], m = grid->edge[2 * i + 1];
    double up = grid->edge[2 * i + 2], m_up = grid->edge[2 * i + 3];
    *ret_slope = (6.0 * x * y * (up - l) + y * (1.0 - 3.0 * x) * m + x * (3.0 * x - 2.0) * m_up) * per;
    return l * y * y * (1.0 + 2.0 * x) + up * x * x * (3.0 - 2.0 * x) + x * y * (y * m - x * m_up);
}

/* The same, without a table where it is an isotherm. */
PATCH_INLINE double helmholtz_cold(const struct helmholtz_grid *grid, double rho, double *ret_slope)
{
    *ret_slope = 0.0;
    return HELMHOLTZ_FLAT ? grid->l_low : helmholtz_edge(grid, rho, ret_slope);
}

#endif
