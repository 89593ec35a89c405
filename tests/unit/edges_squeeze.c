/* Edges of velocity and pressure beside vapour that is squeezed, for pairs that condense over cells: no further from
 * their cell than half the smaller difference, and the cell itself at extremes. No other edge changes. */
#include "flow.h"

#include "scheme/edges_squeeze.h"

enum { CELLS = 3, ROW = CELLS + 2, PITCH = 8 };

#define BEGIN                                                                                            \
    "bulla: 1\ndomain: {lower: [0], upper: [16], cells: [16], boundaries: {x-: outflow, x+: outflow}}\n" \
    "materials:\n  water: {eos: {type: nasg, preset: water-2016}}\n"                                     \
    "  steam: {eos: {type: ideal-gas, preset: water-2016}}\n"                                            \
    "phase-change:\n  - {liquid: water, vapour: steam, condense-over: 8}\ninitial:\n"                    \
    "  - {everywhere: true, material: water, temperature: 360, pressure: 1 bar}\nrun: {until: 1}\n"

static double w_own[FLOW_FIELDS * PITCH], w_state[2 * FLOW_FIELDS * PITCH];

/* Values of a component in the cells and one before and behind, edges `way` below and above each; of row q afterwards,
 * lower and upper by cell, ret. u: the sign of the velocities; back: all turned round. */
static void squeeze(const struct model *model, unsigned q, const double own[ROW], const double thin[ROW], double way,
                    bool pressure, bool back, double ret[CELLS][2])
{
    static double room[PITCH];
    double *upper = w_state + 2 * q * PITCH, *lower = upper + CELLS;
    for (size_t i = 0; i < ROW; i++) w_own[(model->i_alpha + 1) * PITCH + (back ? ROW - 1 - i : i)] = thin[i];
    for (size_t i = 0; i < ROW; i++) w_own[model->i_alpha * PITCH + (back ? ROW - 1 - i : i)] = 1.0 - thin[i];
    for (size_t i = 0; i < ROW; i++) w_own[q * PITCH + (back ? ROW - 1 - i : i)] = own[i];
    for (size_t i = 0; i < CELLS; i++) {
        double here = w_own[q * PITCH + i + 1];
        lower[i] = here + (back ? way : -way);
        upper[i] = here + (back ? -way : way);
    }
    edges_squeeze(&(struct edges_squeeze){.model = model,
                                          .n = CELLS,
                                          .step = 1,
                                          .pitch = PITCH,
                                          .w = w_own + 1,
                                          .state = w_state,
                                          .pressure = pressure,
                                          .thin = room});
    for (size_t i = 0; i < CELLS; i++) {
        size_t at = back ? CELLS - 1 - i : i;
        ret[i][0] = back ? upper[at] : lower[at];
        ret[i][1] = back ? lower[at] : upper[at];
    }
}

/* Velocities 8, 7, 3, 1, 1: half the smaller differences are 1/2, 1, 0. */
static const double fall[ROW] = {8.0, 7.0, 3.0, 1.0, 1.0}, half[CELLS] = {-0.5, -1.0, 0.0};
static const double foam[ROW] = {0.2, 0.2, 0.2, 0.2, 0.2};

static void test_velocity(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, mem_print("%s", BEGIN));
    const struct model *model = flow.state->model;
    for (int k = 0; k < 4; k++) {
        double at[CELLS][2], way = k / 2 ? -0.25 : -1.5, own[ROW];
        bool back = k % 2;
        for (size_t i = 0; i < ROW; i++) own[i] = back ? -fall[i] : fall[i];
        squeeze(model, model->i_u, own, foam, back ? -way : way, true, back, at);
        for (size_t i = 0; i < CELLS; i++) {
            double near = half[i] < way ? way : half[i], turn = back ? -1.0 : 1.0;
            assert_true(at[i][0] == own[i + 1] - turn * near && at[i][1] == own[i + 1] + turn * near);
        }
    }
    flow_stop(&flow);
}

