/* Behind a non-reflecting boundary of a ball a wave from its centre goes on: p' = f'(t - r/c)/r, Z u' = p' + c
 * f/r^2. */
#include "flow.h"

#include "scheme/bound.h"

enum { CELLS = 200 };

static const double c = 1600.0, rho = 1000.0, far = 1e5, A = 0.01, omega = 3200.0;

/* Pressure and velocity at r, t = 0, of f = A sin(omega (t - r/c)). */
static void wave(double r, double *p, double *u)
{
    double f = A * sin(-omega * r / c), rise = A * omega * cos(-omega * r / c) / r;
    *p = far + rise;
    *u = (rise + c * f / (r * r)) / (rho * c);
}

/* The layers behind the outer boundary of a ball of 1 m with that wave in it. */
static void layers_of(const char *type, double p[2], double u[2])
{
    struct flow flow;
    flow_start(&flow, mem_print("bulla: 1\ntitle: near\ndomain: {geometry: spherical, lower: [0], upper: [1], cells: "
                                "[%d], boundaries: {x-: symmetry, x+: {%s}}}\nmesh: {tile: %d}\nmaterials:\n"
                                "  water: {eos: {type: stiffened-gas, gamma: 4, p-inf: 639.9 MPa}}\n"
                                "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                                "run: {until: 1}\n",
                                CELLS, type, CELLS));
    const struct model *model = flow.state->model;
    const struct level *level = flow_level(&flow);
    double *w = level->w[0], frame_w[FLOW_FIELDS * FRAME_CELLS], h = 1.0 / CELLS;
    for (int i = 0; i < CELLS; i++)
        wave((i + 0.5) * h, &w[model->i_E * CELLS + (size_t)i], &w[model->i_u * CELLS + (size_t)i]);
    const struct frame_source source = flow_source(&flow);
    struct frame frame = frame_piece(flow.state->mesh, 0, 0);
    frame_gather(&source, 0, &frame, FRAME_CELLS, frame_w);
    for (int layer = 0; layer < 2; layer++) {
        size_t at = frame_at(&frame, 0, CELLS + layer);
        p[layer] = frame_w[model->i_E * FRAME_CELLS + at] - far;
        u[layer] = frame_w[model->i_u * FRAME_CELLS + at];
    }
    flow_stop(&flow);
}

/* To second order in the width of a cell over r and over the length of the wave. */
static void test_round(void **state)
{
    (void)state;
    double p[2], u[2], size = A * omega;
    layers_of("type: non-reflecting, pressure: 1e5", p, u);
    for (int layer = 0; layer < 2; layer++) {
        double want_p, want_u;
        wave(1.0 + (layer + 0.5) / CELLS, &want_p, &want_u);
        assert_true(fabs(p[layer] - (want_p - far)) < 1e-3 * size);
        assert_true(fabs(rho * c * (u[layer] - want_u)) < 1e-3 * size);
    }
}

/* A wave that comes in has all of the incoming invariant: both layers are what a plane wave makes of the cell. */
static void test_wave(void **state)
{
    (void)state;
    double p[2], u[2], at, inside;
    wave(1.0 - 0.5 / CELLS, &at, &inside);
    layers_of("type: incoming-wave, pressure: 1e5, pulse: sine, amplitude: 1e-9 Pa, frequency: 1 kHz", p, u);
    for (int layer = 0; layer < 2; layer++) {
        assert_true(fabs(p[layer] - 0.5 * (at - far + rho * c * inside)) < 1e-6 * A * omega + 1e-9 * far);
        assert_true(p[layer] == p[0] && u[layer] == u[0]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_round), cmocka_unit_test(test_wave)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
