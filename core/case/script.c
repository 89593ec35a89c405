/* script.c - see script.h: compiling, calling, and messages.
 *
 * All scripts of a case share one Lua state. What they see is an empty, frozen table that shows
 * the whitelist of script_sandbox.c and the case's numbers; a chunk has one more table between
 * for the globals it writes while it is loaded. Anything that may raise a Lua error (memory too)
 * runs under lua_pcall. A chunk is named by the byte \1, with `line - 1` newlines before it:
 * Lua's own messages then carry the right line, and the full file name is put in afterwards. */
#include "case/script.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/script_guard.h"
#include "case/script_state.h"

#include <ctype.h>
#include <lauxlib.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SCRIPT_TICK = 1000000000 };
#define SCRIPT_CHUNK "=\1"

/* Of the guard, in microseconds: a call ends after one to two of them. */
static int script_tick(const struct script_host *host, double extra)
{
    double tick = 0.5e6 * (host->limit + extra);
    return tick < SCRIPT_TICK ? (int)tick : SCRIPT_TICK;
}

/* Messages */

static void script_say_struck(struct text *text, const struct script_host *host, const char *file,
                              struct script_guard_end end)
{
    if (end.many)
        text_add(text,
                 "%s:%d: the scripts of the case ran for too long: calls that take more than %.3g s each, one after "
                 "the other; simpler ones, or a larger run.script-time (now %g s)",
                 file, end.line, host->limit / 200.0, host->limit);
    else
        text_add(text,
                 "%s:%d: the script ran for too long: a loop without end? If not, run.script-time (now %g s) allows "
                 "calls to take longer",
                 file, end.line, host->limit);
}

/* The message on top of the stack as a status, popped: file:line: what happened. */
static int script_fail_lua(const struct script_host *host, const char *file, int line, struct script_guard_end end)
{
    lua_State *lua = host->lua;
    const char *message = lua_type(lua, -1) == LUA_TSTRING ? lua_tostring(lua, -1) : "the error is not a text";
    struct text text = {0};
    if (end.line) script_say_struck(&text, host, file, end);
    else if (*message != SCRIPT_CHUNK[1]) text_add(&text, "%s:%d: %s", file, line, message);
    else
        for (; *message; message++)
            text_add_n(&text, *message == SCRIPT_CHUNK[1] ? file : message,
                       *message == SCRIPT_CHUNK[1] ? strlen(file) : 1);
    lua_pop(lua, 1);
    status_fail(STATUS_CASE, "%s", text.at);
    text_done(&text);
    return STATUS_CASE;
}

int script_fail_at(const struct script *script, const double *in, unsigned n_in)
{
    struct text text = {0};
    if (n_in == 0) return STATUS_CASE;
    text_add(&text, "%s (called with ", status_text());
    if (script->arguments) text_add(&text, "%s = ", script->arguments);
    for (unsigned i = 0; i < n_in; i++) text_add(&text, "%s%.10g", i ? ", " : "", in[i]);
    status_fail(STATUS_CASE, "%s)", text.at);
    text_done(&text);
    return STATUS_CASE;
}

/* Numbers that every script sees */

struct script_number {
    struct script_host *host;
    const char *name;
    double value;
};

static int script_put_number(lua_State *lua)
{
    const struct script_number *number = lua_touserdata(lua, 1);
    lua_rawgeti(lua, LUA_REGISTRYINDEX, number->host->globals);
    lua_pushnumber(lua, number->value);
    lua_setfield(lua, -2, number->name);
    return 0;
}

void script_set_number(struct script_host *host, const char *name, double value)
{
    struct script_number number = {host, name, value};
    lua_pushcfunction(host->lua, script_put_number);
    lua_pushlightuserdata(host->lua, &number);
    if (lua_pcall(host->lua, 1, 0, 0)) lua_pop(host->lua, 1); /* no memory: scripts will find the name missing */
}

/* [protected] Is the text a global? */
static int script_find_global(lua_State *lua)
{
    const struct script_number *wanted = lua_touserdata(lua, 1);
    lua_rawgeti(lua, LUA_REGISTRYINDEX, wanted->host->globals);
    lua_getfield(lua, -1, wanted->name);
    lua_pushboolean(lua, !lua_isnil(lua, -1));
    return 1;
}

bool script_has(struct script_host *host, const char *name)
{
    struct script_number wanted = {host, name, 0.0};
    lua_pushcfunction(host->lua, script_find_global);
    lua_pushlightuserdata(host->lua, &wanted);
    bool found = lua_pcall(host->lua, 1, 1, 0) == LUA_OK && lua_toboolean(host->lua, -1);
    lua_pop(host->lua, 1);
    return found;
}

