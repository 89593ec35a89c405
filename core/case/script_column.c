/* script_column.c - see script_column.h. A column of the run is a pointer to the rows that its owner holds; one that
 * arithmetic makes has its rows behind it, in Lua's memory, and goes with it. Row by row means: by Lua itself, one
 * number after the other, so that a column cannot mean anything else than its numbers. */
#include "case/script_column.h"

#include "case/script_sandbox.h"
#include "case/table.h"

#include <lauxlib.h>
#include <math.h>
#include <string.h>

#define SCRIPT_COLUMN "column" /* its metatable in the registry; what Lua's messages call it */

struct script_column {
    struct trace trace;
    const char *name; /* NULL: it has been computed */
    bool planned;
    double rows[]; /* [trace.n] of one that has been computed */
};

const char *const script_column_functions[] = {"min",     "max",    "first",  "last",     "mean",      "at",
                                               "between", "argmin", "argmax", "dip_time", "peak_time", "zero_time",
                                               "abs",     "sqrt",   "exp",    "log",      NULL};

/* "max": the function that is running, for its messages. */
static const char *script_column_caller(lua_State *lua)
{
    return lua_tostring(lua, lua_upvalueindex(1));
}

static struct script_column *script_column_at(lua_State *lua, int at)
{
    struct script_column *column = luaL_testudata(lua, at, SCRIPT_COLUMN);
    if (column && column->trace.n == 0) luaL_error(lua, "the run wrote no rows of '%s'", column->name);
    return column;
}

static const struct script_column *script_column_needed(lua_State *lua)
{
    const struct script_column *column = script_column_at(lua, 1);
    if (!column)
        luaL_error(lua, "%s: a column of the run is needed, not a %s", script_column_caller(lua),
                   luaL_typename(lua, 1));
    return column;
}

/* Argument `at` as a number. */
static double script_column_number(lua_State *lua, int at, const char *what)
{
    if (lua_type(lua, at) != LUA_TNUMBER)
        luaL_error(lua, "%s: %s is needed as argument %d, not a %s", script_column_caller(lua), what, at,
                   script_column_is(lua, at) ? SCRIPT_COLUMN : luaL_typename(lua, at));
    return lua_tonumber(lua, at);
}

static void script_column_count(lua_State *lua, int count, const char *wants)
{
    if (lua_gettop(lua) != count) luaL_error(lua, "%s takes %s", script_column_caller(lua), wants);
}

/* Pushes a column with the times of another and rows to be filled in. */
static struct script_column *script_column_like(lua_State *lua, const struct script_column *model)
{
    size_t n = model->trace.n;
    struct script_column *column = lua_newuserdatauv(lua, sizeof *column + n * sizeof *column->rows, 1);
    *column = (struct script_column){.trace = {n, model->trace.t, column->rows}, .planned = model->planned};
    luaL_setmetatable(lua, SCRIPT_COLUMN);
    return column;
}

/* Arithmetic: upvalue 1 is the operator of lua_arith. */

static void script_column_operand(lua_State *lua, const struct script_column *column, int at, size_t row)
{
    if (column) lua_pushnumber(lua, column->trace.v[row]);
    else lua_pushvalue(lua, at);
}

static bool script_column_same(const struct trace *a, const struct trace *b)
{
    return a->n == b->n && a->t[0] == b->t[0] && a->t[a->n - 1] == b->t[b->n - 1];
}

static int script_column_arith(lua_State *lua)
{
    int act = (int)lua_tointeger(lua, lua_upvalueindex(1));
    const struct script_column *a = script_column_at(lua, 1), *b = script_column_at(lua, 2);
    if (a && b && !script_column_same(&a->trace, &b->trace))
        return luaL_error(lua, "these columns have different rows; reduce them to numbers first");
    if ((!a && lua_type(lua, 1) != LUA_TNUMBER) || (!b && lua_type(lua, 2) != LUA_TNUMBER))
        return luaL_error(lua, "a column and a %s cannot be combined", luaL_typename(lua, a ? 2 : 1));
    struct script_column *result = script_column_like(lua, a ? a : b);
    for (size_t i = 0; i < result->trace.n; i++) {
        script_column_operand(lua, a, 1, i);
        if (act != LUA_OPUNM) script_column_operand(lua, b, 2, i);
        lua_arith(lua, act);
        result->rows[i] = lua_tonumber(lua, -1);
        lua_pop(lua, 1);
    }
    return 1;
}

