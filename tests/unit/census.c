/* What need not be computed: a tile of one solid that is uniform and at rest may be carried on only if it is
 * unstretched, because mirrors and hoops feel a stretch. */
#include "flow.h"

static void set_stretched(const struct model *model, const double x[3], double *w)
{
    (void)x;
    w[model->i_V] = 1.25;
    w[model->i_V + 1] = 0.8;
}

static void start(struct flow *flow)
{
    flow_start(flow,
               mem_print("bulla: 1\ntitle: stretched\ndomain: {geometry: axisymmetric, lower: [0, 0], upper: [1, 1], "
                         "cells: [16, 16], boundaries: {x-: axis, x+: reflecting, y-: symmetry, y+: outflow}}\n"
                         "mesh: {tile: 8}\nmaterials:\n  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 "
                         "MPa}, constitutive: {type: neo-hookean, shear-modulus: 1 MPa, reference-density: 1000}}\n"
                         "initial:\n  - {everywhere: true, material: gel, density: 1000, pressure: 1e5}\n"
                         "run: {until: 1}\n"));
}

static void test_stretched(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow);
    const struct model *model = flow.state->model;
    flow_set(&flow, set_stretched);
    for (unsigned t = 0; t < flow_level(&flow)->n_local; t++)
        assert_false(flow.state->stages[0]->census.tiles[t].still);
    flow_steps(&flow, 1);
    assert_true(flow.state->counts.carried == 0);
    double *u = flow_primitive(&flow, model->i_u), dt = flow.state->dt;
    for (size_t i = 0; i < flow.n_cell;
         i++) { /* rho du/dt = (s_rr - s_tt)/r = G (B_rr - B_tt)/r, away from the walls */
        double x[3], wanted;
        flow_centre(&flow, i, x);
        if (i % 16 < 5 || i % 16 > 10 || i / 16 < 5 || i / 16 > 10) continue;
        wanted = dt * 1e6 * (1.25 * 1.25 - 1.0) / (1000.0 * x[0]);
        assert_true(fabs(u[i] / wanted - 1.0) < 1e-3);
    }
    mem_free(u);
    flow_stop(&flow);
}

/* Unstretched, all of it is carried on. */
static void test_level(void **state)
{
    (void)state;
    struct flow flow;
    start(&flow);
    flow_steps(&flow, 2);
    assert_true(flow.state->counts.carried > 0 && flow.state->counts.carried == flow.state->counts.cells);
    flow_stop(&flow);
}

/* Beside finer tiles nothing may be carried on, at rest or not: refluxing asks for the fluxes. */
static void test_beside(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: beside\ndomain: {lower: [0, 0], upper: [1, 1], cells: [48, 48], boundaries: "
                         "{x-: reflecting, x+: reflecting, y-: reflecting, y+: reflecting}}\nmesh: {levels: 1, tile: "
                         "8, refine: [{region: {box: {lower: [0.4, 0.4], upper: [0.6, 0.6]}}}]}\nmaterials:\n" FLOW_AIR
                         "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e5}\n"
                         "run: {until: 1}\n"));
    flow_steps(&flow, 3);
    double *u = flow_primitive(&flow, flow.state->model->i_u);
    assert_true(flow.state->mesh->n_level == 2 && flow.state->counts.carried > 0);
    for (size_t i = 0; i < flow.n_cell; i++) assert_true(u[i] == 0.0);
    mem_free(u);
    flow_stop(&flow);
}

/* What flows in comes into a tile that holds nothing of it. */
static void test_inflow(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, mem_print("bulla: 1\ntitle: inflow\ndomain: {lower: [0], upper: [1], cells: [16], boundaries: "
                                "{x-: {type: inflow, material: air, density: 1.2, pressure: 1e5, velocity: [10]}, "
                                "x+: outflow}}\nmesh: {tile: 8}\nmaterials:\n" FLOW_WATER FLOW_AIR
                                "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5, "
                                "velocity: [10]}\nrun: {until: 1}\n"));
    flow_steps(&flow, 1);
    double *air = flow_primitive(&flow, flow.state->model->i_alpha + 1), wanted = 10.0 * flow.state->dt * 16.0;
    assert_true(fabs(air[0] / wanted - 1.0) < 0.02);
    mem_free(air);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_stretched), cmocka_unit_test(test_level),
                                       cmocka_unit_test(test_beside), cmocka_unit_test(test_inflow)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
