/* table_grid.h - states on a grid of rho and T as one potential: local biquintic Hermite interpolation of the Helmholtz
 * energy a = e - T s.
 *
 * Of a node a, a_T = -s and a_r = p/rho^2 are those of the file; the second and mixed derivatives are differences (five
 * points) of these along the grid. Pressure, energy, entropy and sound speed of one potential fit each other whatever
 * the table is like, p is continuously differentiable and c continuous; what does not fit in the file shows in c,
 * which is compared with its column. Spacings may vary.
 *
 * Values of a node, scaled by the spacings of a cell when it is used: [k_T][k_r] of a, k = 0..2. */
#ifndef TABLE_GRID_H
#define TABLE_GRID_H

#include "shared/continuation.h"
#include "table_file.h"

enum { TABLE_NODE = 9 };

/* The arrays lie behind each other in one block. */
struct table_grid {
    size_t n_rho, n_T;
    double *rho, *T, *node;
    double *misses;        /* largest relative difference between the potential's c and the file's */
    double e_zero, s_zero; /* taken off before a is made: a would lose their digits */
};

/* Weights of the derivative at x[at] of a function given at five x around it. */
static void table_grid_difference(const double *x, size_t n, size_t at, size_t *ret_first, double ret_weight[5])
{
    size_t first = at < 2 ? 0 : at - 2;
    first = first + 5 > n ? n - 5 : first;
    for (size_t j = 0; j < 5; j++) { /* derivative of Lagrange's polynomials */
        double sum = 0.0;
        for (size_t m = 0; m < 5; m++) {
            double product = 1.0;
            if (m == j) continue;
            for (size_t k = 0; k < 5; k++)
                if (k != j && k != m) product *= (x[at] - x[first + k]) / (x[first + j] - x[first + k]);
            sum += product / (x[first + j] - x[first + m]);
        }
        ret_weight[j] = sum;
    }
    *ret_first = first;
}

/* Fills value `to` of the nodes of one density with the derivative of value `from`, along rho or along T. */
static void table_grid_derive(const struct table_grid *grid, size_t i, int from, int to, int along_T)
{
    for (size_t j = 0; j < grid->n_T; j++) {
        double weight[5], sum = 0.0;
        size_t first;
        if (along_T) table_grid_difference(grid->T, grid->n_T, j, &first, weight);
        else table_grid_difference(grid->rho, grid->n_rho, i, &first, weight);
        for (size_t k = 0; k < 5; k++) {
            size_t node = along_T ? i * grid->n_T + first + k : (first + k) * grid->n_T + j;
            sum += weight[k] * grid->node[node * TABLE_NODE + (size_t)from];
        }
        grid->node[(i * grid->n_T + j) * TABLE_NODE + (size_t)to] = sum;
    }
}

/* Bytes of the block. */
static size_t table_grid_bytes(size_t n_rho, size_t n_T)
{
    return (n_rho + n_T + n_rho * n_T * TABLE_NODE + 1) * sizeof(double);
}

static struct table_grid table_grid_in(double *block, size_t n_rho, size_t n_T, const double zeros[2])
{
    double *node = block + n_rho + n_T, *misses = node + n_rho * n_T * TABLE_NODE;
    return (struct table_grid){n_rho, n_T, block, block + n_rho, node, misses, zeros[0], zeros[1]};
}

/* Phase 0 of filling: what is in the file. Order of the values of a node: a, a_r, a_rr, a_T, a_rT, a_rrT, a_TT, a_rTT,
 * a_rrTT. */
static void table_grid_states(const struct table_file *file, const struct table_grid *grid)
{
    for (size_t r = 0; r < file->n_row; r++) {
        const double *row = file->row[r];
        double *node = grid->node + r * TABLE_NODE, rho = row[TABLE_RHO];
        grid->rho[r / grid->n_T] = rho;
        grid->T[r % grid->n_T] = row[TABLE_T];
        node[0] = (row[TABLE_E] - grid->e_zero) - row[TABLE_T] * (row[TABLE_S] - grid->s_zero);
        node[1] = row[TABLE_P] / (rho * rho);
        node[3] = -(row[TABLE_S] - grid->s_zero);
    }
}

/* Phases 1 to 3: derivatives of what is there, of every `parts`-th density. */
static void table_grid_slopes(const struct table_grid *grid, unsigned phase, unsigned part, unsigned parts)
{
    for (size_t i = part; i < grid->n_rho; i += parts) {
        if (phase == 1) {
            table_grid_derive(grid, i, 1, 2, 0);
            table_grid_derive(grid, i, 1, 4, 1);
            table_grid_derive(grid, i, 3, 6, 1);
        } else if (phase == 2) {
            table_grid_derive(grid, i, 2, 5, 1);
            table_grid_derive(grid, i, 4, 7, 1);
        } else table_grid_derive(grid, i, 5, 8, 1);
    }
}

/* Six numbers: value, slope and curve at both ends, or a polynomial. */
struct table_six {
    double c[6];
};

/* Weights of the six data at x (0 to 1) in the value, slope or curve of the quintic; h: the length of the interval,
 * to whose powers the data and the result refer. */
