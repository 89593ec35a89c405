/* provenance.c - what made these results: the keys of provenance.json and what they say. */
#include "io/provenance.h"

#include "io/ledger.h"
#include "levels_io.h"
#include "replicated.h"
#include "solve/cost.h"
#include "solve/stage.h"

#include <jansson.h>
#include <math.h>

static json_t *load(const struct small *small)
{
    json_error_t error;
    char *path = small_path(small, "provenance.json");
    json_t *root = json_load_file(path, 0, &error);
    if (!root) print_error("%s\n", error.text);
    assert_non_null(root);
    mem_free(path);
    return root;
}

static const char *text_of(json_t *root, const char *key)
{
    const char *text = json_string_value(json_object_get(root, key));
    if (!text) fail_msg("no text %s", key);
    return text;
}

static void test_running(void **state)
{
    (void)state;
    struct small small;
    struct provenance *provenance;
    char program[] = "bulla", word[] = "run", file[] = "tiny.yaml", *argv[] = {program, word, file, NULL};
    small_start(&small, SMALL_AXISYMMETRIC);
    assert_int_equal(provenance_new(small.state, 3, argv, &provenance), 0);
    json_t *root = load(&small);
    assert_string_equal(text_of(root, "exit_reason"), "running");
    assert_true(json_is_null(json_object_get(root, "exit_code")));
    assert_string_equal(text_of(root, "version"), BULLA_VERSION);
    assert_true(strlen(text_of(root, "commit")) >= 7);
    assert_string_equal(text_of(root, "title"), "A bubble, half of it");
    assert_int_equal(json_array_size(json_object_get(root, "command")), 3);
    assert_int_equal(json_integer_value(json_object_get(root, "ranks")), 1);
    assert_int_equal(json_object_size(json_object_get(root, "hosts")), 1);
    json_t *modules = json_object_get(root, "modules"), *module = json_array_get(modules, 0);
    assert_int_equal(json_array_size(modules),
                     7); /* two equations of state, one reconstruction, two limiters, two Riemann solvers */
    assert_string_equal(text_of(module, "name"), "stiffened-gas");
    assert_int_equal(strlen(text_of(module, "xxh64")), 16);
    assert_int_equal(*text_of(module, "path"), '/');
    char *text = small_text(&small, "provenance.json");
    assert_string_equal(provenance_text(provenance), text);
    mem_free(text);
    json_decref(root);
    provenance_free(provenance);
    small_stop(&small);
}

static void test_end(void **state)
{
    (void)state;
    struct small small;
    struct provenance *provenance;
    char program[] = "bulla", *argv[] = {program, NULL};
    small_start(&small, SMALL_AXISYMMETRIC);
    assert_int_equal(provenance_new(small.state, 1, argv, &provenance), 0);
    small_skip(&small, 1e-7);
    small.state->counts.cells += 4096;
    small.state->counts.clipped = 3;
    size_t m_air = (small.state->model->i_m + 1) * small.state->mesh->n_cell; /* double the air of every tile */
    for (unsigned i = 0; i < small.state->mesh->levels[0].n_local; i++)
        for (size_t c = 0; c < small.state->mesh->n_cell; c++) small.state->mesh->levels[0].u_old[i][m_air + c] *= 2.0;
    assert_int_equal(provenance_write(provenance, small.state, "end time", 0), 0);
    json_t *root = load(&small), *conservation = json_object_get(root, "conservation");
    assert_string_equal(text_of(root, "exit_reason"), "end time");
    assert_int_equal(json_integer_value(json_object_get(root, "exit_code")), 0);
    assert_true(strlen(text_of(root, "started")) == 20 && strlen(text_of(root, "ended")) == 20);
    assert_int_equal(json_integer_value(json_object_get(root, "steps")), 1);
    assert_int_equal(json_integer_value(json_object_get(root, "cells")), 2048);
    assert_true(json_integer_value(json_object_get(root, "cells_updated")) >= 4096);
    assert_true(json_integer_value(json_object_get(root, "peak_memory_bytes")) > 2048 * 7 * 8);
    assert_true(json_number_value(json_object_get(root, "cpu_s")) > 0);
    assert_true(json_number_value(json_object_get(root, "bytes_per_cell")) > 0);
    assert_int_equal(json_integer_value(json_object_get(json_object_get(root, "guard"), "clipped")), 3);
    json_t *air = json_object_get(conservation, "mass_air"), *water = json_object_get(conservation, "mass_water");
    assert_true(fabs(json_number_value(json_object_get(air, "relative_change")) - 1.0) < 1e-12);
    assert_true(json_number_value(json_object_get(water, "relative_change")) == 0.0);
    assert_non_null(json_object_get(conservation, "momentum_x"));
    assert_non_null(json_object_get(conservation, "energy"));
    json_decref(root);
    provenance_free(provenance);
    small_stop(&small);
}

