/* The shock tube of Sod with levels: at a small threshold 128 cells and two levels have the error of 512 cells, with
 * fewer cells; a larger one leaves the rarefaction coarse. Errors of the density against exact averages over cells. */
#include "amr.h"

#include "judge/exact.h"

struct result {
    double error;
    long long cells; /* updated, both stages */
};

static struct result run(int cells, int levels, const char *above)
{
    struct flow flow;
    struct exact exact;
    struct result result = {0};
    const struct exact_side side[2] = {{.gamma = 1.4, .rho = 1, .p = 1}, {.gamma = 1.4, .rho = 0.125, .p = 0.1}};
    flow_start(&flow, mem_print("bulla: 1\ntitle: Sod\n"
                                "domain: {lower: [-0.5], upper: [0.5], cells: [%d], boundaries: {x-: outflow, x+: "
                                "outflow}}\n"
                                "mesh: {tile: 8, levels: %d, regrid-every: 2, buffer: 2, refine: [{jump: density, "
                                "above: %s}]}\nmaterials:\n" FLOW_AIR "initial:\n"
                                "  - {everywhere: true, material: air, density: 1, pressure: 1}\n"
                                "  - {box: {lower: [0], upper: [1]}, material: air, density: 0.125, pressure: 0.1}\n"
                                "scheme: {cfl: 0.4}\nrun: {until: 0.2}\n",
                                cells, levels, above));
    flow_until(&flow, 0.2);
    if (exact_solve(side, &exact)) fail_msg("%s", status_text());
    struct amr_leaves leaves = amr_leaves(&flow);
    for (size_t i = 0; i < leaves.n; i++) {
        double half = 0.5 * leaves.all[i].volume, wanted[EXACT_VALUES];
        exact_average(&exact, 0.2, leaves.all[i].x[0] - half, leaves.all[i].x[0] + half, wanted);
        result.error += leaves.all[i].volume * fabs(amr_conserved(&flow, &leaves.all[i], 0) - wanted[EXACT_RHO]);
    }
    result.cells = flow.state->counts.cells;
    print_message("%d cells, %d levels, %s: error %.3e, %lld cell-stages\n", cells, levels, above, result.error,
                  result.cells);
    mem_free(leaves.all);
    flow_stop(&flow);
    return result;
}

static void test_threshold(void **state)
{
    (void)state;
    struct result fine = run(512, 0, "1 kg/m3"), small = run(128, 2, "0.005 kg/m3"), medium = run(128, 2, "0.02 kg/m3"),
                  large = run(128, 2, "0.1 kg/m3");
    assert_true(fabs(small.error / fine.error - 1.0) <= 0.02);
    assert_true(fabs(medium.error / fine.error - 1.0) <= 0.02);
    assert_true(2 * small.cells < fine.cells && 3 * medium.cells < fine.cells);
    assert_true(large.error > 1.1 * fine.error && large.error < run(128, 0, "1 kg/m3").error);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_threshold)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
