/* The guard: what is not admissible is said with place and cause, a failed step leaves the last good state to the
 * bit, strict allows no repair, and the relaxation of one cell keeps what is conserved. */
#include "phys/relax.h"

#include "flow.h"

/* Water that parts at `speed`, a slab of air in the middle if there is air. */
static char *parting(const char *materials, double speed, const char *scheme)
{
    bool air = strstr(materials, "air") != NULL;
    return mem_print("bulla: 1\ntitle: parting\ndomain: {lower: [-1], upper: [1], cells: [128], boundaries: {x-: "
                     "periodic, x+: periodic}}\nmaterials:\n%sinitial:\n"
                     "  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: "
                     "['= x > 0 and %g or -%g']}\n%sscheme: %s\nrun: {until: 1}\n",
                     materials, speed, speed,
                     air ? "  - {box: {lower: [-0.05], upper: [0.11]}, material: air, density: 1, pressure: 1e5}\n"
                         : "",
                     scheme);
}

static void check_says_in(const char *text, const char *const *words)
{
    for (; *words; words++)
        if (!strstr(text, *words)) fail_msg("'%s' is not in: %s", *words, text);
}

/* The words that a failure must hold. */
static void check_says(const char *const *words)
{
    check_says_in(status_text(), words);
}

static void test_initial(void **state)
{
    (void)state;
    struct flow flow;
    int code =
        flow_open(&flow, mem_print("bulla: 1\ntitle: bad\ndomain: {lower: [0], upper: [1], cells: [64], boundaries: "
                                   "{x-: outflow, x+: outflow}}\nmaterials:\n" FLOW_WATER FLOW_AIR
                                   "initial:\n  - {everywhere: true, fractions: {water: 0.5, air: 0.5}, "
                                   "density: {water: 1000, air: 1}, pressure: '= x > 0.5 and -1e5 or 1e5'}\n"
                                   "run: {until: 1}\n"));
    assert_int_equal(code, STATUS_CASE);
    check_says((const char *const[]){"air", "0.5", "Pa", NULL});
    scene_free(flow.scene);
}

static double *snapshot(const struct flow *flow)
{
    unsigned n_field = flow->state->model->n_field;
    double *all = mem_new(n_field * flow->n_cell, sizeof *all);
    for (unsigned q = 0; q < n_field; q++) {
        double *u = flow_conserved(flow, q);
        memcpy(all + q * flow->n_cell, u, flow->n_cell * sizeof *u);
        mem_free(u);
    }
    return all;
}

/* Steps until one fails; the code, with the state before and after it compared. */
static int run_to_failure(struct flow *flow, int most)
{
    for (int i = 0; i < most; i++) {
        double *before = snapshot(flow), t = flow->state->t, *w = flow_primitive(flow, flow->state->model->i_E);
        long step = flow->state->step;
        int code = advance_step(flow->state, HUGE_VAL);
        if (code) {
            double *after = snapshot(flow), *now = flow_primitive(flow, flow->state->model->i_E);
            assert_memory_equal(before, after, flow->state->model->n_field * flow->n_cell * sizeof *after);
            for (size_t c = 0; c < flow->n_cell; c++) assert_true(w[c] == now[c]);
            assert_true(flow->state->t == t && flow->state->step == step);
            mem_free(after);
            mem_free(now);
        }
        mem_free(before);
        mem_free(w);
        if (code) return code;
    }
    return STATUS_OK;
}

static void test_strict(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, parting(FLOW_WATER FLOW_AIR, 800.0, "{limiter: superbee, cfl: 0.9, guard: strict}"));
    assert_int_equal(run_to_failure(&flow, 100), STATUS_RUN);
    check_says((const char *const[]){"strict", "air", "stage", "cell at (", "pressure", NULL});
    assert_int_equal(flow.state->counts.retries, 0);
    assert_int_equal(flow.state->counts.relaxed, 0);
    flow_stop(&flow);
}

/* A fixed step so long that not even its sixty-fourth part is stable. */
static void test_impossible(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, parting(FLOW_WATER, 500.0, "{limiter: mc, dt: 1 ms}"));
    assert_int_equal(run_to_failure(&flow, 5), STATUS_RUN);
    check_says((const char *const[]){"water", "stage", "cell at (", NULL});
    assert_true(flow.state->counts.retries > 0);
    assert_true(flow.state->counts.fallback > 0);
    flow_stop(&flow);
}

