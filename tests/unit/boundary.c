/* Boundaries: mirrors, copies and wraps to the bit; waves that leave without an echo and enter as they were asked
 * for; an inflow that fills the domain. Both sides of every axis. */
#include "flow.h"

enum { LONG = 160, ACROSS = 4 };

static const char NAMES[] = "xyz";

/* All six sides of a box: `type` on both sides of `axis` (or only on `side`, `other` opposite), periodic else. */
static char *sides_of(int dim, int axis, int side, const char *type, const char *other)
{
    char *text = mem_text("");
    for (int d = 0; d < dim; d++)
        for (int s = 0; s < 2; s++) {
            const char *one = d != axis ? "periodic" : s == side ? type : other;
            char *more = mem_print("%s%s%c%c: %s", text, *text ? ", " : "", NAMES[d], s ? '+' : '-', one);
            mem_free(text);
            text = more;
        }
    return text;
}

/* A column of LONG x ACROSS x ACROSS cells of 1/LONG along `axis`. */
static void start_column(struct flow *flow, int dim, int axis, char *sides, const char *fill)
{
    char upper[96] = "", cells[96] = "";
    for (int d = 0; d < dim; d++) {
        size_t a = strlen(upper), b = strlen(cells);
        snprintf(upper + a, sizeof upper - a, "%s%.17g", d ? ", " : "", d == axis ? 1.0 : (double)ACROSS / LONG);
        snprintf(cells + b, sizeof cells - b, "%s%d", d ? ", " : "", d == axis ? LONG : ACROSS);
    }
    flow_start(flow, mem_print("bulla: 1\ntitle: column\ndomain: {lower: [%s], upper: [%s], cells: [%s], boundaries: "
                               "{%s}}\nmaterials:\n" FLOW_WATER FLOW_AIR "initial:\n  - {everywhere: true, %s}\n"
                               "scheme: {cfl: 0.7}\nrun: {until: 1}\n",
                               dim == 1   ? "0"
                               : dim == 2 ? "0, 0"
                                          : "0, 0, 0",
                               upper, cells, sides, fill));
    mem_free(sides);
}

static void set_noise(const struct model *model, const double x[3], double *w)
{
    uint64_t seed = (uint64_t)(1e5 * (x[0] + 17.0 * x[1] + 331.0 * x[2]));
    w[0] = flow_random(&seed);
    w[1] = 1.0 - w[0];
    w[model->i_m] = 1000.0 + flow_random(&seed);
    w[model->i_m + 1] = 1.0 + flow_random(&seed);
    for (int d = 0; d < model->dim; d++) w[model->i_u + (unsigned)d] = flow_random(&seed) - 0.5;
    w[model->i_E] = 1e5 * (1.0 + flow_random(&seed));
}

/* Where the ghost layer behind a side gets its value, as an index along the axis, and with which sign. */
struct rule {
    const char *type;
    bool mirror, no_slip, wrap;
};

static void check_layer(const struct flow *flow, const struct rule *rule, const struct frame *frame, int side,
                        const double *w)
{
    const struct model *model = flow->state->model;
    int n = (int)frame->n;
    for (int ghost = 0; ghost < (int)frame->ghosts; ghost++) {
        int to = side ? n + ghost : -1 - ghost, inner = rule->mirror ? ghost : 0, from = side ? n - 1 - inner : inner;
        if (rule->wrap) from = side ? ghost : n - 1 - ghost;
        for (unsigned q = 0; q < model->n_field; q++) {
            bool velocity = q >= model->i_u && q < model->i_E;
            bool turned = velocity && rule->mirror && (rule->no_slip || q == model->i_u + (unsigned)frame->axis);
            const double *row = w + q * FRAME_CELLS;
            for (size_t o = 0; o < frame->outer; o++)
                for (size_t k = 0; k < frame->inner; k++) {
                    double got = row[frame_at(frame, o, to) + k], wanted = row[frame_at(frame, o, from) + k];
                    assert_true(got == (turned ? -wanted : wanted));
                }
        }
    }
}

