/* script_sandbox.c - see script_sandbox.h.
 *
 * Functions of the standard libraries are taken only if they are pure and short. Those that
 * are not have a twin here: pairs (sorted: Lua's own order follows a random hash seed), tostring
 * and format (no addresses), rep (its loop over an empty string never ends), table.insert and
 * remove (a border of 2^62 is easily made, and shifting that many elements never ends).
 * next, load, setmetatable, string patterns and everything else are absent. */
#include "case/script_sandbox.h"

#include "case/script_library.h"

#include <lauxlib.h>
#include <lualib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SCRIPT_SANDBOX_TEXT = 1 << 20, SCRIPT_SANDBOX_LENGTH = 1 << 23 }; /* longest text of rep; longest list */

struct script_key {
    const char *text; /* NULL: a number */
    size_t length;
    double number;
};

static int script_sandbox_order(const void *a, const void *b)
{
    const struct script_key *left = a, *right = b;
    if (!left->text != !right->text) return left->text ? 1 : -1;
    if (!left->text) return (left->number > right->number) - (left->number < right->number);
    size_t common = left->length < right->length ? left->length : right->length;
    int order = memcmp(left->text, right->text, common);
    return order ? order : (left->length > right->length) - (left->length < right->length);
}

static struct script_key script_sandbox_key(lua_State *lua, int at)
{
    struct script_key key = {0};
    if (lua_type(lua, at) == LUA_TSTRING) key.text = lua_tolstring(lua, at, &key.length);
    else if (lua_type(lua, at) == LUA_TNUMBER) key.number = lua_tonumber(lua, at);
    else luaL_error(lua, "pairs: a key is a %s; only numbers and strings have an order", luaL_typename(lua, at));
    return key;
}

/* Iterator of pairs. Upvalues: the table, the sorted keys, how many were handed out. */
static int script_sandbox_step(lua_State *lua)
{
    const struct script_key *keys = lua_touserdata(lua, lua_upvalueindex(2));
    lua_Integer count = (lua_Integer)(lua_rawlen(lua, lua_upvalueindex(2)) / sizeof *keys);
    lua_Integer at = lua_tointeger(lua, lua_upvalueindex(3));
    for (; at < count; at++) {
        const struct script_key *key = keys + at;
        lua_Integer whole;
        if (key->text) lua_pushlstring(lua, key->text, key->length);
        else if (lua_numbertointeger(key->number, &whole) && (double)whole == key->number) lua_pushinteger(lua, whole);
        else lua_pushnumber(lua, key->number);
        lua_pushvalue(lua, -1);
        if (lua_rawget(lua, lua_upvalueindex(1)) != LUA_TNIL) {
            lua_pushinteger(lua, at + 1);
            lua_replace(lua, lua_upvalueindex(3));
            return 2;
        }
        lua_pop(lua, 2); /* removed during the traversal */
    }
    return 0;
}

static int script_sandbox_pairs(lua_State *lua)
{
    luaL_checktype(lua, 1, LUA_TTABLE);
    lua_settop(lua, 1);
    size_t count = 0;
    for (lua_pushnil(lua); lua_next(lua, 1); lua_pop(lua, 1)) count++;
    struct script_key *keys = lua_newuserdatauv(lua, count * sizeof *keys, 1);
    lua_createtable(lua, 0, 0); /* keeps the texts alive while they are keys here */
    size_t at = 0;
    for (lua_pushnil(lua); lua_next(lua, 1); lua_pop(lua, 1)) {
        keys[at] = script_sandbox_key(lua, -2);
        if (keys[at].text) {
            lua_pushvalue(lua, -2);
            lua_rawseti(lua, 3, (lua_Integer)at + 1);
        }
        at++;
    }
    if (count) qsort(keys, count, sizeof *keys, script_sandbox_order);
    lua_setiuservalue(lua, 2, 1);
    lua_pushvalue(lua, 1);
    lua_pushvalue(lua, 2);
    lua_pushinteger(lua, 0);
    lua_pushcclosure(lua, script_sandbox_step, 3);
    return 1;
}

static int script_sandbox_tostring(lua_State *lua)
{
    luaL_checkany(lua, 1);
    int type = lua_type(lua, 1);
    if (type == LUA_TNUMBER || type == LUA_TSTRING || type == LUA_TBOOLEAN || type == LUA_TNIL)
        luaL_tolstring(lua, 1, NULL);
    else lua_pushstring(lua, luaL_typename(lua, 1)); /* the usual text has an address in it */
    return 1;
}

