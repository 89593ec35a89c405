/* helmholtz_build.h - makes the table of helmholtz_grid.h for one fluid, in a block that all ranks of a machine fill
 * together: rows of one rank, or every so-and-so-many-th.
 *
 * Terms are products, so what depends on rho is computed once per row and what depends on T once per column. */
#ifndef HELMHOLTZ_BUILD_H
#define HELMHOLTZ_BUILD_H

#include "helmholtz_find.h"

/* Factors of all terms that depend on T, at all nodes: n x (n_term + 1) x HELMHOLTZ_L; the last is the ideal part. */
static void helmholtz_columns(const struct helmholtz_fluid *fluid, const struct helmholtz_grid *grid, double *ret_g)
{
    int m = fluid->n_term;
    for (int j = 0; j < grid->n; j++) {
        double theta = log(fluid->T_c) - (grid->l_0 + j * grid->step_l),
               *g = ret_g + (size_t)(j * (m + 1) * HELMHOLTZ_L);
        for (int k = 0; k < m; k++) helmholtz_thermal_part(&fluid->terms[k], theta, g + k * HELMHOLTZ_L);
        helmholtz_ideal_part(fluid, theta, g + m * HELMHOLTZ_L);
    }
}

/* Those that depend on rho, of one row: n_term x HELMHOLTZ_R. */
static void helmholtz_row_factors(const struct helmholtz_fluid *fluid, const struct helmholtz_grid *grid, int i,
                                  double *ret_f)
{
    double rho = grid->rho_0 + i * grid->step_rho, tiny = 1e-9 * fluid->rho_c;
    double delta = (rho > tiny ? rho : tiny) / fluid->rho_c;
    for (int k = 0; k < fluid->n_term; k++) helmholtz_density_part(&fluid->terms[k], delta, ret_f + k * HELMHOLTZ_R);
}

/* The node (i, j): a and its derivatives, scaled by the spacings. */
static void helmholtz_node(const struct helmholtz_law *law, const struct helmholtz_grid *grid, const double *f,
                           const double *all_g, int i, int j)
{
    const struct helmholtz_fluid *fluid = law->fluid;
    double phi[HELMHOLTZ_R][HELMHOLTZ_L] = {{0}}, a[HELMHOLTZ_R][HELMHOLTZ_L];
    double l = grid->l_0 + j * grid->step_l, rho = grid->rho_0 + i * grid->step_rho;
    int m = fluid->n_term;
    const double *g = all_g + (size_t)(j * (m + 1) * HELMHOLTZ_L);
    memcpy(phi[0], g + m * HELMHOLTZ_L, sizeof phi[0]);
    for (int k = 0; k < m; k++)
        for (int r = 0; r < HELMHOLTZ_R; r++)
            for (int t = 0; t < HELMHOLTZ_L; t++) phi[r][t] += f[k * HELMHOLTZ_R + r] * g[k * HELMHOLTZ_L + t];
    double delta = rho / fluid->rho_c;
    if (fluid->critical) fluid->critical(delta, log(fluid->T_c) - l, phi);
    if (!law->gas) {
        phi[0][0] += log(delta);
        phi[1][0] += 1.0 / delta;
        phi[2][0] -= 1.0 / (delta * delta);
    }
    helmholtz_energy(fluid, l, phi, a);
    double *node = grid->node + (size_t)(i * grid->n + j) * HELMHOLTZ_NODE, size_l = 1.0;
    for (int t = 0; t < 3; t++, size_l *= grid->step_l) {
        double size = size_l;
        for (int r = 0; r < 3; r++, size *= grid->step_rho) node[3 * t + r] = size * a[r][t];
    }
}

/* p/rho in row i at l, and its slope in l. */
static double helmholtz_row(const struct helmholtz_grid *grid, int gas, int i, double l, double *ret_slope)
{
    double up = (l - grid->l_0) * grid->per_l, rho = grid->rho_0 + i * grid->step_rho;
    int j = helmholtz_cell(up, grid->last_cell);
    const double *node = grid->node + (size_t)(i * grid->n + j) * HELMHOLTZ_NODE;
    struct helmholtz_six r =
        helmholtz_quintic((struct helmholtz_six){node[1], node[4], node[7], node[10], node[13], node[16]});
    double RT = gas ? grid->R * exp(l) : 0.0, scale = rho * grid->per_rho;
    *ret_slope = scale * helmholtz_slope(r, up - j) * grid->per_l + RT;
    return scale * helmholtz_value(r, up - j) + RT;
}

/* Starts of one row: from the upper end down, each from the one before. */
static void helmholtz_starts(const struct helmholtz_law *law, const struct helmholtz_grid *grid, int i)
{
    double unused, rho = grid->rho_0 + i * grid->step_rho, inside = rho > law->rho_low ? rho : law->rho_low;
    double low = law->gas ? grid->l_low : helmholtz_edge(grid, inside, &unused), l = grid->l_high;
    double least = helmholtz_row(grid, law->gas, i, low, &unused), most = helmholtz_row(grid, law->gas, i, l, &unused);
    double *start = grid->start + (size_t)(i * (HELMHOLTZ_STARTS + 1));
    grid->ends[2 * i] = least;
    grid->ends[2 * i + 1] = most;
    for (int k = HELMHOLTZ_STARTS; k >= 0; k--) {
        double y = (double)k / HELMHOLTZ_STARTS, target = least + y * y * (most - least), slope;
        for (int step = 0; step < 30; step++) {
            double off = helmholtz_row(grid, law->gas, i, l, &slope) - target, next = l - off / slope;
            next = next > low ? next : low;
            next = next < grid->l_high ? next : grid->l_high;
            double moved = fabs(next - l);
            l = next;
            if (moved < 1e-10) break;
        }
        start[k] = l;
    }
}

