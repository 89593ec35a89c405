/* What the guard calls inadmissible, one cell at a time: no number, no stiffness, less than no mass, a
 * fraction without mass; what it names then, and what it repairs; and whose marks stay when the first stage of an
 * attempt was bad. */
#include "flow.h"

/* A tile with its speeds, as a stage hands it over. */
struct judged {
    struct flow flow;
    struct guard *guard;
    double *u, *w, *rho_c2, *c2;
    size_t n;
    struct guard_tile tile;
};

static void start(struct judged *judged)
{
    flow_start(&judged->flow,
               mem_print(
                   "bulla: 1\ntitle: judge\ndomain: {lower: [0], upper: [1], cells: [16], boundaries: {x-: outflow, "
                   "x+: outflow}}\nmesh: {tile: 16}\nmaterials:\n" FLOW_WATER FLOW_AIR
                   "initial:\n  - {everywhere: true, fractions: {water: 0.6, air: 0.4}, density: {water: 1000, air: "
                   "1.2}, pressure: 1e5}\nrun: {until: 1}\n"));
    const struct model *model = judged->flow.state->model;
    const struct level *level = flow_level(&judged->flow);
    size_t n = judged->n = judged->flow.state->mesh->n_cell;
    judged->guard = judged->flow.state->stages[0]->guard;
    judged->guard->repair = false;
    judged->u = mem_new(model->n_field * n, sizeof(double));
    judged->w = mem_new(model->n_field * n, sizeof(double));
    judged->rho_c2 = mem_new(2 * n, sizeof(double));
    judged->c2 = mem_new(n, sizeof(double));
    memcpy(judged->u, level->u_old[0], model->n_field * n * sizeof(double));
    memcpy(judged->w, level->w[0], model->n_field * n * sizeof(double));
    mix_stiffness(model, n, n, judged->w, judged->rho_c2);
    mix_speed2(model, n, n, judged->w, judged->rho_c2, judged->c2);
    judged->tile = (struct guard_tile){.model = model,
                                       .stage = 1,
                                       .u_old = level->u_old[0],
                                       .u = judged->u,
                                       .w = judged->w,
                                       .rho_c2 = judged->rho_c2,
                                       .c2 = judged->c2};
    guard_clear(judged->guard);
}

static void stop(struct judged *judged)
{
    double *all[] = {judged->u, judged->w, judged->rho_c2, judged->c2};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) mem_free(all[k]);
    flow_stop(&judged->flow);
}

static long long bad_with(struct judged *judged, double *place, double value)
{
    double before = *place;
    *place = value;
    guard_attempt(judged->guard);
    guard_check(judged->guard, &judged->tile);
    *place = before;
    return judged->guard->bad[1];
}

static void test_values(void **state)
{
    (void)state;
    struct judged judged;
    start(&judged);
    const struct model *model = judged.flow.state->model;
    double *p = judged.w + model->i_E * judged.n + 5, *E = judged.u + model->i_E * judged.n + 5;
    double *m = judged.u + model->i_m * judged.n + 5;
    const double wrong[] = {(double)NAN, HUGE_VAL, -HUGE_VAL};
    assert_int_equal(bad_with(&judged, p, *p), 0);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(bad_with(&judged, p, wrong[i]), 1);
        assert_int_equal(bad_with(&judged, E, wrong[i]), 1);
        assert_int_equal(bad_with(&judged, &judged.c2[5], wrong[i]), 1);
    }
    assert_int_equal(bad_with(&judged, &judged.c2[5], 0.0), 1);
    assert_int_equal(bad_with(&judged, &judged.rho_c2[5], -1.0), 1);
    assert_int_equal(bad_with(&judged, &judged.rho_c2[judged.n + 5], 0.0), 1);
    assert_int_equal(bad_with(&judged, m, -1.0), 1);
    assert_int_equal(bad_with(&judged, m, (double)NAN), 1);
    assert_int_equal(bad_with(&judged, m + judged.n, -1e-2), 1);
    assert_int_equal(bad_with(&judged, m + judged.n, 1e-9), 0);
    assert_int_equal(bad_with(&judged, m + judged.n, 0.0), 1); /* 0.4 of the cell, and nothing in it */
    assert_int_equal(bad_with(&judged, m + judged.n, -1e-9), 1);
    judged.u[judged.n + 5] = judged.w[judged.n + 5] = 1e-7;
    assert_int_equal(bad_with(&judged, m + judged.n, -1e-9), 0); /* round-off of 600 kg/m3 */
    assert_int_equal(bad_with(&judged, m + judged.n, -1e-2), 1);
    double *owed = flow_level(&judged.flow)->u_old[0] + (model->i_m + 1) * judged.n + 5;
    *owed = -1e-2;
    assert_int_equal(bad_with(&judged, m + judged.n, -1e-2), 0); /* not less than before the step */
    assert_int_equal(bad_with(&judged, m + judged.n, -1.0001e-2), 1);
    judged.u[judged.n + 5] = judged.w[judged.n + 5] = 1e-2;
    assert_int_equal(bad_with(&judged, m + judged.n, -1e-2), 1); /* a fraction and nothing in it */
    stop(&judged);
}

