/* script_guard.c - see script_guard.h and docs/decisions/script-sandbox.md.
 *
 * The signal handler does three async-safe things: compare two counters, lua_sethook (made for
 * handlers: the manual's "can be called asynchronously"), timer_settime. The timer runs only
 * while scripts do: after a tick without any call it is left to lapse, and the next call starts
 * it again. A POSIX timer, unlike setitimer, does not survive exec into another program. */
#include "case/script_guard.h"

#include <errno.h>
#include <lauxlib.h>
#include <signal.h>
#include <stddef.h>
#include <time.h>

enum {
    SCRIPT_GUARD_TICK = 200000000, /* ns of CPU time; a call is ended after one to two ticks */
    SCRIPT_GUARD_HALVINGS = 7,     /* of the tick, one per call that was ended: many endless scripts end soon, too */
    SCRIPT_GUARD_COUNT = 50000000, /* instructions, where there is no timer */
};

static struct {
    timer_t timer;
    unsigned users;
    lua_State *volatile busy;          /* inside a call, or NULL */
    volatile sig_atomic_t calls, seen; /* calls begun so far; the same at the last tick */
    volatile sig_atomic_t ticking;     /* the timer is set */
    volatile sig_atomic_t line;        /* where the guard struck */
    int strikes;                       /* calls ended since the first user came */
    int timeless;                      /* no timer to be had: count instructions, slower */
} script_guard;

/* Fails at every instruction from now on: an error that a pcall swallows comes again at once. */
static void script_guard_strike(lua_State *lua, lua_Debug *where)
{
    lua_sethook(lua, script_guard_strike, LUA_MASKCOUNT, 1);
    lua_getinfo(lua, "l", where);
    if (!script_guard.line) script_guard.line = where->currentline;
    luaL_error(lua, "the script does not end");
}

static void script_guard_set(void)
{
    struct itimerspec once = {.it_value = {.tv_nsec = SCRIPT_GUARD_TICK >> script_guard.strikes}};
    script_guard.ticking = 1;
    timer_settime(script_guard.timer, 0, &once, NULL);
}

static void script_guard_tick(int signal)
{
    (void)signal;
    int keep = errno;
    int same = script_guard.calls == script_guard.seen;
    if (script_guard.busy && same) lua_sethook(script_guard.busy, script_guard_strike, LUA_MASKCOUNT, 1);
    script_guard.seen = script_guard.calls;
    if (script_guard.busy || !same) script_guard_set();
    else script_guard.ticking = 0;
    errno = keep;
}

void script_guard_new(void)
{
    if (script_guard.users++) return;
    script_guard.strikes = 0;
    struct sigaction action = {.sa_handler = script_guard_tick, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    struct sigevent event = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGVTALRM};
    script_guard.timeless =
        sigaction(SIGVTALRM, &action, NULL) || timer_create(CLOCK_THREAD_CPUTIME_ID, &event, &script_guard.timer);
    script_guard.ticking = script_guard.timeless; /* without a timer there is nothing to set */
}

void script_guard_free(void)
{
    if (--script_guard.users) return;
    if (!script_guard.timeless) timer_delete(script_guard.timer); /* the handler stays: a signal may be under way */
    script_guard.ticking = 0;
}

void script_guard_enter(lua_State *lua)
{
    script_guard.calls = (sig_atomic_t)((unsigned)script_guard.calls + 1u);
    script_guard.busy = lua;
    if (!script_guard.ticking) script_guard_set();
    if (script_guard.timeless) lua_sethook(lua, script_guard_strike, LUA_MASKCOUNT, SCRIPT_GUARD_COUNT);
}

int script_guard_leave(lua_State *lua)
{
    script_guard.busy = NULL;
    if (!lua_gethookmask(lua)) return 0;
    lua_sethook(lua, NULL, 0, 0);
    if (script_guard.strikes < SCRIPT_GUARD_HALVINGS) script_guard.strikes++;
    int line = (int)script_guard.line;
    script_guard.line = 0;
    return line;
}

bool script_guard_struck(void)
{
    return script_guard.strikes > 0;
}
