/* contract_limiter.c - see contract_limiter.h. The region is Sweby's (SIAM J. Numer. Anal. 21 (1984)
 * 995-1011): no slope at extremes, at most twice the smaller difference, so that no face value
 * leaves the range of the neighbours. A limiter with two sides is asked for the edges of cells of value 0, whose
 * differences are those drawn, to the bit. */
#include "suite/contract_limiter.h"

#include "bulla/limiter.h"
#include "plug/vet.h"
#include "suite/contract_batch.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LIMITER_PAIRS = 20000, LIMITER_ROW = 41, LIMITER_PITCH = 9 };

static double contract_limiter_slope(const struct contract *contract, double a, double b)
{
    const struct bulla_limiter *limiter = contract->module->table;
    double value = NAN;
    limiter->slope(contract->self, 1, &a, &b, &value);
    return value;
}

/* Differences of all sizes and signs. */
static double contract_limiter_draw(uint64_t *seed)
{
    double size = pow(10.0, contract_random(seed, -12.0, 12.0));
    return contract_random(seed, 0.0, 1.0) < 0.5 ? -size : size;
}

static double contract_limiter_least(double a, double b)
{
    return fabs(a) < fabs(b) ? fabs(a) : fabs(b);
}

/* Opposite signs or a zero: no slope. Else the same sign, and at most twice the smaller one. */
static void contract_limiter_region(struct contract *contract, double a, double b)
{
    double value = contract_limiter_slope(contract, a, b), most = 2.0 * contract_limiter_least(a, b);
    if ((a > 0.0) != (b > 0.0) || most == 0.0) {
        contract_begin(contract, "no slope at an extreme or beside a zero", 0.0);
        contract_error(contract, value != 0.0, "slope(%.9g, %.9g) = %.9g", a, b, value);
        return;
    }
    contract_begin(contract, "0 <= slope/d <= 2 for the smaller difference d", 0.0);
    contract_error(contract, !(value * copysign(1.0, a) >= 0.0 && fabs(value) <= most), "slope(%.9g, %.9g) = %.9g", a,
                   b, value);
}

static void contract_limiter_pairs(struct contract *contract)
{
    uint64_t seed = 2;
    for (int i = 0; i < LIMITER_PAIRS; i++) {
        double a = contract_limiter_draw(&seed),
               b = i % 2 ? contract_limiter_draw(&seed) : a * contract_random(&seed, -3.0, 3.0);
        contract_limiter_region(contract, a, b);
    }
    static const double ends[] = {0.0, -0.0, 5e-324, 1e-310, 1e-200, 1.0, 3.0, -3.0, 1e200, 8e307};
    enum { COUNT = sizeof ends / sizeof *ends };
    for (int i = 0; i < COUNT * COUNT; i++) contract_limiter_region(contract, ends[i / COUNT], ends[i % COUNT]);
}

static void contract_limiter_symmetry(struct contract *contract)
{
    uint64_t seed = 3;
    for (int i = 0; i < LIMITER_PAIRS; i++) {
        double a = contract_limiter_draw(&seed), b = a * contract_random(&seed, -1.0, 4.0);
        double value = contract_limiter_slope(contract, a, b), size = contract_limiter_least(a, b);
        char where[64];
        snprintf(where, sizeof where, "slope at (%.9g, %.9g)", a, b);
        contract_begin(contract, "odd: slope(-a, -b) = -slope(a, b), bitwise", 0.0);
        contract_holds(contract, contract_limiter_slope(contract, -a, -b) == -value, where);
        contract_begin(contract, "symmetric: slope(b, a) = slope(a, b)", contract->strict ? 0.0 : 1e-14);
        contract_near(contract, contract_limiter_slope(contract, b, a), value, size, where);
        double k = pow(10.0, contract_random(&seed, -9.0, 9.0));
        contract_begin(contract, "homogeneous: slope(k a, k b) = k slope(a, b)", 1e-13);
        contract_near(contract, contract_limiter_slope(contract, k * a, k * b), k * value, k * size, where);
        snprintf(where, sizeof where, "slope at (%.9g, %.9g)", a, a);
        contract_begin(contract, "equal differences are the slope (second order)", contract->strict ? 0.0 : 1e-14);
        contract_near(contract, contract_limiter_slope(contract, a, a), a, fabs(a), where);
    }
}