/* What is owed since before the step is not what is wrong with a cell. */
static void test_named(void **state)
{
    (void)state;
    struct judged judged;
    start(&judged);
    const struct model *model = judged.flow.state->model;
    double *m = judged.u + model->i_m * judged.n + 5,
           *owed = flow_level(&judged.flow)->u_old[0] + model->i_m * judged.n + 5;
    judged.u[5] = judged.w[5] = 1e-7;
    *owed = *m = -1e-2;
    assert_int_equal(bad_with(&judged, m, *m), 0);
    assert_int_equal(bad_with(&judged, &judged.rho_c2[judged.n + 5], -1.0), 1);
    print_message("%s\n", judged.guard->cause);
    assert_true(strstr(judged.guard->cause, "pressure") && strstr(judged.guard->cause, "'air'"));
    *owed = 0.0;
    assert_int_equal(bad_with(&judged, m, *m), 1);
    assert_non_null(strstr(judged.guard->cause, "partial_density_water = -0.01"));
    stop(&judged);
}

/* A fraction that has grown where the mass is owed: relaxation empties it, and the debt stays. */
static void test_repaired(void **state)
{
    (void)state;
    enum { CELL = 5, DEBT = 1 };
    struct judged judged;
    start(&judged);
    const struct model *model = judged.flow.state->model;
    size_t n = judged.n;
    double w[FLOW_FIELDS], u[FLOW_FIELDS], *old = flow_level(&judged.flow)->u_old[0];
    for (unsigned q = 0; q < model->n_field; q++) w[q] = judged.w[q * n + CELL];
    w[model->i_alpha + DEBT] = 2e-6;
    w[model->i_alpha] = 1.0 - 2e-6;
    mix_conserved(model, 1, 1, w, u);
    u[model->i_m + DEBT] = -1e-2;
    for (unsigned q = 0; q < model->n_field; q++) old[q * n + CELL] = judged.u[q * n + CELL] = u[q];
    mix_primitives(model, 1, n, judged.u + CELL, judged.w + CELL);
    guard_attempt(judged.guard);
    guard_check(judged.guard, &judged.tile);
    assert_int_equal(judged.guard->bad[1], 1);
    judged.guard->repair = true;
    guard_attempt(judged.guard);
    guard_check(judged.guard, &judged.tile);
    assert_int_equal(judged.guard->bad[1], 0);
    assert_int_equal(judged.guard->relaxed, 1);
    assert_true(judged.u[(model->i_alpha + DEBT) * n + CELL] == 0.0);
    assert_true(judged.u[(model->i_m + DEBT) * n + CELL] == -1e-2);
    stop(&judged);
}

/* Marks of the second stage count only if the first was clean on all ranks. Until the attempt is over no tile sees
 * them: which come before others hangs on the ranks. */
static void test_marks(void **state)
{
    (void)state;
    for (int first = 0; first < 2; first++) {
        struct judged judged;
        start(&judged);
        judged.guard->last = false;
        assert_int_equal(bad_with(&judged, &judged.c2[5], (double)NAN), 1);
        assert_true(judged.guard->mask[0][5] == 0.0);
        guard_settle(judged.guard, first ? 0 : 1);
        assert_true(judged.guard->mask[0][5] == (first ? 0.0 : 1.0) && judged.guard->mask[0][6] == 0.0);
        assert_int_equal(judged.guard->bad[1], first ? 0 : 1);
        stop(&judged);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_values), cmocka_unit_test(test_named),
                                       cmocka_unit_test(test_repaired), cmocka_unit_test(test_marks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
