/* formula.c - see formula.h. Names are looked up before anything is evaluated, so that one in a branch that is not
 * taken is found too. Lua's messages know lines only: the expression is given to it with every word on a line of its
 * own, and a line is a place in the text. */
#include "case/formula.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/formula_words.h"
#include "case/script_column.h"
#include "case/script_sandbox.h"
#include "case/script_state.h"

#include <lauxlib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FORMULA_CHUNK "formula" /* what stands before the line in Lua's messages */

enum { FORMULA_ROOM = 64 }; /* columns that one evaluation may hold beside those of the run */

struct formula_entry {
    char *name;
    struct trace trace;
};

struct formula {
    struct script_host *host;
    bool planned;
    unsigned n;
    struct formula_entry *entries;
    int environment; /* registry */
};

/* Names and values */

static const struct formula_entry *formula_find(const struct formula *formula, const char *name, size_t length)
{
    for (unsigned i = 0; i < formula->n; i++)
        if (strncmp(formula->entries[i].name, name, length) == 0 && formula->entries[i].name[length] == '\0')
            return &formula->entries[i];
    return NULL;
}

/* The first column `name.something` from entry `from` on; formula->n: none. */
static unsigned formula_field(const struct formula *formula, const char *name, size_t length, unsigned from)
{
    for (; from < formula->n; from++)
        if (strncmp(formula->entries[from].name, name, length) == 0 && formula->entries[from].name[length] == '.')
            break;
    return from;
}

static void formula_push(lua_State *lua, const struct formula *formula, const struct formula_entry *entry)
{
    script_column_push(lua, entry->name, &entry->trace, formula->planned);
}

/* Pushes the columns of a probe as a table; nothing if there is no such probe. */
static bool formula_push_probe(lua_State *lua, const struct formula *formula, const char *name)
{
    size_t length = strlen(name);
    unsigned i = formula_field(formula, name, length, 0);
    if (i == formula->n) return false;
    lua_createtable(lua, 0, 4);
    for (; i < formula->n; i = formula_field(formula, name, length, i + 1)) {
        formula_push(lua, formula, &formula->entries[i]);
        lua_setfield(lua, -2, formula->entries[i].name + length + 1);
    }
    return true;
}

/* __index of the environment. Upvalues: the formula; the functions over columns, which show the globals. */
static int formula_index(lua_State *lua)
{
    const struct formula *formula = lua_touserdata(lua, lua_upvalueindex(1));
    const char *name = luaL_checkstring(lua, 2);
    const struct formula_entry *entry = formula_find(formula, name, strlen(name));
    if (entry) formula_push(lua, formula, entry);
    if (formula_push_probe(lua, formula, name)) {
        if (entry) script_column_fields(lua);
        return 1;
    }
    if (entry) return 1;
    lua_rawgeti(lua, LUA_REGISTRYINDEX, formula->host->globals);
    lua_getfield(lua, -1, name);
    if (lua_type(lua, -1) == LUA_TNUMBER) return 1;
    lua_getfield(lua, lua_upvalueindex(2), name);
    return 1;
}

/* [protected] Makes the environment of a formula. */
static int formula_open(lua_State *lua)
{
    struct formula *formula = lua_touserdata(lua, 1);
    script_column_open(lua, formula->host->globals);
    lua_pushvalue(lua, -1);
    script_sandbox_freeze(lua, "a global");
    lua_getmetatable(lua, -1);
    lua_pushlightuserdata(lua, formula);
    lua_pushvalue(lua, -4);
    lua_pushcclosure(lua, formula_index, 2);
    lua_setfield(lua, -2, "__index");
    lua_pop(lua, 1);
    formula->environment = luaL_ref(lua, LUA_REGISTRYINDEX);
    return 0;
}

struct formula *formula_new(struct script_host *host, bool planned)
{
    struct formula *formula = mem_new(1, sizeof *formula);
    *formula = (struct formula){.host = host, .planned = planned};
    lua_pushcfunction(host->lua, formula_open);
    lua_pushlightuserdata(host->lua, formula);
    if (lua_pcall(host->lua, 1, 0, 0)) lua_pop(host->lua, 1); /* no memory: every expression says so */
    return formula;
}

void formula_free(struct formula *formula)
{
    if (!formula) return;
    if (formula->environment) luaL_unref(formula->host->lua, LUA_REGISTRYINDEX, formula->environment);
    formula->host->room = 0;
    for (unsigned i = 0; i < formula->n; i++) mem_free(formula->entries[i].name);
    mem_free(formula->entries);
    mem_free(formula);
}

void formula_add(struct formula *formula, const char *name, const struct trace *trace)
{
    size_t room = FORMULA_ROOM * sizeof(double) * trace->n;
    if (room > formula->host->room) formula->host->room = room;
    formula->entries = mem_grow(formula->entries, formula->n, formula->n + 1, sizeof *formula->entries);
    formula->entries[formula->n++] = (struct formula_entry){mem_text(name), *trace};
}

