/* study_child.c - see study_child.h. */
#include "batch/study_child.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { STUDY_CHILD_WORDS = 16 };

static unsigned study_child_add(char **arguments, unsigned n, const char *option, const char *value)
{
    if (option) arguments[n++] = (char *)(uintptr_t)option;
    arguments[n++] = (char *)(uintptr_t)value;
    return n;
}

/* The command line; NULL-terminated, its words belong to others. */
static char **study_child_arguments(const struct study_child *child)
{
    unsigned n_set = 0, n = 0;
    while (child->sets[n_set]) n_set++;
    char **arguments = mem_new(2 * n_set + STUDY_CHILD_WORDS, sizeof *arguments);
    n = study_child_add(arguments, n, "bulla", "run");
    n = study_child_add(arguments, n, child->path, "--quiet");
    n = study_child_add(arguments, n, NULL, child->restart ? "--restart" : "--overwrite");
    n = study_child_add(arguments, n, "-o", child->directory);
    if (child->ranks) n = study_child_add(arguments, n, "-n", child->ranks);
    if (child->variant) n = study_child_add(arguments, n, "--variant", child->variant);
    for (unsigned k = 0; k < n_set; k++) n = study_child_add(arguments, n, "--set", child->sets[k]);
    return arguments;
}

static void study_child_files(const char *log)
{
    int file = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0644), null = open("/dev/null", O_RDONLY);
    if (null >= 0) dup2(null, STDIN_FILENO);
    if (file < 0) return;
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
}

int study_child_start(const struct study_child *child, pid_t *ret_pid)
{
    char **arguments = study_child_arguments(child);
    pid_t parent = getpid(), pid = fork();
    if (pid == 0) {
        if (child->mask) sigprocmask(SIG_SETMASK, child->mask, NULL);
        setpgid(0, 0);
        system_end_with_parent();
        study_child_files(child->log);
        if (getppid() == parent) system_again(arguments);
        _exit(STATUS_RUN);
    }
    mem_free(arguments);
    if (pid < 0) return status_fail(STATUS_RUN, "cannot start a run: %s", strerror(errno));
    *ret_pid = pid;
    return STATUS_OK;
}

int study_child_code(int state)
{
    return WIFEXITED(state) ? WEXITSTATUS(state) : STATUS_RUN;
}
