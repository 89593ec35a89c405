/* Order in time: the same cells, fewer and fewer steps, against very many. What is left of the slopes' limiter is
 * smooth (van Albada) and the same in all runs, so that differences are those of the integrator alone. */
#include "flow.h"

static const char *const one = "  air: {eos: {type: ideal-gas, gamma: 1.4}}\n";
static const char *const two = FLOW_WATER FLOW_AIR;

static void set_wave(const struct model *model, const double x[3], double *w)
{
    double s = sin(2.0 * M_PI * x[0]);
    for (unsigned l = 0; l < model->n_material; l++) w[model->i_m + l] *= 1.0 + 0.1 * s;
    if (model->n_alpha) w[model->i_alpha + 1] = 0.3 + 0.1 * s;
    if (model->n_alpha) w[model->i_alpha] = 0.7 - 0.1 * s;
    w[model->i_u] = 40.0 + 10.0 * s;
    w[model->i_E] *= 1.0 + 0.2 * cos(2.0 * M_PI * x[0]);
}

/* The conserved fields at a given time after so many steps. */
static void run(struct flow *flow, const char *materials, const char *integrator, double until, int steps)
{
    flow_start(flow, mem_print("bulla: 1\ntitle: time\ndomain: {lower: [0], upper: [1], cells: [32], boundaries: {x-: "
                               "periodic, x+: periodic}}\nmaterials:\n%sinitial:\n  - {everywhere: true, material: "
                               "air, density: 1.2, pressure: 1e5}\nscheme: {limiter: van-albada, interface-limiter: "
                               "van-albada, integrator: %s, dt: %.17g}\nrun: {until: 1}\n",
                               materials, integrator, until / steps));
    flow_set(flow, set_wave);
    flow_steps(flow, steps);
}

static double difference(const struct flow *a, const struct flow *b)
{
    double sum = 0.0, size = 0.0;
    for (unsigned q = 0; q < a->state->model->n_field; q++) {
        double *x = flow_conserved(a, q), *y = flow_conserved(b, q), most = 0.0, part = 0.0;
        for (size_t c = 0; c < a->n_cell; c++) {
            part += fabs(x[c] - y[c]);
            most = fabs(y[c]) > most ? fabs(y[c]) : most;
        }
        sum += part / most;
        size += 1.0;
        mem_free(x);
        mem_free(y);
    }
    return sum / size;
}

static double order(const char *materials, const char *integrator, double until, int coarse)
{
    struct flow exact, flow[2];
    double error[2];
    run(&exact, materials, "ssprk3", until, 16 * coarse);
    for (int i = 0; i < 2; i++) {
        run(&flow[i], materials, integrator, until, coarse << i);
        error[i] = difference(&flow[i], &exact);
        flow_stop(&flow[i]);
    }
    flow_stop(&exact);
    print_message("%s: %.3g, %.3g: order %.2f\n", integrator, error[0], error[1], log2(error[0] / error[1]));
    return log2(error[0] / error[1]);
}

static void test_midpoint(void **state)
{
    (void)state;
    double found = order(one, "midpoint", 2e-4, 20);
    assert_true(found > 1.8 && found < 2.3);
}

static void test_ssprk3(void **state)
{
    (void)state;
    double found = order(one, "ssprk3", 2e-4, 20);
    assert_true(found > 2.75 && found < 3.3);
}

/* Fractions, closure and exchange are part of the same step. */
static void test_mixture(void **state)
{
    (void)state;
    double found = order(two, "ssprk3", 1e-4, 40);
    assert_true(found > 2.7 && found < 3.3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_midpoint),
        cmocka_unit_test(test_ssprk3),
        cmocka_unit_test(test_mixture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
