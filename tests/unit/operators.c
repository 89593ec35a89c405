/* Operators that a test adds to the list: they act at their places in the step, on every level with its own steps; what
 * a repeated or halved step did is undone with it; tiles that rest are left alone unless an operator says that it moves
 * them; a dump of a step that an operator spoils gives the same bits again. */
#include "flow.h"

#include "scheme/operators.h"
#include "solve/blame_replay.h"

static const double RATE = 300.0, SPEED = 20.0;

static int calls, spoils; /* times an operator was called; how many it still spoils */

/* u falls as exp(-RATE t), exactly, whatever the steps; what kinetic energy loses is heat. */
static void brake(const struct operator_tile *tile)
{
    const struct model *model = tile->model;
    double left = exp(-RATE * tile->dt);
    calls++;
    for (unsigned d = 0; d < model->n_velocity; d++)
        for (size_t i = 0; i < tile->n_cell; i++) tile->u[(model->i_u + d) * tile->n_cell + i] *= left;
}

/* The energy of one cell is lost, as long as there is some to spoil. */
static void spoil(const struct operator_tile *tile)
{
    calls++;
    if (spoils-- > 0) tile->u[tile->model->i_E * tile->n_cell] = NAN;
}

/* Notes how far the states are that stages make. */
static double reached[8];

static void reach(const struct operator_tile *tile)
{
    reached[calls++ % 8] = tile->dt;
}

static bool every(const struct model *path)
{
    (void)path;
    return true;
}

/* Heats by what the primitives say: a thousandth of the pressure, per step. */
static void heat(const struct operator_tile *tile)
{
    size_t row = tile->model->i_E * tile->n_cell;
    for (size_t i = 0; i < tile->n_cell; i++) tile->u[row + i] += 1e-3 * tile->w[row + i];
}

static const struct operator brake_operator = {
    .name = "brake", .owner = "tests", .equation = "u", .when = OPERATOR_STEP, .acts = brake};
static const struct operator spoil_operator = {
    .name = "spoil", .owner = "tests", .equation = "E", .when = OPERATOR_STEP, .acts = spoil};
static const struct operator reach_operator = {
    .name = "reach", .owner = "tests", .equation = "t", .when = OPERATOR_STAGE, .acts = reach};
static const struct operator heat_operator = {.name = "heat",
                                              .owner = "tests",
                                              .equation = "E += p/1000",
                                              .when = OPERATOR_STEP,
                                              .moves = true,
                                              .reads = every,
                                              .acts = heat};

/* Adds to the list; both may be NULL. */
static void add(const struct operator* first, const struct operator* second)
{
    unsigned n = 0;
    while (operators_all[n] && strcmp(operators_all[n]->owner, "tests") != 0) n++;
    operators_all[n] = first;
    operators_all[n + (first != NULL)] = second;
    operators_all[n + (first != NULL) + (second != NULL)] = NULL;
    calls = spoils = 0;
}

static int end(void **state)
{
    (void)state;
    add(NULL, NULL);
    return 0;
}

static const char line[] = "{lower: [0], upper: [1], cells: [64], boundaries: {x-: periodic, x+: periodic}}";
static const char square[] = "{lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: periodic, x+: periodic, "
                             "y-: periodic, y+: periodic}}";
static const char finer[] =
    "mesh: {levels: 1, tile: 8, refine: [{region: {box: {lower: [0.2, 0.2], upper: [0.6, 0.7]}}}]}\n";

static void start(struct flow *flow, const char *domain, const char *mesh, const char *velocity, const char *scheme)
{
    flow_start(flow, mem_print("bulla: 1\ntitle: operators\ndomain: %s\n%smaterials:\n" FLOW_AIR
                               "initial:\n  - {everywhere: true, material: air, density: 1.2, pressure: 1e5, "
                               "velocity: %s}\nscheme: %s\nrun: {until: 1}\n",
                               domain, mesh, velocity, scheme));
}

static void check_speed(const struct flow *flow, double want, double tolerance)
{
    double *u = flow_primitive(flow, flow->state->model->i_u);
    for (size_t c = 0; c < flow->n_cell; c++) assert_true(fabs(u[c] / want - 1.0) < tolerance);
    mem_free(u);
}

static void test_step(void **state)
{
    (void)state;
    struct flow flow;
    size_t tiles;
    add(&brake_operator, NULL);
    start(&flow, line, "mesh: {tile: 16}\n", "[20]", "{cfl: 0.4}");
    tiles = flow_level(&flow)->n_local;
    flow_steps(&flow, 5);
    assert_int_equal(calls, 5 * (int)tiles); /* once a step, however many stages it has */
    check_speed(&flow, SPEED * exp(-RATE * flow.state->t), 1e-12);
    flow_stop(&flow);
}

/* Finer cells take two steps for one; averages and fluxes between the levels change nothing in a uniform flow. */
static void test_levels(void **state)
{
    (void)state;
    struct flow flow;
    add(&brake_operator, NULL);
    start(&flow, square, finer, "[20, 10]", "{cfl: 0.4}");
    assert_int_equal(flow.state->mesh->n_level, 2);
    double before = (double)flow_total(&flow, flow.state->model->i_E, &(double){0});
    flow_steps(&flow, 3);
    assert_true(fabs((double)flow_total(&flow, flow.state->model->i_E, &(double){0}) / before - 1.0) < 1e-14);
    check_speed(&flow, SPEED * exp(-RATE * flow.state->t), 2e-3); /* fluxes of mass at the edges of levels differ */
    flow_stop(&flow);
}

