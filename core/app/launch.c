/* launch.c - see launch.h. */
#include "app/launch.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#define LAUNCH_STATUS "BULLA_STATUS_FILE"
#define LAUNCH_TERMINAL "BULLA_TERMINAL"

static volatile sig_atomic_t launch_signals;
static volatile pid_t launch_child;

char **launch_arguments(long ranks, bool root, const char *program, char **argv)
{
    /* Oversubscription is allowed, so ranks must not be bound nor spin; the copy through
     * another process's memory is off because containers forbid it. */
    static const char *const fixed[] = {"--oversubscribe",
                                        "--bind-to",
                                        "none",
                                        "--mca",
                                        "mpi_yield_when_idle",
                                        "1",
                                        "--mca",
                                        "btl_vader_single_copy_mechanism",
                                        "none"};
    enum { FIXED = sizeof fixed / sizeof *fixed };
    size_t n_own = 0, n = 0;
    while (argv[n_own]) n_own++;
    char **out = mem_new(FIXED + n_own + 6, sizeof *out);
    out[n++] = mem_text("mpirun");
    out[n++] = mem_text("-n");
    out[n++] = mem_print("%ld", ranks);
    for (size_t i = 0; i < FIXED; i++) out[n++] = mem_text(fixed[i]);
    if (root) out[n++] = mem_text("--allow-run-as-root");
    out[n++] = mem_text(program);
    for (size_t i = 1; i < n_own; i++) out[n++] = mem_text(argv[i]);
    return out;
}

void launch_free_arguments(char **arguments)
{
    for (char **at = arguments; at && *at; at++) mem_free(*at);
    mem_free(arguments);
}

static void launch_forward(int number)
{
    (void)number;
    launch_signals++;
    if (launch_child > 0) kill(launch_child, launch_signals == 1 ? SIGUSR1 : SIGTERM);
}

static void launch_catch(void (*handler)(int))
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGUSR1, SIGHUP};
    struct sigaction action = {.sa_handler = handler};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) sigaction(numbers[i], &action, NULL);
}

/* The child: its own process group, so that the terminal's Ctrl-C reaches the parent alone;
 * it ends when the parent is killed. */
static void launch_become(char **arguments)
{
    launch_catch(SIG_DFL);
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    int null = open("/dev/null", O_RDONLY);
    if (null >= 0) dup2(null, STDIN_FILENO);
    execvp(arguments[0], arguments);
    fprintf(stderr, "error: cannot start mpirun: %s; install Open MPI (Debian: openmpi-bin)\n", strerror(errno));
    _exit(127);
}

static int launch_wait(pid_t child, int *ret_raw)
{
    while (waitpid(child, ret_raw, 0) < 0)
        if (errno != EINTR) return status_fail(STATUS_RUN, "lost sight of mpirun: %s", strerror(errno));
    return 0;
}

/* The code that rank 0 wrote, or what mpirun's own end means. */
static int launch_outcome(const char *path, int raw)
{
    FILE *file = fopen(path, "r");
    int code = -1;
    if (file) {
        if (fscanf(file, "%d", &code) != 1) code = -1;
        fclose(file);
    }
    if (code >= 0) return code;
    if (launch_signals) return STATUS_STOPPED;
    if (WIFEXITED(raw) && WEXITSTATUS(raw) <= STATUS_STOPPED) return WEXITSTATUS(raw);
    if (!(WIFEXITED(raw) && WEXITSTATUS(raw) == 127)) log_error("a rank ended without finishing the run");
    return STATUS_RUN;
}

int launch_run(long ranks, char **argv)
{
    char program[4096] = {0};
    if (readlink("/proc/self/exe", program, sizeof program - 1) < 0)
        return status_fail(STATUS_RUN, "cannot find the program's own path: %s", strerror(errno));
    const char *folder = getenv("TMPDIR");
    char *path = mem_print("%s/bulla-status-XXXXXX", folder && *folder ? folder : "/tmp");
    int file = mkstemp(path);
    if (file < 0) return status_fail(STATUS_RUN, "cannot write %s: %s", path, strerror(errno));
    close(file);
    setenv(LAUNCH_STATUS, path, 1);
    if (isatty(STDERR_FILENO)) setenv(LAUNCH_TERMINAL, "1", 1);
    char **arguments = launch_arguments(ranks, geteuid() == 0, program, argv);
    launch_catch(launch_forward);
    pid_t child = fork();
    if (child == 0) launch_become(arguments);
    launch_child = child;
    if (launch_signals) launch_forward(0);
    int raw = 0, code = child < 0 ? status_fail(STATUS_RUN, "cannot start a process: %s", strerror(errno)) : 0;
    if (!code) code = launch_wait(child, &raw);
    if (!code) code = launch_outcome(path, raw);
    unlink(path);
    mem_free(path);
    launch_free_arguments(arguments);
    return code;
}

int launch_report(int code)
{
    const char *path = getenv(LAUNCH_STATUS);
    if (!path || !comm_active()) return code;
    if (comm_rank() != 0) return 0;
    FILE *file = fopen(path, "r+");
    if (!file) return code;
    fprintf(file, "%d\n", code);
    return fclose(file) ? code : 0;
}

bool launch_terminal(void)
{
    return isatty(STDERR_FILENO) || getenv(LAUNCH_TERMINAL) != NULL;
}