/* The same without `strict` goes on; what was done is counted. */
static void test_repairs(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, parting(FLOW_WATER FLOW_AIR, 800.0, "{limiter: superbee, cfl: 0.9}"));
    flow_steps(&flow, 100);
    struct state_counts counts = state_counts_total(flow.state);
    assert_true(counts.relaxed > 0);
    assert_int_equal(counts.cells, 100 * 2 * 128);
    flow_stop(&flow);
}

/* Without repair nothing is counted. */
static void test_idle(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, parting(FLOW_WATER FLOW_AIR, 0.0, "{limiter: mc}"));
    flow_steps(&flow, 5);
    assert_int_equal(flow.state->counts.relaxed + flow.state->counts.fallback + flow.state->counts.retries, 0);
    assert_int_equal(flow.state->counts.clipped, 0);
    flow_stop(&flow);
}

/* Steps that have to be repeated again and again: the run ends before t no longer moves, and the message says why. What
 * the case asks for counts instead; 0 leaves round-off alone. */
static void test_creeping(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, parting(FLOW_WATER FLOW_AIR, 0.0, "{limiter: mc}"));
    flow_steps(&flow, 3);
    double longest = flow.state->dt_longest, t = flow.state->t;
    assert_true(longest > 0.0 && longest >= flow.state->dt);
    flow.state->dt_shrink = 2e-6;
    assert_int_equal(advance_step(flow.state, HUGE_VAL), STATUS_OK);
    assert_true(flow.state->dt_longest == longest);
    t = flow.state->t;
    flow.state->dt_shrink = 5e-7;
    assert_int_equal(advance_step(flow.state, HUGE_VAL), STATUS_RUN);
    check_says((const char *const[]){"below 1e-06 of the longest so far", "repeated have left 5e-07", "water (",
                                     "temperature", "in the cell at (", NULL});
    assert_true(flow.state->t == t && flow.state->step == 4);
    flow.scene->run.dt_least = 0.0;
    assert_int_equal(advance_step(flow.state, HUGE_VAL), STATUS_OK);
    flow.state->dt_shrink = 1e-18;
    assert_int_equal(advance_step(flow.state, HUGE_VAL), STATUS_RUN);
    check_says((const char *const[]){"which t does not notice", "sound speed", NULL});
    flow.scene->run.dt_least = 1.0;
    flow.state->dt_shrink = 1.0;
    assert_int_equal(advance_step(flow.state, HUGE_VAL), STATUS_RUN);
    check_says((const char *const[]){"below run.smallest-step", NULL});
    flow_stop(&flow);
}

#define GEL                                                                                       \
    "  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, constitutive: {type: gent, " \
    "limit: 30, shear-modulus: 85 kPa, reference-density: 1060}}\n"

/* Air above a gel, all at rest, in `dim` dimensions; with one pressure in the plane. */
static char *above_gel(int dim)
{
    static const char *const domain[] = {"lower: [0], upper: [1], cells: [32], boundaries: {x-: outflow, x+: outflow}",
                                         "lower: [0, 0], upper: [1, 1], cells: [32, 32], boundaries: {x-: outflow, x+: "
                                         "outflow, y-: outflow, y+: outflow}"};
    return mem_print("bulla: 1\ntitle: gel\ndomain: {%s}\nmesh: {tile: 16}\nmaterials:\n" FLOW_AIR GEL
                     "initial:\n  - {everywhere: true, material: air, density: 1.2, pressure: 1e5}\n"
                     "  - {box: {lower: [0%s], upper: [0.53%s]}, material: gel, density: 1060, pressure: 1e5}\n"
                     "scheme: {traction: %s}\nrun: {until: 1}\n",
                     domain[dim - 1], dim > 1 ? ", 0" : "", dim > 1 ? ", 1" : "", dim > 1 ? "pressure" : "auto");
}

/* Judges tile 1, which has the interface, with cell 3 at these primitives; repair is not allowed. Returns whether the
 * cell was accepted, with its pressure as it was. */
static bool accepts(struct flow *flow, const double *w)
{
    struct stage *stage = flow->state->stages[0];
    const struct level *level = stage->level;
    size_t n = flow->state->mesh->n_cell;
    double own[FLOW_FIELDS], u[FLOW_FIELDS];
    memcpy(own, w, sizeof own);
    mix_conserved(stage->model, 1, 1, own, u);
    memcpy(level->u_new[1], level->u_old[1], stage->model->n_field * n * sizeof *u);
    for (unsigned q = 0; q < stage->model->n_field; q++) level->u_old[1][q * n + 3] = u[q];
    stage->guard->repair = false;
    guard_clear(stage->guard);
    guard_attempt(stage->guard);
    verdict_touch(stage, 1);
    assert_true(fabs(level->w[1][stage->model->i_E * n + 3] - w[stage->model->i_E]) < 1e-6 * 6e8);
    return stage->guard->bad[1] == 0;
}

