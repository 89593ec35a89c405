/* launch.c - see launch.h. */
#include "run/launch.h"

#include "base/comm.h"
#include "base/launcher.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { LAUNCH_CROWD = 32 }; /* most ranks for each processor */
#define LAUNCH_STATUS "BULLA_STATUS_FILE"
#define LAUNCH_TERMINAL "BULLA_TERMINAL"

char **launch_arguments(long ranks, bool root, const char *program, char **argv)
{
    /* Oversubscription is allowed, so ranks must not be bound nor spin; the copy through
     * another process's memory is off because containers forbid it. Ranks on other machines, too, must know that a
     * parent reports for them. MPICH needs no such words. */
    static const char *const fixed[] = {"-x",
                                        LAUNCH_STATUS,
                                        "--oversubscribe",
                                        "--bind-to",
                                        "none",
                                        "--mca",
                                        "mpi_yield_when_idle",
                                        "1",
                                        "--mca",
                                        "btl_vader_single_copy_mechanism",
                                        "none"};
    size_t n_fixed = BULLA_OPEN_MPI ? sizeof fixed / sizeof *fixed : 0, n_own = 0, n = 0;
    while (argv[n_own]) n_own++;
    char **out = mem_new(n_fixed + n_own + 6, sizeof *out);
    out[n++] = mem_text(BULLA_MPIRUN);
    out[n++] = mem_text("-n");
    out[n++] = mem_print("%ld", ranks);
    for (size_t i = 0; i < n_fixed; i++) out[n++] = mem_text(fixed[i]);
    if (root && BULLA_OPEN_MPI) out[n++] = mem_text("--allow-run-as-root");
    out[n++] = mem_text(program);
    for (size_t i = 1; i < n_own; i++) out[n++] = mem_text(argv[i]);
    return out;
}

void launch_free_arguments(char **arguments)
{
    for (char **at = arguments; at && *at; at++) mem_free(*at);
    mem_free(arguments);
}

/* The child: its own process group, so that the terminal's Ctrl-C reaches the parent alone;
 * it ends when the parent is killed. */
static void launch_become(char **arguments, const sigset_t *mask)
{
    sigprocmask(SIG_SETMASK, mask, NULL);
    setpgid(0, 0);
    system_end_with_parent();
    setenv("OMPI_MCA_pml", "^cm", 0); /* not to look for networks of one kind saves 0.2 s at every start */
    int null = open("/dev/null", O_RDONLY);
    if (null >= 0) dup2(null, STDIN_FILENO);
    execvp(arguments[0], arguments);
    fprintf(stderr, "error: cannot start " BULLA_MPIRUN ": %s; install what bulla was built with (Debian: %s)\n",
            strerror(errno), BULLA_OPEN_MPI ? "openmpi-bin" : "mpich");
    _exit(127);
}

/* What rank 0 has written: its process and, at its end, the exit code; 0 and -1 before. */
static void launch_read(const char *path, long *ret_pid, int *ret_code)
{
    FILE *file = fopen(path, "r");
    *ret_pid = 0;
    *ret_code = -1;
    if (!file) return;
    if (fscanf(file, "%ld %d", ret_pid, ret_code) < 1) *ret_pid = 0;
    fclose(file);
}

/* The first signal goes to rank 0 once there is one (true then), and it tells the others; a
 * second one ends rank 0 at once, and mpirun. `number` is the one that came last. */
static bool launch_forward(const char *path, pid_t child, int count, int number)
{
    long pid;
    int code;
    launch_read(path, &pid, &code);
    if (count > 1) kill(child, SIGTERM);
    return pid > 0 && (code >= 0 || !kill((pid_t)pid, number));
}

/* Waits for the end of mpirun, handing signals on. Returns their number. */
static int launch_wait(const char *path, pid_t child, const sigset_t *wanted, int *ret_raw)
{
    static const struct timespec soon = {.tv_nsec = 50000000};
    bool passed_on = true;
    for (int count = 0, last = 0;;) {
        int number = passed_on ? sigwaitinfo(wanted, NULL) : sigtimedwait(wanted, NULL, &soon);
        if (number == SIGCHLD && waitpid(child, ret_raw, WNOHANG) == child) return count;
        if (number > 0 && number != SIGCHLD) {
            if (count && number == SIGUSR1) continue; /* never a second one: stop.h */
            count++;
            last = number;
        }
        if (number != SIGCHLD && count) passed_on = launch_forward(path, child, count, last);
    }
}

