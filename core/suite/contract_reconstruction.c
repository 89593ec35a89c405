/* contract_reconstruction.c - see contract_reconstruction.h.
 *
 * A stencil is what the edges of one cell may depend on: a few cells of all components of two materials in two
 * dimensions. Schemes of one component are called once per row of it, so that all schemes go through the same
 * checks. */
#include "suite/contract_reconstruction.h"

#include "bulla/reconstruction.h"
#include "suite/contract_batch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Rows: two fractions, two densities, two velocities (the row is along the first), the pressure. */
enum {
    RECONSTRUCTION_ALPHAS = 2,
    RECONSTRUCTION_U = 4,
    RECONSTRUCTION_P = 6,
    RECONSTRUCTION_ROWS = 7,
    RECONSTRUCTION_REACH = 2,
    RECONSTRUCTION_WIDTH = 2 * RECONSTRUCTION_REACH + 1,
    RECONSTRUCTION_TRIES = 4000,
    RECONSTRUCTION_POINTS = 512
};

struct reconstruction_stencil {
    double w[RECONSTRUCTION_ROWS][RECONSTRUCTION_WIDTH]; /* the cell is the middle one */
};

struct reconstruction_edges {
    double at[2][RECONSTRUCTION_ROWS]; /* lower, upper */
};

/* Minmod: the slopes that a scheme may ask for here. */
static void contract_reconstruction_limited(const struct bulla_limited *limited, size_t n, size_t step, const double *w,
                                            double *BULLA_RESTRICT lower, double *BULLA_RESTRICT upper)
{
    (void)limited;
    for (size_t i = 0; i < n; i++) {
        double here = w[i], a = here - *(w + i - step), b = w[i + step] - here;
        double half = a * b > 0.0 ? 0.5 * (fabs(a) < fabs(b) ? a : b) : 0.0;
        lower[i] = here - half;
        upper[i] = here + half;
    }
}

static const struct bulla_limited contract_reconstruction_slopes = {.size = sizeof contract_reconstruction_slopes,
                                                                    .edges = contract_reconstruction_limited};

static const struct bulla_reconstruction *contract_reconstruction_table(const struct contract *contract)
{
    return contract->module->table;
}

/* n cells of all rows. */
static void contract_reconstruction_call(const struct contract *contract, size_t n, size_t step, const double *const *w,
                                         double *const *lower, double *const *upper)
{
    const struct bulla_reconstruction *table = contract_reconstruction_table(contract);
    const struct bulla_limited *limited[RECONSTRUCTION_ROWS];
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++) limited[q] = &contract_reconstruction_slopes;
    const struct bulla_cells cells = {.size = sizeof cells,
                                      .n = n,
                                      .step = step,
                                      .n_row = RECONSTRUCTION_ROWS,
                                      .n_alpha = RECONSTRUCTION_ALPHAS,
                                      .n_rho = RECONSTRUCTION_U - RECONSTRUCTION_ALPHAS,
                                      .n_u = RECONSTRUCTION_P - RECONSTRUCTION_U,
                                      .i_rho = RECONSTRUCTION_ALPHAS,
                                      .i_u = RECONSTRUCTION_U,
                                      .i_p = RECONSTRUCTION_P,
                                      .i_stretch = RECONSTRUCTION_ROWS,
                                      .w = w,
                                      .lower = lower,
                                      .upper = upper,
                                      .limited = limited};
    if (table->all) table->all(contract->self, &cells);
    for (int q = 0; q < RECONSTRUCTION_ROWS && !table->all; q++)
        table->edges(contract->self, limited[q], n, step, w[q], lower[q], upper[q]);
}

/* The edges of one cell, with `beyond` in all cells that must not be looked at. */
static struct reconstruction_edges contract_reconstruction_ask(const struct contract *contract,
                                                               const struct reconstruction_stencil *stencil,
                                                               double beyond)
{
    double rows[RECONSTRUCTION_ROWS][RECONSTRUCTION_WIDTH + 2], *edge[2][RECONSTRUCTION_ROWS];
    const double *w[RECONSTRUCTION_ROWS];
    struct reconstruction_edges edges;
    int reach = (int)contract_reconstruction_table(contract)->layers - 1, middle = RECONSTRUCTION_REACH + 1;
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++) {
        for (int i = 0; i < RECONSTRUCTION_WIDTH + 2; i++) rows[q][i] = beyond;
        for (int i = 0; i < 2 * reach + 1; i++)
            rows[q][middle - reach + i] = stencil->w[q][RECONSTRUCTION_REACH - reach + i];
        w[q] = &rows[q][middle];
        for (int side = 0; side < 2; side++) {
            edges.at[side][q] = (double)NAN;
            edge[side][q] = &edges.at[side][q];
        }
    }
    contract_reconstruction_call(contract, 1, 1, w, edge[0], edge[1]);
    return edges;
}

