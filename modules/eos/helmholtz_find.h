/* helmholtz_find.h - (rho, p) -> l in a table: the hot path of the laws that are given by a Helmholtz energy.
 *
 * One point: the cell of rho, a first l from the table of starts, the cell of l; then the 36 numbers of that cell become
 * three quintics in l (a, a_r and a_rr at this rho), and Newton steps, held inside the domain, find the root of p on
 * the second of them. How often is fixed, so a point costs the same anywhere and rows become vectors. Where the root
 * lies a little beyond the cell of the start its polynomials are continued: they agree with those next door to third
 * order. An infinity or NaN for p or rho ends in the first or last cell. */
#ifndef HELMHOLTZ_FIND_H
#define HELMHOLTZ_FIND_H

#include "helmholtz_grid.h"

/* exp(u) for small u > -0.1, to round-off */
HELMHOLTZ_INLINE double helmholtz_exp(double u)
{
    double high = 1.0 / 120.0 + u * (1.0 / 720.0 + u * (1.0 / 5040.0 + u * (1.0 / 40320.0)));
    return 1.0 + u * (1.0 + u * (0.5 + u * (1.0 / 6.0 + u * (1.0 / 24.0 + u * high))));
}

/* First guess of l: linear in rho and y between the rows of starts. */
HELMHOLTZ_INLINE double helmholtz_start(const struct helmholtz_grid *grid, int i, double x, double p_over_rho)
{
    const double *ends = grid->ends, *start = grid->start;
    double low = ends[2 * i], high = ends[2 * i + 1];
    low += x * (ends[2 * i + 2] - low);
    high += x * (ends[2 * i + 3] - high);
    double part = (p_over_rho - low) / (high - low);
    part = part > 0.0 ? part : 0.0;
    double at = sqrt(part) * (grid->last_start + 1.0);
    int k = helmholtz_cell(at, grid->last_start), row = i * (HELMHOLTZ_STARTS + 1) + k;
    double y = at - k, here = start[row] + y * (start[row + 1] - start[row]);
    double next = start[row + HELMHOLTZ_STARTS + 1];
    next += y * (start[row + HELMHOLTZ_STARTS + 2] - next);
    return here + x * (next - here);
}

/* The six data over rho of one datum in l: `node` is that datum at the lower rho, `next` at the upper one. */
HELMHOLTZ_INLINE struct helmholtz_six helmholtz_data(const double *node, int at, int next)
{
    return (struct helmholtz_six){node[at], node[at + 1], node[at + 2], node[next], node[next + 1], node[next + 2]};
}

/* a, a_r (per spacing) and a_rr at one rho as polynomials over one cell of l. */
struct helmholtz_line {
    struct helmholtz_six a, r, rr;
};

HELMHOLTZ_INLINE struct helmholtz_line helmholtz_line(const struct helmholtz_grid *grid, int i, int j, double x)
{
    const double *node = grid->node;
    int at = (i * grid->n + j) * HELMHOLTZ_NODE, up = at + grid->n * HELMHOLTZ_NODE;
    struct helmholtz_six f0 = helmholtz_data(node, at, up), f1 = helmholtz_data(node, at + 3, up + 3);
    struct helmholtz_six f2 = helmholtz_data(node, at + 6, up + 6), f3 = helmholtz_data(node, at + 9, up + 9);
    struct helmholtz_six f4 = helmholtz_data(node, at + 12, up + 12), f5 = helmholtz_data(node, at + 15, up + 15);
    struct helmholtz_six w = helmholtz_weights(x), s = helmholtz_slope_weights(x), c = helmholtz_curve_weights(x);
    struct helmholtz_six a = {helmholtz_dot(f0, w), helmholtz_dot(f1, w), helmholtz_dot(f2, w),
                              helmholtz_dot(f3, w), helmholtz_dot(f4, w), helmholtz_dot(f5, w)};
    struct helmholtz_six r = {helmholtz_dot(f0, s), helmholtz_dot(f1, s), helmholtz_dot(f2, s),
                              helmholtz_dot(f3, s), helmholtz_dot(f4, s), helmholtz_dot(f5, s)};
    struct helmholtz_six rr = {helmholtz_dot(f0, c), helmholtz_dot(f1, c), helmholtz_dot(f2, c),
                               helmholtz_dot(f3, c), helmholtz_dot(f4, c), helmholtz_dot(f5, c)};
    return (struct helmholtz_line){helmholtz_quintic(a), helmholtz_quintic(r), helmholtz_quintic(rr)};
}