/* The code that rank 0 wrote, unless mpirun says that another rank did not end well. */
static int launch_outcome(const char *path, int raw, int signals)
{
    long pid;
    int code, end = WIFEXITED(raw) ? WEXITSTATUS(raw) : -1;
    launch_read(path, &pid, &code);
    if (code >= 0 && end == 0) return code;
    if (signals) return STATUS_STOPPED;
    if (end == 127) return status_fail(STATUS_RUN, "mpirun did not start");
    return status_fail(STATUS_RUN,
                       "a rank ended without finishing the run; with --restart the same command goes on from the "
                       "newest checkpoint, if there is one");
}

/* Starts mpirun and stays until it ends. */
static int launch_supervise(char **arguments, const char *path)
{
    sigset_t wanted, before;
    sigemptyset(&wanted);
    static const int numbers[] = {SIGINT, SIGTERM, SIGUSR1, SIGHUP, SIGCHLD};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) sigaddset(&wanted, numbers[i]);
    sigprocmask(SIG_BLOCK, &wanted, &before);
    pid_t child = fork();
    if (child == 0) launch_become(arguments, &before);
    int raw = 0, signals = 0;
    if (child > 0) signals = launch_wait(path, child, &wanted, &raw);
    sigprocmask(SIG_SETMASK, &before, NULL);
    if (child < 0) return status_fail(STATUS_RUN, "cannot start a process: %s", strerror(errno));
    return launch_outcome(path, raw, signals);
}

long launch_most(void)
{
    if (launcher_here().name || getenv("OMPI_MCA_orte_default_hostfile")) return LONG_MAX;
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    return LAUNCH_CROWD * (processors > 0 ? processors : 1);
}

int launch_check(long wanted)
{
    struct launcher here = launcher_here();
    if (here.is_mute && here.size > 1)
        return status_fail(
            STATUS_CASE,
            "%s has started %ld processes that cannot find each other: with srun --mpi=pmix they can, if "
            "srun --mpi=list names it; else start them by the mpirun of Open MPI",
            here.name, here.size);
    if (!comm_active() && !here.is_mute) return STATUS_OK;
    if (here.size > 1 && comm_size() == 1)
        return status_fail(STATUS_CASE,
                           "%s has started %ld processes, but MPI makes each of them a run of its own: it cannot talk "
                           "to that launcher; with Slurm try srun --mpi=pmix, else the mpirun of Open MPI",
                           here.name, here.size);
    if (wanted && wanted != comm_size())
        return status_fail(STATUS_CASE, "-n %ld, but %s has started %d rank%s: leave out -n, or let both be the same",
                           wanted, here.name, comm_size(), comm_size() == 1 ? "" : "s");
    return STATUS_OK;
}

int launch_run(long ranks, char **argv)
{
    const char *program = system_program();
    if (!*program) return status_fail(STATUS_RUN, "cannot find the program's own path");
    const char *folder = getenv("TMPDIR");
    char *path = mem_print("%s/bulla-status-XXXXXX", folder && *folder ? folder : "/tmp");
    int file = mkstemp(path), code;
    if (file < 0) {
        code = status_fail(STATUS_RUN, "cannot write %s: %s", path, strerror(errno));
        mem_free(path);
        return code;
    }
    close(file);
    setenv(LAUNCH_STATUS, path, 1);
    if (isatty(STDERR_FILENO)) setenv(LAUNCH_TERMINAL, "1", 1);
    char **arguments = launch_arguments(ranks, geteuid() == 0, program, argv);
    code = launch_supervise(arguments, path);
    unlink(path);
    mem_free(path);
    launch_free_arguments(arguments);
    return code;
}

/* Adds a number to the parent's file, if there is a parent; false if that failed. */
static bool launch_write(long number)
{
    const char *path = getenv(LAUNCH_STATUS);
    FILE *file = fopen(path, "r+");
    if (!file) return false;
    bool good = !fseek(file, 0, SEEK_END) && fprintf(file, "%ld\n", number) > 0;
    return fclose(file) == 0 && good;
}

void launch_announce(void)
{
    if (getenv(LAUNCH_STATUS) && comm_active() && comm_rank() == 0) launch_write((long)getpid());
}

int launch_report(int code)
{
    if (!getenv(LAUNCH_STATUS) || !comm_active()) return code;
    if (comm_rank() != 0) return 0;
    return launch_write(code) ? 0 : code;
}

bool launch_terminal(void)
{
    return isatty(STDERR_FILENO) || getenv(LAUNCH_TERMINAL) != NULL;
}
