/* module_check.c - see module_check.h.
 *
 * A module is code that nobody has looked at yet: it may end the process while it is loaded, write
 * where it should not, or never come back. So it runs in a child; the child leaves what it is
 * about to ask in shared memory, from which the parent tells what the module was doing. */
#include "suite/module_check.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"
#include "base/text.h"
#include "plug/registry.h"
#include "suite/contract_module.h"

#include <errno.h>
#include <inttypes.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* What one check may take: seconds of CPU time, so that a busy machine is no fault of the module (BULLA_CHECK_SECONDS
 * sets others, for tests); and, for one that sleeps, ticks of so many milliseconds. */
enum { MODULE_PATIENCE = 10, MODULE_SLEEP = 30000, MODULE_TICK = 20 };

/* What the child says to its parent. */
struct module_watch {
    char progress[CONTRACT_NAME];
    volatile int ended; /* the child came to its end, whatever that was */
};

static const struct registry_entry *module_check_entry(const char *path)
{
    char *real = realpath(path, NULL);
    const struct registry_entry *found = NULL;
    for (size_t i = 0; real && i < registry_count(); i++)
        if (!strcmp(registry_at(i)->path, real)) found = registry_at(i);
    free(real);
    return found;
}

/* The entry of a file: loaded now, or found on the search path already (perhaps as a copy). */
static int module_check_load(const char *path, struct registry_entry *ret_entry)
{
    char *local = strchr(path, '/') ? mem_text(path) : mem_print("./%s", path);
    TRY(registry_init());
    int code = registry_load(local);
    const struct registry_entry *entry = code ? NULL : module_check_entry(local);
    mem_free(local);
    if (code) return code;
    if (!entry)
        return status_fail(STATUS_CASE, "%s is a copy of a module that is on the search path already: check that one",
                           path);
    *ret_entry = *entry;
    return STATUS_OK;
}

static void module_check_print(const struct registry_entry *entry, const struct contract *contract)
{
    struct text text = {0};
    unsigned failed = contract_failed(contract), tried = 0;
    for (unsigned i = 0; i < contract->n_row; i++) tried += contract->rows[i].points > 0;
    text_add(&text, "%s %s %s  %s  (xxh64 %016" PRIx64 ")\n\n", entry->module->kind, entry->module->name,
             entry->module->version, entry->path, entry->hash);
    contract_table(contract, &text);
    if (failed) text_add(&text, "\nFAIL: %u of %u checks fail\n", failed, tried);
    else text_add(&text, "\npass: all %u checks hold\n", tried);
    fputs(text.at, stdout);
    text_done(&text);
}

/* In the child. */
static int module_check_judge(const char *path, const char *const *sets, struct module_watch *watch)
{
    struct registry_entry entry = {0};
    int code = module_check_load(path, &entry);
    if (code) return cli_failed(code);
    struct contract *contract = mem_new(1, sizeof *contract);
    *contract = (struct contract){.module = entry.module, .progress = watch->progress};
    code = contract_module_run(contract, sets);
    if (code) status_wrap(code, "%s: ", path);
    else module_check_print(&entry, contract);
    unsigned failed = contract_failed(contract);
    mem_free(contract);
    return code ? cli_failed(code) : failed ? STATUS_EXPECT : STATUS_OK;
}

static double module_check_patience(void)
{
    double seconds = MODULE_PATIENCE;
    const char *own = getenv("BULLA_CHECK_SECONDS");
    if (own) text_number(own, &seconds);
    return seconds;
}

/* Waits for the child; false when one check took too long and the child had to be ended. */
static bool module_check_wait(pid_t child, const struct module_watch *watch, int *ret_raw)
{
    static const struct timespec tick = {.tv_nsec = MODULE_TICK * 1000000L};
    char last[CONTRACT_NAME] = "";
    double since = system_cpu_of(child), patience = module_check_patience();
    for (int still = 0; still < MODULE_SLEEP && system_cpu_of(child) - since < patience; still++) {
        pid_t got = waitpid(child, ret_raw, WNOHANG);
        if (got == child || (got < 0 && errno != EINTR)) return true;
        nanosleep(&tick, NULL);
        if (strncmp(last, watch->progress, sizeof last - 1) != 0) {
            still = 0;
            since = system_cpu_of(child);
        }
        memcpy(last, watch->progress, sizeof last - 1);
    }
    kill(child, SIGKILL);
    waitpid(child, ret_raw, 0);
    return false;
}

/* A child that did not come to its end: says what it was doing. Before the first check nothing has run. */
static int module_check_lost(const char *path, const struct module_watch *watch, bool waited, int raw)
{
    bool loading = !*watch->progress;
    const char *when = loading ? "being loaded or opened" : watch->progress;
    int code = loading ? STATUS_CASE : STATUS_EXPECT;
    if (!waited)
        return status_fail(code, "%s does not come back (%s): a loop without end? ended after %g s", path, when,
                           module_check_patience());
    if (WIFSIGNALED(raw))
        return status_fail(code, "%s crashes (%s): signal %d, %s", path, when, WTERMSIG(raw), strsignal(WTERMSIG(raw)));
    return status_fail(code, "%s ends the process (%s); a module never calls exit", path, when);
}

static int module_check(const char *path, const char *const *sets)
{
    struct module_watch *watch = mmap(NULL, sizeof *watch, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (watch == MAP_FAILED) return cli_failed(status_fail(STATUS_RUN, "no shared memory: %s", strerror(errno)));
    fflush(NULL);
    pid_t child = fork();
    if (child < 0) return cli_failed(status_fail(STATUS_RUN, "cannot start a process: %s", strerror(errno)));
    if (child == 0) {
        int code = module_check_judge(path, sets, watch);
        fflush(NULL);
        watch->ended = 1;
        _exit(code);
    }
    int raw = 0;
    bool waited = module_check_wait(child, watch, &raw);
    bool ended = waited && watch->ended && WIFEXITED(raw);
    int code = ended ? WEXITSTATUS(raw) : cli_failed(module_check_lost(path, watch, waited, raw));
    munmap(watch, sizeof *watch);
    return code;
}

int module_check_command(const struct cli_given *given)
{
    if (strcmp(given->words[0], "check") != 0)
        return cli_failed(status_fail(STATUS_CASE,
                                      "module does not know '%s'; usage: bulla module check FILE.so, or table LAW FILE",
                                      given->words[0]));
    if (comm_rank() != 0) return STATUS_OK;
    const char **sets = mem_new((size_t)given->n_option + 1, sizeof *sets);
    for (int i = 0, n = 0; i < given->n_option; i++)
        if (!strcmp(given->options[i]->name, "--set")) sets[n++] = given->values[i];
    int worst = 0;
    for (int i = 1; i < given->n_word; i++) {
        if (i > 1) fputs("\n", stdout);
        int code = module_check(given->words[i], sets);
        worst = code > worst ? code : worst;
    }
    mem_free(sets);
    return worst;
}
