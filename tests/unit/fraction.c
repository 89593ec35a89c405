/* Volume fractions: bounded, at sum 1, and of no background, in random violent runs of three and five materials. */
#include "flow.h"

static const char FIVE[] = FLOW_WATER FLOW_AIR FLOW_HELIUM
    "  oil: {eos: {type: stiffened-gas, gamma: 2.4, p-inf: 450 MPa}}\n  brine: {eos: {type: nasg}}\n";
static const char THREE[] = FLOW_WATER FLOW_AIR FLOW_HELIUM;

static uint64_t run_seed;

/* Blocks of 4 cells of one material or a mixture, at random pressures and velocities. */
static void set_blocks(const struct model *model, const double x[3], double *w)
{
    uint64_t seed = run_seed + 1000u * (uint64_t)floor(8.0 * x[0]) + 10u * (uint64_t)floor(8.0 * x[1]);
    double sum = 0.0;
    flow_random(&seed);
    unsigned whole = (unsigned)(flow_random(&seed) * model->n_material);
    bool mixed = flow_random(&seed) < 0.4;
    for (unsigned l = 0; l < model->n_material; l++) {
        double a = flow_random(&seed);
        w[l] = mixed ? a : l == whole ? 1.0 : 0.0;
        sum += w[l];
    }
    for (unsigned l = 0; l < model->n_material; l++) w[l] /= sum;
    for (unsigned q = model->i_u; q < model->i_E; q++) w[q] = 100.0 * (flow_random(&seed) - 0.5);
    w[model->i_E] = 1e5 * pow(1e3, flow_random(&seed));
}

static void check_fractions(const struct flow *flow)
{
    const struct model *model = flow->state->model;
    double *sum = mem_new(flow->n_cell, sizeof *sum);
    for (unsigned l = 0; l < model->n_material; l++) {
        double *alpha = flow_conserved(flow, l);
        for (size_t c = 0; c < flow->n_cell; c++) {
            if (!(alpha[c] >= 0.0 && alpha[c] <= 1.0))
                fail_msg("alpha of material %u is %.17g after step %ld", l, alpha[c], flow->state->step);
            sum[c] += alpha[c];
        }
        mem_free(alpha);
    }
    for (size_t c = 0; c < flow->n_cell; c++) assert_true(fabs(sum[c] - 1.0) <= 1e-14);
    mem_free(sum);
}

static void check_random(const char *materials, const char *scheme, const char *domain, uint64_t seed)
{
    struct flow flow;
    long double mass[5];
    double size;
    flow_start(&flow, mem_print("bulla: 1\ntitle: blocks\ndomain: {lower: [0, 0], upper: [1, 1], cells: [32, 32], %s}\n"
                                "materials:\n%sinitial:\n"
                                "  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}\n"
                                "scheme: %s\nrun: {until: 1}\n",
                                domain, materials, scheme));
    const struct model *model = flow.state->model;
    run_seed = seed;
    flow_set(&flow, set_blocks);
    for (unsigned l = 0; l < model->n_material; l++) mass[l] = flow_total(&flow, model->i_m + l, &size);
    for (int i = 0; i < 6; i++) {
        flow_steps(&flow, 10);
        check_fractions(&flow);
    }
    for (unsigned l = 0; l < model->n_material; l++)
        assert_true(fabsl(flow_total(&flow, model->i_m + l, &size) - mass[l]) <= 1e-13L * mass[l]);
    struct state_counts counts = flow.state->counts;
    print_message("%u materials, %s: relaxed %lld, fallback %lld, clipped %lld, retries %lld\n", model->n_material,
                  scheme, counts.relaxed, counts.fallback, counts.clipped, counts.retries);
    flow_stop(&flow);
}

static void test_random(void **state)
{
    (void)state;
    const char *box = "boundaries: {x-: periodic, x+: periodic, y-: reflecting, y+: reflecting}";
    check_random(THREE, "{limiter: mc}", box, 1);
    check_random(THREE, "{limiter: superbee, riemann: rusanov}", box, 2);
    check_random(THREE, "{limiter: minmod, riemann: hll}", box, 3);
    check_random(FIVE, "{limiter: mc}", box, 4);
    check_random(FIVE, "{limiter: superbee}", box, 5);
}

/* Seeds at which the relaxation of a cell with traces of the stiffest material once found nothing to give. */
static void test_random_round(void **state)
{
    (void)state;
    const char *round = "geometry: axisymmetric, boundaries: {x-: axis, x+: reflecting, y-: periodic, y+: periodic}";
    check_random(FIVE, "{limiter: minmod, riemann: hll}", round, 1007);
    check_random(FIVE, "{limiter: van-leer, riemann: rusanov}", round, 1013);
    check_random(FIVE, "{limiter: minmod, riemann: hll}", round, 1037);
}

/* Far from an interface there is exactly nothing of the other material, and the mass of gas is kept: a shock goes
 * over a bubble in water. */
static void test_no_background(void **state)
{
    (void)state;
    struct flow flow;
    double size;
    size_t clean = 0;
    flow_start(&flow, mem_print("bulla: 1\ntitle: bubble\ndomain: {lower: [0, 0], upper: [2, 2], cells: [64, 64], "
                                "boundaries: {x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}\n"
                                "materials:\n" FLOW_WATER FLOW_AIR "initial:\n"
                                "  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                                "  - {half-space: {point: [0.4, 0], normal: [1, 0]}, material: water, density: 1020, "
                                "pressure: 1e8}\n"
                                "  - {sphere: {center: [1, 1], radius: 0.25}, material: air, density: 1.2, pressure: "
                                "1e5}\nrun: {until: 1}\n"));
    const struct model *model = flow.state->model;
    long double mass = flow_total(&flow, model->i_m + 1, &size);
    flow_steps(&flow, 100);
    double *alpha = flow_primitive(&flow, 1), *stored = flow_conserved(&flow, 1);
    for (size_t c = 0; c < flow.n_cell; c++) {
        double x[3];
        flow_centre(&flow, c, x);
        if (hypot(x[0] - 1.0, x[1] - 1.0) < 0.75) continue; /* 16 cells from where the interface was */
        assert_true(alpha[c] == 0.0 && stored[c] == 0.0);
        clean++;
    }
    assert_true(clean > flow.n_cell / 2);
    assert_true(fabsl(flow_total(&flow, model->i_m + 1, &size) - mass) <= 1e-13L * mass);
    mem_free(alpha);
    mem_free(stored);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_random), cmocka_unit_test(test_random_round),
                                       cmocka_unit_test(test_no_background)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
