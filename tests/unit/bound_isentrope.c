/* Densities behind a characteristic boundary lie on each material's isentrope: the error falls with the third power of
 * the pressure step, not with the second. And mirrors turn the shear of a stretch round. */
#include "flow.h"

/* Primitives of a line of eight cells, [n_field][FRAME_CELLS]; the places of the last one and of the one behind it. */
static double *gathered(const struct flow *flow, size_t *ret_inside, size_t *ret_behind)
{
    const struct model *model = flow->state->model;
    const struct frame_source source = {.mesh = flow->state->mesh,
                                        .level = flow_level(flow),
                                        .arrays = flow_level(flow)->w,
                                        .halo = flow_level(flow)->halo,
                                        .n_field = model->n_field,
                                        .boundary = bound_fill,
                                        .data = flow->state->stages[0]->bound};
    struct frame frame = frame_piece(source.mesh, 0, 0);
    double *w = mem_new((size_t)model->n_field * FRAME_CELLS, sizeof *w);
    frame_gather(&source, 0, &frame, FRAME_CELLS, w);
    *ret_inside = frame_at(&frame, 0, 7);
    *ret_behind = frame_at(&frame, 0, 8);
    return w;
}

/* Relative error of the density behind x+ of material l against its isentrope (p + P)/rho^gamma. */
static double error_of(double excess, unsigned l)
{
    static const double gamma[] = {4.4, 1.4}, P[] = {6e8, 0.0};
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: isentrope\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: {x-: "
                         "outflow, x+: {type: non-reflecting, pressure: %.17g}}}\nmaterials:\n" FLOW_WATER FLOW_AIR
                         "initial:\n  - {everywhere: true, fractions: {water: 0.4, air: 0.6}, density: {water: "
                         "1000, air: 1.2}, pressure: 1e9}\nrun: {until: 1}\n",
                         1e9 * (1.0 + excess)));
    const struct model *model = flow.state->model;
    size_t inside, behind;
    double *w = gathered(&flow, &inside, &behind);
    const double *p = w + model->i_E * FRAME_CELLS, *rho = w + (model->i_m + l) * FRAME_CELLS;
    assert_true(fabs(p[behind] / 1e9 - (1.0 + 0.5 * excess)) < 1e-3 * excess); /* half of the step comes in */
    double wanted = rho[inside] * pow((p[behind] + P[l]) / (p[inside] + P[l]), 1.0 / gamma[l]);
    double error = fabs(rho[behind] / wanted - 1.0);
    mem_free(w);
    flow_stop(&flow);
    return error;
}

static void test_order(void **state)
{
    (void)state;
    for (unsigned l = 0; l < 2; l++) {
        double wide = error_of(0.2, l), half = error_of(0.1, l), order = log2(wide / half);
        print_message("material %u: errors %.2e, %.2e, order %.2f\n", l, wide, half, order);
        assert_true(order > 2.8 && order < 3.3);
        assert_true(wide < 1e-3);
    }
}

/* A stream goes in and out through both sides as it is. */
static void test_stream(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: stream\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: {x-: "
                         "non-reflecting, x+: non-reflecting}}\nmaterials:\n" FLOW_AIR
                         "initial:\n  - {everywhere: true, material: air, density: 1.2, pressure: 1e5, velocity: "
                         "[100]}\nrun: {until: 1}\n"));
    flow_steps(&flow, 20);
    double *u = flow_primitive(&flow, flow.state->model->i_u), *p = flow_primitive(&flow, flow.state->model->i_E);
    for (size_t i = 0; i < flow.n_cell; i++) assert_true(fabs(u[i] - 100.0) < 1e-9 && fabs(p[i] - 1e5) < 1e-6);
    mem_free(u);
    mem_free(p);
    flow_stop(&flow);
}

static void set_strained(const struct model *model, const double x[3], double *w)
{
    for (unsigned c = 0; c < model->n_stretch; c++)
        w[model->i_V + c] = (c < 3 ? 1.0 : 0.0) + 0.01 * (c + 1.0) * (1.0 + x[0] + 2.0 * x[1] + 3.0 * x[2]);
}

