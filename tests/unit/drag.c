/* Linear resistance: velocities decay as they should, what they lose is heat, and a mixture heats as two phases at one
 * pressure do. Uniform flow on a mesh with levels stays uniform. */
#include "flow.h"

static const double K = 5e3, SPEED = 20.0;

static void start(struct flow *flow, const char *materials, const char *mesh, const char *domain)
{
    flow_start(flow, mem_print("bulla: 1\ntitle: drag\ndomain: %s\n%smaterials:\n%sinitial:\n  - {everywhere: true, "
                               "material: air, density: 1.2, pressure: 1e5, velocity: %s}\nscheme: {dt: 2 us}\n"
                               "run: {until: 1}\n",
                               domain, mesh, materials, strstr(domain, "y-") ? "[20, 0]" : "[20]"));
}

static const char line[] = "{lower: [0], upper: [1], cells: [16], boundaries: {x-: periodic, x+: periodic}}";
static const char air[] = "  air: {eos: {type: ideal-gas, gamma: 1.4}, drag: 5e3}\n";

static double mean(const struct flow *flow, double *values)
{
    double sum = 0.0;
    for (size_t c = 0; c < flow->n_cell; c++) sum += values[c] / (double)flow->n_cell;
    mem_free(values);
    return sum;
}

/* u = u0 exp(-k t / rho), p = p0 + (gamma - 1) of the kinetic energy that is gone. */
static void test_decay(void **state)
{
    (void)state;
    struct flow flow;
    double size, t = 4e-4, rho = 1.2, left = exp(-K * t / rho);
    start(&flow, air, "", line);
    long double before = flow_total(&flow, flow.state->model->i_E, &size);
    flow_until(&flow, t);
    double u = mean(&flow, flow_primitive(&flow, flow.state->model->i_u));
    double p = mean(&flow, flow_primitive(&flow, flow.state->model->i_E));
    assert_true(fabs(u / SPEED - left) < 2e-3 * left);
    assert_true(fabs((p - 1e5) / (0.4 * 0.5 * rho * SPEED * SPEED * (1.0 - left * left)) - 1.0) < 2e-3);
    assert_true(fabs((double)(flow_total(&flow, flow.state->model->i_E, &size) - before)) < 1e-14 * size);
    flow_stop(&flow);
}

static void set_foam(const struct model *model, const double x[3], double *w)
{
    (void)x;
    w[model->i_alpha] = w[model->i_alpha + 1] = 0.5;
    w[model->i_m] = 1000.0;
    w[model->i_m + 1] = 1.2;
}

/* The water of a foam is heated: dp = rho c_w^2 G/(rho_l c_l^2) of what its velocity loses, two thousandths of what it
 * would be with frozen fractions. So an error of (k dt/rho)^2/24 in what volume moves counts two thousandfold: steps
 * are short. */
static void test_foam(void **state)
{
    (void)state;
    struct flow flow;
    double t = 2e-5, K_water = 1.4 * 1e5, stiff = 4.4 * (1e5 + 6e8);
    double wood = 1.0 / (0.5 / stiff + 0.5 / K_water), rho = 500.6;
    start(&flow, "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, drag: 1e6}\n" FLOW_AIR, "", line);
    flow_set(&flow, set_foam);
    flow_until(&flow, t);
    double u = mean(&flow, flow_primitive(&flow, flow.state->model->i_u));
    double p = mean(&flow, flow_primitive(&flow, flow.state->model->i_E));
    double lost = 0.5 * rho * (SPEED * SPEED - u * u), rise = wood * (3.4 / stiff) * lost;
    assert_true(fabs(u / SPEED - exp(-0.5e6 * t / rho)) < 1e-4);
    print_message("pressure rises by %.6g Pa, should by %.6g\n", p - 1e5, rise);
    assert_true(fabs((p - 1e5) / rise - 1.0) < 5e-3);
    flow_stop(&flow);
}

/* A box of finer cells in a uniform flow: nothing shows where it is. */
static void test_levels(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, air, "mesh: {levels: 1, tile: 8, refine: [{region: {box: {lower: [0.2, 0.2], upper: [0.6, 0.7]}}}]}\n",
          "{lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, y-: periodic, y+: "
          "periodic}}");
    assert_int_equal(flow.state->mesh->n_level, 2);
    flow_steps(&flow, 5);
    double *u = flow_primitive(&flow, flow.state->model->i_u), least = u[0], most = u[0];
    for (size_t c = 0; c < flow.n_cell; c++) {
        least = u[c] < least ? u[c] : least;
        most = u[c] > most ? u[c] : most;
    }
    assert_true(most < 0.99 * SPEED);
    assert_true(most - least < 1e-5 * SPEED); /* finer cells take two steps for one: their decay is better */
    mem_free(u);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_decay),
        cmocka_unit_test(test_foam),
        cmocka_unit_test(test_levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
