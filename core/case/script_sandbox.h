/* script_sandbox.h - what a Lua script can see.
 *
 * A whitelist, built by copying single functions out of the standard libraries: nothing that
 * reads files, loads code, prints, depends on addresses, hash seeds or random numbers, or that
 * can run for long inside C (where no hook stops it). Every library table is frozen. */
#ifndef SCRIPT_SANDBOX_H
#define SCRIPT_SANDBOX_H

#include <lua.h>

/* Pushes a new table of all globals a script starts with. May raise a Lua error (memory). */
void script_sandbox_open(lua_State *lua);

/* Replaces the table on top of the stack by an empty one that shows its fields and refuses
 * every write; `what` names it in the message ("a global"). */
void script_sandbox_freeze(lua_State *lua, const char *what);

#endif
