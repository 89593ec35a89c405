/* script_guard.h - ends Lua calls that do not end by themselves.
 *
 * A permanent count hook would slow every call by 60 %, so there is none: a timer on the
 * thread's CPU clock looks at every tick whether the same call is still running, and only then
 * arms a hook that fails each further instruction, so that no pcall can hold the error. It also
 * ends a call when all calls together take too long: more than four ticks, and more than a
 * hundredth of a tick per call, without other work between them. */
#ifndef SCRIPT_GUARD_H
#define SCRIPT_GUARD_H

#include <lua.h>
#include <stdbool.h>

/* How a call ended. */
struct script_guard_end {
    int line;  /* that was running when the guard struck; 0: it did not */
    bool many; /* because of all calls together, not of this one */
};

/* The timer lives as long as somebody uses it. */
void script_guard_new(void);
void script_guard_free(void);

/* Around every call into Lua. `tick`: microseconds of CPU time; a call is ended after one to two of them. */
void script_guard_enter(lua_State *lua, int tick);
struct script_guard_end script_guard_leave(lua_State *lua);

/* Has any call been ended since the first user came? Later ones then get less and less time. */
bool script_guard_struck(void);

#endif