/* The environment that matters, the processor, the flags of the compiler. */
static void test_surroundings(void **state)
{
    (void)state;
    struct small small;
    struct provenance *provenance;
    char program[] = "bulla", odd[] = "--set=\xff", *argv[] = {program, odd, NULL};
    setenv("OMP_NUM_THREADS", "3", 1);
    setenv("BULLA_TEST_ODD", "\xff", 1);
    setenv("OMPI_MCA_orte_secret", "1", 1);
    setenv("SOME_PASSWORD", "1", 1);
    small_start(&small, SMALL_AXISYMMETRIC);
    assert_int_equal(provenance_new(small.state, 2, argv, &provenance), 0);
    json_t *root = load(&small), *environment = json_object_get(root, "environment"),
           *cpu = json_object_get(root, "cpu");
    assert_string_equal(text_of(environment, "OMP_NUM_THREADS"), "3");
    assert_true(json_is_null(json_object_get(environment, "BULLA_TEST_ODD"))); /* JSON has no place for it */
    assert_null(json_object_get(environment, "OMPI_MCA_orte_secret"));
    assert_null(json_object_get(environment, "SOME_PASSWORD"));
    assert_true(json_integer_value(json_object_get(cpu, "processors")) >= 1);
    assert_non_null(text_of(cpu, "model"));
    assert_non_null(strstr(text_of(root, "compiled"), "-ffp-contract=off"));
    assert_non_null(strstr(text_of(root, "compiled"), "optimised"));
    assert_null(strstr(text_of(root, "compiled"), "-ffast-math"));
    assert_string_equal(json_string_value(json_array_get(json_object_get(root, "command"), 1)), "--set=%FF");
    json_decref(root);
    provenance_free(provenance);
    small_stop(&small);
    unsetenv("BULLA_TEST_ODD");
    unsetenv("OMPI_MCA_orte_secret");
    unsetenv("SOME_PASSWORD");
}

static double split_of(json_t *root, const char *part)
{
    json_t *value = json_object_get(json_object_get(root, "cpu_split_s"), part);
    if (!json_is_real(value)) fail_msg("no part %s", part);
    return json_real_value(value);
}

/* CPU time by stages: what was sampled, scaled to all steps; outputs; the rest is `other`. A run that goes on adds what
 * was noted of the one before. */
static void test_split(void **state)
{
    (void)state;
    static const char *const parts[] = {"exchange", "gather", "faces",  "update", "primitives",
                                        "levels",   "output", "regrid", "other"};
    struct small small;
    struct provenance *provenance, *second;
    char program[] = "bulla", *argv[] = {program, NULL};
    struct notes notes = {0};
    small_start(&small, SMALL_AXISYMMETRIC);
    struct cost *cost = &small.state->work->cost;
    assert_int_equal(provenance_new(small.state, 1, argv, &provenance), 0);
    cost->n[COST_STEP] = 74;
    cost->sampled[COST_STEP] = 2;
    cost->sum[COST_STEP][COST_FACES] = 1e-9;
    cost->sum[COST_STEP][COST_EXCHANGE] = 2e-9;
    provenance_output(provenance, 3e-9);
    small.state->counts.regrid_seconds = 4e-9;
    for (double end = cost_cpu() + 0.02; cost_cpu() < end;) continue;
    small.state->counts.cells = 1000;
    assert_int_equal(provenance_write(provenance, small.state, "finished", 0), 0);
    json_t *root = load(&small);
    assert_true(fabs(split_of(root, "faces") / 37e-9 - 1.0) < 1e-12);
    assert_true(fabs(split_of(root, "exchange") / 74e-9 - 1.0) < 1e-12);
    assert_true(split_of(root, "gather") == 0.0 && split_of(root, "output") == 3e-9);
    assert_true(split_of(root, "regrid") == 4e-9);
    double sum = 0.0, run = 1e-9 * 1000 * json_number_value(json_object_get(root, "cpu_ns_per_cell_stage"));
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sum += split_of(root, parts[i]);
    assert_true(run >= 0.02 && fabs(sum / run - 1.0) < 1e-9); /* nothing is left out or counted twice */
    json_decref(root);
    provenance_keep(provenance, small.state, &notes);
    provenance_free(provenance);
    memset(cost, 0, sizeof *cost);
    small.state->counts.regrid_seconds = 0.0;
    assert_int_equal(provenance_new(small.state, 1, argv, &second), 0);
    assert_int_equal(provenance_recall(second, small.state, &notes), 0);
    root = load(&small);
    assert_int_equal(json_integer_value(json_object_get(root, "runs")), 2);
    assert_true(fabs(split_of(root, "faces") / 37e-9 - 1.0) < 1e-12 && split_of(root, "output") == 3e-9);
    assert_true(split_of(root, "regrid") == 4e-9);
    json_decref(root);
    text_done(&notes.text);
    provenance_free(second);
    small_stop(&small);
}

