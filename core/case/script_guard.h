/* script_guard.h - ends Lua calls that do not end by themselves.
 *
 * A permanent count hook would slow every call by 60 %, so there is none: a timer on the
 * thread's CPU clock looks every 0.2 s whether the same call is still running, and only then
 * arms a hook that fails each further instruction, so that no pcall can hold the error. */
#ifndef SCRIPT_GUARD_H
#define SCRIPT_GUARD_H

#include <lua.h>
#include <stdbool.h>

/* The timer lives as long as somebody uses it. */
void script_guard_new(void);
void script_guard_free(void);

/* Around every call into Lua. `leave` returns the line that was running when the guard struck, 0
 * if it did not. */
void script_guard_enter(lua_State *lua);
int script_guard_leave(lua_State *lua);

/* Has any call been ended since the first user came? Later ones then get less and less time. */
bool script_guard_struck(void);

#endif
