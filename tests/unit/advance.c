/* The length of steps: a tenth of what repeated steps have taken comes back with every good one, and a repeated step is
 * half as long as the one before. */
#include "flow.h"

static void start(struct flow *flow, const char *scheme)
{
    flow_start(flow,
               mem_print("bulla: 1\ntitle: steps\ndomain: {lower: [0], upper: [1], cells: [32], boundaries: {x-: "
                         "periodic, x+: periodic}}\nmaterials:\n" FLOW_AIR
                         "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e5, velocity: [30]}\n"
                         "scheme: {%s}\nrun: {until: 1}\n",
                         scheme));
}

static void test_recover(void **state)
{
    (void)state;
    static const char *const schemes[] = {"cfl: 0.5", "dt: 1 us"};
    for (int i = 0; i < 2; i++) {
        struct flow flow;
        start(&flow, schemes[i]);
        double whole = advance_dt(flow.state), wanted = 0.5;
        flow.state->dt_shrink = 0.5; /* as a repeated step leaves it */
        for (int step = 0; step < 12; step++) {
            assert_true(fabs(advance_dt(flow.state) / (whole * wanted) - 1.0) < 1e-12);
            flow_steps(&flow, 1);
            assert_true(fabs(flow.state->dt / (whole * wanted) - 1.0) < 1e-12);
            wanted = fmin(1.0, 1.1 * wanted);
        }
        assert_true(wanted == 1.0 && flow.state->dt_shrink == 1.0);
        flow_stop(&flow);
    }
}

static void set_parting(const struct model *model, const double x[3], double *w)
{
    w[model->i_u] = x[0] > 0.5 ? 1500.0 : -1500.0;
}

/* A fixed step far too long: every attempt is half as long as the last, and so is what is left for the steps after
 * it. */
static void test_halved(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, "dt: 400 us, limiter: superbee");
    flow_set(&flow, set_parting);
    flow_steps(&flow, 1);
    long long retries = flow.state->counts.retries;
    print_message("%lld retries, dt = %g s\n", retries, flow.state->dt);
    assert_true(retries > 0);
    assert_true(flow.state->dt == ldexp(400e-6, -(int)retries) && flow.state->t == flow.state->dt);
    assert_true(fabs(flow.state->dt_shrink / ldexp(1.1, -(int)retries) - 1.0) < 1e-15);
    flow_stop(&flow);
}

/* The signal is the sum over the axes of (|u| + c)/h. */
static void test_signal(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: signal\ndomain: {lower: [0, 0, 0], upper: [1, 2, 4], cells: [8, 8, 8], "
                         "boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: periodic, z-: periodic, z+: "
                         "periodic}}\nmaterials:\n" FLOW_AIR
                         "initial:\n  - {everywhere: true, material: air, density: 1.4, pressure: 1e4, velocity: "
                         "[-10, 20, 40]}\nscheme: {cfl: 0.5}\nrun: {until: 1}\n"));
    double wanted = 0.5 / ((10.0 + 100.0) * 8.0 + (20.0 + 100.0) * 4.0 + (40.0 + 100.0) * 2.0);
    assert_true(fabs(advance_dt(flow.state) / wanted - 1.0) < 1e-12);
    flow_steps(&flow, 1);
    assert_true(fabs(advance_dt(flow.state) / wanted - 1.0) < 1e-12);
    flow_stop(&flow);
}

/* dt of the first step, of gas at 100 m/s of sound in 8 x 8 cells of an eighth. */
static double plane(const char *materials, const char *more)
{
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: plane\ndomain: {lower: [0, 0], upper: [1, 1], cells: [8, 8], boundaries: "
                         "{x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}\nmaterials:\n" FLOW_AIR
                         "%sinitial:\n  - {everywhere: true, material: air, density: 1.4, pressure: 1e4}\n"
                         "%srun: {until: 1}\n",
                         materials, more));
    double dt = advance_dt(flow.state);
    flow_stop(&flow);
    return dt;
}

/* The default is 0.8 as soon as there are two axes, but for what wants short steps. Above 0.5 per axis runs begin with
 * a twentieth, unless told. */