/* The values at both edges of cells, along rows and across them: bitwise what the slope gives. */
static void contract_limiter_edges(struct contract *contract)
{
    const struct bulla_limiter *limiter = contract->module->table;
    contract_begin(contract, "edges are w -+ slope/2, bitwise", 0.0);
    if (!limiter->edges) return;
    uint64_t seed = 6;
    double w[LIMITER_ROW + 2 * LIMITER_PITCH], lower[LIMITER_ROW], upper[LIMITER_ROW];
    for (size_t i = 0; i < sizeof w / sizeof *w; i++) w[i] = contract_limiter_draw(&seed);
    for (size_t step = 1; step <= LIMITER_PITCH; step += LIMITER_PITCH - 1)
        for (size_t n = LIMITER_ROW; n > LIMITER_ROW - 9; n--) {
            limiter->edges(contract->self, n, step, w + LIMITER_PITCH, lower, upper);
            for (size_t i = 0; i < n; i++) {
                const double *here = w + LIMITER_PITCH + i;
                double half = 0.5 * contract_limiter_slope(contract, *here - *(here - step), *(here + step) - *here);
                contract_begin(contract, "edges are w -+ slope/2, bitwise", 0.0);
                contract_error(contract, !(lower[i] == *here - half && upper[i] == *here + half),
                               "cell %zu of %zu, step %zu: %.17g to %.17g", i, n, step, lower[i], upper[i]);
            }
        }
}

/* The edges of a cell of value 0 between -below and above. */
struct limiter_edges {
    double lower, upper;
};

static struct limiter_edges contract_limiter_sides(const struct contract *contract, double below, double above)
{
    const struct bulla_limiter *limiter = contract->module->table;
    const double w[3] = {-below, 0.0, above};
    struct limiter_edges edges = {NAN, NAN};
    limiter->edges(contract->self, 1, 1, w + 1, &edges.lower, &edges.upper);
    return edges;
}

/* Opposite signs or a zero: no step. Else towards the neighbour, and no further. */
static void contract_limiter_between(struct contract *contract, double below, double above)
{
    struct limiter_edges edges = contract_limiter_sides(contract, below, above);
    double sign = copysign(1.0, below), down = -sign * edges.lower, up = sign * edges.upper;
    if ((below > 0.0) != (above > 0.0) || below * sign == 0.0 || above == 0.0) {
        contract_begin(contract, "both edges are the cell's value at an extreme or beside a zero", 0.0);
        contract_error(contract, !(down == 0.0 && up == 0.0), "edges(%.9g, %.9g) = %.9g, %.9g", below, above,
                       edges.lower, edges.upper);
        return;
    }
    contract_begin(contract, "an edge lies between its cell and the neighbour of its side", 0.0);
    contract_error(contract, !(down >= 0.0 && down <= fabs(below) && up >= 0.0 && up <= fabs(above)),
                   "edges(%.9g, %.9g) = %.9g, %.9g", below, above, edges.lower, edges.upper);
}

static void contract_limiter_turned(struct contract *contract, double below, double above, double k)
{
    struct limiter_edges edges = contract_limiter_sides(contract, below, above);
    struct limiter_edges odd = contract_limiter_sides(contract, -below, -above);
    struct limiter_edges back = contract_limiter_sides(contract, -above, -below);
    struct limiter_edges scaled = contract_limiter_sides(contract, k * below, k * above);
    double size = k * (fabs(below) + fabs(above));
    char where[64];
    snprintf(where, sizeof where, "edges at (%.9g, %.9g)", below, above);
    contract_begin(contract, "odd: edges(-w) = -edges(w), bitwise", 0.0);
    contract_holds(contract, odd.lower == -edges.lower && odd.upper == -edges.upper, where);
    contract_begin(contract, "mirrored cells have mirrored edges, bitwise", 0.0);
    contract_holds(contract, back.lower == edges.upper && back.upper == edges.lower, where);
    contract_begin(contract, "homogeneous: edges(k w) = k edges(w)", 1e-13);
    contract_near(contract, scaled.lower, k * edges.lower, size, where);
    contract_near(contract, scaled.upper, k * edges.upper, size, where);
}