/* What the polynomials say at z, in units of rho and l; T is that of the cell's lower node. */
HELMHOLTZ_INLINE struct helmholtz_spot helmholtz_spot(const struct helmholtz_grid *grid,
                                                      const struct helmholtz_line *line, int j, double z, double T)
{
    double l1 = grid->per_l, l2 = l1 * l1, r1 = grid->per_rho, r2 = r1 * r1;
    return (struct helmholtz_spot){
        .l = grid->l_0 + (j + z) * grid->step_l,
        .T = T * helmholtz_exp(z * grid->step_l),
        .a = helmholtz_value(line->a, z),
        .a_l = helmholtz_slope(line->a, z) * l1,
        .a_ll = helmholtz_curve(line->a, z) * l2,
        .a_lll = helmholtz_third(line->a, z) * (l2 * l1),
        .a_r = helmholtz_value(line->r, z) * r1,
        .a_rl = helmholtz_slope(line->r, z) * (r1 * l1),
        .a_rll = helmholtz_curve(line->r, z) * (r1 * l2),
        .a_rr = helmholtz_value(line->rr, z) * r2,
        .a_rrl = helmholtz_slope(line->rr, z) * (r2 * l1),
    };
}

/* A search in one cell: p(rho, l)/rho is a quintic r in z, and R T where the gas is kept apart. */
struct helmholtz_search {
    struct helmholtz_six r;
    double target, RT, step, low, high; /* p/rho, R T of the lower node (0: none), spacing of l, ends of the domain */
};

/* One Newton step, held within the domain. */
HELMHOLTZ_INLINE double helmholtz_step(const struct helmholtz_search *search, const int gas, double z)
{
    double RT = gas ? search->RT * helmholtz_exp(z * search->step) : 0.0;
    double off = helmholtz_value(search->r, z) + RT - search->target;
    double next = z - off / (helmholtz_slope(search->r, z) + RT * search->step);
    next = next > search->low ? next : search->low;
    return next < search->high ? next : search->high;
}

HELMHOLTZ_INLINE struct helmholtz_six helmholtz_scaled(struct helmholtz_six f, double by)
{
    return (struct helmholtz_six){f.c0 * by, f.c1 * by, f.c2 * by, f.c3 * by, f.c4 * by, f.c5 * by};
}

/* Where a search begins: cells i of rho and j of l, the part x of the first, l and the lower edge there with its slope. */
struct helmholtz_place {
    int i, j;
    double x, l, low, slope;
};

HELMHOLTZ_INLINE struct helmholtz_place helmholtz_place(const struct helmholtz_grid *grid, const int gas, double rho,
                                                        double p)
{
    double slope = 0.0, low = gas ? grid->l_low : helmholtz_edge(grid, rho, &slope);
    double at = (rho - grid->rho_0) * grid->per_rho;
    int i = helmholtz_cell(at, grid->last_cell);
    double l = helmholtz_start(grid, i, at - i, p / rho);
    l = l > low ? l : low;
    l = l < grid->l_high ? l : grid->l_high;
    int j = helmholtz_cell((l - grid->l_0) * grid->per_l, grid->last_cell);
    return (struct helmholtz_place){i, j, at - i, l, low, slope};
}

/* The Helmholtz energy where p(rho, l) = p, or on the edge of the domain where that lies outside. */
HELMHOLTZ_INLINE struct helmholtz_spot helmholtz_find(const struct helmholtz_grid *grid, const int gas, double rho,
                                                      double p, struct helmholtz_place place)
{
    struct helmholtz_line line = helmholtz_line(grid, place.i, place.j, place.x);
    double T = grid->T[place.j], up = (place.l - grid->l_0) * grid->per_l;
    struct helmholtz_search search = {.r = helmholtz_scaled(line.r, rho * grid->per_rho),
                                      .target = p / rho,
                                      .RT = grid->R * T,
                                      .step = grid->step_l,
                                      .low = (place.low - grid->l_0) * grid->per_l - place.j,
                                      .high = (grid->l_high - grid->l_0) * grid->per_l - place.j};
    /* the third step is in helmholtz_answer */
    double z = helmholtz_step(&search, gas, helmholtz_step(&search, gas, up - place.j));
    struct helmholtz_spot spot = helmholtz_spot(grid, &line, place.j, z, T);
    spot = gas ? helmholtz_with_gas(spot, rho, grid->R * spot.T) : spot;
    double here = rho * rho * spot.a_r;
    double below = p < here ? -1.0 : 0.0, above = p > here ? 1.0 : 0.0;
    below = z <= search.low ? below : 0.0;
    above = z >= search.high ? above : 0.0;
    spot.side = below + above;
    spot.slope = place.slope;
    return spot;
}

#endif