/* One tile, so that the layers on both sides of a frame are those of the boundary or of the tile itself. */
static void check_rule(const struct rule *rule, const char *scheme, int axis)
{
    struct flow flow;
    flow_start(&flow,
               mem_print("bulla: 1\ntitle: layers\ndomain: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [8, 8, 8], "
                         "boundaries: {x-: %s, x+: %s, y-: %s, y+: %s, z-: %s, z+: %s}}\nmesh: {tile: 8}\n"
                         "materials:\n" FLOW_WATER FLOW_AIR
                         "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e5}\n"
                         "scheme: {reconstruction: %s}\nrun: {until: 1}\n",
                         rule->type, rule->type, rule->type, rule->type, rule->type, rule->type, scheme));
    flow_set(&flow, set_noise);
    const struct frame_source source = {.mesh = flow.state->mesh,
                                        .level = flow_level(&flow),
                                        .arrays = flow_level(&flow)->w,
                                        .halo = flow_level(&flow)->halo,
                                        .n_field = flow.state->model->n_field,
                                        .boundary = bound_fill,
                                        .data = flow.state->stages[0]->bound};
    double *w = mem_new((size_t)source.n_field * FRAME_CELLS, sizeof *w);
    for (size_t piece = 0; piece < frame_pieces(source.mesh, axis); piece++) {
        struct frame frame = frame_piece(source.mesh, axis, piece);
        frame_gather(&source, 0, &frame, FRAME_CELLS, w);
        for (int side = 0; side < 2; side++) check_layer(&flow, rule, &frame, side, w);
    }
    mem_free(w);
    flow_stop(&flow);
}

static void test_layers(void **state)
{
    (void)state;
    const struct rule rules[] = {{"symmetry", .mirror = true},
                                 {"reflecting", .mirror = true},
                                 {"no-slip", .mirror = true, .no_slip = true},
                                 {"outflow", .mirror = false},
                                 {"periodic", .wrap = true}};
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        for (int axis = 0; axis < 3; axis++) {
            check_rule(&rules[i], "muscl", axis);
            check_rule(&rules[i], "weno5-z", axis); /* three layers */
        }
}

/* How a case writes a type. */
static const char *written(enum scene_boundary_type type)
{
    if (type == SCENE_INFLOW)
        return "{type: inflow, fractions: {water: 0.5, air: 0.5}, density: {water: 1000, air: 1}, pressure: 2e5, "
               "velocity: [1, 1]}";
    if (type == SCENE_INCOMING_WAVE) return "{type: incoming-wave, pulse: sine, amplitude: 1e4, frequency: 1 MHz}";
    return scene_boundary_name(type);
}

/* Some pressure and motion, but one material. */
static void set_air(const struct model *model, const double x[3], double *w)
{
    set_noise(model, x, w);
    w[0] = 0.0;
    w[1] = 1.0;
}

/* Do the layers behind y+ of the only tile equal the cells inside? Do they hold no other material than air? */
static void look_behind(const struct flow *flow, bool *ret_equal, bool *ret_pure)
{
    const struct level *level = flow_level(flow);
    struct bound *bound = flow->state->stages[0]->bound;
    bound->t = 1e-7;
    const struct frame_source source = {.mesh = flow->state->mesh,
                                        .level = level,
                                        .arrays = level->w,
                                        .halo = level->halo,
                                        .n_field = flow->state->model->n_field,
                                        .boundary = bound_fill,
                                        .data = bound};
    double *w = mem_new((size_t)source.n_field * FRAME_CELLS, sizeof *w);
    struct frame frame = frame_piece(source.mesh, 1, 0);
    frame_gather(&source, 0, &frame, FRAME_CELLS, w);
    *ret_equal = *ret_pure = true;
    for (int ghost = 0; ghost < (int)flow->state->mesh->ghosts; ghost++)
        for (unsigned q = 0; q < source.n_field; q++)
            for (size_t k = 0; k < frame.inner; k++) {
                double behind = w[q * FRAME_CELLS + frame_at(&frame, 0, (int)frame.n + ghost) + k];
                double inside = w[q * FRAME_CELLS + frame_at(&frame, 0, (int)frame.n - 1) + k];
                if (!(behind == inside)) *ret_equal = false;
                if (q == 0 && behind != 0.0) *ret_pure = false;
            }
    mem_free(w);
}

