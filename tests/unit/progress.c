/* progress.c - progress for programs is JSON; who gets which kind. */
#include "run/progress.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static void modes(void **state)
{
    (void)state;
    assert_int_equal(progress_choose(true, false, true), PROGRESS_JSON);
    assert_int_equal(progress_choose(false, true, true), PROGRESS_SILENT);
    assert_int_equal(progress_choose(false, false, true), PROGRESS_LIVE);
    assert_int_equal(progress_choose(false, false, false), PROGRESS_LINES);
}

/* Runs a short story in JSON mode with stdout in a file; returns the lines parsed. */
static size_t tell(json_t *ret_lines[8])
{
    FILE *file = tmpfile();
    fflush(stdout);
    int kept = dup(STDOUT_FILENO);
    assert_true(kept >= 0 && dup2(fileno(file), STDOUT_FILENO) >= 0);
    struct mesh mesh = {.n_level = 2, .n_cell = 4, .levels = {{.n_tile = 1}, {.n_tile = 3}}};
    long steps[MESH_LEVELS] = {10, 20};
    struct progress progress = {.mode = PROGRESS_JSON, .until = 2};
    progress_mesh(&progress, &mesh, steps); /* what was done before does not count */
    progress_begin(&progress, "a \"case\"", "out");
    progress.start -= 10;
    progress.shown -= 10; /* ten seconds later: time for a line */
    steps[0] += 5;
    steps[1] += 10;
    progress_mesh(&progress, &mesh, steps);
    progress_step(&progress, 0.5, 0.1, 5);
    progress_step(&progress, 0.6, 0.1, 6); /* too soon for another */
    progress_end(&progress, 2, 20, 0, "end time");
    fflush(stdout);
    dup2(kept, STDOUT_FILENO);
    close(kept);
    rewind(file);
    char line[1024];
    size_t n = 0;
    while (n < 8 && fgets(line, sizeof line, file)) ret_lines[n++] = json_loads(line, 0, NULL);
    fclose(file);
    return n;
}

static void lines_are_objects(void **state)
{
    (void)state;
    json_t *lines[8] = {NULL};
    assert_int_equal(tell(lines), 3);
    for (int i = 0; i < 3; i++) assert_non_null(lines[i]);
    assert_string_equal(json_string_value(json_object_get(lines[0], "case")), "a \"case\"");
    assert_true(json_number_value(json_object_get(lines[1], "percent")) == 25);
    assert_true(json_integer_value(json_object_get(lines[1], "step")) == 5);
    assert_int_equal(json_integer_value(json_object_get(lines[1], "cells")), 16);
    json_t *levels = json_object_get(lines[1], "cells_by_level");
    assert_int_equal(json_array_size(levels), 2);
    assert_int_equal(json_integer_value(json_array_get(levels, 1)), 12);
    double rate = json_number_value(json_object_get(lines[1], "updates_per_s"));
    assert_true(rate > 13.5 && rate <= 14.0); /* 5 * 4 + 10 * 12 cells in ten seconds */
    double eta = json_number_value(json_object_get(lines[1], "eta_s"));
    assert_true(eta > 29.9 && eta < 30.5); /* a quarter in ten seconds */
    assert_true(json_number_value(json_object_get(lines[1], "eta_least_s")) < 30);
    assert_true(json_number_value(json_object_get(lines[1], "eta_most_s")) > 30);
    assert_string_equal(json_string_value(json_object_get(lines[2], "event")), "end");
    for (int i = 0; i < 3; i++) json_decref(lines[i]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(modes),
        cmocka_unit_test(lines_are_objects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