void formula_plan(struct formula *formula, const char *name)
{
    static const double t[] = {0, 1}, v[] = {1, 1}; /* two rows stand for those to come */
    formula_add(formula, name, &(struct trace){2, t, v});
}

bool formula_column(const struct formula *formula, const char *name, struct trace *ret_trace)
{
    const struct formula_entry *entry = formula_find(formula, name, strlen(name));
    if (entry) *ret_trace = entry->trace;
    return entry != NULL;
}

/* Faults */

/* Every one is of a word, or of the whole text (NULL). */
static int formula_fail(struct formula_fault *fault, const char *text, const struct formula_word *word, char *said)
{
    *fault = (struct formula_fault){.length = strlen(text), .said = said};
    if (word) fault->at = (size_t)(word->at - text);
    if (word) fault->length = word->length;
    return STATUS_CASE;
}

struct formula_list {
    unsigned n;
    const char **names; /* NULL after the last */
};

static void formula_list_add(void *context, const char *name)
{
    struct formula_list *list = context;
    list->names = mem_grow(list->names, list->n ? list->n + 1 : 0, list->n + 2, sizeof *list->names);
    list->names[list->n++] = name;
}

static int formula_order(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* "did you mean 'min'? ": the nearest of the names, if one is near. */
static void formula_guess(struct text *help, const char *word, const char *const *names)
{
    const char *near = text_nearest(word, names);
    if (near) text_add(help, "did you mean '%s'? ", near);
}

static void formula_help_function(struct text *help, const char *word)
{
    formula_guess(help, word, script_column_functions);
    text_add(help, "known are");
    for (const char *const *name = script_column_functions; *name; name++) text_add(help, " %s", *name);
    text_add(help, ", and those of math, as in math.sin");
}

static void formula_help_value(struct text *help, const struct formula *formula, const char *word)
{
    struct formula_list list = {0};
    for (unsigned i = 0; i < formula->n; i++) formula_list_add(&list, formula->entries[i].name);
    unsigned columns = list.n;
    script_numbers(formula->host, formula_list_add, &list);
    if (list.n > columns) qsort(list.names + columns, list.n - columns, sizeof *list.names, formula_order);
    if (list.n) formula_guess(help, word, list.names);
    text_add(help, "known are");
    for (unsigned i = 0; i < list.n; i++) text_add(help, " %s", list.names[i]);
    mem_free(list.names);
}

/* Nothing of that name: a function, to judge by the bracket behind it, or a value. */
static int formula_unknown(const struct formula *formula, const char *text, const struct formula_word *word,
                           const char *name, bool function, struct formula_fault *ret_fault)
{
    const char *said = function ? "there is no function '%s'" : "there is no column, probe or parameter '%s'";
    struct text help = {0};
    if (function) formula_help_function(&help, name);
    else formula_help_value(&help, formula, name);
    formula_fail(ret_fault, text, word, mem_print(said, name));
    ret_fault->help = help.at;
    return STATUS_CASE;
}

static int formula_bare_probe(const struct formula *formula, const char *text, const struct formula_word *word,
                              unsigned field, struct formula_fault *ret_fault)
{
    return formula_fail(ret_fault, text, word,
                        mem_print("'%.*s' is a probe; which of its fields, as in '%s'?", (int)word->length, word->at,
                                  formula->entries[field].name));
}

/* `wall.pressure`: words i to i + 2. */
static int formula_check_field(const struct formula *formula, const char *text, const struct formula_words *words,
                               unsigned i, struct formula_fault *ret_fault)
{
    const struct formula_word *first = &words->list[i], *last = &words->list[i + 2];
    struct formula_word whole = {first->at, (size_t)(last->at - first->at) + last->length};
    char *name = mem_print("%.*s.%.*s", (int)first->length, first->at, (int)last->length, last->at);
    int code = formula_find(formula, name, strlen(name))
                   ? STATUS_OK
                   : formula_unknown(formula, text, &whole, name, false, ret_fault);
    mem_free(name);
    return code;
}

static bool formula_is_function(const char *name)
{
    for (const char *const *at = script_column_functions; *at; at++)
        if (strcmp(*at, name) == 0) return true;
    return false;
}

/* Looks up the name at word i. */
static int formula_check_name(const struct formula *formula, const char *text, const struct formula_words *words,
                              unsigned i, struct formula_fault *ret_fault)
{
    const struct formula_word *word = &words->list[i];
    bool column = formula_find(formula, word->at, word->length) != NULL;
    unsigned probe = formula_field(formula, word->at, word->length, 0);
    bool dot = formula_words_is(words, i + 1, ".") && i + 2 < words->n;
    if (dot && (column || probe < formula->n)) return formula_check_field(formula, text, words, i, ret_fault);
    if (column) return STATUS_OK;
    if (probe < formula->n) return formula_bare_probe(formula, text, word, probe, ret_fault);
    char *name = mem_text_n(word->at, word->length);
    int code = STATUS_OK;
    if (!formula_is_function(name) && !script_has(formula->host, name))
        code = formula_unknown(formula, text, word, name, formula_words_is(words, i + 1, "("), ret_fault);
    mem_free(name);
    return code;
}

static int formula_check_names(const struct formula *formula, const char *text, const struct formula_words *words,
                               struct formula_fault *ret_fault)
{
    for (unsigned i = 0; i < words->n; i++) {
        if (!formula_words_is_name(words, i)) continue;
        if (i && (formula_words_is(words, i - 1, ".") || formula_words_is(words, i - 1, ":"))) continue;
        TRY(formula_check_name(formula, text, words, i, ret_fault));
    }
    return STATUS_OK;
}

/* Evaluation */

/* What Lua says, without the lines that it was given: " at line 3". */
static char *formula_said(const char *message)
{
    static const char at_line[] = " at line ";
    struct text said = {0};
    for (const char *at; (at = strstr(message, at_line)) != NULL;) {
        text_add_n(&said, message, (size_t)(at - message));
        message = at + strlen(at_line);
        message += strspn(message, "0123456789");
    }
    text_add(&said, "%s", message);
    return said.at;
}

/* Makes a fault of what script_run has said. */
static int formula_fail_lua(const struct formula_words *words, const char *text, struct formula_fault *ret_fault)
{
    const char *said = status_text();
    char *end;
    size_t head = strlen(FORMULA_CHUNK ":");
    if (strncmp(said, FORMULA_CHUNK ":", head) != 0) return formula_fail(ret_fault, text, NULL, mem_text(said));
    long line = strtol(said + head, &end, 10);
    end += strspn(end, ": ");
    return formula_fail(ret_fault, text, formula_words_at(words, line), formula_said(end));
}

static double formula_rows(const struct formula *formula)
{
    size_t most = 0;
    for (unsigned i = 0; i < formula->n; i++)
        if (formula->entries[i].trace.n > most) most = formula->entries[i].trace.n;
    return (double)most;
}

/* Leaves the value of the expression on the stack. */
static int formula_run(const struct formula *formula, const struct formula_words *words, const char *text,
                       struct formula_fault *ret_fault)
{
    struct text chunk = {0};
    struct script_source source = {formula->host, .environment = formula->environment,
                                   .extra = 2e-6 * formula_rows(formula)};
    text_add(&chunk, "return "); /* alone first: in brackets, two halves could make a whole */
    formula_words_lines(words, &chunk);
    source.text = chunk.at;
    source.load = true;
    int code = script_run(&source, FORMULA_CHUNK, 1);
    text_done(&chunk);
    if (code) return formula_fail_lua(words, text, ret_fault);
    text_add(&chunk, "return (");
    formula_words_lines(words, &chunk);
    text_add(&chunk, "\n)");
    source.text = chunk.at;
    source.load = false;
    code = script_run(&source, FORMULA_CHUNK, 1);
    text_done(&chunk);
    return code ? formula_fail_lua(words, text, ret_fault) : STATUS_OK;
}

static int formula_take(lua_State *lua, const char *text, double *ret_value, struct formula_fault *ret_fault)
{
    if (lua_type(lua, -1) == LUA_TNUMBER) {
        *ret_value = lua_tonumber(lua, -1) + 0.0; /* nobody wants to read -0 */
        return STATUS_OK;
    }
    if (script_column_is(lua, -1))
        return formula_fail(ret_fault, text, NULL,
                            mem_text("the value is a whole column; reduce it with min, max, last, ..."));
    return formula_fail(ret_fault, text, NULL,
                        mem_print("the value is a %s; a number is needed", luaL_typename(lua, -1)));
}

static int formula_evaluate(const struct formula *formula, const char *text, double *ret_value,
                            struct formula_fault *ret_fault)
{
    struct formula_words words = formula_words(text);
    lua_State *lua = formula->host->lua;
    int code = STATUS_OK;
    if (words.n == 0) code = formula_fail(ret_fault, text, NULL, mem_text("an expression is needed"));
    else if (!formula->environment) code = formula_fail(ret_fault, text, NULL, mem_text("not enough memory for Lua"));
    if (!code) code = formula_check_names(formula, text, &words, ret_fault);
    if (!code) code = formula_run(formula, &words, text, ret_fault);
    formula_words_done(&words);
    if (code) return code;
    code = formula_take(lua, text, ret_value, ret_fault);
    lua_pop(lua, 1);
    return code;
}

void formula_fault_done(struct formula_fault *fault)
{
    mem_free(fault->said);
    mem_free(fault->help);
}

int formula_value(struct formula *formula, const char *text, double *ret_value, struct formula_fault *ret_fault)
{
    struct formula_fault fault = {0};
    double value;
    int code = formula_evaluate(formula, text, &value, &fault);
    if (!code) *ret_value = value;
    else
        status_fail(code, "'%s', character %zu: %s%s%s", text, fault.at + 1, fault.said, fault.help ? "; " : "",
                    fault.help ? fault.help : "");
    if (ret_fault) *ret_fault = fault;
    else formula_fault_done(&fault);
    return code;
}