/* Row by row: upvalue 1 is the name, upvalue 2 the function of numbers. */
static int script_column_map(lua_State *lua)
{
    const struct script_column *column = script_column_at(lua, 1);
    int count = lua_gettop(lua);
    if (count == 0) script_column_count(lua, 1, "a number or a column");
    for (int i = column ? 2 : 1; i <= count; i++)
        script_column_number(lua, i, i == 1 ? "a number or a column" : "a number");
    luaL_checkstack(lua, count + 2, NULL);
    struct script_column *result = column ? script_column_like(lua, column) : NULL;
    for (size_t row = 0; row < (result ? result->trace.n : 1); row++) {
        lua_pushvalue(lua, lua_upvalueindex(2));
        for (int i = 1; i <= count; i++) script_column_operand(lua, i == 1 ? column : NULL, i, row);
        lua_call(lua, count, 1);
        if (!result) return 1;
        result->rows[row] = lua_tonumber(lua, -1);
        lua_pop(lua, 1);
    }
    return 1;
}

/* Reductions */

static size_t script_column_extreme(const struct trace *c, double sign)
{
    size_t best = 0;
    for (size_t i = 1; i < c->n; i++)
        if (sign * c->v[i] > sign * c->v[best]) best = i;
    return best;
}

/* min and max would skip a value that is not a number. */
static bool script_column_has_nan(const struct trace *c)
{
    for (size_t i = 0; i < c->n; i++)
        if (isnan(c->v[i])) return true;
    return false;
}

static double script_column_min(const struct trace *c)
{
    return c->v[script_column_extreme(c, -1)];
}

static double script_column_max(const struct trace *c)
{
    return c->v[script_column_extreme(c, 1)];
}

static double script_column_argmin(const struct trace *c)
{
    return c->t[script_column_extreme(c, -1)];
}

static double script_column_argmax(const struct trace *c)
{
    return c->t[script_column_extreme(c, 1)];
}

/* Where the parabola through an extreme row and its neighbours has its own extreme: never beyond the middle between
 * rows. At the ends there is no parabola. */
static double script_column_turn(const struct trace *c, double sign)
{
    size_t i = script_column_extreme(c, sign);
    if (i == 0 || i + 1 == c->n) return c->t[i];
    double before = c->t[i] - c->t[i - 1], after = c->t[i + 1] - c->t[i];
    double rise = (c->v[i] - c->v[i - 1]) * after, fall = (c->v[i] - c->v[i + 1]) * before, both = rise + fall;
    return both == 0.0 ? c->t[i] : c->t[i] + 0.5 * (rise * after - fall * before) / both;
}

static double script_column_dip(const struct trace *c)
{
    return script_column_turn(c, -1);
}

static double script_column_peak(const struct trace *c)
{
    return script_column_turn(c, 1);
}

static double script_column_first(const struct trace *c)
{
    return c->v[0];
}

static double script_column_last(const struct trace *c)
{
    return c->v[c->n - 1];
}

/* Average over time; of the rows if no time passes. */
static double script_column_mean(const struct trace *c)
{
    if (c->n == 1 || c->t[c->n - 1] <= c->t[0]) return c->v[0];
    return table_average(c->n, c->t, c->v, c->t[0], c->t[c->n - 1]);
}

static const struct script_column_reduction {
    const char *name;
    double (*function)(const struct trace *);
} script_column_reductions[] = {
    {"min", script_column_min},        {"max", script_column_max},
    {"first", script_column_first},    {"last", script_column_last},
    {"mean", script_column_mean},      {"argmin", script_column_argmin},
    {"argmax", script_column_argmax},  {"dip_time", script_column_dip},
    {"peak_time", script_column_peak}, {NULL, NULL},
};

