/* system.h - what must hold on every system, and with every stand-in. */
#ifndef TEST_SYSTEM_H
#define TEST_SYSTEM_H

#include "base/system.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* This test program, as it was called: by a path, or through PATH. */
static inline void expect_program(const char *called)
{
    char real[4096];
    assert_non_null(realpath("/proc/self/exe", real));
    system_begin(called);
    assert_string_equal(system_program(), real);
}

static inline void expect_signals(void)
{
    assert_string_equal(system_signal_name(SIGINT), "INT");
    assert_string_equal(system_signal_name(SIGTERM), "TERM");
    assert_string_equal(system_signal_name(SIGSEGV), "SEGV");
    assert_string_equal(system_signal_name(SIGXCPU), "XCPU");
    assert_null(system_signal_name(12345));
}

/* The time of a process that works grows, and begins with little. */
static inline void expect_time(void)
{
    double from = system_cpu_of(getpid());
    while (!(system_cpu_of(getpid()) > from + 0.002)) continue;
    pid_t child = fork();
    if (child == 0) {
        pause();
        _exit(0);
    }
    double first = system_cpu_of(child), second = system_cpu_of(child);
    assert_true(first >= 0.0 && second >= first && second < first + 60.0);
    kill(child, SIGKILL);
    assert_int_equal(waitpid(child, NULL, 0), child);
}

/* A crash after system_no_core leaves no core, however large it may be. */
static inline void expect_no_core(void)
{
    int state = 0;
    pid_t child = fork();
    if (child == 0) {
        struct rlimit limit = {0, 0};
        getrlimit(RLIMIT_CORE, &limit);
        limit.rlim_cur = limit.rlim_max; /* as large as it may be */
        setrlimit(RLIMIT_CORE, &limit);
        system_no_core();
        abort();
    }
    assert_int_equal(waitpid(child, &state, 0), child);
    assert_true(WIFSIGNALED(state) && WTERMSIG(state) == SIGABRT);
    assert_false(WCOREDUMP(state));
}

#endif
