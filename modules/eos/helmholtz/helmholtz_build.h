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
    double rho = helmholtz_band_rho(&grid->band, i), tiny = 1e-9 * fluid->rho_c;
    double delta = (rho > tiny ? rho : tiny) / fluid->rho_c;
    for (int k = 0; k < fluid->n_term; k++) helmholtz_density_part(&fluid->terms[k], delta, ret_f + k * HELMHOLTZ_R);
}

/* The node (i, j): a and its derivatives, [l][rho], scaled by the spacings. */
static void helmholtz_node(const struct helmholtz_law *law, const struct helmholtz_grid *grid, const double *f,
                           const double *all_g, int i, int j, double ret_node[HELMHOLTZ_NODE])
{
    const struct helmholtz_fluid *fluid = law->fluid;
    double phi[HELMHOLTZ_R][HELMHOLTZ_L] = {{0}}, a[HELMHOLTZ_R][HELMHOLTZ_L];
    double l = grid->l_0 + j * grid->step_l, rho = helmholtz_band_rho(&grid->band, i);
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
    double size_l = 1.0, stretch = HELMHOLTZ_SKEW > 0.0 ? rho + HELMHOLTZ_SKEW : 1.0;
    for (int t = 0; t < 3; t++, size_l *= grid->step_l) {
        double size = size_l;
        if (HELMHOLTZ_SKEW > 0.0) { /* from derivatives in rho to those in its logarithm */
            a[1][t] *= stretch;
            a[2][t] = a[2][t] * stretch * stretch + a[1][t];
        }
        for (int r = 0; r < 3; r++, size *= grid->band.step_rho) ret_node[3 * t + r] = size * a[r][t];
    }
}

/* Powers of x of the quintic with the given value and two derivatives at both ends. */
static void helmholtz_quintic(const double low[3], const double high[3], double ret_powers[6])
{
    double half = 0.5 * low[2], d0 = high[0] - (low[0] + low[1] + half), d1 = high[1] - (low[1] + low[2]);
    double d2 = high[2] - low[2];
    const double powers[6] = {low[0],
                              low[1],
                              half,
                              10.0 * d0 - 4.0 * d1 + 0.5 * d2,
                              7.0 * d1 - 15.0 * d0 - d2,
                              6.0 * d0 - 3.0 * d1 + 0.5 * d2};
    memcpy(ret_powers, powers, sizeof powers);
}

/* The polynomial of the cell between two nodes of one row and the same two of the next. */
static void helmholtz_cell_powers(const double *row, const double *next, double ret_cell[HELMHOLTZ_CELL])
{
    double along[2][3][6]; /* [end in l][derivative in l][power of rho] */
    for (int end = 0; end < 2; end++)
        for (int t = 0; t < 3; t++)
            helmholtz_quintic(row + HELMHOLTZ_NODE * end + 3 * t, next + HELMHOLTZ_NODE * end + 3 * t, along[end][t]);
    for (int m = 0; m < 6; m++)
        helmholtz_quintic((const double[3]){along[0][0][m], along[0][1][m], along[0][2][m]},
                          (const double[3]){along[1][0][m], along[1][1][m], along[1][2][m]}, ret_cell + 6 * m);
}

/* Rows per density; rho may be 0. */
static double helmholtz_row_per(const struct helmholtz_band *band, double rho)
{
    return HELMHOLTZ_SKEW > 0.0 ? band->per_rho / (rho + HELMHOLTZ_SKEW) : band->per_rho;
}

/* p/rho of the table in row i at l, and its slope in l. */
static double helmholtz_row_f(const struct helmholtz_grid *grid, int gas, int i, double l, double *ret_slope)
{
    double up = (l - grid->l_0) * grid->per_l, rho = helmholtz_band_rho(&grid->band, i);
    int j = patch_cell(up, grid->last_cell), row = i < grid->n - 1 ? i : i - 1;
    struct helmholtz_line line = helmholtz_line(grid->cell, helmholtz_grid_cell(grid, row, j), i - row);
    struct helmholtz_jet jet = helmholtz_jet(line.r, up - j);
    double RT = gas ? grid->R * exp(l) : 0.0, scale = rho * helmholtz_row_per(&grid->band, rho);
    *ret_slope = scale * jet.f1 * grid->per_l + RT;
    return scale * jet.f0 + RT;
}