/* Rows along and across: bitwise the edges of their cells alone. */
static void contract_limiter_rows(struct contract *contract)
{
    const struct bulla_limiter *limiter = contract->module->table;
    uint64_t seed = 6;
    double w[LIMITER_ROW + 2 * LIMITER_PITCH], lower[LIMITER_ROW], upper[LIMITER_ROW], at[2];
    for (size_t i = 0; i < sizeof w / sizeof *w; i++) w[i] = contract_limiter_draw(&seed);
    contract_begin(contract, "edges of a row are those of its cells, bitwise", 0.0);
    for (size_t step = 1; step <= LIMITER_PITCH; step += LIMITER_PITCH - 1) {
        limiter->edges(contract->self, LIMITER_ROW, step, w + LIMITER_PITCH, lower, upper);
        for (size_t i = 0; i < LIMITER_ROW; i++) {
            const double *here = w + LIMITER_PITCH + i, alone[3] = {*(here - step), *here, here[step]};
            limiter->edges(contract->self, 1, 1, alone + 1, at, at + 1);
            contract_error(contract, !(lower[i] == at[0] && upper[i] == at[1]), "cell %zu, step %zu: %.17g to %.17g", i,
                           step, lower[i], upper[i]);
        }
    }
}

/* Sizes at which products overflow are no values of a flow: up to their square roots. */
static void contract_limiter_two_sided(struct contract *contract)
{
    static const double ends[] = {0.0, -0.0, 5e-324, 1e-310, 1e-200, 1.0, 3.0, -3.0, 1e150, 8e307};
    enum { COUNT = sizeof ends / sizeof *ends };
    uint64_t seed = 2;
    for (int i = 0; i < LIMITER_PAIRS; i++) {
        double a = contract_limiter_draw(&seed), k = pow(10.0, contract_random(&seed, -9.0, 9.0));
        double b = i % 2 ? contract_limiter_draw(&seed) : a * contract_random(&seed, -1.0, 4.0);
        contract_limiter_between(contract, a, b);
        contract_limiter_turned(contract, a, b, k);
    }
    for (int i = 0; i < COUNT * COUNT; i++) contract_limiter_between(contract, ends[i / COUNT], ends[i % COUNT]);
    contract_limiter_rows(contract);
}

/* The functions as rows. */

static void contract_limiter_run_slope(const struct contract *contract, const struct contract_call *call, size_t n,
                                       const double *const *in, double *const *out)
{
    const struct bulla_limiter *limiter = contract->module->table;
    (void)call;
    limiter->slope(contract->self, n, in[0], in[1], out[0]);
}

/* Three rows below each other are an array with the step n. */
static void contract_limiter_run_edges(const struct contract *contract, const struct contract_call *call, size_t n,
                                       const double *const *in, double *const *out)
{
    const struct bulla_limiter *limiter = contract->module->table;
    static double rows[3 * 512];
    (void)call;
    for (size_t k = 0; k < 3; k++) memcpy(rows + k * n, in[k], n * sizeof *rows);
    limiter->edges(contract->self, n, n, rows + n, out[0], out[1]);
}

static void contract_limiter_draw_row(const struct contract *contract, const struct contract_call *call, uint64_t *seed,
                                      double *in)
{
    (void)contract;
    in[0] = contract_limiter_draw(seed);
    for (unsigned k = 1; k < call->n_in; k++) in[k] = in[0] * contract_random(seed, -1.0, 4.0);
}

void contract_limiter_run(struct contract *contract)
{
    const struct bulla_limiter *limiter = contract->module->table;
    const struct contract_call slope = {"slope", 2, 1, contract_limiter_run_slope, contract_limiter_draw_row, NULL};
    const struct contract_call edges = {"edges", 3, 2, contract_limiter_run_edges, contract_limiter_draw_row, NULL};
    if (vet_two_sided(limiter)) {
        contract_doing(contract, "edges of both sides");
        contract_limiter_two_sided(contract);
        contract_batch_run(contract, &edges);
        return;
    }
    contract_doing(contract, "slopes of pairs");
    contract_limiter_pairs(contract);
    contract_doing(contract, "symmetries of slopes");
    contract_limiter_symmetry(contract);
    contract_doing(contract, "edges");
    contract_limiter_edges(contract);
    contract_batch_run(contract, &slope);
    if (limiter->edges) contract_batch_run(contract, &edges);
}

void contract_limiter_probe(const struct contract *contract, double out[static CONTRACT_PROBE])
{
    if (vet_two_sided(contract->module->table)) {
        struct limiter_edges edges = contract_limiter_sides(contract, 1.0, 3.0);
        out[0] = edges.lower;
        out[1] = edges.upper;
        return;
    }
    out[0] = contract_limiter_slope(contract, 1.0, 3.0);
    out[1] = contract_limiter_slope(contract, 2.0, 2.2);
}