/* A cell of real water and real air with less energy than they hold at any pressure that both bear: said so. */
static void test_no_pressure(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, mem_print("bulla: 1\ntitle: none\ndomain: {lower: [0], upper: [1], cells: [32], boundaries: {x-: "
                                "outflow, x+: outflow}}\nmesh: {tile: 16}\nmaterials:\n"
                                "  water: {eos: {type: mnasg, preset: water}}\n  air: {eos: {type: rkpr}}\ninitial:\n"
                                "  - {everywhere: true, fractions: {water: 0.5, air: 0.5}, temperature: 300, pressure: "
                                "1 bar}\nrun: {until: 1}\n"));
    struct stage *stage = flow.state->stages[0];
    stage->level->u_old[1][stage->model->i_E * flow.state->mesh->n_cell + 3] -= 1e8;
    stage->guard->repair = false;
    guard_attempt(stage->guard);
    verdict_touch(stage, 1);
    print_message("%s\n", stage->guard->cause);
    assert_true(stage->guard->bad[stage->tableau->n - 1] == 1);
    assert_non_null(strstr(stage->guard->cause, "it stands for none: the materials hold the energy of the cell at no"));
    flow_stop(&flow);
}

/* Primitives of a cell of gel and air at rest. */
static void gel_cell(const struct model *model, double solid, double p, double *w)
{
    memset(w, 0, FLOW_FIELDS * sizeof *w);
    w[model->i_alpha] = 1.0 - solid;
    w[model->i_alpha + 1] = solid;
    w[model->i_m] = 1.2;
    w[model->i_m + 1] = 1060.0;
    w[model->i_E] = p;
    for (unsigned c = 0; c < 3; c++) w[model->i_V + c] = 1.0;
}

/* Where materials share their traction, what air there is among more than half of solid need not bear the tension of
 * the gel; the gel must, and so must air that fills more of the cell, or any air where the pressure is common. */
static void test_tension(void **state)
{
    (void)state;
    struct flow flow;
    double w[FLOW_FIELDS];
    flow_start(&flow, above_gel(1));
    const struct model *model = flow.state->model;
    const char *cause = flow.state->stages[0]->guard->cause;
    assert_true(model->split);
    gel_cell(model, 0.7, -1e5, w);
    assert_true(accepts(&flow, w));
    gel_cell(model, 0.3, -1e5, w);
    assert_false(accepts(&flow, w));
    assert_non_null(strstr(cause, "below what material 'air' (volume fraction 0.7) can bear"));
    gel_cell(model, 0.7, -7e8, w);
    assert_false(accepts(&flow, w));
    assert_non_null(strstr(cause, "below what material 'gel' (volume fraction 0.7) can bear"));
    gel_cell(model, 0.3, 1e5, w);
    assert_true(accepts(&flow, w));
    gel_cell(model, 0.3, 10.0, w);
    w[model->i_V] = 1.2; /* pulled: the air has less than the mean */
    w[model->i_V + 1] = w[model->i_V + 2] = 1.0 / sqrt(1.2);
    assert_false(accepts(&flow, w));
    assert_non_null(
        strstr(cause, "below what material 'air' (volume fraction 0.7) can bear; the mean of the cell is 10 Pa"));
    flow_stop(&flow);
    flow_start(&flow, above_gel(2));
    model = flow.state->model;
    assert_false(model->split);
    gel_cell(model, 0.7, -1e5, w);
    assert_false(accepts(&flow, w));
    flow_stop(&flow);
}