void script_numbers(struct script_host *host, void (*visit)(void *context, const char *name), void *context)
{
    lua_State *lua = host->lua;
    lua_rawgeti(lua, LUA_REGISTRYINDEX, host->globals);
    for (lua_pushnil(lua); lua_next(lua, -2); lua_pop(lua, 1))
        if (lua_type(lua, -1) == LUA_TNUMBER) visit(context, lua_tostring(lua, -2));
    lua_pop(lua, 1);
}

/* Compiling */

/* __newindex of a chunk's environment. Upvalues: the host, the chunk's globals. */
static int script_assign(lua_State *lua)
{
    const struct script_host *host = lua_touserdata(lua, lua_upvalueindex(1));
    if (!host->loading)
        return luaL_error(lua, "a global ('%s') cannot be written here; use a local variable",
                          luaL_tolstring(lua, 2, NULL));
    lua_settop(lua, 3);
    lua_rawset(lua, lua_upvalueindex(2));
    return 0;
}

/* Pushes { } that shows `own` (shows the shared globals), into which it writes while loading. */
static void script_push_environment(lua_State *lua, struct script_host *host)
{
    lua_createtable(lua, 0, 0);
    lua_createtable(lua, 0, 2);
    lua_createtable(lua, 0, 0); /* own */
    lua_createtable(lua, 0, 1);
    lua_rawgeti(lua, LUA_REGISTRYINDEX, host->globals);
    lua_setfield(lua, -2, "__index");
    lua_setmetatable(lua, -2);
    lua_pushvalue(lua, -1);
    lua_setfield(lua, -3, "__index");
    lua_pushlightuserdata(lua, host);
    lua_insert(lua, -2);
    lua_pushcclosure(lua, script_assign, 2);
    lua_setfield(lua, -2, "__newindex");
    lua_setmetatable(lua, -2);
}

/* [protected] Runs a chunk; returns its one result. */
static int script_run_chunk(lua_State *lua)
{
    const struct script_source *source = lua_touserdata(lua, 1);
    if (luaL_loadbufferx(lua, source->text, strlen(source->text), SCRIPT_CHUNK, "t")) return lua_error(lua);
    if (source->load) return 0;
    if (source->own) script_push_environment(lua, source->host);
    else lua_rawgeti(lua, LUA_REGISTRYINDEX, source->environment ? source->environment : source->host->frozen);
    lua_setupvalue(lua, -2, 1);
    lua_call(lua, 0, 1);
    return 1;
}

int script_run(const struct script_source *source, const char *file, int line)
{
    struct script_host *host = source->host;
    lua_pushcfunction(host->lua, script_run_chunk);
    lua_pushlightuserdata(host->lua, (void *)(uintptr_t)source);
    script_guard_enter(host->lua, script_tick(host, source->extra));
    host->loading = true;
    int failed = lua_pcall(host->lua, 1, source->load ? 0 : 1, 0);
    host->loading = false;
    struct script_guard_end end = script_guard_leave(host->lua);
    return failed ? script_fail_lua(host, file, line, end) : STATUS_OK;
}

/* Newlines so that what follows begins at `line`, then the parts. Free with text_done. */
static struct text script_chunk(int line, const char *head, const char *text, const char *tail)
{
    struct text chunk = {0};
    for (int i = 1; i < line; i++) text_add_n(&chunk, "\n", 1);
    text_add(&chunk, "%s%s%s", head, text, tail);
    return chunk;
}

int script_check_number(lua_State *lua, int at, const char *file, int line, double *ret_value)
{
    if (lua_type(lua, at) != LUA_TNUMBER)
        return status_fail(STATUS_CASE, "%s:%d: a number is needed here, but the script gives a %s", file, line,
                           luaL_typename(lua, at));
    double value = lua_tonumber(lua, at);
    if (!isfinite(value))
        return status_fail(STATUS_CASE, "%s:%d: the script gives %s, not a finite number", file, line,
                           isnan(value)  ? "nan"
                           : value > 0.0 ? "inf"
                                         : "-inf");
    *ret_value = value;
    return STATUS_OK;
}

/* Pushes the value of an expression, or with `arguments` a function that returns it. The text is compiled alone
 * first, so that messages about its syntax name only what stands in the case; then in brackets: one value. */