/* Upvalue: string.format. Called protected, so that errors are raised from here and so carry the script's line. */
static int script_sandbox_format(lua_State *lua)
{
    const char *format = luaL_checkstring(lua, 1);
    for (const char *at = strchr(format, '%'); at; at = strchr(at, '%')) {
        at += 1 + strspn(at + 1, "-+ #0123456789.");
        if (*at == 'p') return luaL_error(lua, "format: %%p is not available");
        if (*at) at++;
    }
    int count = lua_gettop(lua);
    for (int i = 2; i <= count; i++)
        if (lua_type(lua, i) > LUA_TSTRING || lua_type(lua, i) == LUA_TLIGHTUSERDATA)
            return luaL_error(lua, "format: argument %d is a %s", i, luaL_typename(lua, i));
    lua_pushvalue(lua, lua_upvalueindex(1));
    lua_insert(lua, 1);
    if (lua_pcall(lua, count, 1, 0)) return luaL_error(lua, "format: %s", lua_tostring(lua, -1));
    return 1;
}

static int script_sandbox_rep(lua_State *lua)
{
    size_t length, gap;
    const char *text = luaL_checklstring(lua, 1, &length);
    lua_Integer times = luaL_checkinteger(lua, 2);
    const char *between = luaL_optlstring(lua, 3, "", &gap);
    if (times < 0 || length + gap == 0) times = 0;
    if (times > 0 && (size_t)times > SCRIPT_SANDBOX_TEXT / (length + gap))
        return luaL_error(lua, "rep: the text would be longer than %d bytes", SCRIPT_SANDBOX_TEXT);
    luaL_Buffer buffer;
    luaL_buffinit(lua, &buffer);
    for (lua_Integer i = 0; i < times; i++) {
        if (i) luaL_addlstring(&buffer, between, gap);
        luaL_addlstring(&buffer, text, length);
    }
    luaL_pushresult(&buffer);
    return 1;
}

/* Length of the list at 1, refused if it is frozen or cannot be a list. */
static lua_Integer script_sandbox_list(lua_State *lua)
{
    luaL_checktype(lua, 1, LUA_TTABLE);
    if (lua_getmetatable(lua, 1)) return luaL_argerror(lua, 1, "this table cannot be changed");
    lua_Unsigned length = lua_rawlen(lua, 1);
    if (length > SCRIPT_SANDBOX_LENGTH) return luaL_argerror(lua, 1, "the list is too long");
    return (lua_Integer)length;
}

static int script_sandbox_insert(lua_State *lua)
{
    lua_Integer end = script_sandbox_list(lua) + 1, at = end;
    int count = lua_gettop(lua);
    if (count != 2 && count != 3) return luaL_error(lua, "insert: wants a table, a position if any, and a value");
    if (count == 3) {
        at = luaL_checkinteger(lua, 2);
        luaL_argcheck(lua, at >= 1 && at <= end, 2, "position out of bounds");
    }
    for (lua_Integer i = end; i > at; i--) {
        lua_rawgeti(lua, 1, i - 1);
        lua_rawseti(lua, 1, i);
    }
    lua_rawseti(lua, 1, at);
    return 0;
}

static int script_sandbox_remove(lua_State *lua)
{
    lua_Integer end = script_sandbox_list(lua), at = luaL_optinteger(lua, 2, end);
    luaL_argcheck(lua, lua_isnoneornil(lua, 2) || (at >= 1 && at <= end + 1), 2, "position out of bounds");
    lua_rawgeti(lua, 1, at);
    for (; at < end; at++) {
        lua_rawgeti(lua, 1, at + 1);
        lua_rawseti(lua, 1, at);
    }
    lua_pushnil(lua);
    lua_rawseti(lua, 1, at);
    return 1;
}

/* Like Lua's, but the message gets its line. */
static int script_sandbox_assert(lua_State *lua)
{
    luaL_checkany(lua, 1);
    if (lua_toboolean(lua, 1)) return lua_gettop(lua);
    return luaL_error(lua, "%s", luaL_optstring(lua, 2, "assertion failed"));
}

static int script_sandbox_sinh(lua_State *lua)
{
    lua_pushnumber(lua, sinh(luaL_checknumber(lua, 1)));
    return 1;
}

static int script_sandbox_cosh(lua_State *lua)
{
    lua_pushnumber(lua, cosh(luaL_checknumber(lua, 1)));
    return 1;
}

static int script_sandbox_tanh(lua_State *lua)
{
    lua_pushnumber(lua, tanh(luaL_checknumber(lua, 1)));
    return 1;
}

static int script_sandbox_erf(lua_State *lua)
{
    lua_pushnumber(lua, erf(luaL_checknumber(lua, 1)));
    return 1;
}

