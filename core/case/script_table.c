/* script_table.c - see script_table.h.
 *
 * The allowed names are split once and anchored in Lua's registry, so that a key is found by
 * comparing addresses (Lua keeps each short string once); the returned table is walked, so that
 * cost follows what it holds and no unknown key slips through. */
#include "case/script_table.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/script_state.h"

#include <lauxlib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One allowed field: the texts are Lua's own, kept alive, so that equal means the same address (short strings). */
struct script_table_field {
    const char *group, *key; /* the parts of "group.key"; group NULL: the key is at the top */
    lua_Integer element;     /* of a list; 0: a named key */
};

struct script_table {
    struct script_table *next;
    unsigned n;
    bool anchored; /* the fields are made; false only if there was no memory */
    char **names;  /* NULL-terminated */
    struct script_table_field *fields;
};

/* [protected] Makes Lua's own copies of the parts of each name and keeps them in the registry. */
static int script_table_anchor(lua_State *lua)
{
    struct script_table *table = lua_touserdata(lua, 1);
    lua_createtable(lua, 2 * (int)table->n, 0);
    for (unsigned i = 0; i < table->n; i++) {
        struct script_table_field *field = table->fields + i;
        const char *name = table->names[i], *dot = strchr(name, '.');
        if (dot) {
            field->group = lua_pushlstring(lua, name, (size_t)(dot - name));
            lua_rawseti(lua, 2, 2 * (lua_Integer)i + 1);
            field->element = strtol(dot + 1, NULL, 10);
        }
        field->key = lua_pushstring(lua, dot ? dot + 1 : name);
        lua_rawseti(lua, 2, 2 * (lua_Integer)i + 2);
    }
    luaL_ref(lua, LUA_REGISTRYINDEX);
    table->anchored = true;
    return 0;
}

static bool script_table_same(const struct script_table *table, const char *const *list, unsigned n)
{
    if (table->n != n) return false;
    for (unsigned i = 0; i < n; i++)
        if (strcmp(table->names[i], list[i]) != 0) return false;
    return true;
}

const struct script_table *script_table(struct script_host *host, const char *const *list, unsigned n_name)
{
    for (struct script_table *table = host->tables; table; table = table->next)
        if (script_table_same(table, list, n_name)) return table;
    struct script_table *table = mem_new(1, sizeof *table);
    *table = (struct script_table){.next = host->tables, .n = n_name};
    table->names = mem_new(n_name + 1, sizeof *table->names);
    table->fields = mem_new(n_name, sizeof *table->fields);
    for (unsigned i = 0; i < n_name; i++) table->names[i] = mem_text(list[i]);
    host->tables = table;
    lua_pushcfunction(host->lua, script_table_anchor);
    lua_pushlightuserdata(host->lua, table);
    if (lua_pcall(host->lua, 1, 0, 0)) lua_pop(host->lua, 1);
    return table;
}

/* Index of the field whose key is at -2, inside `group` (NULL: at the top); -1 if there is none. */
static int script_table_find(lua_State *lua, const struct script_table *table, const char *group)
{
    if (lua_type(lua, -2) == LUA_TNUMBER) {
        lua_Integer element = lua_tointeger(lua, -2);
        for (unsigned i = 0; i < table->n && group && element > 0; i++)
            if (table->fields[i].group == group && table->fields[i].element == element) return (int)i;
        return -1;
    }
    if (lua_type(lua, -2) != LUA_TSTRING) return -1;
    const char *key = lua_tostring(lua, -2);
    for (unsigned i = 0; i < table->n; i++)
        if (table->fields[i].key == key && table->fields[i].group == group) return (int)i;
    for (unsigned i = 0; i < table->n; i++) /* long texts have more than one address */
        if (strcmp(table->fields[i].key, key) == 0 && table->fields[i].group == group) return (int)i;
    return -1;
}

static int script_table_fail(const struct script *script, const struct script_table *table, const char *group)
{
    lua_State *lua = script->host->lua;
    struct text word = {0}, all = {0};
    if (group) text_add(&word, "%s.", group);
    if (lua_type(lua, -2) == LUA_TSTRING) text_add(&word, "%s", lua_tostring(lua, -2));
    else if (lua_type(lua, -2) == LUA_TNUMBER) text_add(&word, "%.14g", lua_tonumber(lua, -2));
    else text_add(&word, "(%s)", luaL_typename(lua, -2));
    const char *nearest = text_nearest(word.at, (const char *const *)table->names);
    if (nearest) text_add(&all, "did you mean '%s'? ", nearest);
    text_add(&all, "Known are:");
    for (unsigned i = 0; i < table->n; i++) text_add(&all, " %s", table->names[i]);
    status_fail(STATUS_CASE, "%s:%d: the script returns an unknown field '%s'; %s", script->file, script->line, word.at,
                all.at);
    text_done(&word);
    text_done(&all);
    return STATUS_CASE;
}

/* Reads the table on top of the stack, which is the field `group` of the outer one (NULL: it is the outer one). */
static int script_table_read(const struct script *script, const struct script_table *table, const char *group,
                             double *out)
{
    lua_State *lua = script->host->lua;
    for (lua_pushnil(lua); lua_next(lua, -2); lua_pop(lua, 1)) {
        if (!group && lua_type(lua, -1) == LUA_TTABLE && lua_type(lua, -2) == LUA_TSTRING) {
            TRY(script_table_read(script, table, lua_tostring(lua, -2), out));
            continue;
        }
        int field = script_table_find(lua, table, group);
        if (field < 0) return script_table_fail(script, table, group);
        double value = lua_tonumber(lua, -1);
        if (!isfinite(value) || lua_type(lua, -1) != LUA_TNUMBER) {
            script_check_number(lua, -1, script->file, script->line, &value);
            return status_fail(STATUS_CASE, "%s, in the field '%s'", status_text(), table->names[field]);
        }
        out[field] = value;
    }
    return STATUS_OK;
}

int script_table_call(const struct script *script, const double *in, unsigned n_in, const struct script_table *table,
                      double *out)
{
    lua_State *lua = script->host->lua;
    if (!table->anchored) return status_fail(STATUS_CASE, "%s: not enough memory for Lua", script->file);
    for (unsigned i = 0; i < table->n; i++) out[i] = (double)NAN;
    int base = lua_gettop(lua), code = STATUS_OK;
    TRY(script_begin(script, in, n_in, 1));
    if (lua_type(lua, -1) == LUA_TTABLE) code = script_table_read(script, table, NULL, out);
    else
        code = status_fail(STATUS_CASE, "%s:%d: the script must return a table of named fields, but gives a %s",
                           script->file, script->line, luaL_typename(lua, -1));
    lua_settop(lua, base);
    return code ? script_fail_at(script, in, n_in) : STATUS_OK;
}

void script_table_free(struct script_table *table)
{
    for (struct script_table *next; table; table = next) {
        next = table->next;
        for (unsigned i = 0; i < table->n; i++) mem_free(table->names[i]);
        mem_free(table->names);
        mem_free(table->fields);
        mem_free(table);
    }
}
