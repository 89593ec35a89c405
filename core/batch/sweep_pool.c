/* sweep_pool.c - see sweep_pool.h. Signals stay blocked and are taken one by one (sigwaitinfo), so that none is lost
 * between a look and a wait. */
#include "batch/sweep_pool.h"

#include "base/mem.h"
#include "base/status.h"

#include <stdbool.h>
#include <sys/wait.h>

struct sweep_pool_work {
    const struct sweep_pool *pool;
    pid_t *pids;     /* [n_job]; 0: a free place */
    unsigned *items; /* [n_job] */
    unsigned next, busy;
    sigset_t before;
    int code;
};

static void sweep_pool_start(struct sweep_pool_work *work)
{
    const struct sweep_pool *pool = work->pool;
    for (unsigned i = 0; i < pool->n_job && work->next < pool->n_item && !work->code; i++) {
        if (work->pids[i]) continue;
        work->items[i] = work->next++;
        work->code = pool->start(pool->context, work->items[i], &work->before, &work->pids[i]);
        if (work->code) work->pids[i] = 0;
        else work->busy++;
    }
}

/* Several processes may stand behind one SIGCHLD. */
static void sweep_pool_collect(struct sweep_pool_work *work)
{
    const struct sweep_pool *pool = work->pool;
    for (unsigned i = 0; i < pool->n_job; i++) {
        int state = 0;
        if (!work->pids[i] || waitpid(work->pids[i], &state, WNOHANG) != work->pids[i]) continue;
        work->pids[i] = 0;
        work->busy--;
        int code = pool->ended(pool->context, work->items[i], state);
        if (!work->code) work->code = code;
    }
}

/* The first time by a signal that is harmless to a run which has got one already (run/stop.h). */
static void sweep_pool_stop(struct sweep_pool_work *work, int number)
{
    bool again = work->code == STATUS_STOPPED;
    for (unsigned i = 0; i < work->pool->n_job; i++)
        if (work->pids[i]) kill(work->pids[i], again && number != SIGUSR1 ? SIGTERM : SIGUSR1);
    work->code = STATUS_STOPPED;
}

int sweep_pool_run(const struct sweep_pool *pool)
{
    static const int numbers[] = {SIGINT, SIGTERM, SIGUSR1, SIGHUP, SIGCHLD};
    struct sweep_pool_work work = {.pool = pool};
    sigset_t wanted;
    sigemptyset(&wanted);
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) sigaddset(&wanted, numbers[i]);
    sigprocmask(SIG_BLOCK, &wanted, &work.before);
    work.pids = mem_new(pool->n_job, sizeof *work.pids);
    work.items = mem_new(pool->n_job, sizeof *work.items);
    sweep_pool_start(&work);
    while (work.busy) {
        int number = sigwaitinfo(&wanted, NULL);
        if (number == SIGCHLD) sweep_pool_collect(&work);
        else if (number > 0) sweep_pool_stop(&work, number);
        sweep_pool_start(&work);
    }
    mem_free(work.pids);
    mem_free(work.items);
    sigprocmask(SIG_SETMASK, &work.before, NULL);
    return work.code;
}