/* What the table says of a type holds for its function. */
static void check_traits(enum scene_boundary_type type)
{
    struct flow flow;
    bool equal, pure;
    flow_start(&flow, mem_print("bulla: 1\ntitle: traits\ndomain: {lower: [0, 0], upper: [1, 1], cells: [8, 8], "
                                "boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: %s}}\nmesh: {tile: 8}\n"
                                "materials:\n" FLOW_WATER FLOW_AIR
                                "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e5}\n"
                                "run: {until: 1}\n",
                                type == SCENE_AXIS ? "symmetry" : written(type)));
    flow.scene->domain.boundary[1][1].type = type; /* no case has the axis there, but it can be filled */
    look_behind(&flow, &equal, &pure);
    print_message("%s: %s beside rest", scene_boundary_name(type), equal ? "rest" : "motion");
    if (scene_boundary_is(flow.scene, 3, SCENE_BOUNDARY_RESTS)) assert_true(equal);
    flow_set(&flow, set_air);
    look_behind(&flow, &equal, &pure);
    print_message(", %s\n", pure ? "the material inside alone" : "other materials");
    if (!scene_boundary_is(flow.scene, 3, SCENE_BOUNDARY_BRINGS)) assert_true(pure);
    bool refers = flow.state->stages[0]->bound->reference[3] != NULL;
    assert_int_equal(refers, scene_boundary_is(flow.scene, 3, SCENE_BOUNDARY_REFERS));
    flow_stop(&flow);
}

static void test_traits(void **state)
{
    (void)state;
    for (int type = 0; type < SCENE_BOUNDARY_MODULE; type++)
        if (type != SCENE_PERIODIC) check_traits((enum scene_boundary_type)type);
}

static const char WATER[] = "material: water, density: 1000, pressure: 1e5";

static double sound(void)
{
    return sqrt(4.4 * (1e5 + 6e8) / 1000.0);
}

/* A small wave of pressure that runs along `pulse_axis` towards `pulse_side`. */
static int pulse_axis, pulse_side;

static void set_pulse(const struct model *model, const double x[3], double *w)
{
    double s = (x[pulse_axis] - 0.5) / 0.08, dp = 1e3 * exp(-s * s), Z = 1000.0 * sound();
    w[model->i_m] = 1000.0 + dp / (sound() * sound());
    w[model->i_E] = 1e5 + dp;
    w[model->i_u + (unsigned)pulse_axis] = (pulse_side ? dp : -dp) / Z;
}

/* Largest |p - base| and |rho c u| in the domain. */
static double loudest(const struct flow *flow, double base, int axis)
{
    const struct model *model = flow->state->model;
    double *p = flow_primitive(flow, model->i_E), *u = flow_primitive(flow, model->i_u + (unsigned)axis), most = 0.0;
    for (size_t c = 0; c < flow->n_cell; c++) most = fmax(most, fmax(fabs(p[c] - base), fabs(u[c]) * 1000.0 * sound()));
    mem_free(p);
    mem_free(u);
    return most;
}

static void check_leaves(int dim, int axis, int side, const char *type, double most)
{
    struct flow flow;
    start_column(&flow, dim, axis, sides_of(dim, axis, side, type, "reflecting"), WATER);
    pulse_axis = axis;
    pulse_side = side;
    flow_set(&flow, set_pulse);
    double before = loudest(&flow, 1e5, axis);
    flow_until(&flow, 0.95 / sound());
    double echo = loudest(&flow, 1e5, axis) / before;
    print_message("%s %c%c in %dD: echo %.2e\n", type, NAMES[axis], side ? '+' : '-', dim, echo);
    if (!(echo < most)) fail_msg("echo %g", echo);
    flow_stop(&flow);
}

static void test_leaving(void **state)
{
    (void)state;
    for (int dim = 1; dim <= 3; dim++)
        for (int axis = dim < 3 ? 0 : 2; axis < dim; axis++)
            for (int side = 0; side < 2; side++) check_leaves(dim, axis, side, "non-reflecting", 0.01);
    check_leaves(1, 0, 1, "{type: incoming-wave, pulse: gaussian, amplitude: 0, center: 0 s, width: 1 s}", 0.01);
}

/* The wave in the column is what the pulse was at the boundary some time ago. */
static void check_enters(int dim, int axis, int side, const char *pulse)
{
    struct flow flow;
    char *type = mem_print("{type: incoming-wave, %s}", pulse);
    double worst = 0.0, push = 0.0, c0 = sound(), Z = 1000.0 * c0;
    start_column(&flow, dim, axis, sides_of(dim, axis, side, type, "non-reflecting"), WATER);
    mem_free(type);
    flow_until(&flow, 0.8 / c0);
    const struct model *model = flow.state->model;
    double *p = flow_primitive(&flow, model->i_E), *u = flow_primitive(&flow, model->i_u + (unsigned)axis);
    for (size_t c = 0; c < flow.n_cell; c++) {
        double x[3], s;
        flow_centre(&flow, c, x);
        s = (flow.state->t - (side ? 1.0 - x[axis] : x[axis]) / c0 - 2e-4) / 8e-5;
        double dp = 1e4 * exp(-s * s), into = side ? -u[c] : u[c];
        worst = fmax(worst, fabs(p[c] - 1e5 - dp) / 1e4);
        push = fmax(push, fabs(Z * into - dp) / 1e4);
    }
    print_message("wave from %c%c in %dD: p off by %.2e, rho c u by %.2e of the amplitude\n", NAMES[axis],
                  side ? '+' : '-', dim, worst, push);
    assert_true(worst < 0.02 && push < 0.02);
    mem_free(p);
    mem_free(u);
    flow_stop(&flow);
}

