/* helmholtz_find.h - (rho, p) -> l in a table: the hot path of the laws that are given by a Helmholtz energy.
 *
 * One point: its row of densities and its y (helmholtz_band.h), a first l from the table of starts, good to some 1e-5,
 * the cell of that l. The polynomial of the cell becomes three quintics in l (a, a_r and a_rr at this rho); one step of
 * third order on the second of them finds the root of p, and helmholtz_state.h takes up the rest. No iteration: a point
 * costs the same anywhere and rows become vectors. Where the root lies a little beyond the cell of the start
 * its polynomials are continued: they agree with those next door to third order. An infinity or NaN for p or rho ends
 * in the first or last cell. */
#ifndef HELMHOLTZ_FIND_H
#define HELMHOLTZ_FIND_H

#include "helmholtz_grid.h"

/* exp(u) for small u > -0.1, to round-off */
PATCH_INLINE double helmholtz_exp(double u)
{
    double high = 1.0 / 120.0 + u * (1.0 / 720.0 + u * (1.0 / 5040.0 + u * (1.0 / 40320.0)));
    return 1.0 + u * (1.0 + u * (0.5 + u * (1.0 / 6.0 + u * (1.0 / 24.0 + u * high))));
}

/* Where a search begins: the cell j of l, and where in it. */
struct helmholtz_start {
    int j;
    double z;
};

/* Linear in rho and y between the rows of starts: l in intervals of the table. */
PATCH_INLINE double helmholtz_start_at(const struct helmholtz_grid *grid, struct helmholtz_row row,
                                       struct helmholtz_rung rung)
{
    const double *start = grid->start;
    int at = row.i * (HELMHOLTZ_STARTS + 1) + rung.k, up = at + HELMHOLTZ_STARTS + 1;
    double here = start[at] + rung.t * (start[at + 1] - start[at]);
    double next = start[up] + rung.t * (start[up + 1] - start[up]);
    return (here + row.x * (next - here) - grid->l_0) * grid->per_l;
}

PATCH_INLINE struct helmholtz_start helmholtz_start(const struct helmholtz_grid *grid, double at)
{
    int j = patch_cell(at, grid->last_cell);
    return (struct helmholtz_start){j, at - j};
}

/* What the polynomials say at z, in units of rho and l; T is that of the cell's lower node. */
PATCH_INLINE struct helmholtz_spot helmholtz_spot(const struct helmholtz_grid *grid, const struct helmholtz_line *line,
                                                  int j, double z, double T, double per_rho)
{
    double l1 = grid->per_l, l2 = 2.0 * l1 * l1, l3 = 3.0 * l2 * l1, r1 = helmholtz_band_per(&grid->band, per_rho);
    double r2 = 2.0 * r1 * r1, fall = helmholtz_band_fall(per_rho) * r1;
    struct helmholtz_jet a = helmholtz_jet(line->a, z), r = helmholtz_jet(line->r, z), rr = helmholtz_jet(line->rr, z);
    struct helmholtz_spot spot = {
        .l = grid->l_0 + (j + z) * grid->step_l,
        .T = T * helmholtz_exp(z * grid->step_l),
        .a = a.f0,
        .a_l = a.f1 * l1,
        .a_ll = a.f2 * l2,
        .a_lll = a.f3 * l3,
        .a_r = r.f0 * r1,
        .a_rl = r.f1 * (r1 * l1),
        .a_rll = r.f2 * (r1 * l2),
        .a_rr = rr.f0 * r2,
        .a_rrl = rr.f1 * (r2 * l1),
    };
    if (HELMHOLTZ_SKEW > 0.0) {
        spot.a_rr -= fall * r.f0;
        spot.a_rrl -= fall * (r.f1 * l1);
    }
    return spot;
}

/* A search in one cell: p/rho^2 = a_r is a quintic r in z (per spacing of rho), and R T/rho where the gas is kept
 * apart. */
