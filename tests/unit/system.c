/* system.c - the calls of this system. */
#include "system.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>

static void program(void **state)
{
    (void)state;
    expect_program("a name that says nothing");
}

static void names(void **state)
{
    char model[64];
    (void)state;
    expect_signals();
    expect_time();
    expect_no_core();
    system_processor(sizeof model, model);
    assert_true(strlen(model) < sizeof model);
}

/* A file without a name that another process opens. */
static void shared_files(void **state)
{
    struct stat facts;
    (void)state;
    int file = system_shared_file(8192), code = 0;
    assert_true(file >= 0);
    assert_int_equal(fstat(file, &facts), 0);
    assert_int_equal(facts.st_size, 8192);
    assert_int_equal(pwrite(file, "seen", 4, 4096), 4);
    pid_t owner = getpid(), child = fork();
    if (child == 0) {
        char text[5] = "";
        int again = system_shared_open(owner, file);
        _exit(again >= 0 && pread(again, text, 4, 4096) == 4 && !strcmp(text, "seen") ? 0 : 1);
    }
    waitpid(child, &code, 0);
    assert_true(WIFEXITED(code) && WEXITSTATUS(code) == 0);
    close(file);
    assert_int_equal(system_shared_open(owner, file), -1);
}

/* Who looks at a lock does not take it. */
static void locks(void **state)
{
    (void)state;
    char path[] = "/tmp/bulla-lock-XXXXXX";
    assert_non_null(mkdtemp(path));
    assert_int_equal(system_locked(path), 0);
    int file = open(path, O_RDONLY | O_DIRECTORY), other = open(path, O_RDONLY | O_DIRECTORY);
    assert_int_equal(flock(file, LOCK_EX), 0);
    assert_int_equal(system_locked(path), 1);
    assert_int_equal(flock(file, LOCK_UN), 0);
    assert_int_equal(system_locked(path), 0);
    assert_int_equal(flock(other, LOCK_EX | LOCK_NB), 0);
    close(file);
    close(other);
    assert_int_equal(rmdir(path), 0);
    assert_int_equal(system_locked(path), -1); /* it is not there */
}

static volatile sig_atomic_t ticks;

static void count_tick(int number)
{
    (void)number;
    ticks++;
}

static void timers(void **state)
{
    (void)state;
    signal(SIGVTALRM, count_tick);
    assert_true(system_timer_new(SIGVTALRM));
    for (int i = 1; i <= 2; i++) {
        system_timer_set(1000);
        while (ticks < i) {
        }
    }
    system_timer_free();
}

/* Killed parents take their children along. */
static void parents(void **state)
{
    int ends[2], code;
    char none;
    (void)state;
    assert_int_equal(pipe(ends), 0);
    pid_t parent = fork();
    if (parent == 0) {
        if (fork() == 0) {
            system_end_with_parent();
            if (write(ends[1], "x", 1) == 1)
                for (;;) pause();
        }
        for (;;) pause();
    }
    close(ends[1]);
    assert_int_equal(read(ends[0], &none, 1), 1);
    kill(parent, SIGKILL);
    waitpid(parent, &code, 0);
    assert_int_equal(read(ends[0], &none, 1), 0); /* all ends are closed: the child is gone */
    close(ends[0]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(program), cmocka_unit_test(names),   cmocka_unit_test(shared_files),
        cmocka_unit_test(timers),  cmocka_unit_test(parents), cmocka_unit_test(locks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
