/* Heat that flows: what laws say of it, order, walls, steps short enough; and what has another temperature is not at
 * rest. */
#include "conduction.h"

#include "scheme/conduction.h"
#include "solve/census.h"

/* What laws say of heat: rho cv by differences. */
static void test_facts(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, "lower: [0], upper: [8 um], cells: [8], boundaries: {x-: reflecting, x+: reflecting}", "", WATER AIR,
          "cfl: 0.4");
    struct conduction_facts water = conduction_facts(flow.state->model, 0),
                            air = conduction_facts(flow.state->model, 1);
    assert_true(fabs(water.rho_cv / (rho_water(298.15) * CV_WATER) - 1.0) < 1e-3);
    assert_true(fabs(air.rho_cv / (rho_air(298.15) * CV_AIR) - 1.0) < 1e-3);
    assert_true(fabs(water.cp / (4.4 * CV_WATER) - 1.0) < 1e-3 && water.k == K_WATER);
    assert_true(fabs(air.cp / (1.4 * CV_AIR) - 1.0) < 1e-3 && air.k == K_AIR);
    flow_stop(&flow);
}

/* --- order, walls, levels --- */

enum { SPOT_MOST = 80 };

/* w, about w^2/(4 a), and less than air conducts: the pressure that spreading makes is that over a/(w c). */
static const double SPOT = 2e-6, SPOT_TIME = 9e-7, SPOT_K = 0.00131;
#define DULL_AIR "  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}, conductivity: 0.00131 W/m/K}\n"
static int curved;

/* The centroid of a cell of n over 10 um. */
static double spot_place(int i, int n)
{
    double h = 1e-5 / n, a = i * h, b = a + h;
    return curved ? metric_centroid(2, a, b) : 0.5 * (a + b);
}

static int spot_cells;

static void set_spot(const struct model *model, const double x[3], double *w)
{
    double r = spot_place((int)(x[0] / 1e-5 * spot_cells), spot_cells);
    w[model->i_m] = rho_air(300.0 + 1e-3 * exp(-r * r / (SPOT * SPOT)));
    w[model->i_E] = P;
}

/* Mean error of a small spot that has spread, over its height. */
static double spot_error(int n, const char *mesh)
{
    struct flow flow;
    double error = 0.0, a = SPOT_K / (rho_air(300.0) * 1.4 * CV_AIR), wide = SPOT * SPOT + 4.0 * a * SPOT_TIME;
    char domain[160];
    snprintf(domain, sizeof domain,
             "geometry: %s, lower: [0], upper: [10 um], cells: [%d], boundaries: {x-: symmetry, "
             "x+: outflow}",
             curved ? "spherical" : "cartesian", n);
    start(&flow, domain, mesh, DULL_AIR, "cfl: 0.4");
    spot_cells = n;
    flow_set(&flow, set_spot);
    flow_until(&flow, SPOT_TIME);
    double *rho = flow_primitive(&flow, flow.state->model->i_m), *p = flow_primitive(&flow, flow.state->model->i_E);
    for (int i = 0; i < n; i++) {
        double r = spot_place(i, n), T = p[i] / (0.4 * CV_AIR * rho[i]) - 300.0;
        double exact = 1e-3 * pow(SPOT * SPOT / wide, curved ? 1.5 : 0.5) * exp(-r * r / wide);
        error += fabs(T - exact) / 1e-3 / n;
    }
    mem_free(rho);
    mem_free(p);
    flow_stop(&flow);
    return error;
}

static void test_order(void **state)
{
    (void)state;
    for (curved = 0; curved < 2; curved++) {
        double coarse = spot_error(SPOT_MOST / 4, ""), fine = spot_error(SPOT_MOST / 2, "");
        print_message("%s: %.3g, %.3g: order %.2f\n", curved ? "ball" : "spot", coarse, fine, log2(coarse / fine));
        assert_true(fine < 5e-3);
        assert_true(log2(coarse / fine) > 1.8);
    }
}

/* --- rest --- */

static void set_layers(const struct model *model, const double x[3], double *w)
{
    w[model->i_m] = rho_air(x[0] < 32e-6 ? 300.0 : 400.0);
    w[model->i_E] = P;
}

