/* How surfaces lie to the axes, and what edges make of it: shares of the normal on meshes of unequal widths, a wave on
 * a surface that moves along it and gets no teeth, and pieces of rows. */
#include "flow.h"

#include "scheme/edges_slope.h"
#include "solve/curve.h"

enum { WAVE = 16 }; /* cells of a wave, and of the domain in each direction */

static void start(struct flow *flow, int dim, const char *lower, const char *cells, const char *third,
                  const char *scheme)
{
    const char *sides = dim == 2 ? "x-: periodic, x+: periodic, y-: symmetry, y+: symmetry"
                                 : "x-: outflow, x+: outflow, y-: outflow, y+: outflow, z-: outflow, z+: outflow";
    flow_start(flow, mem_print("bulla: 1\ntitle: slant\ndomain: {%s, cells: %s, boundaries: {%s}}\nmesh: {tile: 8}\n"
                               "materials:\n" FLOW_WATER FLOW_AIR "%sinitial:\n  - {everywhere: true, material: air, "
                               "density: 1.2, pressure: 1e5, velocity: %s}\nscheme: {%s}\nrun: {until: 1}\n",
                               lower, cells, sides, third, dim == 2 ? "[200, 0]" : "[0, 0, 0]", scheme));
}

/* Two materials, the last ones of a scene of three. */
static void set_fractions(const struct model *model, double part, double *w)
{
    for (unsigned l = 0; l < model->n_alpha; l++) w[model->i_alpha + l] = 0.0, w[model->i_m + l] = 1000.0;
    w[model->i_alpha + model->n_alpha - 2] = part;
    w[model->i_alpha + model->n_alpha - 1] = 1.0 - part;
}

/* Fronts three cells wide through the middle of 16^dim cells whose widths are 1, 2 and 1. */
static void set_front(const struct model *model, const double x[3], double *w)
{
    double plane = 0.6 * (x[0] - 8.0) + 0.8 * (x[1] - 16.0);
    double space = ((x[0] - 8.0) + 2.0 * (x[1] - 16.0) + 2.0 * (x[2] - 8.0)) / 3.0;
    set_fractions(model, 0.5 + 0.5 * tanh((model->dim == 2 ? plane : space) / 3.0), w);
}

/* Largest error of the shares n_d^2 in cells that are no traces, away from boundaries. */
static double error_of(int dim, const char *third)
{
    static const double share[2][3] = {{0.36, 0.64, 0.0}, {1.0 / 9.0, 4.0 / 9.0, 4.0 / 9.0}};
    struct flow flow;
    double error = 0.0;
    start(&flow, dim, dim == 2 ? "lower: [0, 0], upper: [16, 32]" : "lower: [0, 0, 0], upper: [16, 32, 16]",
          dim == 2 ? "[16, 16]" : "[16, 16, 16]", third, "interface-along: normal");
    const struct model *model = flow.state->model;
    flow_set(&flow, set_front);
    curve_take(flow.state->work->curve, 0, flow_level(&flow)->w);
    double *part = flow_primitive(&flow, model->i_alpha + model->n_alpha - 1);
    for (int d = 0; d < dim; d++) {
        double *slant = flow_primitive(&flow, model->i_slant + (unsigned)d);
        for (size_t c = 0; c < flow.n_cell; c++) {
            double x[3];
            flow_centre(&flow, c, x);
            bool inside =
                x[0] > 1.0 && x[0] < 15.0 && x[1] > 2.0 && x[1] < 30.0 && (dim == 2 || fabs(x[2] - 8.0) < 7.0);
            if (inside && part[c] * (1.0 - part[c]) > 0.01) error = fmax(error, fabs(slant[c] - share[dim - 2][d]));
        }
        mem_free(slant);
    }
    mem_free(part);
    flow_stop(&flow);
    return error;
}

static void test_shares(void **state)
{
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        double two = error_of(dim, ""), three = error_of(dim, FLOW_HELIUM);
        print_message("%d axes: error of n_d^2 %.2e; with a third material that is nowhere %.2e\n", dim, two, three);
        assert_true(two > 0.0 && two < 0.04);
        assert_true(fabs(three - two) < 1e-9);
    }
}

/* A surface across y, half-way through a cell, with a wave of 0.45 cells. */
static void set_wave(const struct model *model, const double x[3], double *w)
{
    double part = x[1] < 8.0 ? 1.0 : x[1] > 9.0 ? 0.0 : 0.5 + 0.45 * sin(2.0 * M_PI * x[0] / WAVE);
    set_fractions(model, part, w);
}

