/* script_host.c - see script_host.h. */
#include "case/script_host.h"

#include "base/abort.h"
#include "base/mem.h"
#include "base/status.h"
#include "case/script_guard.h"
#include "case/script_sandbox.h"
#include "case/script_state.h"
#include "case/script_table.h"

#include <lauxlib.h>
#include <stdio.h>

enum { SCRIPT_HOST_MEMORY = 64 << 20 };

static void *script_host_allocate(void *user, void *block, size_t old, size_t size)
{
    struct script_host *host = user;
    size_t held = block ? old : 0;
    if (size > held && host->used - held + size > SCRIPT_HOST_MEMORY + host->room) return NULL;
    void *moved = mem_try(block, size);
    if (moved || !size) host->used = host->used - held + size;
    return moved;
}

static int script_host_open(lua_State *lua)
{
    struct script_host *host = lua_touserdata(lua, 1);
    script_sandbox_open(lua);
    lua_pushvalue(lua, -1);
    host->globals = luaL_ref(lua, LUA_REGISTRYINDEX);
    script_sandbox_freeze(lua, "a global");
    host->frozen = luaL_ref(lua, LUA_REGISTRYINDEX);
    return 0;
}

struct script_host *script_host_new(void)
{
    struct script_host *host = mem_new(1, sizeof *host);
    host->lua = lua_newstate(script_host_allocate, host);
    if (host->lua) {
        lua_pushcfunction(host->lua, script_host_open);
        lua_pushlightuserdata(host->lua, host);
    }
    if (!host->lua || lua_pcall(host->lua, 1, 0, 0)) {
        fprintf(stderr, "bulla: error: out of memory: cannot start Lua\n");
        abort_all(STATUS_RUN);
    }
    host->limit = SCRIPT_HOST_TIME;
    script_guard_new();
    return host;
}

void script_host_limit(struct script_host *host, double seconds)
{
    host->limit = seconds;
}

void script_host_free(struct script_host *host)
{
    if (!host) return;
    script_guard_free();
    lua_close(host->lua);
    for (struct script *script = host->scripts, *next; script; script = next) {
        next = script->next;
        mem_free(script->file);
        mem_free(script->arguments);
        mem_free(script);
    }
    script_table_free(host->tables);
    mem_free(host);
}
