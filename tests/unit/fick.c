/* Gases through each other: a cloud spreads as the heat kernel says, at one pressure and temperature; hot vapour and
 * cold air keep their temperatures while they mingle. */
#include "flow.h"

#include "phys/traction.h"

static const double P = 2e5, T = 600.0, W = 1e-4;

static void start(struct flow *flow, const char *domain, const char *law)
{
    flow_start(flow, mem_print("bulla: 1\ntitle: gases\ndomain: {%s}\nmaterials:\n"
                               "  steam: {eos: {type: ideal-gas, gamma: 1.3, cv: 1400}}\n"
                               "  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}}\n"
                               "gas-diffusion: [{gases: [steam, air], %s}]\n"
                               "initial:\n  - {everywhere: true, material: air, density: 1.2, pressure: 1 atm}\n"
                               "run: {until: 1}\n",
                               domain, law));
}

static double dense(double p, double gamma, double cv, double temperature)
{
    return p / ((gamma - 1.0) * cv * temperature);
}

static void set_cloud(const struct model *model, const double x[3], double *w)
{
    double share = 0.2 + 0.6 * exp(-x[0] * x[0] / (W * W));
    w[model->i_alpha] = share;
    w[model->i_alpha + 1] = 1.0 - share;
    w[model->i_m] = dense(P, 1.3, 1400.0, T);
    w[model->i_m + 1] = dense(P, 1.4, 717.5, T);
    w[model->i_E] = P;
}

static double largest(const struct flow *flow, double *values, double sign)
{
    double most = sign * values[0];
    for (size_t c = 0; c < flow->n_cell; c++) most = fmax(most, sign * values[c]);
    mem_free(values);
    return sign * most;
}

/* How far the cloud is from the heat kernel in its middle, after 4 D t = W^2, with n cells. */
static double cloud_error(int n, bool steady)
{
    struct flow flow;
    char *domain = mem_print("lower: [0], upper: [8e-4], cells: [%d], boundaries: {x-: symmetry, x+: outflow}", n);
    double D = 1e-4 * (steady ? 1.0 : 0.5 * pow(2.0, 1.75));
    start(&flow, domain,
          steady ? "diffusivity: 1e-4, law: constant" : "diffusivity: 1e-4, temperature: 300, pressure: 1e5");
    flow_set(&flow, set_cloud);
    flow_until(&flow, W * W / (4.0 * D));
    double h = 8e-4 / n, x = 0.5 * h / W, right = 0.2 + 0.6 / sqrt(2.0) * exp(-x * x / 2.0);
    double found = largest(&flow, flow_primitive(&flow, flow.state->model->i_alpha), 1.0);
    double high = largest(&flow, flow_primitive(&flow, flow.state->model->i_E), 1.0);
    double low = largest(&flow, flow_primitive(&flow, flow.state->model->i_E), -1.0);
    assert_true((high - low) / P < 2e-5);
    flow_stop(&flow);
    mem_free(domain);
    return fabs(found - right);
}

static void test_cloud(void **state)
{
    (void)state;
    for (int steady = 0; steady < 2; steady++) {
        double coarse = cloud_error(40, steady), fine = cloud_error(80, steady);
        print_message("error of the cloud %.3g, with cells half as large %.3g\n", coarse, fine);
        assert_true(coarse < 4e-3 && fine < 1e-3);
    }
}

static void set_contact(const struct model *model, const double x[3], double *w)
{
    bool steam = x[0] > 5e-4;
    w[model->i_alpha] = steam ? 1.0 : 0.0;
    w[model->i_alpha + 1] = steam ? 0.0 : 1.0;
    w[model->i_m] = dense(P, 1.3, 1400.0, 500.0);
    w[model->i_m + 1] = dense(P, 1.4, 717.5, 300.0);
    w[model->i_E] = P;
}

/* The largest relative error of a gas's temperature where it is a thousandth of the cell or more. */
static double warmed(const struct flow *flow, unsigned l, double R, double right)
{
    const struct model *model = flow->state->model;
    double *alpha = flow_primitive(flow, model->i_alpha + l), *rho = flow_primitive(flow, model->i_m + l);
    double *p = flow_primitive(flow, model->i_E), worst = 0.0;
    for (size_t c = 0; c < flow->n_cell; c++)
        if (alpha[c] > 1e-3) worst = fmax(worst, fabs(p[c] / (R * rho[c]) / right - 1.0));
    mem_free(alpha);
    mem_free(rho);
    mem_free(p);
    return worst;
}