static struct reconstruction_edges contract_reconstruction_of(const struct contract *contract,
                                                              const struct reconstruction_stencil *stencil)
{
    return contract_reconstruction_ask(contract, stencil, 1.0);
}

/* Size of a row: of what is compared in it. */
static double contract_reconstruction_size(const struct reconstruction_stencil *stencil, int q)
{
    double most = 1e-300;
    for (int i = 0; i < RECONSTRUCTION_WIDTH; i++) most = fabs(stencil->w[q][i]) > most ? fabs(stencil->w[q][i]) : most;
    return most;
}

static double contract_reconstruction_sign(uint64_t *seed)
{
    return contract_random(seed, 0.0, 1.0) < 0.5 ? -1.0 : 1.0;
}

/* Cells of a mixture: fractions that sum to 1, densities and pressures of all sizes, velocities of both signs. */
static void contract_reconstruction_draw_cells(uint64_t *seed, struct reconstruction_stencil *ret)
{
    double size[RECONSTRUCTION_ROWS], spread = pow(10.0, contract_random(seed, -6.0, 0.0));
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++) size[q] = pow(10.0, contract_random(seed, -3.0, 9.0));
    for (int i = 0; i < RECONSTRUCTION_WIDTH; i++) {
        ret->w[0][i] = contract_random(seed, 0.0, 1.0) < 0.2 ? 1.0 : contract_random(seed, 0.0, 1.0);
        ret->w[1][i] = 1.0 - ret->w[0][i];
        for (int q = RECONSTRUCTION_ALPHAS; q < RECONSTRUCTION_ROWS; q++) {
            bool velocity = q >= RECONSTRUCTION_U && q < RECONSTRUCTION_P;
            ret->w[q][i] = size[q] * (1.0 + spread * contract_random(seed, -0.9, 0.9));
            if (velocity) ret->w[q][i] *= contract_reconstruction_sign(seed);
        }
    }
}

static void contract_reconstruction_where(const struct reconstruction_stencil *stencil, int q, size_t room, char *where)
{
    const double *w = stencil->w[q];
    snprintf(where, room, "row %d of cells %.6g %.6g %.6g %.6g %.6g", q, w[0], w[1], w[2], w[3], w[4]);
}

/* One row of edges against what they should be. */
static void contract_reconstruction_near(struct contract *contract, const struct reconstruction_stencil *stencil, int q,
                                         const double got[2], double lower, double upper)
{
    char where[CONTRACT_WHERE];
    contract_reconstruction_where(stencil, q, sizeof where, where);
    contract_near(contract, got[0], lower, contract_reconstruction_size(stencil, q), where);
    contract_near(contract, got[1], upper, contract_reconstruction_size(stencil, q), where);
}

static void contract_reconstruction_equal(struct contract *contract, const struct reconstruction_stencil *drawn)
{
    struct reconstruction_stencil flat;
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++)
        for (int i = 0; i < RECONSTRUCTION_WIDTH; i++) flat.w[q][i] = drawn->w[q][0];
    struct reconstruction_edges edges = contract_reconstruction_of(contract, &flat);
    contract_begin(contract, "equal cells have edges that are their value, bitwise", 0.0);
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++)
        contract_reconstruction_near(contract, &flat, q, (double[]){edges.at[0][q], edges.at[1][q]}, flat.w[q][0],
                                     flat.w[q][0]);
}

/* Schemes that sharpen interfaces need not leave lines of fractions as they are. */
static void contract_reconstruction_line(struct contract *contract, const struct reconstruction_stencil *drawn)
{
    struct reconstruction_stencil line;
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++)
        for (int i = 0; i < RECONSTRUCTION_WIDTH; i++)
            line.w[q][i] = drawn->w[q][0] + (i - RECONSTRUCTION_REACH) * 0.1 * (drawn->w[q][1] - drawn->w[q][0]);
    struct reconstruction_edges edges = contract_reconstruction_of(contract, &line);
    contract_begin(contract, "edges of a straight line lie on it", 1e-13);
    for (int q = contract_reconstruction_table(contract)->all ? RECONSTRUCTION_ALPHAS : 0; q < RECONSTRUCTION_ROWS;
         q++) {
        double half = 0.05 * (drawn->w[q][1] - drawn->w[q][0]), here = line.w[q][RECONSTRUCTION_REACH];
        contract_reconstruction_near(contract, &line, q, (double[]){edges.at[0][q], edges.at[1][q]}, here - half,
                                     here + half);
    }
}