struct helmholtz_search {
    struct helmholtz_six r;
    double target, RT, step; /* p/rho^2, R T/rho of the lower node (0: none), spacing of l */
};

/* One Newton step, and what the curvature adds to it; little, unless the root lies far beyond an edge. */
PATCH_INLINE double helmholtz_step(const struct helmholtz_search *search, const int gas, const int inside, double z)
{
    double RT = gas ? search->RT * helmholtz_exp(z * search->step) : 0.0, RT_z = RT * search->step;
    struct helmholtz_jet r = helmholtz_jet(search->r, z);
    double per = 1.0 / (r.f1 + RT_z), step = (search->target - RT - r.f0) * per;
    double bend = step * per * (r.f2 + 0.5 * RT_z * search->step);
    if (!inside) {
        bend = bend < 0.5 ? bend : 0.5;
        bend = bend > -0.5 ? bend : -0.5;
    }
    return z + step * (1.0 - bend);
}

/* Density per row. */
PATCH_INLINE double helmholtz_find_scale(const struct helmholtz_band *band, double rho)
{
    return HELMHOLTZ_SKEW > 0.0 ? band->step_rho * (rho + HELMHOLTZ_SKEW) : band->step_rho;
}

/* The Helmholtz energy where p(rho, l) = p, or on the edge of the domain where that lies outside. `inside` (a constant
 * in loops): it lies well inside. */
PATCH_INLINE struct helmholtz_spot helmholtz_find(const struct helmholtz_grid *grid, const int gas, const int inside,
                                                  struct helmholtz_row row, struct helmholtz_level level,
                                                  struct helmholtz_start start, double rho)
{
    double low = 0.0, high = 0.0, slope = 0.0, edge = inside ? 0.0 : helmholtz_cold(grid, rho, &slope);
    if (!inside && HELMHOLTZ_SKEW > 0.0) { /* its edge is steep: a search that is held there has the cell of the edge */
        struct helmholtz_start held = helmholtz_start(grid, (edge - grid->l_0) * grid->per_l);
        start.j = level.q < HELMHOLTZ_NEAR ? held.j : start.j;
        start.z = level.q < HELMHOLTZ_NEAR ? held.z : start.z;
    }
    struct helmholtz_line line = helmholtz_line(grid->cell, helmholtz_grid_cell(grid, row.i, start.j), row.x);
    double T = grid->T[start.j], z = start.z;
    double per = helmholtz_find_scale(&grid->band, rho) * level.per_rho;
    struct helmholtz_search search = {line.r, level.f * per, gas ? grid->R * T * per : 0.0, grid->step_l};
    if (!inside) { /* away from an edge it is moved out of the way */
        double free = level.q < HELMHOLTZ_NEAR ? 0.0 : 1e6, free_up = level.q > HELMHOLTZ_FAR ? 0.0 : 1e6;
        low = (edge - grid->l_0) * grid->per_l - start.j - free;
        high = (grid->l_high - grid->l_0) * grid->per_l - start.j + free_up;
        z = z > low ? z : low;
        z = z < high ? z : high;
    }
    z = helmholtz_step(&search, gas, inside, z);
    if (!inside) { /* the start may be worse on the edge: once more */
        z = z > low ? z : low;
        z = z < high ? z : high;
        double again = helmholtz_step(&search, gas, 0, z);
        again = again > low ? again : low;
        again = again < high ? again : high;
        z = level.q < HELMHOLTZ_NEAR ? again : z;
    }
    struct helmholtz_spot spot = helmholtz_spot(grid, &line, start.j, z, T, level.per_rho);
    spot = gas ? helmholtz_with_gas(spot, level.per_rho, grid->R * spot.T) : spot;
    double off = level.f * level.per_rho - spot.a_r, below = off < 0.0 ? -1.0 : 0.0, above = off > 0.0 ? 1.0 : 0.0;
    below = z <= low ? below : 0.0;
    above = z >= high ? above : 0.0;
    spot.side = inside ? 0.0 : below + above;
    spot.slope = slope;
    return spot;
}

#endif
