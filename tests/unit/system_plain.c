/* system_plain.c - what stands in on systems without the calls of Linux; all else of this program uses it, too. */
#define BULLA_HAS_PRCTL 0
#define BULLA_HAS_MEMFD 0
#define BULLA_HAS_SIGABBREV 0
#define BULLA_HAS_DLADDR1 0
#define BULLA_HAS_TIMER 0
#define BULLA_HAS_PROC 0
#include "../../core/base/system.c"

#include "base/share.h"
#include "plug/registry.h"
#include "system.h"

static char own[PATH_MAX];

static void program(void **state)
{
    char *slash = strrchr(own, '/'), *path = NULL;
    (void)state;
    expect_program(own);
    *slash = '\0';
    assert_true(asprintf(&path, "/nowhere::%s", own) > 0);
    *slash = '/';
    assert_int_equal(setenv("PATH", path, 1), 0);
    expect_program(slash + 1);
    free(path);
    system_begin("no-such-program");
    assert_string_equal(system_program(), "");
    system_begin("/no/such/program");
    assert_string_equal(system_program(), "");
}

static void names(void **state)
{
    char model[64] = "x";
    (void)state;
    expect_signals();
    expect_time();
    expect_no_core();
    system_processor(sizeof model, model);
    assert_string_equal(model, "");
    assert_int_equal(system_symbol_size(&errno), 0);
}

/* Tables are each process's own. */
static void shared_files(void **state)
{
    struct share share;
    (void)state;
    assert_int_equal(system_shared_file(4096), -1);
    assert_int_equal(errno, ENOSYS);
    assert_int_equal(share_new(4096, true, &share), 0);
    assert_int_equal(share.parts, 1);
    share_free(&share);
}

static void timers(void **state)
{
    (void)state;
    assert_false(system_timer_new(SIGVTALRM));
}

static void locks(void **state)
{
    (void)state;
    assert_int_equal(system_locked("."), -1);
}

/* The modules beside the program are found from where it lies. */
static void modules(void **state)
{
    const char *build = getenv("BULLA_BUILD");
    char *path = NULL;
    (void)state;
    assert_non_null(build);
    assert_true(asprintf(&path, "%s/bin/bulla", build) > 0);
    unsetenv("BULLA_MODULE_PATH");
    system_begin(path);
    free(path);
    assert_int_equal(registry_init(), 0);
    assert_non_null(registry_find("eos", "ideal-gas"));
    registry_done();
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(program), cmocka_unit_test(names),   cmocka_unit_test(shared_files),
        cmocka_unit_test(timers),  cmocka_unit_test(modules), cmocka_unit_test(locks),
    };
    if (argc < 1 || !realpath(argv[0], own)) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
