/* What a cell holds that the surface between two bodies of fluid cuts: their contact, against closed forms. */
#include "flow.h"

#include "phys/mix.h"

/* Velocity and pressure of the cell that is cut at x = 0.04, or at -0.04; its masses are those of the shapes. */
static void cut_cell(const char *layers, bool turned, double rho_a, double rho_b, double *ret_u, double *ret_p)
{
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: cut\ndomain: {lower: [-1], upper: [1], cells: [32], boundaries: {x-: "
                         "outflow, x+: outflow}}\nmaterials:\n" FLOW_WATER FLOW_AIR "initial:\n%srun: {until: 1}\n",
                         layers));
    const struct model *model = flow.state->model;
    size_t cell = turned ? 15 : 16;
    double w[MODEL_FIELDS], u[MODEL_FIELDS], m = 0.0, part = 1.0 - 0.04 * 16.0;
    for (unsigned q = 0; q < model->n_field; q++) {
        double *row = flow_conserved(&flow, q);
        u[q] = row[cell];
        mem_free(row);
    }
    w[model->i_E] = 1e5;
    mix_primitives(model, 1, 1, u, w);
    for (unsigned l = 0; l < model->n_material; l++) m += u[model->i_m + l];
    assert_true(fabs(m / (part * rho_b + (1.0 - part) * rho_a) - 1.0) < 1e-12);
    *ret_u = w[model->i_u];
    *ret_p = w[model->i_E];
    flow_stop(&flow);
}

/* Relative. */
static void near(double value, double exact, double within)
{
    assert_true(fabs(value - exact) <= within * fabs(exact));
}

/* What the pressure p takes of the velocity of a body of density rho at p0 (Toro 2009, 4.2; stiffened gas). */
static double taken(double gamma, double p_inf, double rho, double p0, double p)
{
    double P = p + p_inf, P0 = p0 + p_inf, c = sqrt(gamma * P0 / rho), half = 0.5 * (gamma - 1.0);
    if (p <= p0) return c / half * (pow(P / P0, half / gamma) - 1.0);
    return (p - p0) * sqrt(2.0 / (rho * ((gamma + 1.0) * P + (gamma - 1.0) * P0)));
}

/* Air of 1.2 kg/m3 and 1 bar on the left, with this velocity, water of 1000 kg/m3 and this pressure at rest on the
 * right. */
static double star(double u, double p_water, double *ret_p)
{
    double low = 1e3, high = 2e9;
    for (int k = 0; k < 200; k++) {
        double p = *ret_p = 0.5 * (low + high);
        double apart = u - taken(1.4, 0.0, 1.2, 1e5, p) - taken(4.4, 6e8, 1000.0, p_water, p);
        if (apart > 0.0) low = p;
        else high = p;
    }
    return u - taken(1.4, 0.0, 1.2, 1e5, *ret_p);
}

/* Where a surface with another pressure on its other side cuts a cell, the cell holds the contact, of strong waves too:
 * gas that is run over, gas that stands in the way of water, both pushed together. Mirrored scenes mirror it to the
 * bit. Two pressures of one material are a wave: its mean stays. */
static void cut_cells_hold_the_contact(void **state)
{
    (void)state;
    static const double meet[][2] = {{7.0, 1e8}, {0.0, 1e9}, {900.0, 2e6}, {-150.0, 1e8}};
    double u[2], p;
    for (size_t i = 0; i < sizeof meet / sizeof *meet; i++) {
        double wanted_p, wanted = star(meet[i][0], meet[i][1], &wanted_p);
        for (int turned = 0; turned < 2; turned++) {
            int sign = turned ? -1 : 1;
            char *layers = mem_print(
                "  - {everywhere: true, material: air, density: 1.2, pressure: 1 bar, velocity: [%g]}\n"
                "  - {half-space: {point: [%g], normal: [%d]}, material: water, density: 1000, pressure: %g}\n",
                sign * meet[i][0], sign * 0.04, sign, meet[i][1]);
            cut_cell(layers, turned, 1.2, 1000.0, &u[turned], &p);
            near(p, wanted_p, 2e-3);
            mem_free(layers);
        }
        near(u[0], wanted, 1e-3);
        assert_true(u[1] == -u[0]);
    }
    cut_cell("  - {everywhere: true, material: water, density: 1000, pressure: 1 bar}\n"
             "  - {half-space: {point: [0.04], normal: [1]}, material: water, density: 1200, pressure: 1 GPa}\n",
             false, 1000.0, 1200.0, &u[0], &p);
    assert_true(u[0] == 0.0);
    near(p, 1e5 + 0.36 * (1e9 - 1e5), 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cut_cells_hold_the_contact)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
