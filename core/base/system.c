/* system.c - see system.h. BULLA_HAS_... are 1 where the build has found the call, 0 where it has not. */
#include "base/system.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#if BULLA_HAS_PRCTL
#include <sys/prctl.h>
#endif
#if BULLA_HAS_DLADDR1
#include <dlfcn.h>
#include <link.h>
#endif

static char system_path[PATH_MAX];

/* The absolute path of a file that can be run, in system_path. */
static bool system_is_here(const char *folder, size_t length, const char *name)
{
    char path[PATH_MAX];
    int n = snprintf(path, sizeof path, "%.*s%s%s", (int)length, folder, length ? "/" : "", name);
    return n > 0 && (size_t)n < sizeof path && !access(path, X_OK) && realpath(path, system_path);
}

/* As a shell finds it. */
static void system_search(const char *name)
{
    const char *list = getenv("PATH");
    system_path[0] = '\0';
    if (strchr(name, '/')) {
        if (!system_is_here("", 0, name)) system_path[0] = '\0';
        return;
    }
    for (; list && *list; list += *list == ':') {
        size_t length = strcspn(list, ":");
        if (system_is_here(length ? list : ".", length ? length : 1, name)) return;
        list += length;
    }
    system_path[0] = '\0';
}

void system_begin(const char *name)
{
    ssize_t length = BULLA_HAS_PROC ? readlink("/proc/self/exe", system_path, sizeof system_path - 1) : -1;
    if (length > 0) system_path[length] = '\0';
    else system_search(name ? name : "");
}

const char *system_program(void)
{
    if (!system_path[0] && BULLA_HAS_PROC) system_begin(NULL);
    return system_path;
}

void system_again(char *const *arguments)
{
    if (BULLA_HAS_PROC) execv("/proc/self/exe", arguments); /* also if the file has been replaced meanwhile */
    else execv(system_program(), arguments);
}

void system_end_with_parent(void)
{
#if BULLA_HAS_PRCTL
    prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
}

void system_no_core(void)
{
#if BULLA_HAS_PRCTL
    prctl(PR_SET_DUMPABLE, 0); /* holds for cores that are piped to a program, too */
#else
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
#endif
}

int system_shared_file(size_t bytes)
{
#if BULLA_HAS_MEMFD && BULLA_HAS_PROC
    int file = memfd_create("bulla-table", MFD_CLOEXEC), error;
    if (file < 0) return -1;
    error = posix_fallocate(file, 0, (off_t)bytes); /* reserved: no trap where memory runs out */
    if (!error) return file;
    close(file);
    errno = error;
    return -1;
#else
    (void)bytes;
    errno = ENOSYS;
    return -1;
#endif
}

int system_shared_open(pid_t process, int file)
{
    char path[64];
    snprintf(path, sizeof path, "/proc/%ld/fd/%d", (long)process, file);
    return open(path, O_RDWR | O_CLOEXEC);
}

void system_large_pages(void *at, size_t bytes)
{
#ifdef MADV_HUGEPAGE
    madvise(at, bytes, MADV_HUGEPAGE);
#else
    (void)at;
    (void)bytes;
#endif
}

const char *system_signal_name(int number)
{
#if BULLA_HAS_SIGABBREV
    return sigabbrev_np(number);
#else
    static const struct {
        int number;
        const char *name;
    } names[] = {{SIGHUP, "HUP"},   {SIGINT, "INT"},   {SIGQUIT, "QUIT"}, {SIGILL, "ILL"},
                 {SIGABRT, "ABRT"}, {SIGBUS, "BUS"},   {SIGFPE, "FPE"},   {SIGKILL, "KILL"},
                 {SIGUSR1, "USR1"}, {SIGSEGV, "SEGV"}, {SIGUSR2, "USR2"}, {SIGPIPE, "PIPE"},
                 {SIGALRM, "ALRM"}, {SIGTERM, "TERM"}, {SIGXCPU, "XCPU"}, {SIGXFSZ, "XFSZ"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (names[i].number == number) return names[i].name;
    return NULL;
#endif
}

/* The first `model name` of /proc/cpuinfo. */
void system_processor(size_t room, char *ret_name)
{
    char line[256];
    FILE *stream = BULLA_HAS_PROC ? fopen("/proc/cpuinfo", "r") : NULL;
    snprintf(ret_name, room, "%s", "");
    while (stream && fgets(line, sizeof line, stream)) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", strlen("model name")) || !colon) continue;
        colon += 1 + strspn(colon + 1, " ");
        snprintf(ret_name, room, "%.*s", (int)strcspn(colon, "\n"), colon);
        break;
    }
    if (stream) fclose(stream);
}

size_t system_symbol_size(const void *symbol)
{
#if BULLA_HAS_DLADDR1
    Dl_info info;
    const ElfW(Sym) *entry = NULL;
    if (symbol && dladdr1(symbol, &info, (void **)&entry, RTLD_DL_SYMENT) && entry) return entry->st_size;
#else
    (void)symbol;
#endif
    return 0;
}

/* Lines of /proc/locks: "7: FLOCK  ADVISORY  WRITE 4711 fe:00:1234 0 EOF". Some file systems number their devices in
 * two ways, so the file's own number decides. */
int system_locked(const char *path)
{
    char line[256];
    struct stat file;
    FILE *stream = BULLA_HAS_PROC ? fopen("/proc/locks", "r") : NULL;
    int locked = stream && !stat(path, &file) ? 0 : -1;
    while (locked == 0 && fgets(line, sizeof line, stream)) {
        unsigned long number = 0;
        if (sscanf(line, "%*s FLOCK %*s WRITE %*s %*[^:]:%*[^:]:%lu", &number) == 1) locked = number == file.st_ino;
    }
    if (stream) fclose(stream);
    return locked;
}

double system_cpu_of(pid_t process)
{
    struct timespec now = {0};
    clockid_t clock = CLOCK_MONOTONIC;
#if BULLA_HAS_TIMER
    if (clock_getcpuclockid(process, &clock)) return 0.0;
#else
    (void)process;
#endif
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#if BULLA_HAS_TIMER
static timer_t system_timer;

bool system_timer_new(int signal)
{
    struct sigevent event = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = signal};
    return !timer_create(CLOCK_THREAD_CPUTIME_ID, &event, &system_timer);
}

void system_timer_set(long microseconds)
{
    struct itimerspec once = {
        .it_value = {.tv_sec = microseconds / 1000000, .tv_nsec = microseconds % 1000000 * 1000 + 1}};
    timer_settime(system_timer, 0, &once, NULL);
}

void system_timer_free(void)
{
    timer_delete(system_timer);
}
#else
bool system_timer_new(int signal)
{
    (void)signal;
    return false;
}

void system_timer_set(long microseconds)
{
    (void)microseconds;
}

void system_timer_free(void)
{
}
#endif
