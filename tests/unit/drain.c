/* Liquid that lies behind a surface goes back to it, with mass, energy and momentum to round-off, the same in a mirror
 * and along every axis; what is at rest stays so. Beside a stretched gel it takes along the energy of
 * its own pressure. */
#include "flow.h"

#include "phys/traction.h"
#include "scheme/drain.h"

static const double P = 101325.0, T = 372.66;
static double speed;
static int along;
static bool back;
static double gel; /* what a stretched gel fills of each cell, on a line */

#define CELLS 24

static void start(struct flow *flow, int axis, const char *onset)
{
    static const char *const domain[] = {
        "lower: [0, 0], upper: [24, 4], cells: [24, 4], boundaries: {x-: symmetry, x+: symmetry, y-: periodic, y+: "
        "periodic}",
        "lower: [0, 0], upper: [4, 24], cells: [4, 24], boundaries: {x-: periodic, x+: periodic, y-: symmetry, y+: "
        "symmetry}",
        "lower: [0], upper: [24], cells: [24], boundaries: {x-: symmetry, x+: symmetry}"};
    flow_start(flow, mem_print("bulla: 1\ndomain: {%s}\nmesh: {tile: 4}\nmaterials:\n"
                               "  water: {eos: {type: nasg, preset: water-2016}, conductivity: 1e-9 W/m/K}\n"
                               "  steam: {eos: {type: ideal-gas, preset: water-2016}}\n%s"
                               "phase-change: [{liquid: water, vapour: steam, rate: none%s}]\n"
                               "initial:\n  - {everywhere: true, material: water, temperature: 372.66, pressure: 1 atm}"
                               "\nscheme: {low-mach: 0.05}\nrun: {until: 1}\n",
                               domain[gel > 0.0 ? 2 : axis],
                               gel > 0.0 ? "  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 616576970}, "
                                           "constitutive: {type: neo-hookean, shear-modulus: 100 MPa, "
                                           "reference-density: 1060}}\n"
                                         : "",
                               onset));
    along = axis;
}

static double wetness(double at)
{
    return at < 8.0 ? 0.0 : at < 10.0 ? 0.03 : at < 11.0 ? 0.3 : 0.9;
}

/* The gel beside both, at their traction. */
static void set_gel(const struct model *model, double *w)
{
    double mean, *V = w + model->solids[0].stretch;
    for (unsigned l = 0; l < 2; l++) w[model->i_alpha + l] *= 1.0 - gel;
    w[model->i_alpha + 2] = gel;
    w[model->i_m + 2] = 1060.0;
    V[0] = 1.5;
    V[1] = V[2] = 1.0 / sqrt(1.5);
    traction_mean(model, 1, 1, w, &mean);
    w[model->i_E] += mean;
}

/* Vapour at rest, with some liquid, behind liquid that goes away from it; saturated. */
static void set(const struct model *model, const double x[3], double *w)
{
    double at = back ? CELLS - x[along] : x[along], wet = wetness(at);
    double p = P, temperature = T;
    for (unsigned l = 0; l < 2; l++)
        model->eos[l].law->density(model->eos[l].self, 1, &p, &temperature, &w[model->i_m + l]);
    w[model->i_alpha] = wet;
    w[model->i_alpha + 1] = 1.0 - wet;
    w[model->i_u + (unsigned)along] = at < 10.0 ? 0.0 : back ? -speed : speed;
    w[model->i_E] = P;
    if (model->n_velocity > 1) w[model->i_u + 1 - (unsigned)along] = 0.25;
    if (model->n_solid) set_gel(model, w);
}

/* Fractions of the liquid along the axis after some steps; totals are kept. */
static void run(int axis, const char *onset, double u, bool mirrored, double ret_wet[CELLS])
{
    struct flow flow;
    start(&flow, axis, onset);
    const struct model *model = flow.state->model;
    speed = u, back = mirrored;
    flow_set(&flow, set);
    const unsigned kept[] = {model->i_m, model->i_m + 1, model->i_E};
    long double before[3];
    double size[3];
    for (int q = 0; q < 3; q++) before[q] = flow_total(&flow, kept[q], &size[q]);
    flow_steps(&flow, 200);
    for (int q = 0; q < 3; q++)
        assert_true(fabsl(flow_total(&flow, kept[q], &size[q]) - before[q]) < 1e-13L * (long double)size[q]);
    double *wet = flow_primitive(&flow, model->i_alpha);
    for (size_t c = 0; c < flow.n_cell; c++) {
        double x[3];
        flow_centre(&flow, c, x);
        size_t at = (size_t)x[axis];
        if (x[1 - axis] < 1.0) ret_wet[mirrored ? CELLS - 1 - at : at] = wet[c];
    }
    mem_free(wet);
    flow_stop(&flow);
}