/* Upvalue 1 is the name, upvalue 2 the index of the reduction, upvalue 3 the function of numbers or nil. */
static int script_column_reduce(lua_State *lua)
{
    const struct script_column_reduction *reduction =
        script_column_reductions + lua_tointeger(lua, lua_upvalueindex(2));
    int count = lua_gettop(lua);
    bool numbers = !lua_isnil(lua, lua_upvalueindex(3)) && count > 1 && !script_column_is(lua, 1);
    if (numbers) {
        for (int i = 1; i <= count; i++) script_column_number(lua, i, "a number");
        lua_pushvalue(lua, lua_upvalueindex(3));
        lua_insert(lua, 1);
        lua_call(lua, count, 1);
        return 1;
    }
    script_column_count(lua, 1,
                        lua_isnil(lua, lua_upvalueindex(3)) ? "one column of the run" : "one column, or numbers");
    const struct script_column *column = script_column_needed(lua);
    lua_pushnumber(lua, script_column_has_nan(&column->trace) ? (double)NAN : reduction->function(&column->trace));
    return 1;
}

static int script_column_value(lua_State *lua)
{
    script_column_count(lua, 2, "a column and a time: at(column, time)");
    const struct script_column *column = script_column_needed(lua);
    const struct trace *c = &column->trace;
    double time = script_column_number(lua, 2, "a time");
    if (!column->planned && !(time >= c->t[0] && time <= c->t[c->n - 1]))
        return luaL_error(lua, "at: the run has no such time: %f is outside of %f to %f", time, c->t[0],
                          c->t[c->n - 1]);
    lua_pushnumber(lua, table_interpolate(c->n, c->t, c->v, time));
    return 1;
}

/* Time of the passage through 0 that is `count`-th, on the straight line between two rows; the number of passages in
 * `found`, if there are less. */
static double script_column_passage(const struct trace *c, double count, size_t *found)
{
    for (size_t i = 1; i < c->n; i++) {
        double a = c->v[i - 1], b = c->v[i];
        if ((a < 0.0) == (b < 0.0) || (double)++*found < count) continue;
        return c->t[i - 1] + (c->t[i] - c->t[i - 1]) * (a / (a - b));
    }
    return NAN;
}

static int script_column_zero(lua_State *lua)
{
    if (lua_gettop(lua) != 2)
        script_column_count(lua, 1, "a column, and which of its passages through 0: zero_time(column, 2)");
    const struct script_column *column = script_column_needed(lua);
    const struct trace *c = &column->trace;
    double count = lua_gettop(lua) == 2 ? script_column_number(lua, 2, "which passage") : 1.0;
    bool known = !script_column_has_nan(c);
    size_t found = 0;
    if (!(count >= 1.0)) return luaL_error(lua, "zero_time: passages are counted from 1, not from %f", count);
    double time = column->planned || !known ? c->t[0] : script_column_passage(c, count, &found);
    if (isnan(time))
        return luaL_error(lua, "zero_time: the column passes through 0 %d times from %f to %f, not %f times",
                          (int)found, c->t[0], c->t[c->n - 1], count);
    lua_pushnumber(lua, known ? time : (double)NAN);
    return 1;
}

/* The rows with from <= t <= to, without a copy: rows ascend in time. */
static int script_column_between(lua_State *lua)
{
    script_column_count(lua, 3, "a column and two times: between(column, from, to)");
    const struct script_column *column = script_column_needed(lua);
    const struct trace *c = &column->trace;
    double from = script_column_number(lua, 2, "a time"), to = script_column_number(lua, 3, "a time");
    size_t first = 0, end = c->n;
    while (!column->planned && first < end && !(c->t[first] >= from)) first++;
    while (!column->planned && end > first && !(c->t[end - 1] <= to)) end--;
    if (first == end)
        return luaL_error(lua, "between: no rows in that time span, %f to %f; there are rows from %f to %f", from, to,
                          c->t[0], c->t[c->n - 1]);
    struct trace part = {end - first, c->t + first, c->v + first};
    script_column_push(lua, column->name, &part, column->planned);
    lua_pushvalue(lua, 1); /* holds the rows */
    lua_setiuservalue(lua, -2, 1);
    return 1;
}

/* wall.pressure, where `wall` is a column too. */
static int script_column_index(lua_State *lua)
{
    lua_getiuservalue(lua, 1, 1);
    if (!lua_istable(lua, -1)) return luaL_error(lua, "a column has no fields");
    lua_pushvalue(lua, 2);
    lua_rawget(lua, -2);
    return 1;
}