static int script_run_expression(struct script_host *host, const char *text, const char *arguments, const char *file,
                                 int line)
{
    struct text alone = script_chunk(line, "return ", text, "");
    struct script_source look = {.host = host, .text = alone.at, .load = true};
    int code = script_run(&look, file, line);
    text_done(&alone);
    if (code) return code;
    struct text head = {0};
    if (arguments) text_add(&head, "return function(%s) ", arguments);
    text_add(&head, "return (");
    struct text chunk = script_chunk(line, head.at, text, arguments ? "\n) end" : "\n)");
    struct script_source source = {.host = host, .text = chunk.at};
    code = script_run(&source, file, line);
    text_done(&head);
    text_done(&chunk);
    return code;
}

int script_evaluate(struct script_host *host, const char *text, const char *file, int line, double *ret_value)
{
    TRY(script_run_expression(host, text, NULL, file, line));
    int code = script_check_number(host->lua, -1, file, line, ret_value);
    lua_pop(host->lua, 1);
    return code;
}

static int script_keep(lua_State *lua)
{
    lua_pushinteger(lua, luaL_ref(lua, LUA_REGISTRYINDEX));
    return 1;
}

/* Makes a script of the function on top of the stack (popped). */
static int script_new(struct script_host *host, const char *arguments, const char *file, int line,
                      const struct script **ret_script)
{
    if (!lua_isfunction(host->lua, -1)) {
        status_fail(STATUS_CASE,
                    "%s:%d: the script must return a function, such as 'return function(x, y, z) ... end', "
                    "but gives a %s",
                    file, line, luaL_typename(host->lua, -1));
        lua_pop(host->lua, 1);
        return STATUS_CASE;
    }
    lua_pushcfunction(host->lua, script_keep);
    lua_insert(host->lua, -2);
    if (lua_pcall(host->lua, 1, 1, 0)) return script_fail_lua(host, file, line, (struct script_guard_end){0});
    struct script *script = mem_new(1, sizeof *script);
    *script = (struct script){host, host->scripts, mem_text(file), mem_text(arguments), line, 0, false};
    script->function = (int)lua_tointeger(host->lua, -1);
    lua_pop(host->lua, 1);
    host->scripts = script;
    *ret_script = script;
    return STATUS_OK;
}

/* Does the text have a name out of the list as a word? Strings and comments count too: better one constant
 * missed than one too many. */
static bool script_mentions(const char *text, const char *arguments)
{
    for (const char *at = text; *at;) {
        size_t length = 0;
        while (isalnum((unsigned char)at[length]) || at[length] == '_') length++;
        bool dot = at > text && at[-1] == '.', dots = dot && at - 1 > text && at[-2] == '.';
        for (const char *name = arguments; *name && length && (!dot || dots);) { /* "math.t" is no t, ".." t is one */
            size_t size = strcspn(name, ", ");
            if (size == length && strncmp(name, at, size) == 0) return true;
            name += size + strspn(name + size, ", ");
        }
        at += length ? length : 1;
    }
    return false;
}

int script_compile(struct script_host *host, const char *text, const char *arguments, const char *file, int line,
                   const struct script **ret_script)
{
    TRY(script_run_expression(host, text, arguments, file, line));
    TRY(script_new(host, arguments, file, line, ret_script));
    host->scripts->constant = !script_mentions(text, arguments);
    return STATUS_OK;
}

/* Bytes of white space and comments at the start. */
static size_t script_blank(const char *text)
{
    size_t at = strspn(text, " \t\r\n");
    while (text[at] == '-' && text[at + 1] == '-') {
        at += strcspn(text + at, "\n");
        at += strspn(text + at, " \t\r\n");
    }
    return at;
}

int script_compile_function(struct script_host *host, const char *text, const char *file, int line,
                            const struct script **ret_script)
{
    size_t at = script_blank(text);
    bool bare = strncmp(text + at, "function", 8) == 0 && text[at + 8 + strspn(text + at + 8, " \t")] == '(';
    struct text head = {0};
    text_add_n(&head, text, at);
    struct text chunk = script_chunk(line, head.at, bare ? "return " : "", text + at);
    struct script_source source = {.host = host, .text = chunk.at, .own = true};
    int code = script_run(&source, file, line);
    text_done(&head);
    text_done(&chunk);
    return code ? code : script_new(host, NULL, file, line, ret_script);
}

bool script_is_constant(const struct script *script)
{
    return script->constant;
}

/* Calling */

