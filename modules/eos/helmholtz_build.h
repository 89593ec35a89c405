/* helmholtz_build.h - makes the table of helmholtz_grid.h for one fluid and keeps it for all its instances.
 *
 * Terms are products, so what depends on rho is computed once per row and what depends on T once per column; a table of
 * 256 x 256 takes some 20 ms. */
#ifndef HELMHOLTZ_BUILD_H
#define HELMHOLTZ_BUILD_H

#include "helmholtz_find.h"

/* Factors of all terms at the nodes of one coordinate. */
struct helmholtz_factors {
    double *f; /* n x n_term x HELMHOLTZ_R */
    double *g; /* n x (n_term + 1) x HELMHOLTZ_L; the last is the ideal part */
};

static void helmholtz_factors_fill(const struct helmholtz_law *law, const struct helmholtz_grid *grid,
                                   const struct helmholtz_factors *factors)
{
    const struct helmholtz_fluid *fluid = law->fluid;
    int m = fluid->n_term;
    for (int i = 0; i < grid->n; i++) {
        double rho = grid->rho_0 + i * grid->step_rho, tiny = 1e-9 * fluid->rho_c;
        double delta = (rho > tiny ? rho : tiny) / fluid->rho_c;
        double theta = log(fluid->T_c) - (grid->l_0 + i * grid->step_l);
        double *f = factors->f + (size_t)(i * m * HELMHOLTZ_R), *g = factors->g + (size_t)(i * (m + 1) * HELMHOLTZ_L);
        for (int k = 0; k < m; k++) {
            helmholtz_density_part(&fluid->terms[k], delta, f + k * HELMHOLTZ_R);
            helmholtz_thermal_part(&fluid->terms[k], theta, g + k * HELMHOLTZ_L);
        }
        helmholtz_ideal_part(fluid, theta, g + m * HELMHOLTZ_L);
    }
}

/* The node (i, j): a and its derivatives, scaled by the spacings. */
static void helmholtz_node(const struct helmholtz_law *law, const struct helmholtz_grid *grid,
                           const struct helmholtz_factors *factors, int i, int j)
{
    const struct helmholtz_fluid *fluid = law->fluid;
    double phi[HELMHOLTZ_R][HELMHOLTZ_L] = {{0}}, a[HELMHOLTZ_R][HELMHOLTZ_L];
    double l = grid->l_0 + j * grid->step_l, rho = grid->rho_0 + i * grid->step_rho;
    int m = fluid->n_term;
    const double *f = factors->f + (size_t)(i * m * HELMHOLTZ_R), *g = factors->g + (size_t)(j * (m + 1) * HELMHOLTZ_L);
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

static void helmholtz_edges(const struct helmholtz_law *law, struct helmholtz_grid *grid)
{
    double step = (law->rho_high - law->rho_low) / HELMHOLTZ_EDGES;
    grid->edge_0 = law->rho_low;
    grid->per_edge = 1.0 / step;
    for (int i = 0; i <= HELMHOLTZ_EDGES; i++) grid->edge[2 * i] = log(law->T_low(law, law->rho_low + i * step));
    for (int i = 0; i <= HELMHOLTZ_EDGES; i++) {
        int down = i > 0 ? i - 1 : 0, up = i < HELMHOLTZ_EDGES ? i + 1 : i;
        grid->edge[2 * i + 1] = (grid->edge[2 * up] - grid->edge[2 * down]) / (up - down);
    }
    grid->l_low = grid->edge[0];
}

static void helmholtz_grid_free(struct helmholtz_grid *grid)
{
    if (!grid) return;
    free(grid->node);
    free(grid);
}

/* All arrays in one block, `node` first. NULL: out of memory. */
static struct helmholtz_grid *helmholtz_grid_new(int n)
{
    size_t count = (size_t)n, starts = count * (HELMHOLTZ_STARTS + 1), edges = 2 * (HELMHOLTZ_EDGES + 1);
    size_t nodes = count * count * HELMHOLTZ_NODE;
    struct helmholtz_grid *grid = malloc(sizeof *grid);
    double *block = malloc((nodes + 3 * count + starts + edges) * sizeof *block);
    if (!grid || !block) {
        free(grid);
        free(block);
        return NULL;
    }
    *grid = (struct helmholtz_grid){.n = n, .node = block, .T = block + nodes};
    grid->ends = grid->T + count;
    grid->start = grid->ends + 2 * count;
    grid->edge = grid->start + starts;
    return grid;
}

/* NULL: out of memory. */
static struct helmholtz_grid *helmholtz_build(const struct helmholtz_law *law, int n)
{
    size_t rows = (size_t)n, terms = (size_t)law->fluid->n_term;
    struct helmholtz_grid *grid = helmholtz_grid_new(n);
    struct helmholtz_factors factors = {malloc(rows * terms * HELMHOLTZ_R * sizeof(double)),
                                        malloc(rows * (terms + 1) * HELMHOLTZ_L * sizeof(double))};
    if (grid && factors.f && factors.g) {
        grid->rho_0 = law->grid_rho;
        grid->last_cell = n - 2;
        grid->last_start = HELMHOLTZ_STARTS - 1;
        grid->last_edge = HELMHOLTZ_EDGES - 1;
        grid->step_rho = (law->rho_high - law->grid_rho) / (n - 1);
        grid->l_0 = log(law->grid_T);
        grid->step_l = log(law->grid_T_high / law->grid_T) / (n - 1);
        grid->per_rho = 1.0 / grid->step_rho;
        grid->per_l = 1.0 / grid->step_l;
        grid->l_high = log(law->T_high);
        grid->R = law->fluid->R;
        for (int j = 0; j < n; j++) grid->T[j] = exp(grid->l_0 + j * grid->step_l);
        helmholtz_edges(law, grid);
        helmholtz_factors_fill(law, grid, &factors);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) helmholtz_node(law, grid, &factors, i, j);
        for (int i = 0; i < n; i++) helmholtz_starts(law, grid, i);
    } else {
        helmholtz_grid_free(grid);
        grid = NULL;
    }
    free(factors.f);
    free(factors.g);
    return grid;
}

#endif