void script_column_push(lua_State *lua, const char *name, const struct trace *trace, bool planned)
{
    struct script_column *column = lua_newuserdatauv(lua, sizeof *column, 1);
    *column = (struct script_column){.trace = *trace, .name = name, .planned = planned};
    luaL_setmetatable(lua, SCRIPT_COLUMN);
}

void script_column_fields(lua_State *lua)
{
    lua_setiuservalue(lua, -2, 1);
}

bool script_column_is(lua_State *lua, int at)
{
    return luaL_testudata(lua, at, SCRIPT_COLUMN) != NULL;
}

static void script_column_open_type(lua_State *lua)
{
    static const struct {
        const char *event;
        int act;
    } events[] = {{"__add", LUA_OPADD}, {"__sub", LUA_OPSUB}, {"__mul", LUA_OPMUL},   {"__div", LUA_OPDIV},
                  {"__pow", LUA_OPPOW}, {"__mod", LUA_OPMOD}, {"__idiv", LUA_OPIDIV}, {"__unm", LUA_OPUNM}};
    if (luaL_newmetatable(lua, SCRIPT_COLUMN)) {
        for (size_t i = 0; i < sizeof events / sizeof *events; i++) {
            lua_pushinteger(lua, events[i].act);
            lua_pushcclosure(lua, script_column_arith, 1);
            lua_setfield(lua, -2, events[i].event);
        }
        lua_pushcfunction(lua, script_column_index);
        lua_setfield(lua, -2, "__index");
    }
    lua_pop(lua, 1);
}

/* Adds to the table on top of the stack the functions that go over columns row by row; the library math is at
 * `math`. */
static void script_column_open_maps(lua_State *lua, int math, const char *const *names)
{
    for (; *names; names++) {
        lua_pushstring(lua, *names);
        lua_getfield(lua, math, *names);
        lua_pushcclosure(lua, script_column_map, 2);
        lua_setfield(lua, -2, *names);
    }
}

static void script_column_open_reductions(lua_State *lua, int math)
{
    for (lua_Integer i = 0; script_column_reductions[i].name; i++) {
        const char *name = script_column_reductions[i].name;
        lua_pushstring(lua, name);
        lua_pushinteger(lua, i);
        lua_getfield(lua, math, name); /* nil for most */
        lua_pushcclosure(lua, script_column_reduce, 3);
        lua_setfield(lua, -2, name);
    }
}

static void script_column_show(lua_State *lua, int shown)
{
    lua_createtable(lua, 0, 1);
    lua_pushvalue(lua, shown);
    lua_setfield(lua, -2, "__index");
    lua_setmetatable(lua, -2);
}

void script_column_open(lua_State *lua, int globals)
{
    static const char *const bare[] = {"abs", "sqrt", "exp", "log", NULL};
    static const char *const maps[] = {"abs", "acos", "asin", "atan", "ceil", "cos",  "deg",  "exp", "floor", "log",
                                       "rad", "sin",  "sqrt", "tan",  "sinh", "cosh", "tanh", "erf", NULL};
    static const luaL_Reg timed[] = {{"at", script_column_value},
                                     {"between", script_column_between},
                                     {"zero_time", script_column_zero},
                                     {NULL, NULL}};
    script_column_open_type(lua);
    lua_rawgeti(lua, LUA_REGISTRYINDEX, globals);
    int shown = lua_gettop(lua), math = shown + 1;
    lua_getfield(lua, shown, "math");
    lua_createtable(lua, 0, 16);
    script_column_open_maps(lua, math, bare);
    script_column_open_reductions(lua, math);
    for (const luaL_Reg *function = timed; function->name; function++) {
        lua_pushstring(lua, function->name);
        lua_pushcclosure(lua, function->func, 1);
        lua_setfield(lua, -2, function->name);
    }
    lua_createtable(lua, 0, 32); /* math */
    script_column_open_maps(lua, math, maps);
    lua_getfield(lua, -2, "min");
    lua_setfield(lua, -2, "min");
    lua_getfield(lua, -2, "max");
    lua_setfield(lua, -2, "max");
    script_column_show(lua, math);
    script_sandbox_freeze(lua, "a field of math");
    lua_setfield(lua, -2, "math");
    script_column_show(lua, shown);
    lua_replace(lua, shown);
    lua_settop(lua, shown);
}
