/* aside.c - see aside.h. */
#include "base/aside.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>

enum { ASIDE_TEXT = 4096 };

struct aside {
    int (*work)(void *data);
    void *data;
    pthread_t thread;
    bool is_thread;
    int code;
    char text[ASIDE_TEXT]; /* why it failed */
    atomic_bool done;      /* set last */
};

static void *aside_run(void *pointer)
{
    struct aside *aside = pointer;
    aside->code = aside->work(aside->data);
    if (aside->code) snprintf(aside->text, sizeof aside->text, "%s", status_text());
    atomic_store(&aside->done, true);
    return NULL;
}

/* Signals are for the main thread; a new thread inherits the mask. */
static bool aside_thread(struct aside *aside)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    bool made = pthread_create(&aside->thread, NULL, aside_run, aside) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return made;
}

struct aside *aside_start(int (*work)(void *data), void *data, bool beside)
{
    struct aside *aside = mem_new(1, sizeof *aside);
    aside->work = work;
    aside->data = data;
    aside->is_thread = beside && comm_threads() && aside_thread(aside);
    if (!aside->is_thread) aside_run(aside);
    return aside;
}

bool aside_busy(const struct aside *aside)
{
    return aside && !atomic_load(&aside->done);
}

int aside_end(struct aside *aside)
{
    if (!aside) return STATUS_OK;
    if (aside->is_thread) pthread_join(aside->thread, NULL);
    int code = aside->code;
    if (code) status_fail(code, "%s", aside->text);
    mem_free(aside);
    return code;
}
