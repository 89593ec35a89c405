/* Viscosity at the wall of a bubble: gas and liquid of its cells have pressures that differ by the liquid's stress,
 * energy is kept, and tiles do not matter. */
#include "flow.h"

#include "phys/traction.h"

static const double MU = 0.1, RADIUS = 4e-6, P = 101325.0, WALL = 2.0;

/* A bubble in a closed ball (BETA 2) or tube (1). */
static void start(struct flow *flow, const char *geometry, int tile, const char *mu)
{
    flow_start(flow,
               mem_print("bulla: 1\ntitle: pull\ndomain: {geometry: %s, lower: [0], upper: [16 um], cells: [64], "
                         "boundaries: {x-: axis, x+: reflecting}}\nmesh: {tile: %d}\nmaterials:\n"
                         "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}%s}\n" FLOW_AIR
                         "initial:\n  - {everywhere: true, material: water, density: 998.2, pressure: 101325}\n"
                         "  - {sphere: {center: [0], radius: 4.1 um}, material: air, density: 2, pressure: 1 MPa}\n"
                         "run: {until: 1}\n",
                         geometry, tile, mu));
}

/* A front of some cells around a wall that moves outwards. */
static void set_wall(const struct model *model, const double x[3], double *w)
{
    double r = x[0], gas = 0.5 - 0.5 * tanh((r - RADIUS) / 0.5e-6);
    w[model->i_alpha] = 1.0 - gas;
    w[model->i_alpha + 1] = gas;
    w[model->i_m] = 998.2;
    w[model->i_m + 1] = 1.2;
    w[model->i_u] = r < RADIUS ? WALL * r / RADIUS : WALL * pow(RADIUS / r, model->beta);
    w[model->i_E] = P;
    for (unsigned k = 0; k < model->n_pull; k++) w[model->pulls[k].field] = -1e4;
}

/* The mean of the lags is 0, they differ by the pull, and energy gives p back. */
static void test_lags(void **state)
{
    (void)state;
    struct flow flow;
    static struct traction_pressures parts;
    start(&flow, "spherical", 64, ", viscosity: 0.1");
    const struct model *model = flow.state->model;
    flow_set(&flow, set_wall);
    const double *w = flow_level(&flow)->w[0];
    traction_part(model, 64, 64, w, &parts);
    for (size_t i = 0; i < 64; i++) {
        assert_true(fabs(parts.lag[1][i] - parts.lag[0][i] - 1e4) < 1e-9 * P);
        assert_true(fabs(w[i] * parts.lag[0][i] + w[64 + i] * parts.lag[1][i]) < 1e-9 * P);
        assert_true(fabs(w[model->i_E * 64 + i] - P) < 1e-5 * P);
    }
    flow_stop(&flow);
}

/* After a step the liquid pulls with -2 beta mu u/r, wherever it meets gas. */
static void test_wall(void **state)
{
    static const char *const geometry[] = {"axisymmetric", "spherical"};
    (void)state;
    for (int beta = 1; beta <= 2; beta++) {
        struct flow flow;
        int met = 0;
        start(&flow, geometry[beta - 1], 64, ", viscosity: 0.1");
        const struct model *model = flow.state->model;
        assert_int_equal(model->n_pull, 1);
        flow_set(&flow, set_wall);
        double *before = flow_primitive(&flow, model->i_u), *alpha = flow_conserved(&flow, 0);
        flow_steps(&flow, 1);
        double *pull = flow_primitive(&flow, model->pulls[0].field);
        for (size_t c = 0; c < flow.n_cell; c++) {
            double x[3], right;
            flow_centre(&flow, c, x);
            right = -2.0 * beta * MU * before[c] / x[0];
            if (alpha[c] < 0.2 || alpha[c] > 0.8) continue;
            met++;
            assert_true(fabs(pull[c] / right - 1.0) < 0.06); /* u is that of the middle of the step */
        }
        assert_true(met >= 2);
        mem_free(pull);
        mem_free(before);
        mem_free(alpha);
        flow_stop(&flow);
    }
}

/* A bubble that swells in a closed ball: the energy stays, to round-off. */
static void test_energy(void **state)
{
    (void)state;
    struct flow flow;
    double size;
    start(&flow, "spherical", 64, ", viscosity: 0.1");
    unsigned energy = flow.state->model->i_E;
    long double total = flow_total(&flow, energy, &size);
    flow_until(&flow, 30e-9);
    double *pull = flow_primitive(&flow, flow.state->model->pulls[0].field), most = 0.0;
    for (size_t c = 0; c < flow.n_cell; c++) most = fabs(pull[c]) > most ? fabs(pull[c]) : most;
    print_message("largest pull %.4g Pa, energy lost %.3Lg of %.6Lg J\n", most,
                  total - flow_total(&flow, energy, &size), total);
    assert_true(most > 1e3);
    assert_true(fabs((double)(flow_total(&flow, energy, &size) - total)) < 4e-15 * size);
    mem_free(pull);
    flow_stop(&flow);
}

/* The same bits on tiles of any size. */
static void test_tiles(void **state)
{
    (void)state;
    struct flow one, many;
    start(&one, "spherical", 64, ", viscosity: 0.1");
    start(&many, "spherical", 8, ", viscosity: 0.1");
    flow_steps(&one, 60);
    flow_steps(&many, 60);
    for (unsigned q = 0; q < one.state->model->pulls[0].field;
         q++) { /* where nothing meets, nobody looks at the pull */
        double *a = flow_conserved(&one, q), *b = flow_conserved(&many, q);
        assert_memory_equal(a, b, one.n_cell * sizeof *a);
        mem_free(a);
        mem_free(b);
    }
    flow_stop(&one);
    flow_stop(&many);
}

/* Without viscosity, and in the plane, there is no such field. */
static void test_none(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, "spherical", 64, "");
    assert_int_equal(flow.state->model->n_pull, 0);
    assert_false(flow.state->model->lagged);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lags),  cmocka_unit_test(test_wall), cmocka_unit_test(test_energy),
        cmocka_unit_test(test_tiles), cmocka_unit_test(test_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