static int script_sandbox_refuse(lua_State *lua)
{
    return luaL_error(lua, "%s ('%s') cannot be written here; use a local variable",
                      lua_tostring(lua, lua_upvalueindex(1)), luaL_tolstring(lua, 2, NULL));
}

void script_sandbox_freeze(lua_State *lua, const char *what)
{
    lua_createtable(lua, 0, 0);
    lua_createtable(lua, 0, 2);
    lua_pushvalue(lua, -3);
    lua_setfield(lua, -2, "__index");
    lua_pushstring(lua, what);
    lua_pushcclosure(lua, script_sandbox_refuse, 1);
    lua_setfield(lua, -2, "__newindex");
    lua_setmetatable(lua, -2);
    lua_remove(lua, -2);
}

/* Copies the named fields of the library `name` into the table on top of the stack. */
static void script_sandbox_take(lua_State *lua, const char *name, lua_CFunction open, const char *const *fields)
{
    lua_pushcfunction(lua, open);
    lua_pushstring(lua, name);
    lua_call(lua, 1, 1);
    for (; *fields; fields++) {
        lua_getfield(lua, -1, *fields);
        lua_setfield(lua, -3, *fields);
    }
    lua_pop(lua, 1);
}

static const char *const script_sandbox_base[] = {"ipairs", "select", "type", "tonumber", "error", "pcall", NULL};
static const char *const script_sandbox_math[] = {
    "abs",  "acos", "asin", "atan", "ceil",       "cos",  "deg",        "exp",  "floor",
    "fmod", "huge", "log",  "max",  "maxinteger", "min",  "mininteger", "modf", "pi",
    "rad",  "sin",  "sqrt", "tan",  "tointeger",  "type", "ult",        NULL,
};
/* Those of math that need no "math." before them. */
static const char *const script_sandbox_bare[] = {"pi", "abs", "sqrt", "exp", "log", "min", "max", NULL};
static const char *const script_sandbox_string[] = {"len", "sub", "upper", "lower", "byte", "char", "format", NULL};
static const char *const script_sandbox_table[] = {"concat", "unpack", NULL};

static void script_sandbox_open_math(lua_State *lua)
{
    static const luaL_Reg more[] = {
        {"sinh", script_sandbox_sinh},
        {"cosh", script_sandbox_cosh},
        {"tanh", script_sandbox_tanh},
        {"erf", script_sandbox_erf},
        {NULL, NULL},
    };
    luaL_newlib(lua, more);
    script_sandbox_take(lua, "math", luaopen_math, script_sandbox_math);
    script_sandbox_freeze(lua, "a field of math");
}

static void script_sandbox_open_string(lua_State *lua)
{
    lua_createtable(lua, 0, 8);
    script_sandbox_take(lua, "string", luaopen_string, script_sandbox_string);
    lua_getfield(lua, -1, "format");
    lua_pushcclosure(lua, script_sandbox_format, 1);
    lua_setfield(lua, -2, "format");
    lua_pushcfunction(lua, script_sandbox_rep);
    lua_setfield(lua, -2, "rep");
    lua_pushliteral(lua, ""); /* the library gives strings a metatable that leads to all of it */
    lua_pushnil(lua);
    lua_setmetatable(lua, -2);
    lua_pop(lua, 1);
    script_sandbox_freeze(lua, "a field of string");
}

void script_sandbox_open(lua_State *lua)
{
    static const luaL_Reg base[] = {{"pairs", script_sandbox_pairs},
                                    {"tostring", script_sandbox_tostring},
                                    {"assert", script_sandbox_assert},
                                    {NULL, NULL}};
    static const luaL_Reg lists[] = {{"insert", script_sandbox_insert},
                                     {"remove", script_sandbox_remove},
                                     {NULL, NULL}};
    luaL_newlib(lua, base);
    script_sandbox_take(lua, "_G", luaopen_base, script_sandbox_base);
    script_sandbox_open_math(lua);
    for (const char *const *name = script_sandbox_bare; *name; name++) {
        lua_getfield(lua, -1, *name);
        lua_setfield(lua, -3, *name);
    }
    lua_setfield(lua, -2, "math");
    script_sandbox_open_string(lua);
    lua_setfield(lua, -2, "string");
    luaL_newlib(lua, lists);
    script_sandbox_take(lua, "table", luaopen_table, script_sandbox_table);
    script_sandbox_freeze(lua, "a field of table");
    lua_setfield(lua, -2, "table");
    script_library_open(lua);
    script_sandbox_freeze(lua, "a field of bulla");
    lua_setfield(lua, -2, "bulla");
}