/* Trouble of an elastic law is said as such: a stretch that is lost, with what it was; one beyond the law's range. */
static void test_elastic(void **state)
{
    (void)state;
    struct flow flow;
    double w[FLOW_FIELDS];
    flow_start(&flow, above_gel(2));
    const struct model *model = flow.state->model;
    struct stage *stage = flow.state->stages[0];
    size_t n = flow.state->mesh->n_cell;
    gel_cell(model, 1.0, 1e5, w);
    assert_true(accepts(&flow, w));
    memcpy(stage->level->u_new[1], stage->level->u_old[1], model->n_field * n * sizeof(double));
    for (unsigned c = 0; c < model->n_stretch; c++) stage->level->u_old[1][(model->i_V + c) * n + 3] = NAN;
    guard_attempt(stage->guard);
    verdict_touch(stage, 1);
    check_says_in(stage->guard->cause,
                  (const char *const[]){"stretch_xx = ", "nan of material 'gel' (gent)",
                                        "before the step (xx = 1, yy = 1", "cell (3, 0, 0)", NULL});
    assert_string_equal(stage->guard->found.field, "stretch_xx");
    for (unsigned c = 0; c < model->n_stretch; c++)
        stage->level->u_old[1][(model->i_V + c) * n + 3] = c == 0 ? 64.0 : c < 3 ? 0.125 : 0.0;
    guard_attempt(stage->guard);
    verdict_touch(stage, 1);
    check_says_in(stage->guard->cause, (const char *const[]){"pressure = -", "the elastic law 'gent' of 'gel' holds",
                                                             "at I1 = 4096.03", "beyond its range (I1 <= 31.5", NULL});
    flow_stop(&flow);
}

/* Random cells of a pair or a triple whose energy lies below what their fractions can hold: expanded too fast. The last
 * material has about `share` of the volume of the others. */
static void check_relax(const struct model *model, double share, uint64_t *seed, int *ret_done)
{
    double w[FLOW_FIELDS] = {0}, old[FLOW_FIELDS], u[FLOW_FIELDS], now[FLOW_FIELDS], sum = 0.0, floor = -HUGE_VAL;
    for (unsigned l = 0; l < model->n_material; l++) {
        w[l] = (0.02 + flow_random(seed)) * (l + 1 == model->n_material ? share : 1.0);
        sum += w[l];
        w[model->i_m + l] = model->eos[l].rho_fill * (0.9 + 0.2 * flow_random(seed));
    }
    for (unsigned l = 0; l < model->n_material; l++) w[l] /= sum;
    w[model->i_u] = 100.0 * (flow_random(seed) - 0.5);
    w[model->i_E] = 1e5 * pow(100.0, flow_random(seed));
    mix_conserved(model, 1, 1, w, old);
    memcpy(u, old, sizeof u);
    double loss = 0.02 * flow_random(seed); /* part of everything that left the cell; the fractions stayed */
    for (unsigned q = model->i_m; q < model->n_field; q++) u[q] *= 1.0 - loss;
    memcpy(now, u, sizeof now);
    double got[FLOW_FIELDS];
    memcpy(got, w, sizeof got);
    if (!relax_cell(model, 1, old, now, got)) return;
    (*ret_done)++;
    for (unsigned q = model->i_m; q < model->n_field; q++) assert_true(now[q] == u[q]);
    sum = 0.0;
    for (unsigned l = 0; l < model->n_material; l++) {
        double least, rho = got[model->i_m + l];
        assert_true(now[l] >= 0.0 && now[l] <= 1.0);
        sum += now[l];
        model->eos[l].law->p_min(model->eos[l].self, 1, &rho, &least);
        if (now[l] > MIX_ABSENT) floor = fmax(floor, least);
    }
    assert_true(fabs(sum - 1.0) <= 1e-14);
    if (!(got[model->i_E] > floor)) fail_msg("p = %g, least %g", got[model->i_E], floor);
    double again[FLOW_FIELDS];
    memcpy(again, got, sizeof again);
    mix_primitives(model, 1, 1, now, again);
    assert_true(fabs(again[model->i_E] - got[model->i_E]) <= 1e-6 * (fabs(got[model->i_E]) + 1.0));
}

static void test_relax_cell(void **state)
{
    (void)state;
    static const char *const materials[] = {
        (FLOW_WATER FLOW_AIR), (FLOW_WATER FLOW_AIR FLOW_HELIUM), ("  water: {eos: {type: mnasg}}\n" FLOW_AIR),
        "  water: {eos: {type: iapws95, table-size: 64}}\n  air: {eos: {type: rkpr}}\n",
        "  water: {eos: {type: modified-tait}}\n  air: {eos: {type: peng-robinson}}\n"};
    for (int i = 0; i < 5; i++) {
        struct flow flow;
        uint64_t seed = 99;
        int done = 0;
        flow_start(&flow,
                   mem_print("bulla: 1\ntitle: relax\ndomain: {lower: [0], upper: [1], cells: [8], boundaries: {x-: "
                             "outflow, x+: outflow}}\nmaterials:\n%sinitial:\n  - {everywhere: true, material: "
                             "air, density: 1.2, pressure: 1e5}\nrun: {until: 1}\n",
                             materials[i]));
        for (int k = 0; k < 2000; k++) check_relax(flow.state->model, k % 2 ? 1e-5 : 1.0, &seed, &done);
        print_message("relaxed %d of 2000 cells\n", done);
        assert_int_equal(done, 2000);
        flow_stop(&flow);
    }
}