int script_begin(const struct script *script, const double *in, unsigned n_in, unsigned n_out)
{
    struct script_host *host = script->host;
    lua_State *lua = host->lua;
    if (host->ended == script)
        return status_fail(STATUS_CASE, "%s:%d: the script ran for too long before", script->file, script->line);
    lua_checkstack(lua, 2 * SCRIPT_ARGUMENTS);
    lua_rawgeti(lua, LUA_REGISTRYINDEX, script->function);
    for (unsigned i = 0; i < n_in; i++) lua_pushnumber(lua, in[i]);
    script_guard_enter(lua, script_tick(host, 0.0));
    int failed = lua_pcall(lua, (int)n_in, (int)n_out, 0);
    struct script_guard_end end = script_guard_leave(lua);
    if (!failed) return STATUS_OK;
    if (end.line) host->ended = script;
    script_fail_lua(host, script->file, script->line, end);
    return script_fail_at(script, in, n_in);
}

int script_call(const struct script *script, const double *in, unsigned n_in, double *out, unsigned n_out)
{
    TRY(script_begin(script, in, n_in, n_out));
    lua_State *lua = script->host->lua;
    for (unsigned i = 0; i < n_out; i++) {
        double value = lua_tonumber(lua, (int)i - (int)n_out);
        if (!isfinite(value) || lua_type(lua, (int)i - (int)n_out) != LUA_TNUMBER) {
            script_check_number(lua, (int)i - (int)n_out, script->file, script->line, &value);
            lua_pop(lua, (int)n_out);
            if (n_out > 1) status_fail(STATUS_CASE, "%s as result %u of %u", status_text(), i + 1, n_out);
            return script_fail_at(script, in, n_in);
        }
        out[i] = value;
    }
    lua_pop(lua, (int)n_out);
    return STATUS_OK;
}

/* A row of points for one protected call, which costs as much as that of a point. */
struct script_points {
    const struct script *script;
    size_t n;
    const double *const *in;
    unsigned n_in;
    double *out;
};

static int script_points(lua_State *lua)
{
    const struct script_points *points = lua_touserdata(lua, 1);
    lua_rawgeti(lua, LUA_REGISTRYINDEX, points->script->function);
    for (size_t i = 0; i < points->n; i++) {
        lua_pushvalue(lua, -1);
        for (unsigned k = 0; k < points->n_in; k++) lua_pushnumber(lua, points->in[k][i]);
        lua_call(lua, (int)points->n_in, 1);
        if (lua_type(lua, -1) != LUA_TNUMBER)
            return luaL_error(lua, "a number is needed here, but the script gives a %s", luaL_typename(lua, -1));
        points->out[i] = lua_tonumber(lua, -1);
        lua_pop(lua, 1);
    }
    return 0;
}

int script_row(const struct script *script, size_t n, const double *const *in, unsigned n_in, double *out)
{
    struct script_host *host = script->host;
    struct script_points points = {script, n, in, n_in, out};
    for (size_t i = 0; i < n; i++) out[i] = NAN;
    if (host->ended == script)
        return status_fail(STATUS_CASE, "%s:%d: the script ran for too long before", script->file, script->line);
    lua_checkstack(host->lua, 2 * SCRIPT_ARGUMENTS);
    lua_pushcfunction(host->lua, script_points);
    lua_pushlightuserdata(host->lua, &points);
    script_guard_enter(host->lua, script_tick(host, 0.0));
    int failed = lua_pcall(host->lua, 1, 0, 0);
    struct script_guard_end end = script_guard_leave(host->lua);
    if (!failed) return STATUS_OK;
    if (end.line) host->ended = script;
    return script_fail_lua(host, script->file, script->line, end);
}

int script_test(const struct script *script, const double *in, unsigned n_in, bool *ret)
{
    TRY(script_begin(script, in, n_in, 1));
    lua_State *lua = script->host->lua;
    double value = lua_toboolean(lua, -1) ? 1.0 : 0.0;
    bool number = !lua_isboolean(lua, -1) && !lua_isnil(lua, -1);
    int code = number ? script_check_number(lua, -1, script->file, script->line, &value) : STATUS_OK;
    lua_pop(lua, 1);
    *ret = value > 0.0;
    return code ? script_fail_at(script, in, n_in) : STATUS_OK;
}

const char *script_parameter(const struct script *script, unsigned index)
{
    lua_State *lua = script->host->lua;
    lua_rawgeti(lua, LUA_REGISTRYINDEX, script->function);
    const char *name = lua_getlocal(lua, NULL, (int)index + 1);
    lua_pop(lua, 1);
    return name;
}