static void contract_reconstruction_mirror(struct contract *contract, const struct reconstruction_stencil *drawn)
{
    struct reconstruction_stencil turned;
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++)
        for (int i = 0; i < RECONSTRUCTION_WIDTH; i++)
            turned.w[q][i] = (q == RECONSTRUCTION_U ? -1.0 : 1.0) * drawn->w[q][RECONSTRUCTION_WIDTH - 1 - i];
    struct reconstruction_edges one = contract_reconstruction_of(contract, drawn),
                                two = contract_reconstruction_of(contract, &turned);
    contract_begin(contract, "mirrored cells have mirrored edges, bitwise", 0.0);
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++) {
        double sign = q == RECONSTRUCTION_U ? -1.0 : 1.0;
        contract_reconstruction_near(contract, &turned, q, (double[]){two.at[0][q], two.at[1][q]}, sign * one.at[1][q],
                                     sign * one.at[0][q]);
    }
}

/* What lies too far away is a number here and none there. */
static void contract_reconstruction_reach(struct contract *contract, const struct reconstruction_stencil *drawn)
{
    struct reconstruction_edges one = contract_reconstruction_of(contract, drawn);
    struct reconstruction_edges two = contract_reconstruction_ask(contract, drawn, (double)NAN);
    contract_begin(contract, "cells further away than layers - 1 are not looked at", 0.0);
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++)
        contract_reconstruction_near(contract, drawn, q, (double[]){two.at[0][q], two.at[1][q]}, one.at[0][q],
                                     one.at[1][q]);
}

static void contract_reconstruction_units(struct contract *contract, const struct reconstruction_stencil *drawn,
                                          uint64_t *seed)
{
    struct reconstruction_stencil scaled = *drawn;
    double unit[RECONSTRUCTION_ROWS];
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++) {
        unit[q] = q < RECONSTRUCTION_ALPHAS ? 1.0 : ldexp(1.0, (int)contract_random(seed, -20.0, 20.0));
        for (int i = 0; i < RECONSTRUCTION_WIDTH; i++) scaled.w[q][i] *= unit[q];
    }
    struct reconstruction_edges one = contract_reconstruction_of(contract, drawn),
                                two = contract_reconstruction_of(contract, &scaled);
    contract_begin(contract, "units do not matter: edges(k w) = k edges(w)", 1e-12);
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++)
        contract_reconstruction_near(contract, &scaled, q, (double[]){two.at[0][q], two.at[1][q]},
                                     unit[q] * one.at[0][q], unit[q] * one.at[1][q]);
}

/* No further from the cell than the nearer neighbour, on the side of its own neighbour, and fractions that fill a cell
 * do so at its edges. */
static void contract_reconstruction_bounds(struct contract *contract, const struct reconstruction_stencil *drawn)
{
    if (!contract_reconstruction_table(contract)->bounded) return;
    struct reconstruction_edges edges = contract_reconstruction_of(contract, drawn);
    contract_begin(contract, "bounded: edges no further away than the nearer neighbour", 4e-16);
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++) {
        const double *w = drawn->w[q] + RECONSTRUCTION_REACH;
        double a = w[0] - w[-1], b = w[1] - w[0], most = a * b > 0.0 ? (fabs(a) < fabs(b) ? fabs(a) : fabs(b)) : 0.0;
        char where[CONTRACT_WHERE];
        contract_reconstruction_where(drawn, q, sizeof where, where);
        for (int side = 0; side < 2; side++) {
            double away = (side ? 1.0 : -1.0) * copysign(1.0, b) * (edges.at[side][q] - w[0]);
            double excess = away < 0.0 ? -away : away > most ? away - most : away >= 0.0 ? 0.0 : (double)NAN;
            contract_error(contract, excess / contract_reconstruction_size(drawn, q), "%s: edge %.9g", where,
                           edges.at[side][q]);
        }
    }
    contract_begin(contract, "bounded: fractions of two materials sum to 1 at edges", 4e-16);
    for (int side = 0; side < 2; side++)
        contract_near(contract, edges.at[side][0] + edges.at[side][1], 1.0, 1.0, side ? "upper" : "lower");
}

