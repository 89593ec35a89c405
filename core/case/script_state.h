/* script_state.h - the inside of the Lua host, shared by script.c, script_table.c and formula.c alone. */
#ifndef SCRIPT_STATE_H
#define SCRIPT_STATE_H

#include "case/script.h"

#include <lua.h>

struct script_table;

struct script_host {
    lua_State *lua;
    size_t used, room;          /* bytes that Lua holds; that it may hold beside the usual ones */
    int globals;                /* registry: the numbers and libraries that all scripts see */
    int frozen;                 /* registry: the same behind glass, the environment of expressions */
    bool loading;               /* a chunk is being run: its globals can be written */
    double limit;               /* seconds of CPU time that a call may take */
    const struct script *ended; /* by the guard, the last one: not called again */
    struct script *scripts;
    struct script_table *tables;
};

struct script {
    struct script_host *host;
    struct script *next;
    char *file, *arguments; /* arguments: as given, NULL for a function */
    int line, function;     /* function: registry */
    bool constant;
};

/* A chunk that is compiled and run. */
struct script_source {
    struct script_host *host;
    const char *text; /* newlines before it included */
    bool own;         /* has globals of its own while it is loaded */
    bool load;        /* only look whether it can be compiled */
    int environment;  /* registry; 0: the globals behind glass */
    double extra;     /* seconds of CPU time beside the host's limit */
};

/* Runs a chunk. On success its result is on the stack (nothing with source.load); else the message begins with file
 * and line. STATUS_CASE. */
int script_run(const struct script_source *source, const char *file, int line);

/* Calls; on success n_out results are on the stack, on failure nothing. */
int script_begin(const struct script *script, const double *in, unsigned n_in, unsigned n_out);

/* Is the value at `at` a finite number? Else a message that begins with file and line. */
int script_check_number(lua_State *lua, int at, const char *file, int line, double *ret_value);

/* Adds the arguments of a call to the recorded message. Returns STATUS_CASE. */
int script_fail_at(const struct script *script, const double *in, unsigned n_in);

#endif