static void test_stages(void **state)
{
    (void)state;
    static const struct {
        const char *scheme;
        int n;
        double at[3];
    } cases[] = {{"{integrator: midpoint, dt: 1 us}", 2, {0.5, 1.0}},
                 {"{integrator: ssprk3, dt: 1 us}", 3, {1.0, 0.5, 1.0}}};
    for (int i = 0; i < 2; i++) {
        struct flow flow;
        add(&reach_operator, NULL);
        start(&flow, line, "mesh: {tile: 64}\n", "[20]", cases[i].scheme);
        calls = 0;
        flow_steps(&flow, 1);
        assert_int_equal(calls, cases[i].n);
        for (int s = 0; s < cases[i].n; s++) assert_true(fabs(reached[s] / 1e-6 - cases[i].at[s]) < 1e-12);
        flow_stop(&flow);
    }
}

/* A step that comes to nothing, once as it is and once halved: the brake has acted as often as there were accepted
 * steps. */
static void test_undone(void **state)
{
    (void)state;
    struct flow flow;
    add(&brake_operator, &spoil_operator);
    start(&flow, line, "mesh: {tile: 64}\n", "[20]", "{dt: 2 us}");
    flow_steps(&flow, 2);
    spoils = GUARD_ROUNDS + 2; /* all rounds of the first attempt, and one of the halved step */
    calls = 0;
    flow_steps(&flow, 1);
    assert_int_equal(calls, 2 * (GUARD_ROUNDS + 3));
    assert_int_equal(flow.state->counts.retries, 1);
    assert_true(fabs(flow.state->t - 5e-6) < 1e-18);
    check_speed(&flow, SPEED * exp(-RATE * flow.state->t), 1e-14);
    flow_stop(&flow);
}

/* What rests is not touched, unless the operator may move it. */
static void test_rest(void **state)
{
    (void)state;
    struct flow flow;
    add(&brake_operator, NULL);
    start(&flow, line, "mesh: {tile: 16}\n", "[0]", "{cfl: 0.4}");
    flow_steps(&flow, 3);
    assert_int_equal(calls, 0);
    flow_stop(&flow);
    add(&heat_operator, NULL);
    start(&flow, line, "mesh: {tile: 16}\n", "[0]", "{cfl: 0.4}");
    flow_steps(&flow, 3);
    double *p = flow_primitive(&flow, flow.state->model->i_E), want = 1e5 * pow(1.0 + 0.4e-3, 3.0);
    for (size_t c = 0; c < flow.n_cell; c++) assert_true(fabs(p[c] / want - 1.0) < 1e-13);
    mem_free(p);
    flow_stop(&flow);
}

/* The last attempt of a hopeless step, computed again from what was kept of it. */
static void test_dump(void **state)
{
    (void)state;
    struct flow flow;
    struct blame_facts facts;
    struct blame_outcome outcome;
    const struct blame *blame;
    add(&brake_operator, &spoil_operator);
    start(&flow, line, "mesh: {tile: 64}\n", "['= 20 + math.sin(2 * math.pi * x)']", "{dt: 2 us}");
    flow_steps(&flow, 2);
    spoils = INT32_MAX;
    assert_int_equal(advance_step(flow.state, HUGE_VAL), STATUS_RUN);
    assert_true(blame_find(flow.state, &facts, &blame));
    blame_replay(flow.state->model, blame, &outcome);
    assert_int_equal(outcome.cells, 0);
    assert_int_equal(outcome.faces, 0);
    assert_true(outcome.same_verdict);
    spoils = 0; /* an operator that does something else is seen */
    blame_replay(flow.state->model, blame, &outcome);
    assert_int_equal(outcome.cells, 1);
    flow_stop(&flow);
}

/* Closures begin at the pressures from before, whatever an operator has had made on the way: a path without it would.
 */
static void test_before(void **state)
{
    (void)state;
    struct flow flow;
    struct operators operators;
    add(&heat_operator, NULL);
    start(&flow, line, "mesh: {tile: 16}\n", "[20]", "{cfl: 0.4}");
    const struct model *model = flow.state->model;
    const struct level *level = &flow.state->mesh->levels[0];
    size_t n_cell = flow.state->mesh->n_cell;
    double before[64], *p = level->w[0] + model->i_E * n_cell;
    for (size_t i = 0; i < n_cell; i++) before[i] = 7.0 + (double)i;
    const struct operator_tile tile = {
        .model = model, .n_cell = n_cell, .dt = 1e-6, .u = level->u_old[0], .w = level->w[0], .before = before};
    operators_of(model, &operators);
    operators_act(&operators, true, &tile);
    assert_memory_equal(p, before, n_cell * sizeof *p);
    assert_true(level->u_old[0][model->i_E * n_cell] > 2.5e5); /* it had the pressure, 1e5, and not those */
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(test_step, end),   cmocka_unit_test_teardown(test_levels, end),
        cmocka_unit_test_teardown(test_stages, end), cmocka_unit_test_teardown(test_undone, end),
        cmocka_unit_test_teardown(test_rest, end),   cmocka_unit_test_teardown(test_dump, end),
        cmocka_unit_test_teardown(test_before, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
