/* reconstruction.c - the contract of kind "reconstruction" (core/suite/contract_reconstruction.c) on every built-in
 * scheme; what weno5-z gives against its paper, its order, and what it does at a jump. */
#include "support.h"

#include "bulla/reconstruction.h"
#include "suite/contract_module.h"

enum { WIDTH = 5 };

static void test_contract(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        unsigned checks;
    } schemes[] = {{"muscl", 12}, {"weno5-z", 11}};
    for (size_t i = 0; i < sizeof schemes / sizeof *schemes; i++) {
        struct contract contract = {.module = support_module("reconstruction", schemes[i].name), .strict = true};
        assert_int_equal(contract_module_run(&contract, NULL), 0);
        support_holds(&contract);
        assert_true(contract.n_row == schemes[i].checks && contract.n_cost == 1);
        for (unsigned k = 0; k < contract.n_row; k++) assert_true(contract.rows[k].points > 0);
    }
}

/* Edges of the middle one of five cells, in a scene of one gas that has this density. */
static void weno(const double cells[WIDTH], double ret[2])
{
    static const double rest[WIDTH];
    const struct bulla_module *module = support_module("reconstruction", "weno5-z");
    const struct bulla_reconstruction *table = module->table;
    const struct bulla_value value = {.text = "limited"};
    double spare[2];
    void *self;
    const struct bulla_cells row = {.size = sizeof row,
                                    .n = 1,
                                    .step = 1,
                                    .n_row = 3,
                                    .n_rho = 1,
                                    .n_u = 1,
                                    .i_u = 1,
                                    .i_p = 2,
                                    .i_stretch = 3,
                                    .w = (const double *[]){cells + 2, rest + 2, rest + 2},
                                    .lower = (double *[]){&ret[0], &spare[0], &spare[0]},
                                    .upper = (double *[]){&ret[1], &spare[1], &spare[1]},
                                    .limited = (const struct bulla_limited *[]){NULL, NULL, NULL}};
    assert_int_equal(module->open(NULL, &value, &self), 0);
    table->all(self, &row);
    module->close(self);
}

/* The upper edge as the paper writes it: parabolas and indicators of the values, not of differences. */
static double textbook(const double *f)
{
    double q[3] = {(2 * f[0] - 7 * f[1] + 11 * f[2]) / 6, (-f[1] + 5 * f[2] + 2 * f[3]) / 6,
                   (2 * f[2] + 5 * f[3] - f[4]) / 6};
    double curve[3] = {f[0] - 2 * f[1] + f[2], f[1] - 2 * f[2] + f[3], f[2] - 2 * f[3] + f[4]};
    double slope[3] = {f[0] - 4 * f[1] + 3 * f[2], f[1] - f[3], 3 * f[2] - 4 * f[3] + f[4]};
    double beta[3], ideal[3] = {0.1, 0.6, 0.3}, sum = 0, value = 0;
    for (int k = 0; k < 3; k++) beta[k] = 13.0 / 12 * curve[k] * curve[k] + 0.25 * slope[k] * slope[k];
    double tau = fabs(beta[0] - beta[2]);
    for (int k = 0; k < 3; k++) {
        double weight = ideal[k] * (1 + pow(tau / (beta[k] + 1e-40), 2));
        sum += weight;
        value += weight * q[k];
    }
    return value / sum;
}

static void test_textbook(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 20000; i++) {
        double cells[WIDTH], turned[WIDTH], edges[2], most = 0;
        for (int k = 0; k < WIDTH; k++) {
            cells[k] = contract_random(&seed, -1.0, 1.0) * (i % 3 ? 1.0 : 1e6);
            turned[WIDTH - 1 - k] = cells[k];
            most = fmax(most, fabs(cells[k]));
        }
        weno(cells, edges);
        support_near("upper", edges[1], textbook(cells), 1e-13, most);
        support_near("lower", edges[0], textbook(turned), 1e-13, most);
    }
}

/* Means of sin over cells of width h about x, and the worst error of both edges. */
static double sine_error(double h)
{
    double worst = 0;
    for (double x = 0; x < 6.3; x += 0.01) {
        double cells[WIDTH], edges[2];
        for (int k = 0; k < WIDTH; k++) cells[k] = sin(x + (k - 2) * h) * sin(0.5 * h) / (0.5 * h);
        weno(cells, edges);
        worst = fmax(worst, fmax(fabs(edges[0] - sin(x - 0.5 * h)), fabs(edges[1] - sin(x + 0.5 * h))));
    }
    return worst;
}

/* Fifth order wherever the slope or the curvature vanishes, too. */
static void test_order(void **state)
{
    (void)state;
    for (double h = 0.2; h > 0.03; h *= 0.5) {
        double order = log2(sine_error(h) / sine_error(0.5 * h));
        if (!(order > 4.7)) fail_msg("order %.2f between cells of %g and %g", order, h, 0.5 * h);
    }
}

/* A jump two cells away does not reach the edges: they stay on the smooth side. */
static void test_jump(void **state)
{
    (void)state;
    static const double jumps[][WIDTH] = {{1, 1, 1, 1, 5}, {1, 1, 1, 5, 5}, {5, 5, 1, 1, 1}, {9, 1, 1, 1, 1}};
    for (size_t i = 0; i < sizeof jumps / sizeof *jumps; i++) {
        double edges[2];
        weno(jumps[i], edges);
        assert_true(edges[0] == 1 && edges[1] == 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_contract), cmocka_unit_test(test_textbook),
                                       cmocka_unit_test(test_order), cmocka_unit_test(test_jump)};
    return cmocka_run_group_tests(tests, support_start, support_stop);
}