static inline struct table_six table_grid_weights(double x, double h, int derivative)
{
    double y = 1.0 - x, xx = x * x, yy = y * y, per = 1.0 / h;
    if (derivative == 0)
        return (struct table_six){{yy * y * (1.0 + x * (3.0 + 6.0 * x)), h * yy * y * x * (1.0 + 3.0 * x),
                                   0.5 * h * h * yy * y * xx, xx * x * (1.0 + y * (3.0 + 6.0 * y)),
                                   -h * xx * x * y * (1.0 + 3.0 * y), 0.5 * h * h * xx * x * yy}};
    if (derivative == 1)
        return (struct table_six){{-30.0 * xx * yy * per, yy * (1.0 + x * (2.0 - 15.0 * x)),
                                   0.5 * h * yy * x * (2.0 - 5.0 * x), 30.0 * xx * yy * per,
                                   xx * (1.0 + y * (2.0 - 15.0 * y)), -0.5 * h * xx * y * (2.0 - 5.0 * y)}};
    double odd = 60.0 * x * y * (x - y) * per * per;
    return (struct table_six){{odd, -12.0 * x * y * (3.0 - 5.0 * x) * per, y * (1.0 + x * (10.0 * x - 8.0)), -odd,
                               12.0 * x * y * (3.0 - 5.0 * y) * per, x * (1.0 + y * (10.0 * y - 8.0))}};
}

static inline double table_grid_dot(struct table_six f, struct table_six w)
{
    double sum = 0.0;
    for (int k = 0; k < 6; k++) sum += f.c[k] * w.c[k];
    return sum;
}

/* Last index with x[index] <= at, at most n - 2; 0 if at is below or not a number. */
static inline size_t table_grid_cell(const double *x, size_t n, double at)
{
    size_t low = 0, high = n - 1;
    while (high - low > 1) {
        size_t mean = (low + high) / 2;
        if (x[mean] <= at) low = mean;
        else high = mean;
    }
    return low;
}

/* The derivatives of a in T (0, 1, 2) at a density and a node of temperature, by its weights of derivative `r` in rho.
 * Differences of a are formed before they are weighted: rounding must not shake what a search sees. */
static inline double table_grid_along(const struct table_grid *grid, size_t i, size_t j, int order,
                                      const struct table_six *w, int r)
{
    const double *low = grid->node + (i * grid->n_T + j) * TABLE_NODE + 3 * order;
    const double *high = low + grid->n_T * TABLE_NODE;
    struct table_six data = {{0.0, low[1], low[2], high[0] - low[0], high[1], high[2]}};
    return table_grid_dot(data, *w) + (r == 0 ? low[0] : 0.0);
}

/* One density: its cell and weights of a, a_r, a_rr. */
struct table_density {
    size_t i;
    double rho;
    struct table_six w[3];
};

static inline struct table_density table_grid_density(const struct table_grid *grid, double rho)
{
    size_t i = table_grid_cell(grid->rho, grid->n_rho, rho);
    double h = grid->rho[i + 1] - grid->rho[i], x = (rho - grid->rho[i]) / h;
    return (struct table_density){
        i, rho, {table_grid_weights(x, h, 0), table_grid_weights(x, h, 1), table_grid_weights(x, h, 2)}};
}

/* p at a density and a node of temperature. */
static inline double table_grid_node_p(const struct table_grid *grid, const struct table_density *at, size_t j)
{
    return at->rho * at->rho * table_grid_along(grid, at->i, j, 0, &at->w[1], 1);
}

/* A cell at one density: the data of a, a_r, a_rr at both of its temperatures. */
struct table_line {
    double T, h, e_zero, s_zero;
    struct table_six f[3];
};

static inline struct table_line table_grid_line(const struct table_grid *grid, const struct table_density *at, size_t j)
{
    struct table_line line = {.T = grid->T[j],
                              .h = grid->T[j + 1] - grid->T[j],
                              .e_zero = grid->e_zero,
                              .s_zero = grid->s_zero};
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 6; k++)
            line.f[r].c[k] = table_grid_along(grid, at->i, j + (size_t)(k / 3), k % 3, &at->w[r], r);
    double a = line.f[0].c[0], a_T = line.f[0].c[1]; /* what is linear in T is kept apart: it would round the rest */
    line.e_zero += a - line.T * a_T;
    line.s_zero -= a_T;
    line.f[0].c[0] = 0.0;
    line.f[0].c[1] = 0.0;
    line.f[0].c[3] = (line.f[0].c[3] - a) - line.h * a_T;
    line.f[0].c[4] -= a_T;
    return line;
}

/* The point of the potential at (density, T). */
static inline struct continuation_point table_grid_point(const struct table_line *line, double rho, double T,
                                                         double *ret_s)
{
    double x = (T - line->T) / line->h, square = rho * rho;
    struct table_six value = table_grid_weights(x, line->h, 0), slope = table_grid_weights(x, line->h, 1);
    struct table_six curve = table_grid_weights(x, line->h, 2);
    double a_T = table_grid_dot(line->f[0], slope), a_TT = table_grid_dot(line->f[0], curve);
    double a_r = table_grid_dot(line->f[1], value), a_rT = table_grid_dot(line->f[1], slope);
    double a_rTT = table_grid_dot(line->f[1], curve), a_rr = table_grid_dot(line->f[2], value);
    double a_rrT = table_grid_dot(line->f[2], slope), p_T = square * a_rT, cv = -T * a_TT, G = p_T / (rho * cv);
    double p_rT = 2.0 * rho * a_rT + square * a_rrT;
    *ret_s = line->s_zero - a_T;
    return (struct continuation_point){.p = square * a_r,
                                       .e = line->e_zero + (table_grid_dot(line->f[0], value) - T * a_T),
                                       .cv = cv,
                                       .G = G,
                                       .c2 = 2.0 * rho * a_r + square * a_rr + T * p_T * p_T / (square * cv),
                                       .stiffening = G + rho * p_rT / p_T + T * a_rTT * rho / cv};
}

#endif
