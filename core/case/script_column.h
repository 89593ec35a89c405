/* script_column.h - columns of a run as Lua values, and the functions over them.
 *
 * A column is a value like a number: arithmetic goes row by row and is that of Lua's numbers; two columns must have
 * the same rows. Functions:
 *     of a column to a number   min max first last mean (over time) argmin argmax (the time of it)
 *                               dip_time peak_time (that of a parabola through it and its neighbours)
 *                               at(column, time), zero_time(column, which) (straight lines between rows)
 *     of a column to a column   between(column, from, to): the rows with from <= t <= to
 *     row by row                the functions of math that take one number; abs sqrt exp log without "math." too
 * min and max of two or more numbers are those of math. A value that is not a number reaches the result of whatever
 * is made of its column. Errors are raised in Lua: "min: a column of the run is needed, not a number". */
#ifndef SCRIPT_COLUMN_H
#define SCRIPT_COLUMN_H

#include "case/trace.h"

#include <lua.h>
#include <stdbool.h>

/* Names of the functions that the globals of script_sandbox.h do not have like this; NULL-terminated. */
extern const char *const script_column_functions[];

/* Pushes a table of these functions, with a `math` that takes columns too; `globals` is the registry's index of the
 * table it shows where it has nothing of its own. May raise a Lua error (memory), as all of these. */
void script_column_open(lua_State *lua, int globals);

/* Pushes a column; `trace` and `name` (for messages) must live as long as the value. `planned`: it stands for one of a
 * run to come, and any time is in it. */
void script_column_push(lua_State *lua, const char *name, const struct trace *trace, bool planned);

/* Pops a table and makes it the fields of the column below it: `wall.pressure` beside `wall`. */
void script_column_fields(lua_State *lua);

/* Is the value at `at` a column? */
bool script_column_is(lua_State *lua, int at);

#endif
