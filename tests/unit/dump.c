/* Dumps of failed steps: what is kept of a tile gives the same bits again, in every dimension and geometry, from memory
 * and from a file; and a replay notices when anything is not as it was. */
#include "io/dump.h"

#include "flow.h"
#include "io/dump_read.h"
#include "io/dump_show.h"
#include "solve/blame_replay.h"

#include <sys/stat.h>

#define DUMP_GEL                                                                                         \
    "  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 600 MPa}, constitutive: {type: neo-hookean, " \
    "shear-modulus: "                                                                                    \
    "85 kPa, reference-density: 1000}}\n"

/* Matter that parts so fast, in steps so long, that no first-order flux and no sixty-fourth of a step saves it. */
static char *hopeless(const char *domain, const char *velocity, const char *materials, const char *scheme)
{
    bool air = strstr(materials, "air") != NULL, gel = strstr(materials, "gel") != NULL;
    return mem_print(
        "bulla: 1\ntitle: hopeless\ndomain: %s\nmesh: {tile: 16}\nmaterials:\n%sinitial:\n"
        "  - {everywhere: true, material: water, density: 1000, pressure: 1e5, velocity: %s}\n%s%s"
        "scheme: %s\nrun: {until: 1}\n",
        domain, materials, velocity,
        air ? "  - {sphere: {center: [0.3, 0.1], radius: 0.21}, material: air, density: 1, pressure: 1e5}\n" : "",
        gel ? "  - {half-space: {normal: [0, -1], point: [0, -2.5]}, material: gel, density: 1000, pressure: 1e5}\n"
            : "",
        scheme);
}

static const char line[] = "{lower: [-1], upper: [1], cells: [128], boundaries: {x-: periodic, x+: periodic}}";
static const char disc[] = "{geometry: axisymmetric, lower: [0, -1], upper: [1, 1], cells: [32, 64], boundaries: {x-: "
                           "axis, x+: outflow, y-: outflow, y+: outflow}}";
static const char cube[] = "{lower: [-1, -1, -1], upper: [1, 1, 1], cells: [32, 32, 32], boundaries: {x-: reflecting, "
                           "x+: reflecting, y-: reflecting, y+: reflecting, z-: reflecting, z+: reflecting}}";

/* Steps until one fails; returns what is kept of it, which belongs to the state. */
static const struct blame *fail_at_last(struct flow *flow, int most)
{
    int code = STATUS_OK;
    for (int i = 0; i < most && !code; i++) code = advance_step(flow->state, HUGE_VAL);
    assert_int_equal(code, STATUS_RUN);
    struct blame_facts facts;
    const struct blame *blame;
    assert_true(blame_find(flow->state, &facts, &blame));
    assert_non_null(blame);
    assert_int_equal(facts.step, flow->state->step + 1);
    assert_non_null(strstr(status_text(), facts.verdict));
    return blame;
}

static struct blame_outcome replay(const struct flow *flow, const struct blame *blame)
{
    struct blame_outcome outcome;
    blame_replay(flow->state->model, blame, &outcome);
    return outcome;
}

static void check_same(const struct flow *flow, const struct blame *blame)
{
    struct blame_outcome outcome = replay(flow, blame);
    assert_int_equal(outcome.faces, 0);
    assert_int_equal(outcome.cells, 0);
    assert_true(outcome.same_value);
    assert_string_equal(outcome.verdict, blame->facts.verdict);
    assert_true(outcome.same_verdict);
}

static void test_line(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, hopeless(line, "['= x > 0 and 500 or -500']", FLOW_WATER, "{limiter: mc, dt: 1 ms}"));
    const struct blame *blame = fail_at_last(&flow, 5);
    assert_true(blame->facts.masked);
    assert_int_equal(blame->facts.pure, -1);
    check_same(&flow, blame);
    flow_stop(&flow);
}

/* Strict: the first attempt is the last, without marks; the trouble is between water and air. */
static void test_strict(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, hopeless("{lower: [-1, -1], upper: [1, 1], cells: [64, 64], boundaries: {x-: periodic, x+: "
                               "periodic, y-: reflecting, y+: reflecting}}",
                               "['= x > 0.3 and 300 or -300', 10]", FLOW_WATER FLOW_AIR,
                               "{limiter: superbee, cfl: 0.9, guard: strict}"));
    const struct blame *blame = fail_at_last(&flow, 100);
    assert_false(blame->facts.masked);
    assert_non_null(blame->block[BLAME_K]);
    check_same(&flow, blame);
    flow_stop(&flow);
}

