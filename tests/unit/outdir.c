/* outdir.c - an old run is refused with a list, replaced on request; other files stay. */
#include "run/outdir.h"

#include "base/mem.h"
#include "base/status.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char *place; /* an empty folder */

static int make_place(void **state)
{
    (void)state;
    char name[] = "/tmp/bulla-outdir-XXXXXX";
    assert_non_null(mkdtemp(name));
    place = mem_text(name);
    return 0;
}

static int remove_place(void **state)
{
    (void)state;
    char *command = mem_print("rm -rf '%s'", place);
    int code = system(command);
    mem_free(command);
    mem_free(place);
    return code;
}

static bool exists(const char *directory, const char *name)
{
    char *path = mem_print("%s/%s", directory, name);
    bool there = access(path, F_OK) == 0;
    mem_free(path);
    return there;
}

static void old_runs_are_refused_then_replaced(void **state)
{
    (void)state;
    char *run = mem_print("%s/a/b", place), *fields = mem_print("%s/fields", run);
    assert_int_equal(outdir_check(run, false), 0); /* not there yet */
    assert_int_equal(outdir_prepare(run), 0);
    assert_int_equal(outdir_check(run, false), 0); /* empty */
    assert_int_equal(outdir_write(run, "notes.md", "mine"), 0);
    assert_int_equal(outdir_check(run, false), 0); /* not ours: no run */

    assert_int_equal(outdir_write(run, "history.csv", "t\n"), 0);
    assert_int_equal(mkdir(fields, 0777), 0);
    assert_int_equal(outdir_write(fields, "x_0.hdf", ""), 0);
    assert_int_equal(outdir_write(fields, "mine.txt", ""), 0);
    assert_int_equal(outdir_check(run, false), STATUS_CASE);
    assert_non_null(strstr(status_text(), "history.csv"));
    assert_non_null(strstr(status_text(), "fields/ (1 file)"));
    assert_non_null(strstr(status_text(), "--overwrite"));
    assert_true(exists(run, "history.csv"));

    assert_int_equal(outdir_check(run, true), 0);
    assert_true(exists(run, "history.csv"));
    assert_int_equal(outdir_prepare(run), 0);
    assert_false(exists(run, "history.csv"));
    assert_false(exists(fields, "x_0.hdf"));
    assert_true(exists(fields, "mine.txt"));
    assert_true(exists(run, "notes.md"));
    mem_free(fields);
    mem_free(run);
}

static void impossible_places_are_named(void **state)
{
    (void)state;
    assert_int_equal(outdir_write(place, "file", "x"), 0);
    char *at_file = mem_print("%s/file", place), *below = mem_print("%s/file/run", place);
    assert_int_equal(outdir_check(at_file, true), STATUS_CASE);
    assert_non_null(strstr(status_text(), "is a file"));
    assert_int_equal(outdir_prepare(below), STATUS_RUN);
    assert_non_null(strstr(status_text(), "cannot make the output directory"));
    mem_free(at_file);
    mem_free(below);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(old_runs_are_refused_then_replaced, make_place, remove_place),
        cmocka_unit_test_setup_teardown(impossible_places_are_named, make_place, remove_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