/* Components with one index along the axis change sign behind a mirror, but not behind a no-slip wall. */
static void test_stretch(void **state)
{
    (void)state;
    static const char *const types[] = {"reflecting", "no-slip"};
    static const unsigned pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (int type = 0; type < 2; type++) {
        const char *t = types[type];
        struct flow flow;
        flow_start(&flow,
                   mem_print("bulla: 1\ntitle: stretch\ndomain: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [8, 8, "
                             "8], boundaries: {x-: %s, x+: %s, y-: %s, y+: %s, z-: %s, z+: %s}}\nmesh: {tile: "
                             "8}\nmaterials:\n  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, "
                             "constitutive: {type: neo-hookean, shear-modulus: 1 MPa, reference-density: 1000}}\n"
                             "initial:\n  - {everywhere: true, material: gel, density: 1000, pressure: 1e5}\n"
                             "run: {until: 1}\n",
                             t, t, t, t, t, t));
        flow_set(&flow, set_strained);
        const struct model *model = flow.state->model;
        const struct frame_source source = {.mesh = flow.state->mesh,
                                            .level = flow_level(&flow),
                                            .arrays = flow_level(&flow)->w,
                                            .halo = flow_level(&flow)->halo,
                                            .n_field = model->n_field,
                                            .boundary = bound_fill,
                                            .data = flow.state->stages[0]->bound};
        double *w = mem_new((size_t)model->n_field * FRAME_CELLS, sizeof *w);
        for (int axis = 0; axis < 3; axis++) {
            struct frame frame = frame_piece(source.mesh, axis, 0);
            frame_gather(&source, 0, &frame, FRAME_CELLS, w);
            for (unsigned c = 0; c < 6; c++) {
                const double *V = w + (model->i_V + c) * FRAME_CELLS;
                bool crossed = (pairs[c][0] == (unsigned)axis) != (pairs[c][1] == (unsigned)axis);
                double sign = crossed && type == 0 ? -1.0 : 1.0;
                assert_true(V[frame_at(&frame, 0, -1)] == sign * V[frame_at(&frame, 0, 0)]);
                assert_true(V[frame_at(&frame, 0, 9)] == sign * V[frame_at(&frame, 0, 6)]);
            }
        }
        mem_free(w);
        flow_stop(&flow);
    }
}

/* A far field that would draw all pressure out of a gas: it bears none, so what lies inside lies behind, too. */
static void test_borne(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, mem_print("bulla: 1\ntitle: borne\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: {x-: "
                                "outflow, x+: {type: non-reflecting, pressure: -300 kPa}}}\nmaterials:\n" FLOW_AIR
                                "initial:\n  - {everywhere: true, material: air, density: 1.2, pressure: 1e5, "
                                "velocity: [10]}\nrun: {until: 1}\n"));
    const struct model *model = flow.state->model;
    size_t inside, behind;
    double *w = gathered(&flow, &inside, &behind);
    for (unsigned q = 0; q < model->n_field; q++)
        assert_true(w[q * FRAME_CELLS + behind] == w[q * FRAME_CELLS + inside]);
    mem_free(w);
    flow_stop(&flow);
}

/* Water under tension bears what a trace of gas in it does not: the gas keeps its density, the water follows. */
static void test_trace(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: trace\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: {x-: "
                         "outflow, x+: {type: non-reflecting, pressure: -200 MPa}}}\nmaterials:\n" FLOW_WATER FLOW_AIR
                         "initial:\n  - {everywhere: true, fractions: {water: 0.999, air: 0.001}, "
                         "density: {water: 1000, air: 1.2}, pressure: 1e5}\nrun: {until: 1}\n"));
    const struct model *model = flow.state->model;
    size_t inside, behind;
    double *w = gathered(&flow, &inside, &behind);
    const double *rho = w + model->i_m * FRAME_CELLS, *p = w + model->i_E * FRAME_CELLS;
    assert_true(p[behind] < -9e7);
    assert_true(rho[behind] < 0.99 * rho[inside]);
    assert_true(rho[FRAME_CELLS + behind] == rho[FRAME_CELLS + inside]);
    mem_free(w);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_order), cmocka_unit_test(test_stream),
                                       cmocka_unit_test(test_stretch), cmocka_unit_test(test_borne),
                                       cmocka_unit_test(test_trace)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