static double behind(const double wet[CELLS])
{
    double sum = 0.0;
    for (size_t i = 0; i < 10; i++) sum += wet[i];
    return sum;
}

static void test_back(void **state)
{
    (void)state;
    double with[CELLS], without[CELLS], rest[CELLS], other[CELLS];
    run(0, ", onset: 0.99", 20.0, false, with);
    run(0, "", 20.0, false, without);
    print_message("liquid behind the surface: %.4g cells, without onset %.4g, at first 0.06\n", behind(with),
                  behind(without));
    assert_true(behind(with) < 0.85 * behind(without));
    for (int k = 0; k < 3; k++) {
        run(k > 0, ", onset: 0.99", 20.0, k != 1, other);
        assert_memory_equal(other, with, sizeof with);
    }
    run(0, ", onset: 0.99", 0.0, false, rest);
    for (size_t i = 0; i < CELLS; i++) assert_true(fabs(rest[i] - wetness((double)i + 0.5)) < 1e-12);
}

/* What cells of the first line have after one step: of water, of steam, of energy. */
static void step(const char *onset, double ret[3][CELLS], double ret_heat[2])
{
    struct flow flow;
    start(&flow, 0, onset);
    const struct model *model = flow.state->model;
    const unsigned which[] = {model->i_m, model->i_m + 1, model->i_E};
    speed = 20.0, back = false;
    flow_set(&flow, set);
    flow_steps(&flow, 1);
    for (int q = 0; q < 3; q++) {
        double *all = flow_conserved(&flow, which[q]);
        for (size_t c = 0; c < flow.n_cell; c++) {
            double x[3];
            flow_centre(&flow, c, x);
            if (x[1] < 1.0) ret[q][(size_t)x[0]] = all[c];
        }
        mem_free(all);
    }
    for (unsigned l = 0; l < 2; l++) {
        double p = P, temperature = T, rho, rho_e, rho_c2;
        model->eos[l].law->density(model->eos[l].self, 1, &p, &temperature, &rho);
        model->eos[l].law->state(model->eos[l].self, 1, &rho, &p, &rho_e, &rho_c2);
        ret_heat[l] = rho_e / rho;
    }
    flow_stop(&flow);
}

/* The masses that have changed places took their energy along. */
static void test_heat(void **state)
{
    (void)state;
    double with[3][CELLS], without[3][CELLS], heat[2];
    step(", onset: 0.99", with, heat);
    step("", without, heat);
    for (size_t i = 9; i < 11; i++) {
        double water = with[0][i] - without[0][i], steam = with[1][i] - without[1][i];
        double energy = with[2][i] - without[2][i], expected = water * heat[0] + steam * heat[1];
        print_message("cell %zu: %.4g kg/m3 of water, %.4g of steam; %.5g J/m3 for %.5g\n", i, water, steam, energy,
                      expected);
        assert_true(fabs(water) > 1e-3 && water * steam < 0.0 && (water < 0.0) == (i == 9));
        assert_true(fabs(energy / expected - 1.0) < 0.02);
    }
}

/* Pressures of the fluids after one step. */
static void pressed(const char *onset, double ret[CELLS])
{
    struct flow flow;
    start(&flow, 0, onset);
    const struct model *model = flow.state->model;
    speed = 20.0, back = false;
    flow_set(&flow, set);
    flow_steps(&flow, 1);
    double *w = mem_new(model->n_field * CELLS, sizeof *w), mean[CELLS];
    for (unsigned q = 0; q < model->n_field; q++) {
        double *row = flow_primitive(&flow, q);
        memcpy(w + q * CELLS, row, CELLS * sizeof *w);
        mem_free(row);
    }
    traction_mean(model, CELLS, CELLS, w, mean);
    for (size_t i = 0; i < CELLS; i++) ret[i] = w[model->i_E * CELLS + i] - mean[i];
    mem_free(w);
    flow_stop(&flow);
}

/* And that of their own pressures, not of the cell's: what has changed places leaves them as they are. */
static void test_pressed(void **state)
{
    (void)state;
    double with[CELLS], without[CELLS], worst = 0.0;
    gel = 0.3;
    pressed(", onset: 0.99", with);
    pressed("", without);
    gel = 0.0;
    for (size_t i = 0; i < CELLS; i++) worst = fmax(worst, fabs(with[i] - without[i]));
    print_message("beside a stretched gel pressures change by %.3g Pa\n", worst);
    assert_true(worst < 4.0); /* 7 by the pressure of the cell */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_back), cmocka_unit_test(test_heat),
                                       cmocka_unit_test(test_pressed)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