static void test_default(void **state)
{
    (void)state;
    static const struct {
        const char *scheme;
        double cfl, first;
    } wanted[] = {{"exchange: auto", 0.4, 1.0},
                  {"cfl: 0.5", 0.5, 1.0},
                  {"cfl: 0.8", 0.8, 0.05},
                  {"cfl: 0.8, first-step: 0.3", 0.8, 0.3},
                  {"cfl: 0.2, first-step: 0.3", 0.2, 0.3}};
    const double signal = (30.0 + sqrt(1.4e5)) * 32.0;
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        struct flow flow;
        double dt = wanted[i].cfl / signal, part = wanted[i].first;
        start(&flow, wanted[i].scheme);
        for (int step = 0; step < 40; step++) {
            flow_steps(&flow, 1);
            assert_true(fabs(flow.state->dt / (part * dt) - 1.0) < 1e-12);
            part = fmin(1.0, 1.1 * part);
        }
        flow_stop(&flow);
    }
    static const struct {
        const char *materials, *more;
        double cfl;
    } planes[] = {{"", "", 0.8},
                  {FLOW_HELIUM, "scheme: {closure: allaire}\n", 0.4},
                  {"", "bodies: {ball: {sphere: {center: [0.5, 0.5], radius: 0.2}}}\n", 0.4},
                  {"  water: {eos: {type: nasg, preset: water-2016}}\n"
                   "  steam: {eos: {type: ideal-gas, preset: water-2016}}\n",
                   "phase-change: [{liquid: water, vapour: steam}]\n", 0.4}};
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++) {
        double dt = plane(planes[i].materials, planes[i].more);
        assert_true(fabs(dt / (planes[i].cfl / (2 * 100.0 * 8.0)) - 1.0) < 1e-12);
    }
}

/* dt before the first step, of gas at 100 m/s of sound in 8 x 8 cells of a quarter, with this boundary at x-. */
static double entered(const char *boundary, bool first)
{
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: jet\ndomain: {lower: [0, 0], upper: [2, 2], cells: [8, 8], boundaries: "
                         "{x-: {%s}, x+: outflow, y-: outflow, y+: outflow}}\nmaterials:\n" FLOW_AIR
                         "initial:\n  - {everywhere: true, material: air, density: 1.4, pressure: 1e4}\n"
                         "scheme: {cfl: 0.5, guard: strict}\nrun: {until: 1}\n",
                         boundary));
    if (!first) flow_steps(&flow, 3);
    double dt = advance_dt(flow.state);
    flow_stop(&flow);
    return dt;
}

/* What comes in through a boundary shortens the step before it is in any cell: else the guard would have to catch it.
 * Up to a quarter more is left to the cells. */
static void test_entering(void **state)
{
    (void)state;
    const char *jet = "type: inflow, material: air, density: 1.4, pressure: 1e4, velocity: ['= y > 1 and 1e4 or 0', 0]";
    const double rest = 0.5 / (2 * 100.0 * 4.0), driven = 0.5 / ((1e4 + 2 * 100.0) * 4.0);
    assert_true(fabs(entered(jet, true) / driven - 1.0) < 1e-12);
    assert_true(entered(jet, false) <= driven * (1.0 + 1e-12));
    assert_true(entered("type: inflow, material: air, density: 1.4, pressure: 1e4, velocity: [40, 0]", true) == rest);
    assert_true(entered("type: outflow", true) == rest);
    double wave = entered("type: incoming-wave, pulse: lithotripter, amplitude: 1e5", true);
    assert_true(wave < rest / 1.25);
}

/* Both halves of a finer level's step know their time: heat that grows with t, taken at midpoints, adds up exactly. */
static void test_time(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print(
                   "bulla: 1\ntitle: time\ndomain: {lower: [0], upper: [1], cells: [32], boundaries: {x-: periodic, "
                   "x+: periodic}}\nmesh: {levels: 1, tile: 8, refine: [{region: {box: {lower: [0], upper: "
                   "[1]}}}]}\nmaterials:\n" FLOW_AIR
                   "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e5}\n"
                   "sources: {heating: \"= 1e12 * t\"}\nscheme: {dt: 10 us}\nrun: {until: 1}\n"));
    flow_steps(&flow, 10);
    const struct mesh *mesh = flow.state->mesh;
    double t = flow.state->t, wanted = 1e5 + 0.4 * 0.5e12 * t * t;
    const double *p = mesh->levels[1].w[0] + flow.state->model->i_E * mesh->n_cell;
    print_message("p = %.9g Pa, should be %.9g\n", p[3], wanted);
    assert_int_equal(mesh->n_level, 2);
    assert_true(fabs(p[3] / wanted - 1.0) < 1e-12);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_recover), cmocka_unit_test(test_halved),
                                       cmocka_unit_test(test_signal),  cmocka_unit_test(test_time),
                                       cmocka_unit_test(test_default), cmocka_unit_test(test_entering)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
