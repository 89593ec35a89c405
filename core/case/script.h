/* script.h - Lua 5.4, fenced in: expressions, initial conditions, boundary values.
 *
 * One host (Lua state, script_host.h) per case. Scripts see math, a few base functions and the case's
 * parameters; no files, no processes, no loading of code, no random numbers, and an order of
 * `pairs` that is always the same, so that results never depend on run or rank. Memory is
 * capped, endless loops are ended; every error carries the line of the case file.
 * Globals can be written while a chunk is loaded, and never afterwards. */
#ifndef SCRIPT_H
#define SCRIPT_H

#include <stdbool.h>
#include <stddef.h>

struct script_host; /* the Lua state and all that lives in it */
struct script;      /* a compiled expression or function; owned by its host */

enum { SCRIPT_ARGUMENTS = 16 }; /* most numbers in and out of a call */

/* Makes a number visible to all scripts as a global (a case parameter). */
void script_set_number(struct script_host *host, const char *name, double value);

/* Is there a global of that name: a number, a function, a library? */
bool script_has(struct script_host *host, const char *name);

/* Visits the names of all numbers that scripts see (parameters, pi), in no order. */
void script_numbers(struct script_host *host, void (*visit)(void *context, const char *name), void *context);

/* Evaluates an expression ("1.1 * R0") to a number at once. `file`, `line`: where its text
 * stands. Errors: STATUS_CASE. A non-finite result is an error. */
int script_evaluate(struct script_host *host, const char *text, const char *file, int line, double *ret_value);

/* Compiles an expression of the named arguments ("x,y,z,r,t"; at most SCRIPT_ARGUMENTS). `text` without the leading
 * "=". */
int script_compile(struct script_host *host, const char *text, const char *arguments, const char *file, int line,
                   const struct script **ret_script);

/* Compiles a chunk that must return a function (YAML block or the text of a .lua file). A
 * text that starts with "function(" is accepted too. */
int script_compile_function(struct script_host *host, const char *text, const char *file, int line,
                            const struct script **ret_script);

/* Does an expression mention none of its arguments (it can be replaced by a number)? False for functions. */
bool script_is_constant(const struct script *script);

/* Calls with n_in numbers; wants n_out numbers back, all finite. */
int script_call(const struct script *script, const double *in, unsigned n_in, double *out, unsigned n_out);

/* Calls at n points, one after the other: in[n_in] rows of n, out a row of n; what comes out may be infinite or not a
 * number. A result that is none at all, or an error at any point: STATUS_CASE, and `out` is NaN from there on. */
int script_row(const struct script *script, size_t n, const double *const *in, unsigned n_in, double *out);

/* Calls for a decision: true, or a number above 0. Anything that is no number, true, false or nil: STATUS_CASE. */
int script_test(const struct script *script, const double *in, unsigned n_in, bool *ret);

/* Name of a function's parameter, counted from 0; NULL: it has no more. Valid as long as the script. */
const char *script_parameter(const struct script *script, unsigned index);

#endif