/* Amplitude of the part of the height that goes `mode` times up and down. */
static double height_mode(const struct flow *flow, int mode)
{
    double *part = flow_primitive(flow, flow->state->model->i_alpha), sum[2] = {0};
    for (size_t c = 0; c < flow->n_cell; c++) {
        double x[3];
        flow_centre(flow, c, x);
        sum[0] += part[c] * cos(2.0 * M_PI * mode * x[0] / WAVE) * 2.0 / WAVE;
        sum[1] += part[c] * sin(2.0 * M_PI * mode * x[0] / WAVE) * 2.0 / WAVE;
    }
    mem_free(part);
    return hypot(sum[0], sum[1]);
}

/* Moved along itself by one wave. */
static void carried(struct flow *flow, const char *scheme)
{
    start(flow, 2, "lower: [0, 0], upper: [16, 16]", "[16, 16]", "", scheme);
    flow_set(flow, set_wave);
    flow_until(flow, WAVE / 200.0);
}

static void test_wave(void **state)
{
    (void)state;
    static const char *const schemes[] = {
        "interface-limiter: thinc, interface-along: normal",
        "interface-limiter: thinc, interface-along: normal, along-limiter: {type: thinc, beta: 1.15}",
        "interface-limiter: thinc, interface-along: axes"};
    enum { NORMAL, MILD, AXES, WAYS };
    double first[WAYS], third[WAYS];
    for (int along = 0; along < WAYS; along++) {
        struct flow flow;
        carried(&flow, schemes[along]);
        first[along] = height_mode(&flow, 1);
        third[along] = height_mode(&flow, 3);
        flow_stop(&flow);
    }
    print_message("wave %.3f, teeth %.4f; with a mild tangent along %.3f, %.4f; along axes %.3f, %.4f\n", first[NORMAL],
                  third[NORMAL], first[MILD], third[MILD], first[AXES], third[AXES]);
    assert_true(first[NORMAL] > 0.4 && third[NORMAL] < 0.04);
    assert_true(first[MILD] > 0.4 && third[MILD] < 0.06);
    assert_true(third[MILD] > 0.045 && third[AXES] > 0.1); /* else this tells nothing */
}

/* Schemes may ask for the edges of a part of a row: its cells keep their slants. What a scheme brings of its own has
 * none, and gets the limiter as it is. */
static void test_pieces(void **state)
{
    (void)state;
    enum { CELLS = 62, PITCH = 64, FROM = 17, PART = 20 };
    double rows[3 * PITCH], room[9 * PITCH], whole[2 * PITCH], part[2 * PITCH], own[2 * PITCH], copy[PITCH];
    uint64_t seed = 7;
    struct flow flow;
    start(&flow, 2, "lower: [0, 0], upper: [16, 16]", "[16, 16]", "", "interface-limiter: thinc");
    const struct model *model = flow.state->model;
    struct edges_slope soft = {.limiter = model->limiter, .difference = room, .slope = room + PITCH};
    struct edges_slope steep = {.call = {.edges = edges_slope_limit},
                                .limiter = model->limiter_alpha,
                                .soft = &soft,
                                .cells = rows + 1,
                                .slant = rows + 2 * PITCH + 1,
                                .pitch = PITCH,
                                .rows = 2,
                                .room = room + 2 * PITCH};
    for (int i = 0; i < 3 * PITCH; i++) rows[i] = 0.01 * (i % PITCH) + 0.02 * flow_random(&seed);
    const double *second = rows + PITCH + 1;
    memcpy(copy, second - 1, sizeof copy);
    edges_slope_limit(&steep.call, CELLS, 1, second, whole, whole + PITCH);
    edges_slope_limit(&steep.call, PART, 1, second + FROM, part, part + PITCH);
    edges_slope_limit(&steep.call, CELLS, 1, copy + 1, own, own + PITCH);
    assert_memory_equal(part, whole + FROM, PART * sizeof *part);
    assert_memory_equal(part + PITCH, whole + PITCH + FROM, PART * sizeof *part);
    steep.soft = NULL;
    edges_slope_limit(&steep.call, CELLS, 1, second, whole, whole + PITCH);
    assert_memory_equal(own, whole, CELLS * sizeof *own);
    assert_true(memcmp(part, whole + FROM, PART * sizeof *part) != 0);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_shares), cmocka_unit_test(test_wave),
                                       cmocka_unit_test(test_pieces)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