/* What moves apart, has no vapour or no liquid beside it, or leans against its differences. */
static void test_others(void **state)
{
    (void)state;
    static const double drop[ROW] = {0.0, 0.0, 0.0, 5e-5, 2e-4}, dry[ROW] = {1.0, 1.0, 1.0, 1.0 - 5e-5, 1.0 - 2e-4};
    struct flow flow;
    flow_start(&flow, mem_print("%s", BEGIN));
    const struct model *model = flow.state->model;
    double at[CELLS][2], rise[ROW];
    for (size_t i = 0; i < ROW; i++) rise[i] = -fall[i];
    squeeze(model, model->i_u, rise, foam, 1.5, true, false, at);
    for (size_t i = 0; i < CELLS; i++) assert_true(at[i][0] == rise[i + 1] - 1.5 && at[i][1] == rise[i + 1] + 1.5);
    for (int k = 0; k < 2; k++) {
        squeeze(model, model->i_u, fall, k ? dry : drop, -1.5, true, false, at);
        for (size_t i = 0; i < CELLS; i++) {
            double near = i < 2 ? -1.5 : half[i];
            assert_true(at[i][0] == fall[i + 1] - near && at[i][1] == fall[i + 1] + near);
        }
    }
    squeeze(model, model->i_u, fall, foam, 1.5, true, false, at);
    for (size_t i = 0; i < CELLS; i++) assert_true(at[i][0] == fall[i + 1] && at[i][1] == fall[i + 1]);
    flow_stop(&flow);
}

/* By the velocities of before; not where pressure gets edges of its own. Densities never. */
static void test_pressure(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, mem_print("%s", BEGIN));
    const struct model *model = flow.state->model;
    double at[CELLS][2];
    squeeze(model, model->i_u, fall, foam, 0.0, true, false, at);
    for (int k = 0; k < 3; k++) {
        bool held = k == 0;
        squeeze(model, k < 2 ? model->i_E : model->i_m, fall, foam, -1.5, k != 1, false, at);
        for (size_t i = 0; i < CELLS; i++) {
            double near = held ? half[i] : -1.5;
            assert_true(at[i][0] == fall[i + 1] - near && at[i][1] == fall[i + 1] + near);
        }
    }
    flow_stop(&flow);
}

#define TUBE                                                                                              \
    "bulla: 1\ndomain: {lower: [0], upper: [1], cells: [100], boundaries: {x-: outflow, x+: outflow}}\n"  \
    "mesh: {tile: 100}\nmaterials:\n  water: {eos: {type: nasg, preset: water-2016}}\n"                   \
    "  steam: {eos: {type: ideal-gas, preset: water-2016}}\n"                                             \
    "phase-change:\n  - {liquid: water, vapour: steam}\ninitial:\n"                                       \
    "  - {everywhere: true, fractions: {water: 0.8, steam: 0.2}, temperature: 360, pressure: 63611.973, " \
    "velocity: [\"= x < 0.5 and 20 or -20\"]}\nrun: {until: 1}\n"

/* Two shocks in which all vapour condenses leave water of 1.65 MPa behind, which swings by less than a tenth here (with
 * slopes as everywhere 0.2 to 3.4 MPa, without `condense-over` -0.8 to 4.4). */
static void check_shock(const char *low_mach)
{
    struct flow flow;
    flow_start(&flow, mem_print(TUBE "scheme: {low-mach: %s}\n", low_mach));
    const struct model *model = flow.state->model;
    double least = 1e9, most = 0.0;
    flow_steps(&flow, 400);
    for (int step = 0; step < 100; step++) {
        flow_steps(&flow, 1);
        const double *p = flow_level(&flow)->w[0] + model->i_E * 100;
        for (size_t i = 46; i < 54; i++) least = p[i] < least ? p[i] : least, most = p[i] > most ? p[i] : most;
    }
    print_message("behind the shocks, low-mach %s: %.4g to %.4g MPa\n", low_mach, 1e-6 * least, 1e-6 * most);
    assert_true(least > 1.5e6 && most < 1.8e6);
    flow_stop(&flow);
}

static void test_shock(void **state)
{
    (void)state;
    check_shock("1");
    check_shock("0.05");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_velocity), cmocka_unit_test(test_others),
                                       cmocka_unit_test(test_pressure), cmocka_unit_test(test_shock)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