/* Hoop terms, exact areas: and tiles of one material in a scene of two. */
static void test_disc(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               hopeless(disc, "[0, '= y > -0.6 and 500 or -500']", FLOW_WATER FLOW_AIR, "{limiter: mc, dt: 10 ms}"));
    const struct blame *blame = fail_at_last(&flow, 5);
    check_same(&flow, blame);
    flow_stop(&flow);
}

/* A pure tile of water in a scene with air, strict: it is gone over with the water alone. */
static void test_pure(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               hopeless("{geometry: axisymmetric, lower: [0, -3], upper: [1, 1], cells: [32, 128], boundaries: {x-: "
                        "axis, x+: outflow, y-: outflow, y+: outflow}}",
                        "[0, '= y > -2.6 and 500 or -500']", FLOW_WATER FLOW_AIR,
                        "{limiter: mc, dt: 1 ms, guard: strict}"));
    const struct blame *blame = fail_at_last(&flow, 50);
    assert_int_equal(blame->facts.pure, 0);
    assert_null(blame->block[BLAME_K]);
    check_same(&flow, blame);
    flow_stop(&flow);
}

/* Fluids alone, in a scene with a solid: their tile has less of the closure than the scene has materials, and nothing
 * is written behind it. */
static void test_fluids(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               hopeless("{geometry: axisymmetric, lower: [0, -3], upper: [1, 1], cells: [32, 128], boundaries: {x-: "
                        "axis, x+: outflow, y-: outflow, y+: outflow}}",
                        "[0, '= y > 0.1 and 500 or 0']", FLOW_WATER FLOW_AIR DUMP_GEL,
                        "{limiter: mc, dt: 1 ms, guard: strict}"));
    const struct model *model = flow.state->model;
    const struct blame *blame = fail_at_last(&flow, 50);
    size_t n = blame->facts.n_cell;
    assert_int_equal(blame->facts.pure, SCENE_MATERIALS);
    assert_int_equal(blame_shape(model, &blame->facts, BLAME_K).rows, 2);
    check_same(&flow, blame);
    struct blame *like = blame_like(model, &blame->facts);
    double *given = mem_new(3 * n, sizeof *given), *room = mem_new(3 * n, sizeof *room);
    double *all = mem_new(model->n_field * n, sizeof *all), *K = like->block[BLAME_K];
    for (size_t i = 0; i < 3 * n; i++) given[i] = 1.0, room[i] = -7.0;
    like->block[BLAME_K] = room;
    blame_rates(like, model, &(struct term_tile){.u = all, .w = all, .K = given, .rho_c2 = given}, all);
    for (size_t i = 0; i < 3 * n; i++) assert_true(room[i] == (i < 2 * n ? 1.0 : -7.0));
    like->block[BLAME_K] = K;
    blame_free(like);
    mem_free(given);
    mem_free(room);
    mem_free(all);
    flow_stop(&flow);
}

/* One traction for both materials: the frame of the dump holds pressures, as it was gathered. */
static void test_split(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, mem_print("bulla: 1\ntitle: split\ndomain: {lower: [-1], upper: [1], cells: [64], boundaries: "
                                "{x-: outflow, x+: outflow}}\nmaterials:\n%sinitial:\n  - {everywhere: true, "
                                "material: water, density: 1000, pressure: 1e5, velocity: ['= x > 0.1 and 900 or "
                                "-900']}\n  - {half-space: {normal: [1], point: [0.1]}, material: gel, density: 1000, "
                                "pressure: 1e5}\nscheme: {riemann: hlld, limiter: mc, dt: 1 ms, guard: strict}\n"
                                "run: {until: 1}\n",
                                FLOW_WATER DUMP_GEL));
    assert_true(flow.state->model->split);
    const struct blame *blame = fail_at_last(&flow, 50);
    check_same(&flow, blame);
    flow_stop(&flow);
}