/* Starts of one row: from the upper end down, each from the one before. */
static void helmholtz_starts(const struct helmholtz_law *law, const struct helmholtz_grid *grid, int i)
{
    double unused, rho = helmholtz_band_rho(&grid->band, i);
    double low = helmholtz_cold(grid, rho, &unused), l = grid->l_high;
    double f0 = helmholtz_band_node(&grid->band, i, 0), s = helmholtz_band_node(&grid->band, i, 1);
    double *start = grid->start + (size_t)(i * (HELMHOLTZ_STARTS + 1));
    for (int k = HELMHOLTZ_STARTS; k >= 0; k--) {
        double y = grid->steps.y_0 + k / grid->steps.per_y, target = f0 + y * y / s, slope;
        for (int step = 0; step < 30; step++) {
            double off = helmholtz_row_f(grid, law->gas, i, l, &slope) - target, next = l - off / slope;
            next = next > low ? next : low;
            next = next < grid->l_high ? next : grid->l_high;
            double moved = fabs(next - l);
            l = next;
            if (moved < 1e-10) break;
        }
        start[k] = l;
    }
}

/* p/rho at both ends of the domain, by the formulas, for rows of a band. */
static void helmholtz_ends_fill(const struct helmholtz_law *law, const struct helmholtz_grid *grid,
                                const struct helmholtz_band *band, int part, int parts)
{
    for (int i = part; i < band->n; i += parts) {
        double unused, tiny = 1e-9 * law->fluid->rho_c, rho = helmholtz_band_rho(band, i);
        rho = rho > tiny ? rho : tiny;
        double low = HELMHOLTZ_FLAT ? log(law->T_low(law, rho)) : helmholtz_edge(grid, rho, &unused);
        band->ends[2 * i] = rho * helmholtz_exact(law->fluid, law->gas, rho, low).a_r;
        band->ends[2 * i + 1] = rho * helmholtz_exact(law->fluid, law->gas, rho, grid->l_high).a_r;
    }
}

static void helmholtz_cubics_fill(const struct helmholtz_band *band, int part, int parts)
{
    for (int i = part; i < band->n - 1; i += parts) helmholtz_band_fill(band, i);
}

static size_t helmholtz_band_count(int n)
{
    return (size_t)(HELMHOLTZ_BAND + 2) * (size_t)n;
}

/* From the first row of densities to the last. */
static double helmholtz_span(const struct helmholtz_law *law)
{
    return helmholtz_along(law->rho_high) - helmholtz_along(law->rho_low);
}

/* A band of n rows over the densities of a law, whose numbers are in the block; bends rounded over `blur` kg/m3. */
static struct helmholtz_band helmholtz_band_in(const struct helmholtz_law *law, int n, double blur, double *block)
{
    double step = helmholtz_span(law) / (n - 1);
    return (struct helmholtz_band){.n = n,
                                   .rho_0 = helmholtz_along(law->rho_low),
                                   .per_rho = 1.0 / step,
                                   .step_rho = step,
                                   .last = n - 2,
                                   .blur = HELMHOLTZ_SKEW > 0.0 ? 0.0 : blur / step,
                                   .cubic = block,
                                   .ends = block + (size_t)HELMHOLTZ_BAND * (size_t)n};
}

/* The lower edge, part by part: each point is the end of an iteration. */
static void helmholtz_edges(const struct helmholtz_law *law, const struct helmholtz_grid *grid, int part, int parts)
{
    double step = helmholtz_span(law) / HELMHOLTZ_EDGES, first = helmholtz_along(law->rho_low);
    for (int i = part; i <= HELMHOLTZ_EDGES; i += parts)
        grid->edge[2 * i] = log(law->T_low(law, helmholtz_back(first + i * step)));
}

static void helmholtz_edge_slopes(const struct helmholtz_grid *grid)
{
    for (int i = 0; i <= HELMHOLTZ_EDGES; i++) {
        int down = i > 0 ? i - 1 : 0, up = i < HELMHOLTZ_EDGES ? i + 1 : i;
        grid->edge[2 * i + 1] = (grid->edge[2 * up] - grid->edge[2 * down]) / (up - down);
    }
}

static size_t helmholtz_cells(int n)
{
    return (size_t)(n - 1) * (size_t)(n - 1) * HELMHOLTZ_CELL;
}

/* How many numbers it has. */
static size_t helmholtz_grid_count(int n)
{
    size_t rows = (size_t)n, starts = rows * (HELMHOLTZ_STARTS + 1), edges = 2 * (HELMHOLTZ_EDGES + 1);
    return helmholtz_cells(n) + rows + helmholtz_band_count(n) + starts + edges;
}