/* Worst error of the edges of an exponential, cells of width h, relative. */
static double contract_reconstruction_error(const struct contract *contract, double h)
{
    struct reconstruction_stencil wave;
    double worst = 0.0, mean = sinh(0.5 * h) / (0.5 * h);
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++)
        for (int i = 0; i < RECONSTRUCTION_WIDTH; i++)
            wave.w[q][i] = q < RECONSTRUCTION_ALPHAS ? 0.5 : exp((i - RECONSTRUCTION_REACH) * h) * mean;
    struct reconstruction_edges edges = contract_reconstruction_of(contract, &wave);
    for (int q = RECONSTRUCTION_ALPHAS; q < RECONSTRUCTION_ROWS; q++)
        for (int side = 0; side < 2; side++) {
            double error = fabs(edges.at[side][q] - exp((side ? 0.5 : -0.5) * h));
            worst = error > worst ? error : worst;
        }
    return worst;
}

static void contract_reconstruction_order(struct contract *contract)
{
    contract_begin(contract, "edges of a smooth row: second order or more", 0.0);
    for (double h = 0.2; h > 0.04; h *= 0.5) {
        double order =
            log2(contract_reconstruction_error(contract, h) / contract_reconstruction_error(contract, 0.5 * h));
        contract_error(contract, !(order >= 1.8), "order %.2f between cells of %g and %g", order, h, 0.5 * h);
    }
}

/* Stencils as inputs of points; rows below each other are an array whose step is their length. */
static void contract_reconstruction_rows_run(const struct contract *contract, const struct contract_call *call,
                                             size_t n, const double *const *in, double *const *out)
{
    static double rows[RECONSTRUCTION_ROWS][RECONSTRUCTION_WIDTH * RECONSTRUCTION_POINTS];
    const double *w[RECONSTRUCTION_ROWS];
    (void)call;
    for (int q = 0; q < RECONSTRUCTION_ROWS; q++) {
        for (int i = 0; i < RECONSTRUCTION_WIDTH; i++)
            memcpy(rows[q] + (size_t)i * n, in[q * RECONSTRUCTION_WIDTH + i], n * sizeof **rows);
        w[q] = rows[q] + RECONSTRUCTION_REACH * n;
    }
    contract_reconstruction_call(contract, n, n, w, out, out + RECONSTRUCTION_ROWS);
}

static void contract_reconstruction_draw(const struct contract *contract, const struct contract_call *call,
                                         uint64_t *seed, double *in)
{
    struct reconstruction_stencil stencil;
    (void)contract;
    (void)call;
    contract_reconstruction_draw_cells(seed, &stencil);
    memcpy(in, &stencil, sizeof stencil);
}

void contract_reconstruction_run(struct contract *contract)
{
    const struct bulla_reconstruction *table = contract_reconstruction_table(contract);
    const struct contract_call call = {table->all ? "all" : "edges", RECONSTRUCTION_ROWS * RECONSTRUCTION_WIDTH,
                                       2 * RECONSTRUCTION_ROWS,      contract_reconstruction_rows_run,
                                       contract_reconstruction_draw, NULL};
    uint64_t seed = 5;
    contract_doing(contract, "edges of cells");
    for (int i = 0; i < RECONSTRUCTION_TRIES; i++) {
        struct reconstruction_stencil stencil;
        contract_reconstruction_draw_cells(&seed, &stencil);
        contract_reconstruction_equal(contract, &stencil);
        contract_reconstruction_line(contract, &stencil);
        contract_reconstruction_mirror(contract, &stencil);
        contract_reconstruction_reach(contract, &stencil);
        contract_reconstruction_units(contract, &stencil, &seed);
        contract_reconstruction_bounds(contract, &stencil);
    }
    contract_doing(contract, "smooth rows");
    contract_reconstruction_order(contract);
    contract_batch_run(contract, &call);
    contract_fact(contract, "looks at two cells on each side", table->layers == 3);
    contract_fact(contract, "promises bounds", table->bounded);
}

void contract_reconstruction_probe(const struct contract *contract, double out[static CONTRACT_PROBE])
{
    uint64_t seed = 7;
    struct reconstruction_stencil stencil;
    contract_reconstruction_draw_cells(&seed, &stencil);
    struct reconstruction_edges edges = contract_reconstruction_of(contract, &stencil);
    for (int i = 0; i < CONTRACT_PROBE; i++) out[i] = edges.at[1][2 * i];
}