/* The lower edge, part by part: each point is the end of an iteration. */
static void helmholtz_edges(const struct helmholtz_law *law, const struct helmholtz_grid *grid, int part, int parts)
{
    double step = (law->rho_high - law->rho_low) / HELMHOLTZ_EDGES;
    for (int i = part; i <= HELMHOLTZ_EDGES; i += parts)
        grid->edge[2 * i] = log(law->T_low(law, law->rho_low + i * step));
}

static void helmholtz_edge_slopes(const struct helmholtz_grid *grid)
{
    for (int i = 0; i <= HELMHOLTZ_EDGES; i++) {
        int down = i > 0 ? i - 1 : 0, up = i < HELMHOLTZ_EDGES ? i + 1 : i;
        grid->edge[2 * i + 1] = (grid->edge[2 * up] - grid->edge[2 * down]) / (up - down);
    }
}

static size_t helmholtz_nodes(int n)
{
    return (size_t)n * (size_t)n * HELMHOLTZ_NODE;
}

/* What is behind the nodes, and the errors of HELMHOLTZ_SAMPLES states. */
static size_t helmholtz_bytes(int n)
{
    size_t rows = (size_t)n, starts = rows * (HELMHOLTZ_STARTS + 1), edges = 2 * (HELMHOLTZ_EDGES + 1);
    return (helmholtz_nodes(n) + 3 * rows + starts + edges + 2 * HELMHOLTZ_SAMPLES) * sizeof(double);
}

/* The grid whose numbers are in the block; l_low once the edges are there. */
static struct helmholtz_grid helmholtz_grid_in(const struct helmholtz_law *law, int n, double *block)
{
    struct helmholtz_grid grid = {.n = n, .node = block, .T = block + helmholtz_nodes(n)};
    grid.ends = grid.T + n;
    grid.start = grid.ends + 2 * n;
    grid.edge = grid.start + (size_t)n * (HELMHOLTZ_STARTS + 1);
    grid.misses = grid.edge + 2 * (HELMHOLTZ_EDGES + 1);
    grid.rho_0 = law->grid_rho;
    grid.last_cell = n - 2;
    grid.last_start = HELMHOLTZ_STARTS - 1;
    grid.last_edge = HELMHOLTZ_EDGES - 1;
    grid.step_rho = (law->rho_high - law->grid_rho) / (n - 1);
    grid.l_0 = log(law->grid_T);
    grid.step_l = log(law->grid_T_high / law->grid_T) / (n - 1);
    grid.per_rho = 1.0 / grid.step_rho;
    grid.per_l = 1.0 / grid.step_l;
    grid.l_high = log(law->T_high);
    grid.R = law->fluid->R;
    grid.edge_0 = law->rho_low;
    grid.per_edge = 1.0 / ((law->rho_high - law->rho_low) / HELMHOLTZ_EDGES);
    grid.l_low = grid.edge[0];
    return grid;
}

/* The nodes of the rows of a part. Non-zero: out of memory. */
static int helmholtz_rows_fill(const struct helmholtz_law *law, const struct helmholtz_grid *grid, int part, int parts)
{
    size_t terms = (size_t)law->fluid->n_term;
    double *f = malloc(terms * HELMHOLTZ_R * sizeof *f);
    double *g = malloc((size_t)grid->n * (terms + 1) * HELMHOLTZ_L * sizeof *g);
    bool good = f && g;
    if (good) helmholtz_columns(law->fluid, grid, g);
    for (int i = part; good && i < grid->n; i += parts) {
        helmholtz_row_factors(law->fluid, grid, i, f);
        for (int j = 0; j < grid->n; j++) helmholtz_node(law, grid, f, g, i, j);
    }
    free(f);
    free(g);
    return !good;
}

enum { HELMHOLTZ_MAKE_EDGES, HELMHOLTZ_MAKE_NODES, HELMHOLTZ_MAKE_STARTS, HELMHOLTZ_MAKE_PHASES };

/* One phase of one part. Non-zero: out of memory. */
static int helmholtz_build(const struct helmholtz_law *law, const struct helmholtz_grid *grid, unsigned phase, int part,
                           int parts)
{
    if (phase == HELMHOLTZ_MAKE_EDGES) helmholtz_edges(law, grid, part, parts);
    if (phase == HELMHOLTZ_MAKE_NODES && part == 0) {
        helmholtz_edge_slopes(grid);
        for (int j = 0; j < grid->n; j++) grid->T[j] = exp(grid->l_0 + j * grid->step_l);
    }
    if (phase == HELMHOLTZ_MAKE_NODES) return helmholtz_rows_fill(law, grid, part, parts);
    for (int i = part; phase == HELMHOLTZ_MAKE_STARTS && i < grid->n; i += parts) helmholtz_starts(law, grid, i);
    return 0;
}

#endif