/* The grid whose numbers are in the block; l_low once the edges are there. */
static struct helmholtz_grid helmholtz_grid_in(const struct helmholtz_law *law, int n, double *block)
{
    struct helmholtz_grid grid = {.n = n, .cell = block, .T = block + helmholtz_cells(n)};
    double *bands = grid.T + n;
    grid.band = helmholtz_band_in(law, n, 0.0, bands);
    grid.start = bands + helmholtz_band_count(n);
    grid.edge = grid.start + (size_t)n * (HELMHOLTZ_STARTS + 1);
    grid.last_cell = n - 2;
    grid.last_edge = HELMHOLTZ_EDGES - 1;
    grid.steps = helmholtz_steps_of(HELMHOLTZ_STARTS + 1);
    grid.l_0 = log(law->grid_T);
    grid.step_l = log(law->grid_T_high / law->grid_T) / (n - 1);
    grid.per_l = 1.0 / grid.step_l;
    grid.l_high = log(law->T_high);
    grid.R = law->fluid->R;
    grid.edge_0 = helmholtz_along(law->rho_low);
    grid.per_edge = 1.0 / (helmholtz_span(law) / HELMHOLTZ_EDGES);
    grid.l_low = grid.edge[0];
    return grid;
}

/* The cells of the rows of a part: rows that follow each other, so that nodes are made once. Non-zero: out of
 * memory. */
static int helmholtz_cells_fill(const struct helmholtz_law *law, const struct helmholtz_grid *grid, int part, int parts)
{
    size_t terms = (size_t)law->fluid->n_term, n = (size_t)grid->n;
    int first = (grid->n - 1) * part / parts, last = (grid->n - 1) * (part + 1) / parts;
    double *f = malloc(terms * HELMHOLTZ_R * sizeof *f), *g = malloc(n * (terms + 1) * HELMHOLTZ_L * sizeof *g);
    double *nodes = malloc(2 * n * HELMHOLTZ_NODE * sizeof *nodes);
    bool good = f && g && nodes;
    if (good) helmholtz_columns(law->fluid, grid, g);
    for (int i = first; good && i <= last; i++) {
        double *row = nodes + n * HELMHOLTZ_NODE * (size_t)(i & 1),
               *before = nodes + n * HELMHOLTZ_NODE * (size_t)(~i & 1);
        helmholtz_row_factors(law->fluid, grid, i, f);
        for (int j = 0; j < grid->n; j++) helmholtz_node(law, grid, f, g, i, j, row + HELMHOLTZ_NODE * j);
        for (int j = 0; i > first && j < grid->n - 1; j++)
            helmholtz_cell_powers(before + HELMHOLTZ_NODE * j, row + HELMHOLTZ_NODE * j,
                                  grid->cell + helmholtz_grid_cell(grid, i - 1, j));
    }
    free(f);
    free(g);
    free(nodes);
    return !good;
}

enum { HELMHOLTZ_MAKE_EDGES, HELMHOLTZ_MAKE_CELLS, HELMHOLTZ_MAKE_BAND, HELMHOLTZ_MAKE_STARTS, HELMHOLTZ_MAKE_PHASES };

/* One phase of one part. Non-zero: out of memory. */
static int helmholtz_build(const struct helmholtz_law *law, const struct helmholtz_grid *grid, unsigned phase, int part,
                           int parts)
{
    if (phase == HELMHOLTZ_MAKE_EDGES) helmholtz_edges(law, grid, part, parts);
    if (phase == HELMHOLTZ_MAKE_CELLS && part == 0) {
        helmholtz_edge_slopes(grid);
        for (int j = 0; j < grid->n; j++) grid->T[j] = exp(grid->l_0 + j * grid->step_l);
    }
    if (phase == HELMHOLTZ_MAKE_CELLS) return helmholtz_cells_fill(law, grid, part, parts);
    if (phase == HELMHOLTZ_MAKE_BAND) helmholtz_ends_fill(law, grid, &grid->band, part, parts);
    if (phase == HELMHOLTZ_MAKE_STARTS) helmholtz_cubics_fill(&grid->band, part, parts);
    for (int i = part; phase == HELMHOLTZ_MAKE_STARTS && i < grid->n; i += parts) helmholtz_starts(law, grid, i);
    return 0;
}

#endif
