/* script_guard.c - see script_guard.h and docs/decisions/script-sandbox.md.
 *
 * The signal handler does async-safe things only: arithmetic on its own counters, lua_sethook
 * (made for handlers: the manual's "can be called asynchronously"), timer_settime. The timer
 * runs only while scripts do: after a tick without any call it is left to lapse, and the next
 * call starts it again. A POSIX timer, unlike setitimer, does not survive exec into another
 * program. The debt is a sample: a tick that finds a call under way counts as one tick spent in
 * scripts, one that does not as one tick of other work. */
#include "case/script_guard.h"

#include "base/system.h"

#include <errno.h>
#include <lauxlib.h>
#include <signal.h>
#include <stddef.h>

enum {
    SCRIPT_GUARD_HALVINGS = 6,     /* of the tick, one per call that was ended: many endless scripts end soon, too */
    SCRIPT_GUARD_COUNT = 25000000, /* instructions, where there is no timer */
    SCRIPT_GUARD_BASE = 4,         /* ticks that all calls together may take at least */
    SCRIPT_GUARD_SHARE = 100,      /* and so many calls one tick more */
};

static struct {
    unsigned users;
    lua_State *volatile busy;          /* inside a call, or NULL */
    volatile sig_atomic_t calls, seen; /* calls begun so far; the same at the last tick */
    volatile sig_atomic_t ticking;     /* the timer is set */
    volatile sig_atomic_t line;        /* where the guard struck */
    volatile sig_atomic_t debt;        /* ticks in scripts less those in other work */
    volatile sig_atomic_t since;       /* calls when there was no debt */
    volatile sig_atomic_t tick;        /* microseconds of CPU time; a call is ended after one to two ticks */
    volatile sig_atomic_t many;        /* it struck because of all calls, not of the last one */
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
    long tick = (long)script_guard.tick >> script_guard.strikes;
    script_guard.ticking = 1;
    system_timer_set(tick);
}

/* Have the calls since there was no debt taken too long in the mean? */
static int script_guard_overdrawn(void)
{
    unsigned calls = (unsigned)script_guard.calls - (unsigned)script_guard.since;
    return script_guard.debt > SCRIPT_GUARD_BASE + (int)(calls / SCRIPT_GUARD_SHARE);
}

static void script_guard_tick(int signal)
{
    (void)signal;
    int keep = errno;
    int same = script_guard.calls == script_guard.seen;
    lua_State *busy = script_guard.busy;
    script_guard.seen = script_guard.calls;
    script_guard.debt += busy ? 1 : script_guard.debt > 0 ? -1 : 0;
    if (script_guard.debt == 0) script_guard.since = script_guard.calls;
    if (busy && (same || script_guard_overdrawn())) {
        script_guard.many = !same;
        lua_sethook(busy, script_guard_strike, LUA_MASKCOUNT, 1);
    }
    if (busy || !same) script_guard_set();
    else script_guard.ticking = 0;
    errno = keep;
}

void script_guard_new(void)
{
    if (script_guard.users++) return;
    script_guard.strikes = 0;
    struct sigaction action = {.sa_handler = script_guard_tick, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    script_guard.timeless = sigaction(SIGVTALRM, &action, NULL) || !system_timer_new(SIGVTALRM);
    script_guard.ticking = script_guard.timeless; /* without a timer there is nothing to set */
}

void script_guard_free(void)
{
    if (--script_guard.users) return;
    if (!script_guard.timeless) system_timer_free(); /* the handler stays: a signal may be under way */
    script_guard.ticking = 0;
}

void script_guard_enter(lua_State *lua, int tick)
{
    script_guard.calls = (sig_atomic_t)((unsigned)script_guard.calls + 1u);
    script_guard.busy = lua;
    if (!script_guard.ticking || script_guard.tick != tick) {
        script_guard.tick = tick;
        script_guard.debt = 0;
        script_guard.since = script_guard.calls;
        script_guard_set();
    }
    if (script_guard.timeless) lua_sethook(lua, script_guard_strike, LUA_MASKCOUNT, SCRIPT_GUARD_COUNT);
}

struct script_guard_end script_guard_leave(lua_State *lua)
{
    script_guard.busy = NULL;
    if (!lua_gethookmask(lua)) return (struct script_guard_end){0};
    lua_sethook(lua, NULL, 0, 0);
    struct script_guard_end end = {(int)script_guard.line, script_guard.many != 0};
    if (end.line) {
        if (script_guard.strikes < SCRIPT_GUARD_HALVINGS) script_guard.strikes++;
        script_guard.debt = 0;
        script_guard.since = script_guard.calls;
    }
    script_guard.line = 0;
    script_guard.many = 0;
    return end;
}

bool script_guard_struck(void)
{
    return script_guard.strikes > 0;
}