static void test_contact(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow, "lower: [0], upper: [1e-3], cells: [100], boundaries: {x-: outflow, x+: outflow}",
          "diffusivity: 1e-4, law: constant");
    flow_set(&flow, set_contact);
    flow_until(&flow, 2e-5);
    double steam = warmed(&flow, 0, 0.3 * 1400.0, 500.0), air = warmed(&flow, 1, 0.4 * 717.5, 300.0);
    print_message("temperatures are off by %.3g and %.3g\n", steam, air);
    assert_true(steam < 0.02 && air < 0.02);
    flow_stop(&flow);
}

static double trace_heat; /* temperature of the trace below */

static void set_trace(const struct model *model, const double x[3], double *w)
{
    (void)x;
    w[model->i_alpha] = 1e-3;
    w[model->i_alpha + 1] = 1.0 - 1e-3;
    w[model->i_m] = dense(P, 1.3, 1400.0, trace_heat);
    w[model->i_m + 1] = dense(P, 1.4, 717.5, 300.0);
    w[model->i_E] = P;
}

static double trace_step(double temperature)
{
    struct flow flow;
    start(&flow, "lower: [0], upper: [1e-6], cells: [8], boundaries: {x-: symmetry, x+: symmetry}",
          "diffusivity: 1e-3, temperature: 300, pressure: 1e5");
    trace_heat = temperature;
    flow_set(&flow, set_trace);
    flow_steps(&flow, 1);
    double step = flow.state->t;
    flow_stop(&flow);
    return step;
}

/* A trace of vapour hotter than all else does not make the whole mixture diffuse as if it were as hot. */
static void test_hot_trace(void **state)
{
    (void)state;
    double cold = trace_step(300.0), hot = trace_step(3e7);
    print_message("first step beside a trace of 300 K %.3g s, of 3e7 K %.3g s\n", cold, hot);
    assert_true(hot > 0.3 * cold);
}

/* Gases in a strained gel, half of each cell: they have the pressure that leaves one traction, and their temperature at
 * that. */
static void set_gel(const struct model *model, const double x[3], double *w)
{
    const double share = 0.2 + 0.6 * exp(-x[0] * x[0] / (W * W)), part[] = {0.5 * share, 0.5 - 0.5 * share, 0.5};
    struct traction_pressures parts;
    for (unsigned l = 0; l < 3; l++) w[model->i_alpha + l] = part[l];
    w[model->i_m] = w[model->i_m + 1] = 1.0;
    w[model->i_m + 2] = 1000.0;
    w[model->i_E] = P;
    w[model_stretch(model, 0)] = 1.05;
    for (unsigned c = 1; c < model->n_stretch; c++) w[model_stretch(model, 0) + c] = 1.0 / sqrt(1.05);
    traction_part(model, 1, 1, w, &parts);
    w[model->i_m] = dense(*traction_pressure(model, 1, 0, &P, &parts), 1.3, 1400.0, T);
    w[model->i_m + 1] = dense(*traction_pressure(model, 1, 1, &P, &parts), 1.4, 717.5, T);
}

static void test_gel(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, mem_print("bulla: 1\ntitle: gel\ndomain: {lower: [0], upper: [8e-4], cells: [16], boundaries: "
                                "{x-: symmetry, x+: symmetry}}\nmesh: {tile: 16}\nmaterials:\n"
                                "  steam: {eos: {type: ideal-gas, gamma: 1.3, cv: 1400}}\n"
                                "  air: {eos: {type: ideal-gas, gamma: 1.4, cv: 717.5}}\n"
                                "  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, constitutive: {type: "
                                "neo-hookean, shear-modulus: 1 MPa, reference-density: 1000}}\n"
                                "gas-diffusion: [{gases: [steam, air], diffusivity: 1e-4, law: constant}]\n"
                                "initial:\n  - {everywhere: true, material: air, density: 1.2, pressure: 1 atm}\n"
                                "run: {until: 1}\n"));
    const struct model *model = flow.state->model;
    flow_set(&flow, set_gel);
    flow_until(&flow, 1e-6);
    const double *w = flow_level(&flow)->w[0], gamma[] = {1.3, 1.4}, cv[] = {1400.0, 717.5};
    struct traction_pressures parts;
    double worst = 0.0;
    traction_part(model, 16, 16, w, &parts);
    for (unsigned l = 0; l < 2; l++) {
        const double *p = traction_pressure(model, 16, l, w + model->i_E * 16, &parts);
        for (size_t i = 0; i < 16; i++)
            worst = fmax(worst, fabs(dense(p[i], gamma[l], cv[l], T) / w[(model->i_m + l) * 16 + i] - 1.0));
    }
    print_message("gases in a gel: temperatures off by %.3g, pressure of the gas %.5g of the mean %.5g\n", worst,
                  P + parts.lag[0][0], P);
    assert_true(worst < 2e-3);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cloud),
        cmocka_unit_test(test_contact),
        cmocka_unit_test(test_hot_trace),
        cmocka_unit_test(test_gel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
