/* Steps of a finer level that fail are halved by that level alone, and what is conserved stays conserved: two streams
 * that part too fast, inside a refined region, and a fixed step too large for the finest level. */
#include "amr.h"

struct sums {
    long double total[FLOW_FIELDS];
    double size[FLOW_FIELDS];
};

static struct sums sums_of(const struct flow *flow)
{
    struct sums sums;
    for (unsigned q = 0; q < flow->state->model->n_field; q++) sums.total[q] = amr_total(flow, q, &sums.size[q]);
    return sums;
}

static void check_kept(const struct flow *flow, const struct sums *before)
{
    const struct model *model = flow->state->model;
    struct sums now = sums_of(flow);
    for (unsigned q = model->i_m; q < model->n_field; q++) {
        double off = (double)fabsl(now.total[q] - before->total[q]) / fmax(now.size[q], before->size[q]);
        print_message("  %s: relative drift %.1e\n", model->field_names[q], off);
        assert_true(off <= 1e-14);
    }
}

#define PERIODIC2 "x-: periodic, x+: periodic, y-: periodic, y+: periodic"

/* Streams part only within the refined region; the coarse cells of the outside never need repair. */
static char *parting(const char *domain, const char *velocity, const char *region, const char *subcycle)
{
    return mem_print(
        "bulla: 1\ntitle: parting\ndomain: %s\n"
        "mesh: {levels: 2, tile: 8, buffer: 6, subcycle: %s, refine: [{region: %s}]}\nmaterials:\n" FLOW_AIR
        "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e4, velocity: %s}\n"
        "scheme: {limiter: superbee, cfl: 0.9}\nrun: {until: 1}\n",
        domain, subcycle, region, velocity);
}

static void check_parting(char *text, const char *name, int steps)
{
    struct flow flow;
    flow_start(&flow, text);
    struct sums before = sums_of(&flow);
    flow_steps(&flow, steps);
    amr_print(&flow, name);
    assert_true(flow.state->counts.fallback > 0);
    check_kept(&flow, &before);
    flow_stop(&flow);
}

static void test_parting(void **state)
{
    (void)state;
    static const char *const subcycle[] = {"true", "false"};
    for (int i = 0; i < 2; i++)
        check_parting(parting("{lower: [-1], upper: [1], cells: [64], boundaries: {x-: periodic, x+: periodic}}",
                              "['= x > 0 and 1500 or -1500']", "{box: {lower: [-0.3], upper: [0.3]}}", subcycle[i]),
                      "line", 60);
    check_parting(parting("{lower: [-1, -1], upper: [1, 1], cells: [32, 32], boundaries: {" PERIODIC2 "}}",
                          "['= x > 0.1 and 1500 or -1500', '= y > 0.1 and 900 or -900']",
                          "{box: {lower: [-0.3, -0.2], upper: [0.3, 0.4]}}", "true"),
                  "plane", 30);
}

/* A blast within the region: its fixed step is fine for the coarse level, not for what happens on the finest. */
static void test_halved(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, mem_print("bulla: 1\ntitle: halved\n"
                                "domain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {" PERIODIC2 "}}\n"
                                "mesh: {levels: 2, tile: 8, refine: [{region: {box: {lower: [0.3, 0.3], upper: [0.7, "
                                "0.7]}}}]}\nmaterials:\n" FLOW_AIR "initial:\n"
                                "  - {everywhere: true, material: air, density: 1, pressure: 1e5}\n"
                                "  - {sphere: {center: [0.5, 0.5], radius: 0.07}, material: air, density: 1, pressure: "
                                "1e8}\nscheme: {dt: 3 us, limiter: superbee}\nrun: {until: 1}\n"));
    struct sums before = sums_of(&flow);
    flow_steps(&flow, 25);
    amr_print(&flow, "halved");
    assert_true(flow.state->counts.retries > 0);
    assert_true(fabs(flow.state->t / 75e-6 - 1.0) < 1e-12); /* level 0 took all its steps whole */
    check_kept(&flow, &before);
    flow_stop(&flow);
}

/* Liquid and gas at 1 GPa and 1 bar with the interface in the levels, steps that the guard relaxes and repeats. */
static void test_pair(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: pair\n"
                         "domain: {lower: [-1], upper: [1], cells: [64], boundaries: {x-: periodic, x+: periodic}}\n"
                         "mesh: {levels: 2, tile: 8, buffer: 6, refine: [{interface: air}]}\n"
                         "materials:\n" FLOW_WATER FLOW_AIR "initial:\n"
                         "  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: ['= x > "
                         "0 and 300 or -300']}\n"
                         "  - {box: {lower: [-0.05], upper: [0.11]}, material: air, density: 1, pressure: 1e5}\n"
                         "scheme: {limiter: superbee, cfl: 0.9}\nrun: {until: 1}\n"));
    struct sums before = sums_of(&flow);
    flow_steps(&flow, 100);
    amr_print(&flow, "pair");
    print_message("  %lld relaxed\n", flow.state->counts.relaxed);
    assert_true(flow.state->counts.relaxed > 0);
    assert_true(amr_fraction_fault(&flow) <= 1e-15 * 4);
    check_kept(&flow, &before);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_parting),
        cmocka_unit_test(test_halved),
        cmocka_unit_test(test_pair),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