/* Cells so small that sound would allow steps in which heat gets over two of them. */
static void test_pace(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, "lower: [0], upper: [64 um], cells: [12800], boundaries: {x-: reflecting, x+: reflecting}", "", AIR,
          "cfl: 0.4");
    flow_set(&flow, set_layers);
    flow_steps(&flow, 40);
    double *rho = flow_primitive(&flow, flow.state->model->i_m), *p = flow_primitive(&flow, flow.state->model->i_E);
    for (size_t c = 0; c < flow.n_cell; c++) {
        double T = p[c] / (0.4 * CV_AIR * rho[c]);
        assert_true(T > 290.0 && T < 405.0);
    }
    mem_free(rho);
    mem_free(p);
    flow_stop(&flow);
}

/* One pressure, no motion, two temperatures: heat flows at the step between them; far from it tiles are carried on. */
static void test_rest(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, "lower: [0], upper: [64 um], cells: [64], boundaries: {x-: reflecting, x+: reflecting}",
          "mesh: {tile: 8}\n", AIR, "cfl: 0.4");
    flow_set(&flow, set_layers);
    flow_steps(&flow, 2);
    double *T = flow_derived(&flow, "temperature_air", 0);
    assert_true(T[31] > 300.0 && T[32] < 400.0);
    assert_true(fabs(T[0] - 300.0) < 1e-9);
    assert_true(flow.state->stages[0]->carried > 0);
    mem_free(T);
    flow_stop(&flow);
}

static void set_half(const struct model *model, const double x[3], double *w)
{
    w[model->i_alpha] = x[0] < 4e-6 ? 0.4 : 1.0;
    w[model->i_alpha + 1] = 1.0 - w[model->i_alpha];
    w[model->i_m] = rho_water(300.0);
    w[model->i_m + 1] = rho_air(300.0);
    w[model->i_E] = P;
}

/* A wall that gives 1 MW/m2, beside one that has a temperature: energy rises by what they give, also where materials
 * are mixed and at a radius. */
static void test_walls(void **state)
{
    (void)state;
    static const char *const geometry[] = {"cartesian", "spherical"};
    for (int k = 0; k < 2; k++) {
        struct flow flow;
        double size, dt = 1e-11, r = 2e-6, h = 0.5e-6;
        char domain[256];
        snprintf(
            domain, sizeof domain,
            "geometry: %s, lower: [2 um], upper: [10 um], cells: [16], boundaries: {x-: {type: no-slip, heat-flux: 1 "
            "MW/m2}, x+: {type: reflecting, temperature: 310 K}}",
            geometry[k]);
        start(&flow, domain, "", WATER AIR, "dt: 0.01 ns");
        flow_set(&flow, set_half);
        long double before = flow_total(&flow, flow.state->model->i_E, &size);
        flow_steps(&flow, 1);
        double area[] = {k ? 4.0 * M_PI * r * r : 1.0, k ? 4.0 * M_PI * 1e-10 : 1.0};
        double d = k ? 1e-5 - metric_centroid(2, 1e-5 - h, 1e-5) : 0.5 * h;
        double given = dt * (area[0] * 1e6 + area[1] * K_WATER * 10.0 / d);
        double got = (double)(flow_total(&flow, flow.state->model->i_E, &size) - before);
        print_message("%s: %.9g J, should be %.9g\n", geometry[k], got, given);
        assert_true(fabs(got / given - 1.0) < 1e-3); /* the layer beside the wall warms within the step */
        flow_stop(&flow);
    }
}

static void set_even(const struct model *model, const double x[3], double *w)
{
    (void)x;
    w[model->i_m] = rho_air(300.0);
    w[model->i_E] = P;
}

/* All at rest at one temperature, but for a wall. */
static void test_rest_at_wall(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow,
          "lower: [0], upper: [64 um], cells: [64], boundaries: {x-: {type: reflecting, temperature: 310 K}, x+: "
          "reflecting}",
          "mesh: {tile: 8}\n", AIR, "cfl: 0.4");
    flow_set(&flow, set_even);
    flow_steps(&flow, 4);
    double *T = flow_derived(&flow, "temperature_air", 0);
    assert_true(T[0] > 300.01);
    assert_true(flow.state->stages[0]->carried > 0);
    mem_free(T);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_facts), cmocka_unit_test(test_order), cmocka_unit_test(test_walls),
        cmocka_unit_test(test_pace),  cmocka_unit_test(test_rest),  cmocka_unit_test(test_rest_at_wall),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
