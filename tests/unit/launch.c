/* launch.c - the command line that starts the ranks. */
#include "run/launch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

static int position(char **arguments, const char *word)
{
    for (int i = 0; arguments[i]; i++)
        if (!strcmp(arguments[i], word)) return i;
    return -1;
}

static void own_command_line_follows_the_program(void **state)
{
    (void)state;
    char *argv[] = {"bulla", "run", "a case.yaml", "-n", "3", NULL};
    char **out = launch_arguments(3, 0, "/x/bulla", argv);
    assert_string_equal(out[0], BULLA_MPIRUN);
    assert_string_equal(out[1], "-n");
    assert_string_equal(out[2], "3");
    int at = position(out, "/x/bulla");
    assert_true(at > 0);
    for (int i = 1; i <= 5; i++) {
        if (argv[i]) assert_string_equal(out[at + i], argv[i]);
        else assert_null(out[at + i]);
    }
    launch_free_arguments(out);
}

static void every_machine_knows_that_a_parent_reports(void **state)
{
    (void)state;
    char *argv[] = {"bulla", "run", NULL};
    char **out = launch_arguments(2, false, "/x/bulla", argv);
    int at = position(out, "-x"); /* Hydra of MPICH hands the whole environment on by itself */
    if (!BULLA_OPEN_MPI) assert_int_equal(at, -1);
    else assert_true(at > 0 && at < position(out, "/x/bulla"));
    if (at > 0) assert_string_equal(out[at + 1], "BULLA_STATUS_FILE");
    launch_free_arguments(out);
}

static void root_is_allowed_only_for_root(void **state)
{
    (void)state;
    char *argv[] = {"bulla", "run", NULL};
    for (int root = 0; root < 2; root++) {
        char **out = launch_arguments(2, root, "/x/bulla", argv);
        int flag = position(out, "--allow-run-as-root");
        assert_int_equal(flag >= 0, root && BULLA_OPEN_MPI);
        assert_true(flag < position(out, "/x/bulla"));
        launch_free_arguments(out);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(own_command_line_follows_the_program),
        cmocka_unit_test(every_machine_knows_that_a_parent_reports),
        cmocka_unit_test(root_is_allowed_only_for_root),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