/* Three axes, in pieces. */
static void test_cube(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, hopeless(cube, "[0, 0, '= z > 0.2 and 500 or -500']", FLOW_WATER, "{limiter: mc, dt: 10 ms}"));
    const struct blame *blame = fail_at_last(&flow, 5);
    assert_non_null(blame->block[BLAME_FRAME_Z]);
    check_same(&flow, blame);
    flow_stop(&flow);
}

/* A neighbour's value of which one bit is another; a state before the step that is another. */
static void test_notices(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow,
               hopeless(line, "['= x > 0 and 500 or -500']", FLOW_WATER, "{limiter: mc, dt: 1 ms, guard: strict}"));
    const struct blame *blame = fail_at_last(&flow, 50);
    check_same(&flow, blame);
    const struct blame_facts *facts = &blame->facts;
    size_t ghosts = (size_t)flow.state->mesh->ghosts, row = (size_t)facts->n[0] + 2 * ghosts,
           at = flow.state->model->i_E * row + facts->cell + ghosts;
    uint64_t bits;
    double *value = &blame->block[BLAME_FRAME_X][at];
    memcpy(&bits, value, sizeof bits);
    bits ^= 1;
    memcpy(value, &bits, sizeof bits);
    struct blame_outcome outcome = replay(&flow, blame);
    assert_true(outcome.faces > 0);
    bits ^= 1;
    memcpy(value, &bits, sizeof bits);
    check_same(&flow, blame);
    blame->block[BLAME_U_OLD][flow.state->model->i_E * facts->n_cell + facts->cell] *= 2.0;
    outcome = replay(&flow, blame);
    assert_int_equal(outcome.faces, 0);
    assert_true(outcome.cells > 0);
    assert_false(outcome.same_verdict);
    flow_stop(&flow);
}

/* After refluxing there are no faces: state and verdict. The guard is given a tile as sync.c does. */
static void test_sync(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, hopeless(disc, "[0, 1]", FLOW_WATER FLOW_AIR, "{limiter: mc}"));
    struct stage *stage = flow.state->stages[0];
    size_t n = flow.state->mesh->n_cell, E = flow.state->model->i_E;
    guard_attempt(stage->guard);
    memcpy(stage->level->u_new[2], stage->level->u_old[2], flow.state->model->n_field * n * sizeof(double));
    stage->level->u_old[2][E * n + 5] = NAN;
    verdict_touch(stage, 2);
    assert_int_equal(stage->guard->bad[1], 1);
    stage->guard->found.stage = BLAME_FAILED_SYNC;
    stage->blame = blame_new(stage->model, stage->guard);
    blame_keep(stage->blame, stage->model, stage->level->w[2], stage->guard->kept);
    assert_string_equal(stage->blame->facts.field, "total_energy");
    assert_int_equal(stage->blame->facts.cell, 5);
    assert_null(stage->blame->block[BLAME_FACES]);
    check_same(&flow, stage->blame);
    flow_stop(&flow);
}

/* The first bad cell is that of the first tile, whatever the order in which tiles are looked at. */
static void test_first(void **state)
{
    (void)state;
    struct flow flow;
    flow_start(&flow, hopeless(line, "[1]", FLOW_WATER, "{limiter: mc}"));
    struct stage *stage = flow.state->stages[0];
    size_t n = flow.state->mesh->n_cell, E = flow.state->model->i_E;
    const unsigned order[] = {4, 1, 6, 3};
    guard_attempt(stage->guard);
    for (int i = 0; i < 4; i++) {
        stage->level->u_old[order[i]][E * n + order[i]] = -1e20;
        verdict_touch(stage, order[i]);
    }
    assert_int_equal(stage->guard->bad[1], 4);
    assert_int_equal(stage->guard->found.local, 1);
    assert_int_equal(stage->guard->found.cell, 1);
    assert_string_equal(stage->guard->found.field, "pressure");
    assert_non_null(strstr(stage->guard->cause, "(cell (1, 0, 0) of tile (1, 0, 0))"));
    flow_stop(&flow);
}

/* Through a file. */
struct filed {
    struct flow flow;
    char folder[64], *path;
};

