/* formula.h - expressions over columns of a run: "min(V)/first(V)", "argmin(R)/t_c".
 *
 * Numbers, + - * / ^, parentheses, columns (`V`, `wall.pressure`; `t` is the time of the
 * history), numbers of the case (its parameters), pi, and functions:
 *     of a column to a number   min max first last mean (over time) argmin argmax (the time of it)
 *                               at(column, time) (straight lines between rows)
 *     of a column to a column   between(column, from, to): the rows with from <= t <= to
 *     of numbers or columns     abs sqrt exp log
 * Arithmetic of columns goes row by row; both must have the same rows. */
#ifndef FORMULA_H
#define FORMULA_H

#include <stdbool.h>
#include <stddef.h>

/* One column over time. */
struct trace {
    size_t n;
    const double *t, *v; /* [n] */
};

/* Where names come from. */
struct formula_names {
    void *context;
    bool (*column)(void *context, const char *name, struct trace *ret_trace);
    bool (*number)(void *context, const char *name, double *ret_value);
    const char *const *known; /* NULL-terminated: columns and parameters, for suggestions */
};

/* The value of an expression that yields a number. STATUS_CASE: the message says what is wrong
 * at which character, with a suggestion for unknown names. */
int formula_evaluate(const char *text, const struct formula_names *names, double *ret_value);

/* Would it be an expression for a run that is only planned? Columns may have any rows; times in at and between are
 * not looked at. */
int formula_check(const char *text, const struct formula_names *names);

#endif