/* A bubble of two gases that water in tension pulls apart: the gases' masses leave cells that their fractions stay in.
 * On the mesh and steps of each row the fractions once filled a cell, and the run stopped before its 100th step. */
static void test_empty(void **state)
{
    (void)state;
    static const char *const ROWS[][2] = {
        {"tile: 4", "limiter: mc, cfl: 0.4"},
        {"tile: 4", "limiter: superbee, cfl: 0.8"},
        {"levels: 2, tile: 4, regrid-every: 2, buffer: 3, patience: 1, refine: [{region: {box: {lower: [0.55, 0.3], "
         "upper: [0.8, 0.55]}}}]",
         "limiter: superbee, cfl: 0.8"},
    };
    for (size_t i = 0; i < sizeof ROWS / sizeof *ROWS; i++) {
        struct flow flow;
        flow_start(&flow,
                   mem_print("bulla: 1\ntitle: empty\ndomain: {geometry: axisymmetric, lower: [0, 0], upper: [1, 1], "
                             "cells: [16, 16], boundaries: {x-: axis, x+: reflecting, y-: periodic, y+: periodic}}\n"
                             "mesh: {%s}\nmaterials:\n" FLOW_WATER FLOW_HELIUM FLOW_AIR "initial:\n"
                             "  - {everywhere: true, material: water, density: 1000, pressure: 1e6, velocity: ['= 300 "
                             "* x * (1 - x)', 900]}\n"
                             "  - {sphere: {center: [0.45, 0.45], radius: 0.2}, fractions: {air: 0.7, helium: 0.3}, "
                             "density: {air: 1.2, helium: 0.17}, pressure: 1e5, velocity: ['= 300 * x * (1 - x)', "
                             "900]}\nscheme: {%s}\nrun: {until: 1}\n",
                             ROWS[i][0], ROWS[i][1]));
        flow_steps(&flow, 150);
        print_message("%s: %lld relaxed, %lld redone, %lld halved\n", ROWS[i][1], flow.state->counts.relaxed,
                      flow.state->counts.fallback, flow.state->counts.retries);
        flow_stop(&flow);
    }
}

/* Two runs of three steps, the second with its mesh made anew after the first step; `single`: as if that step had been
 * the last of all tries, which is one explicit step. The next steps find what their own integrator needs. */
static void check_last(bool single, double *ret_u)
{
    struct flow flow;
    const int same[] = {0, 1};
    const bool born[] = {false, false};
    flow_start(&flow, parting(FLOW_WATER, 10.0, "{integrator: ssprk3}"));
    struct stage *stage = flow.state->stages[0];
    flow_steps(&flow, 1);
    if (single) stage->tableau = tableau_numbered(TABLEAU_SINGLE);
    assert_int_equal(stage->level->n_local * flow.state->mesh->n_cell, 2 * 64);
    adopt_level(stage, same, born);
    stage->guard->bad[2] = 3;
    assert_int_equal(guard_bad(stage->guard), 3);
    flow_steps(&flow, 2);
    memcpy(ret_u, stage->level->u_old[1], flow.state->mesh->n_cell * sizeof *ret_u);
    flow_stop(&flow);
}

static void test_last(void **state)
{
    (void)state;
    double u[2][64];
    for (int single = 0; single < 2; single++) check_last(single, u[single]);
    assert_memory_equal(u[0], u[1], sizeof u[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_initial),  cmocka_unit_test(test_strict),      cmocka_unit_test(test_impossible),
        cmocka_unit_test(test_repairs),  cmocka_unit_test(test_idle),        cmocka_unit_test(test_relax_cell),
        cmocka_unit_test(test_creeping), cmocka_unit_test(test_tension),     cmocka_unit_test(test_elastic),
        cmocka_unit_test(test_empty),    cmocka_unit_test(test_no_pressure), cmocka_unit_test(test_last),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
