/* expect.c - expectations judged from the files of a run: bounds, norms over time, expect.json. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/status.h"
#include "case/script_host.h"
#include "judge/expect.h"

static char folder[] = "/tmp/bulla-expect-XXXXXX";
static struct script_host *host;

static void write_file(const char *name, const char *text)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static int make_run(void **state)
{
    (void)state;
    if (!mkdtemp(folder)) return -1;
    host = script_host_new();
    write_file("history.csv", "step,t,dt,V\n0,0,0,8\n1,1,1,2\n2,2,1,4\n3,4,2,6\n");
    write_file("probes.csv", "t,wall.pressure\n0,1e5\n4,3e5\n");
    write_file("reference.csv", "# columns: t/tc, t[s], V (volume)\n0,-1,7\n1,1,3\n2,4,6\n");
    return 0;
}

static int remove_run(void **state)
{
    static const char *const names[] = {"history.csv", "probes.csv", "reference.csv", "expect.json"};
    (void)state;
    script_host_free(host);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[128];
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    return rmdir(folder);
}

static int judge(struct scene_expect *expects, unsigned n)
{
    char path[] = "case.yaml";
    struct scene scene = {.path = path, .n_expect = n, .expects = expects, .host = host};
    for (unsigned i = 0; i < n; i++)
        if (expects[i].scale == 0) expects[i].scale = 1;
    return expect_judge(&scene, folder, true);
}

static json_t *report(void)
{
    char path[128];
    snprintf(path, sizeof path, "%s/expect.json", folder);
    json_t *root = json_load_file(path, 0, NULL);
    assert_non_null(root);
    return root;
}

static double reported(const json_t *root, size_t index)
{
    return json_number_value(json_object_get(json_array_get(json_object_get(root, "expectations"), index), "value"));
}

static void test_bounds(void **state)
{
    (void)state;
    struct scene_expect expects[] = {
        {.value = "min(V)/first(V)", .has_at_most = true, .at_most = 0.25},
        {.value = "last(V)", .has_at_least = true, .at_least = 6, .has_at_most = true, .at_most = 6},
        {.value = "argmin(V)", .has_equals = true, .equals = 1.01, .relative = 0.01},
        {.value = "max(wall.pressure)", .has_equals = true, .equals = 299990, .tolerance = 10},
    };
    assert_int_equal(judge(expects, 4), STATUS_OK);
    json_t *root = report();
    assert_true(json_is_true(json_object_get(root, "passed")));
    assert_true(reported(root, 0) == 0.25);
    assert_true(reported(root, 3) == 3e5);
    json_decref(root);
}

static void test_failures(void **state)
{
    (void)state;
    struct scene_expect misses[] = {
        {.value = "min(V)", .has_at_most = true, .at_most = 1.999},
        {.value = "min(V)", .has_at_least = true, .at_least = 2.001},
        {.value = "min(V)", .has_equals = true, .equals = 2.1, .tolerance = 0.09},
        {.value = "min(V) / 0", .has_at_least = true, .at_least = 0},
    };
    for (size_t i = 0; i < sizeof misses / sizeof *misses; i++) {
        assert_int_equal(judge(&misses[i], 1), STATUS_EXPECT);
        json_t *root = report();
        assert_true(json_is_false(json_object_get(root, "passed")));
        json_decref(root);
    }
}

/* V against the lines (-1, 7) (1, 3) (4, 6): differences 3, -1, 0, 0 at t = 0, 1, 2, 4. */
static void test_norms_over_time(void **state)
{
    (void)state;
    char reference[128], L1[] = "L1", L2[] = "L2", Linf[] = "Linf", field[] = "V";
    snprintf(reference, sizeof reference, "%s/reference.csv", folder);
    struct scene_expect expects[] = {
        {.reference = reference, .norm = L1, .field = field, .has_at_most = true, .at_most = 1},
        {.reference = reference, .norm = L2, .field = field, .has_at_most = true, .at_most = 2},
        {.reference = reference, .norm = Linf, .field = field, .has_at_most = true, .at_most = 3, .scale = 10},
    };
    assert_int_equal(judge(expects, 3), STATUS_OK);
    json_t *root = report();
    assert_true(fabs(reported(root, 0) - (3 * 0.5 + 1 * 1) / 4) < 1e-15);
    assert_true(fabs(reported(root, 1) - sqrt((9 * 0.5 + 1 * 1) / 4)) < 1e-15);
    assert_true(fabs(reported(root, 2) - 0.3) < 1e-15);
    json_decref(root);
}

/* A value that these files do not have fails, says why, and holds up nothing else. */
static void test_values_that_cannot_be_had(void **state)
{
    (void)state;
    struct scene_expect expects[] = {
        {.value = "max(wall.presure)", .line = 12, .has_at_least = true},
        {.value = "at(V, 5)", .line = 13, .has_at_least = true},
        {.value = "min(V)", .line = 14, .has_at_least = true},
    };
    assert_int_equal(judge(expects, 3), STATUS_EXPECT);
    json_t *root = report(), *list = json_object_get(root, "expectations");
    const char *first = json_string_value(json_object_get(json_array_get(list, 0), "fault"));
    const char *second = json_string_value(json_object_get(json_array_get(list, 1), "fault"));
    assert_true(first && strstr(first, "case.yaml:12: expect: ") && strstr(first, "did you mean 'wall.pressure'"));
    assert_true(second && strstr(second, "case.yaml:13: expect: ") && strstr(second, "no such time"));
    assert_true(json_is_null(json_object_get(json_array_get(list, 0), "value")));
    assert_null(json_object_get(json_array_get(list, 2), "fault"));
    assert_true(json_is_true(json_object_get(json_array_get(list, 2), "passed")));
    json_decref(root);
}

static void test_nonsense_names_its_line(void **state)
{
    (void)state;
    char reference[] = "/nowhere/reference.csv", L1[] = "L1", field[] = "V";
    struct scene_expect missing = {.reference = reference, .norm = L1, .field = field, .line = 13};
    assert_int_equal(judge(&missing, 1), STATUS_RUN);
    assert_non_null(strstr(status_text(), "case.yaml:13"));
    assert_non_null(strstr(status_text(), reference));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_failures),
        cmocka_unit_test(test_norms_over_time),
        cmocka_unit_test(test_values_that_cannot_be_had),
        cmocka_unit_test(test_nonsense_names_its_line),
    };
    return cmocka_run_group_tests(tests, make_run, remove_run);
}
