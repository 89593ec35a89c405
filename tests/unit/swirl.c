/* swirl.c - matter that turns around the axis: as a whole it goes on turning without any shear, with and without
 * viscosity, levels and a surface; angular momentum is kept to round-off by viscous torques, too; a vortex keeps u_th r
 * where it is drawn in; mirrors of the axis. */
#include "amr.h"

enum { STEPS = 60 };

static const double OMEGA = 300.0, P = 1e6, RHO = 1000.0;

/* A tank of water with a ball of air; walls slip. */
static char *tank(const char *more, const char *viscosity)
{
    return mem_print("bulla: 1\ndomain: {geometry: axisymmetric, velocity-components: 3, lower: [0, 0], upper: [0.1, "
                     "0.1], cells: [24, 24], boundaries: {x-: axis, x+: reflecting, y-: reflecting, y+: reflecting}}\n"
                     "mesh: {tile: 6%s}\nmaterials:\n"
                     "  water: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 6 MPa}%s}\n"
                     "  air: {eos: {type: ideal-gas, gamma: 1.4}%s}\n"
                     "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e6, "
                     "velocity: [0, 0, '= 30 * math.sin(40 * x)']}\n"
                     "  - {sphere: {center: [0, 0.05], radius: 0.03}, material: air, density: 100, pressure: 1e6, "
                     "velocity: [0, 0, '= 300 * x']}\nscheme: {low-mach: 0.05}\nrun: {until: 1}\n",
                     more, viscosity, viscosity);
}

/* Turns as a whole: p + rho (Omega r)^2/2, means over cells. */
static void turn(const struct model *model, const double x[3], double *w)
{
    double h = 0.1 / 24, a = x[0] - 0.5 * h, b = x[0] + 0.5 * h, r = metric_centroid(1, a, b);
    double air = hypot(x[0], x[1] - 0.05) < 0.03;
    w[model->i_alpha] = 1.0 - air;
    w[model->i_alpha + 1] = air;
    w[model->i_m] = w[model->i_m + 1] = RHO;
    w[model->i_u + 2] = OMEGA * r;
    w[model->i_E] = P + 0.25 * RHO * OMEGA * OMEGA * (a * a + b * b);
}

/* Largest |u_th/r - Omega|/Omega, and velocity in the plane [m/s]. */
static double wrung(const struct flow *flow, double *ret_speed)
{
    const struct model *model = flow->state->model;
    struct amr_leaves leaves = amr_leaves(flow);
    double worst = 0.0;
    *ret_speed = 0.0;
    for (size_t i = 0; i < leaves.n; i++) {
        double r = amr_lever(flow, &leaves.all[i], model->i_u + 2);
        worst = fmax(worst, fabs(amr_primitive(flow, &leaves.all[i], model->i_u + 2) / r / OMEGA - 1.0));
        for (unsigned d = 0; d < 2; d++)
            *ret_speed = fmax(*ret_speed, fabs(amr_primitive(flow, &leaves.all[i], model->i_u + d)));
    }
    mem_free(leaves.all);
    return worst;
}

/* What thick matter does that turns as a whole, in some steps: nothing but what sound does of a pressure of cells. */
static void test_whole(void **state)
{
    (void)state;
    double worst[2], speed[2];
    for (int thick = 0; thick < 2; thick++) {
        struct flow flow;
        flow_start(&flow, tank("", thick ? ", viscosity: 1 Pa s" : ""));
        flow_set(&flow, turn);
        flow_steps(&flow, STEPS);
        worst[thick] = wrung(&flow, &speed[thick]);
        print_message("%s: u_th/r off by %.2g, %.2g m/s in the plane (30 m/s at the wall)\n", thick ? "thick" : "thin",
                      worst[thick], speed[thick]);
        flow_stop(&flow);
    }
    assert_true(worst[0] < 2e-3 && speed[0] < 0.01);
    assert_true(worst[1] < 2e-3 && speed[1] < 0.01);
}

/* Layers that turn apart hold each other back; nothing goes to the walls. */
static void shear(const struct model *model, const double x[3], double *w)
{
    turn(model, x, w);
    w[model->i_u + 2] *= sin(40.0 * x[0]) * cos(50.0 * x[1]);
    w[model->i_u + 1] = 3.0 * sin(60.0 * x[1]);
}

static void kept(const char *mesh, bool levels)
{
    struct flow flow;
    flow_start(&flow, tank(mesh, ", viscosity: 1 Pa s"));
    const struct model *model = flow.state->model;
    if (!levels) flow_set(&flow, shear);
    const unsigned fields[] = {model->i_m, model->i_m + 1, model->i_u + 2, model->i_E};
    long double before[4];
    double size[4], now;
    for (int k = 0; k < 4; k++) before[k] = amr_total(&flow, fields[k], &size[k]);
    flow_steps(&flow, STEPS);
    amr_print(&flow, mesh);
    for (int k = 0; k < 4; k++) {
        double off = (double)fabsl(amr_total(&flow, fields[k], &now) - before[k]) / fmax(size[k], now);
        print_message("%s drifts by %.1e\n", model->field_names[fields[k]], off);
        assert_true(off < 2e-14);
    }
    flow_stop(&flow);
}

static void test_kept(void **state)
{
    (void)state;
    kept("", false);
    kept(", levels: 2, regrid-every: 2, refine: [{interface: air}]", true);
}

/* Twice Omega along the axis, against it: r, z and what is around are a left-handed frame. */
static void test_curl(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, tank("", ""));
    flow_set(&flow, turn);
    double *curl[3], worst = 0.0;
    for (unsigned d = 0; d < 3; d++) curl[d] = flow_derived(&flow, "vorticity", d);
    for (size_t c = 0; c < flow.n_cell; c++) {
        double x[3];
        flow_centre(&flow, c, x);
        if (x[0] < 0.02 || x[0] > 0.09) continue;
        worst = fmax(worst, fabs(curl[1][c] / (-2.0 * OMEGA) - 1.0));
        assert_true(fabs(curl[0][c]) < 1e-9 && fabs(curl[2][c]) < 1e-9);
    }
    print_message("vorticity off by %.2g\n", worst);
    assert_true(worst < 0.01);
    for (unsigned d = 0; d < 3; d++) mem_free(curl[d]);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_whole), cmocka_unit_test(test_kept),
                                       cmocka_unit_test(test_curl)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
