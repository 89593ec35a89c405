/* Surface tension around a centre: what balances stays, what moves keeps energy and surface together, materials of a
 * cell have pressures that differ by it, and tiles do not matter. */
#include "flow.h"

#include "paint/paint_curvature.h"
#include "phys/traction.h"

static const double SIGMA = 0.0728, RADIUS = 2e-6, P = 101325.0;

/* A ball of `inside` in `outside`, in a closed ball of 16 um. */
static void start(struct flow *flow, const char *inside, const char *outside, double radius, int tile, const char *more,
                  const char *limiter)
{
    double density = strcmp(inside, "air") ? 998.2 : 2.0, other = strcmp(outside, "air") ? 998.2 : 1.2;
    flow_start(
        flow,
        mem_print("bulla: 1\ntitle: tension\ndomain: {geometry: spherical, lower: [0], upper: [16 um], cells: "
                  "[64], boundaries: {x-: axis, x+: reflecting}}\nmesh: {tile: %d}\nmaterials:\n" FLOW_WATER FLOW_AIR
                  "surface-tension: {air+water: 72.8 mN/m}\ninitial:\n"
                  "  - {everywhere: true, material: %s, density: %g, pressure: 101325}\n"
                  "  - {sphere: {center: [0], radius: %.10g}, material: %s, density: %g, pressure: 101325%s}\n"
                  "scheme: {limiter: %s}\nrun: {until: 1}\n",
                  tile, outside, other, radius, inside, density, more, limiter));
}

static double largest(const struct flow *flow, unsigned q)
{
    double *row = flow_primitive(flow, q), most = 0.0;
    for (size_t c = 0; c < flow->n_cell; c++) most = fabs(row[c]) > most ? fabs(row[c]) : most;
    mem_free(row);
    return most;
}

/* A bubble in water, and a drop in air: the pressure inside is higher by 2 sigma/R, whatever is inside and whether
 * limited edges lie as far on both sides or not. */
static void test_rest(void **state)
{
    static const char *const inside[] = {"air", "water"}, *const limiter[] = {"mc", "koren"};
    (void)state;
    for (int i = 0; i < 4; i++) {
        struct flow flow;
        start(&flow, inside[i % 2], inside[1 - i % 2], RADIUS, 64, ", balance: tension", limiter[i / 2]);
        flow_steps(&flow, 400);
        double *p = flow_primitive(&flow, flow.state->model->i_E);
        assert_true(fabs((p[0] - p[63]) / (2.0 * SIGMA / RADIUS) - 1.0) < 1e-9);
        assert_true(fabs(p[63] / P - 1.0) < 1e-9);
        assert_true(largest(&flow, flow.state->model->i_u) < 1e-7);
        mem_free(p);
        flow_stop(&flow);
    }
}

static double surface(const struct flow *flow)
{
    double *density = flow_derived(flow, "surface_energy", 0), *volume = flow_volumes(flow), sum = 0.0;
    for (size_t c = 0; c < flow->n_cell; c++) sum += density[c] * volume[c];
    mem_free(density);
    mem_free(volume);
    return sum;
}

/* A bubble whose surface cuts a cell, and whose gas has too little pressure, shrinks: the fluids gain what the surface
 * loses. */
static void test_energy(void **state)
{
    (void)state;
    struct flow flow;
    double size;
    start(&flow, "air", "water", 1.013 * RADIUS, 64, "", "mc");
    unsigned energy = flow.state->model->i_E;
    double before = surface(&flow), area = 4.0 * M_PI * 1.013 * 1.013 * RADIUS * RADIUS;
    assert_true(fabs(before / (SIGMA * area) - 1.0) < 0.01);
    long double total = flow_total(&flow, energy, &size);
    flow_until(&flow, 60e-9);
    double gained = (double)(flow_total(&flow, energy, &size) - total), lost = before - surface(&flow);
    print_message("the surface loses %.6g of %.6g J, the fluids gain %.6g J\n", lost, before, gained);
    assert_true(lost > 0.01 * before);
    assert_true(fabs(gained - lost) < 2e-15 * size);
    flow_stop(&flow);
}

static void set_mixed(const struct model *model, const double x[3], double *w)
{
    double part = x[0] / 16e-6;
    w[model->i_alpha] = part;
    w[model->i_alpha + 1] = 1.0 - part;
    w[model->i_m] = 998.2;
    w[model->i_m + 1] = 1.2;
    w[model->i_E] = P;
    w[model->pairs[0].i_kappa] = 1e6;
}

/* In any mixture: gas has sigma kappa more than water, their mean is p, and energy gives p back. */
static void test_lags(void **state)
{
    (void)state;
    struct flow flow;
    static struct traction_pressures parts;
    start(&flow, "air", "water", RADIUS, 64, "", "mc");
    const struct model *model = flow.state->model;
    flow_set(&flow, set_mixed);
    const double *w = flow_level(&flow)->w[0];
    traction_part(model, 64, 64, w, &parts);
    for (size_t i = 0; i < 64; i++) {
        double water = w[i], air = w[64 + i];
        assert_true(fabs(parts.lag[1][i] - parts.lag[0][i] - SIGMA * 1e6) < 1e-9 * P);
        assert_true(fabs(water * parts.lag[0][i] + air * parts.lag[1][i]) < 1e-9 * P);
        assert_true(fabs(w[model->i_E * 64 + i] - P) < 1e-5 * P);
    }
    flow_stop(&flow);
}

/* The same bits on tiles of any size, where a bubble moves. */
static void test_tiles(void **state)
{
    (void)state;
    struct flow one, many;
    start(&one, "air", "water", 1.013 * RADIUS, 64, "", "mc");
    start(&many, "air", "water", 1.013 * RADIUS, 8, "", "mc");
    flow_steps(&one, 60);
    flow_steps(&many, 60);
    assert_true(largest(&one, one.state->model->i_u) > 1e-3);
    for (unsigned q = 0; q < one.state->model->pairs[0].i_kappa; q++) { /* where nothing meets, nobody looks at kappa */
        double *a = flow_conserved(&one, q), *b = flow_conserved(&many, q);
        assert_memory_equal(a, b, one.n_cell * sizeof *a);
        mem_free(a);
        mem_free(b);
    }
    flow_stop(&one);
    flow_stop(&many);
}

/* The painted curvature is positive around what lies inside, negative around what surrounds it, and nothing where
 * nothing changes. */
static void test_sign(void **state)
{
    (void)state;
    static const double size[3] = {2.0, 2.0, 2.0}, falls[5] = {1.0, 1.0, 0.5, 0.0, 0.0},
                        rises[5] = {0.0, 0.0, 0.5, 1.0, 1.0}, even[5] = {0.5, 0.5, 0.5, 0.5, 0.5};
    double kappa[3];
    paint_curvature_cells(3, size, falls, rises, kappa);
    assert_true(kappa[1] == 2.0);
    paint_curvature_cells(3, size, rises, falls, kappa);
    assert_true(kappa[1] == -2.0);
    paint_curvature_cells(3, size, even, even, kappa);
    assert_true(kappa[1] == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rest),  cmocka_unit_test(test_energy), cmocka_unit_test(test_lags),
        cmocka_unit_test(test_tiles), cmocka_unit_test(test_sign),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