static void test_entering(void **state)
{
    (void)state;
    const char *gaussian = "pulse: gaussian, amplitude: 10 kPa, center: 0.2 ms, width: 0.08 ms";
    for (int dim = 1; dim <= 3; dim++)
        for (int axis = dim < 3 ? 0 : 2; axis < dim; axis++)
            for (int side = 0; side < 2; side++) check_enters(dim, axis, side, gaussian);
    check_enters(1, 0, 0, "pulse: lua, lua: 'function(t, x) return 1e4 * math.exp(-((t - 2e-4) / 8e-5)^2) end'");
}

/* A far-field pressure becomes the pressure of a closed end. */
static void test_far_field(void **state)
{
    (void)state;
    struct flow flow;
    start_column(&flow, 1, 0, sides_of(1, 0, 1, "{type: non-reflecting, pressure: 150 kPa}", "reflecting"), WATER);
    flow_until(&flow, 6.0 / sound());
    double off = loudest(&flow, 1.5e5, 0) / 5e4;
    print_message("far field: off by %.1e of the step\n", off);
    assert_true(off < 1e-3);
    flow_stop(&flow);
}

/* Gas at Mach 3 over gas: the inflow is all there is in the end, and it is the state asked for. */
static void check_inflow(int axis, int side)
{
    struct flow flow;
    char velocity[64] = "";
    for (int d = 0; d < 2; d++) {
        size_t at = strlen(velocity);
        snprintf(velocity + at, sizeof velocity - at, "%s%d", d ? ", " : "", d != axis ? 7 : side ? -1100 : 1100);
    }
    char *type = mem_print("{type: inflow, fractions: {water: 0.001, air: 0.999}, density: {water: 1000, air: 1.5}, "
                           "pressure: 120 kPa, velocity: [%s]}",
                           velocity);
    start_column(&flow, 2, axis, sides_of(2, axis, side, type, "outflow"),
                 "material: air, density: 1.2, pressure: 1e5");
    mem_free(type);
    flow_until(&flow, 3.0 / 1100.0);
    const struct model *model = flow.state->model;
    const double wanted[] = {0.001, 0.999, 1000.0, 1.5, 7.0, 7.0, 1.2e5};
    for (unsigned q = 0; q < model->n_field; q++) {
        double *w = flow_primitive(&flow, q), value = wanted[q];
        if (q == model->i_u + (unsigned)axis) value = side ? -1100.0 : 1100.0;
        for (size_t c = 0; c < flow.n_cell; c++) assert_true(fabs(w[c] - value) <= 1e-6 * fabs(value));
        mem_free(w);
    }
    flow_stop(&flow);
}

static void test_inflow(void **state)
{
    (void)state;
    for (int axis = 0; axis < 2; axis++)
        for (int side = 0; side < 2; side++) check_inflow(axis, side);
}

/* A script that fails stops the step with the line of the case, and the state stays. */
static void test_script_fails(void **state)
{
    (void)state;
    struct flow flow;
    const char *type = "{type: incoming-wave, pulse: lua, lua: 'function(t) return t > 1e-4 and nil + 1 or 0 end'}";
    start_column(&flow, 1, 0, sides_of(1, 0, 0, type, "outflow"), WATER);
    int code = STATUS_OK, steps = 0;
    double *before = NULL, *after;
    while (!code && steps++ < 1000) {
        mem_free(before);
        before = flow_primitive(&flow, flow.state->model->i_E);
        code = advance_step(flow.state, HUGE_VAL);
    }
    assert_int_equal(code, STATUS_CASE);
    assert_true(flow.state->t < 1.1e-4);
    after = flow_primitive(&flow, flow.state->model->i_E);
    assert_memory_equal(before, after, flow.n_cell * sizeof *after);
    mem_free(before);
    mem_free(after);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_layers),       cmocka_unit_test(test_traits),    cmocka_unit_test(test_leaving),
        cmocka_unit_test(test_entering),     cmocka_unit_test(test_far_field), cmocka_unit_test(test_inflow),
        cmocka_unit_test(test_script_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
