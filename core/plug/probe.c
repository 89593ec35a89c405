/* probe.c - see probe.h. The child says nothing, leaves no core file and has a few seconds. */
#include "plug/probe.h"

#include "base/status.h"
#include "base/system.h"
#include "plug/vet.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PROBE_SECONDS = 5 };

static void probe_child(const char *path)
{
    static const int fatal[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGALRM};
    for (unsigned i = 0; i < sizeof fatal / sizeof *fatal; i++) signal(fatal[i], SIG_DFL);
    system_no_core();
    alarm(PROBE_SECONDS);
    int nowhere = open("/dev/null", O_RDWR);
    if (nowhere >= 0) {
        dup2(nowhere, STDOUT_FILENO);
        dup2(nowhere, STDERR_FILENO);
    }
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    const struct bulla_module *module = handle ? dlsym(handle, "bulla_module") : NULL;
    if (module && vet_module(module, 0) > STATUS_CASE) _exit(STATUS_RUN);
    if (handle) dlclose(handle);
    _exit(STATUS_OK); /* a plain refusal follows in the parent, too */
}

int probe_object(const char *path)
{
    int raw = 0;
    pid_t child = fork(), ended;
    if (child == 0) probe_child(path);
    if (child < 0) return STATUS_OK; /* no process to be had: load it unprobed */
    do ended = waitpid(child, &raw, 0);
    while (ended < 0 && errno == EINTR);
    if (ended < 0 || (WIFEXITED(raw) && WEXITSTATUS(raw) == 0)) return STATUS_OK;
    const char *name = WIFSIGNALED(raw) ? system_signal_name(WTERMSIG(raw)) : NULL;
    return status_fail(STATUS_CASE, "%s is damaged: trying to load it ended with %s%s", path,
                       WIFSIGNALED(raw) ? "SIG" : "", name ? name : "an error of the system's loader");
}
