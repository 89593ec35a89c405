/* formula.h - expressions over the columns of a run: "min(V)/first(V)", "argmin(R)/t_c".
 *
 * They are Lua, in the sandbox of script.h: what the case's parameters may use, the parameters themselves, and columns
 * (`V`, `wall.pressure`; `t` is the time of the history) with the functions of script_column.h. Where a column and a
 * parameter or function have the same name, the column is meant; a parameter goes before a function. An expression is
 * looked at before any run exists by evaluating it over columns that stand for those to come. */
#ifndef FORMULA_H
#define FORMULA_H

#include "case/script.h"
#include "case/trace.h"

struct formula; /* the columns that expressions see */

/* What is wrong with an expression, and with which part of it. */
struct formula_fault {
    size_t at, length; /* bytes of its text */
    char *said;        /* NULL: nothing is */
    char *help;        /* what would be right; or NULL */
};

/* Expressions of a host; `planned`: their columns stand for those of a run to come. The host must live as long. */
struct formula *formula_new(struct script_host *host, bool planned);
void formula_free(struct formula *formula); /* NULL is fine */

/* Adds a column; the rows must live as long as the formula, the name is copied. formula_plan: of a run to come. */
void formula_add(struct formula *formula, const char *name, const struct trace *trace);
void formula_plan(struct formula *formula, const char *name);

/* The column of that name. */
bool formula_column(const struct formula *formula, const char *name, struct trace *ret_trace);

/* The value of an expression that yields a number, finite or not. STATUS_CASE: the message says what is wrong at which
 * character, and so does `ret_fault` (NULL: it is not asked for; release it with formula_fault_done). */
int formula_value(struct formula *formula, const char *text, double *ret_value, struct formula_fault *ret_fault);

void formula_fault_done(struct formula_fault *fault);

#endif