static void filed_start(struct filed *filed)
{
    *filed = (struct filed){.folder = "/tmp/bulla-dump-XXXXXX"};
    assert_non_null(mkdtemp(filed->folder));
    flow_start(&filed->flow,
               hopeless(disc, "[0, '= y > -0.6 and 500 or -500']", FLOW_WATER FLOW_AIR, "{limiter: mc, dt: 10 ms}"));
    mem_free(filed->flow.scene->output.directory);
    filed->flow.scene->output.directory = mem_text(filed->folder);
    fail_at_last(&filed->flow, 5);
    if (dump_write(filed->flow.state, "{\"modules\": []}", &filed->path)) fail_msg("%s", status_text());
    assert_non_null(filed->path);
}

static void filed_stop(struct filed *filed)
{
    flow_stop(&filed->flow);
    unlink(filed->path);
    assert_int_equal(rmdir(filed->folder), 0); /* no draft is left */
    mem_free(filed->path);
}

/* The exit code and what was printed. */
static int say(int (*print)(FILE *out, const char *path), const char *path, char **ret_text)
{
    size_t length = 0;
    *ret_text = NULL;
    FILE *out = open_memstream(ret_text, &length);
    int code = print(out, path);
    fclose(out);
    return code;
}

static void test_file(void **state)
{
    (void)state;
    struct filed filed;
    char *text;
    filed_start(&filed);
    assert_non_null(strstr(filed.path, "/dump_000001.h5"));
    struct dump *dump;
    assert_int_equal(dump_read(filed.path, &dump), STATUS_OK);
    const struct blame *blame;
    struct blame_facts facts;
    blame_find(filed.flow.state, &facts, &blame);
    for (int i = 0; i < BLAME_BLOCKS; i++) {
        assert_int_equal(dump->block[i] != NULL, blame->block[i] != NULL);
        size_t n = dump->shape[i].rows * dump->shape[i].columns;
        if (n) assert_memory_equal(dump->block[i], blame->block[i], n * sizeof(double));
    }
    assert_true(dump->facts.dt == facts.dt && dump->facts.t == facts.t);
    assert_string_equal(dump->facts.verdict, facts.verdict);
    assert_string_equal(dump->resolved, filed.flow.scene->resolved);
    dump_read_free(dump);
    assert_int_equal(say(dump_show, filed.path, &text), STATUS_OK);
    assert_non_null(strstr(text, facts.verdict));
    assert_non_null(strstr(text, "left.sound_speed"));
    free(text);
    if (say(dump_show_replay, filed.path, &text)) fail_msg("%s\n%s", status_text(), text);
    assert_non_null(strstr(text, "0 of 256 cells"));
    free(text);
    filed_stop(&filed);
}

/* Cut anywhere: refused, or, if what is missing was padding, read; never more than a message. */
static void test_cut(void **state)
{
    (void)state;
    struct filed filed;
    char *text;
    struct stat info;
    filed_start(&filed);
    assert_int_equal(stat(filed.path, &info), 0);
    for (int part = 9; part >= 0; part--) {
        assert_int_equal(truncate(filed.path, info.st_size * part / 10), 0);
        assert_int_equal(say(dump_show_replay, filed.path, &text), STATUS_RUN);
        assert_non_null(strstr(status_text(), filed.path));
        free(text);
    }
    filed_stop(&filed);
}

/* Nothing failed: nothing is dumped. */
static void test_nothing(void **state)
{
    (void)state;
    struct flow flow;
    char *path;
    flow_start(&flow, hopeless(line, "[1]", FLOW_WATER, "{limiter: mc}"));
    flow_steps(&flow, 3);
    assert_int_equal(dump_write(flow.state, "{}", &path), STATUS_OK);
    assert_null(path);
    flow_stop(&flow);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_line),    cmocka_unit_test(test_strict),  cmocka_unit_test(test_disc),
        cmocka_unit_test(test_pure),    cmocka_unit_test(test_fluids),  cmocka_unit_test(test_cube),
        cmocka_unit_test(test_split),   cmocka_unit_test(test_notices), cmocka_unit_test(test_sync),
        cmocka_unit_test(test_first),   cmocka_unit_test(test_file),    cmocka_unit_test(test_cut),
        cmocka_unit_test(test_nothing),
    };
    return cmocka_run_group_tests_name("dump", tests, NULL, NULL);
}