static bool near(const double *x)
{
    return hypot(x[0], x[1]) < 0.85e-3;
}

/* What there is of each level, and was at most. */
static void test_levels(void **state)
{
    (void)state;
    struct small small;
    struct provenance *provenance;
    struct mesh_change change;
    char program[] = "bulla", *argv[] = {program, NULL};
    small_start_levels(&small, SMALL_AXISYMMETRIC, 1);
    assert_int_equal(provenance_new(small.state, 1, argv, &provenance), 0);
    levels_add(small.state, near);
    provenance_watch(provenance, small.state);
    small.state->counts.regrids = 1;
    small.state->counts.limited = 5;
    small.state->counts.spread = 7;
    small.state->counts.carried = 256;
    small.state->level_steps[1] = 12;
    small.state->work->balance.level[1] = (struct balance_level){3.0, 0.25};
    small.state->counts.regrid_seconds = 1e-9;
    assert_int_equal(provenance_write(provenance, small.state, "finished", 0), 0);
    json_t *root = load(&small), *fine = json_array_get(json_object_get(root, "levels"), 1);
    assert_int_equal(json_integer_value(json_object_get(root, "cells")), 24 * 256);
    assert_int_equal(json_integer_value(json_object_get(root, "leaves")), 24 * 256 - 16 * 64);
    assert_int_equal(json_integer_value(json_object_get(fine, "tiles")), 16);
    assert_int_equal(json_integer_value(json_object_get(fine, "leaves")), 16 * 256);
    json_t *refinement = json_object_get(root, "refinement");
    assert_int_equal(json_integer_value(json_object_get(refinement, "regrids")), 1);
    assert_true(json_number_value(json_object_get(refinement, "regrid_share")) > 0.0);
    assert_int_equal(json_integer_value(json_object_get(refinement, "limited_cells")), 5);
    assert_int_equal(json_integer_value(json_object_get(refinement, "spread_refluxes")), 7);
    assert_int_equal(json_integer_value(json_object_get(fine, "steps")), 12);
    json_t *balance = json_object_get(fine, "balance"), *coarse = json_array_get(json_object_get(root, "levels"), 0);
    assert_true(json_real_value(json_object_get(balance, "predicted")) == 1.0); /* one rank */
    assert_true(json_real_value(json_object_get(balance, "seen")) == 1.0);
    assert_true(json_is_null(json_object_get(json_object_get(coarse, "balance"), "seen"))); /* no step yet */
    assert_true(json_real_value(json_object_get(fine, "width")) == small.state->mesh->levels[1].h[0]);
    assert_int_equal(json_integer_value(json_object_get(root, "cells_carried")), 256);
    json_decref(root);
    replicated_replace(small.state->mesh, 1, NULL, 0, &change); /* gone again */
    mesh_change_free(&change);
    assert_int_equal(provenance_write(provenance, small.state, "finished", 0), 0);
    root = load(&small);
    fine = json_array_get(json_object_get(root, "levels"), 1);
    assert_int_equal(json_integer_value(json_object_get(root, "leaves")), 8 * 256);
    assert_int_equal(json_integer_value(json_object_get(fine, "tiles")), 0);
    assert_int_equal(json_integer_value(json_object_get(fine, "peak_cells")), 16 * 256);
    json_decref(root);
    provenance_free(provenance);
    small_stop(&small);
}

/* Stock is what the case has painted: masses of a ball and of what surrounds it. */
static void test_ledger(void **state)
{
    (void)state;
    struct small small;
    struct ledger ledger;
    char name[64];
    double ball = 4.0 / 3.0 * M_PI * 0.125e-9, water = M_PI * 2e-9 - ball;
    const double expected[2] = {1000 * water, 1.2 * ball};
    small_start(&small, SMALL_AXISYMMETRIC);
    ledger_take(small.state, &ledger);
    assert_int_equal(ledger.n, 5);
    for (int l = 0; l < 2; l++) assert_true(fabs(ledger.total[l] / expected[l] - 1.0) < 1e-6);
    ledger_name(small.state->model, 1, name, sizeof name);
    assert_string_equal(name, "mass_air");
    ledger_name(small.state->model, 3, name, sizeof name);
    assert_string_equal(name, "momentum_y");
    ledger_name(small.state->model, 4, name, sizeof name);
    assert_string_equal(name, "energy");
    small_stop(&small);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_running), cmocka_unit_test(test_end),    cmocka_unit_test(test_surroundings),
        cmocka_unit_test(test_split),   cmocka_unit_test(test_ledger), cmocka_unit_test(test_levels),
    };
    if (registry_init()) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
