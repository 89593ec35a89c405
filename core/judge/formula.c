/* formula.c - see formula.h. A recursive descent over the text that computes as it goes: an
 * expression is read once per run, so there is nothing to compile. Every intermediate column
 * is noted in the parser and freed at the end, whichever way it ends. */
#include "judge/formula.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/table.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { FORMULA_DEPTH = 64, FORMULA_NAME = 128, FORMULA_ARGUMENTS = 3 };

struct formula_value {
    bool is_column;
    double number;
    struct trace column;
};

struct formula {
    const char *text, *at;
    const struct formula_names *names;
    bool planned; /* there are no rows yet: times are taken as they are */
    int depth;
    void **blocks; /* intermediate columns */
    size_t n_block;
};

static int formula_sum(struct formula *f, struct formula_value *ret);

static int formula_fail(const struct formula *f, const char *at, const char *what, const char *word)
{
    return status_fail(STATUS_CASE, "'%s', character %td: %s%s%s%s", f->text, at - f->text + 1, what, word ? " '" : "",
                       word ? word : "", word ? "'" : "");
}

static double *formula_block(struct formula *f, size_t n)
{
    double *block = mem_new(n + 1, sizeof *block);
    f->blocks = mem_grow(f->blocks, f->n_block, f->n_block + 1, sizeof *f->blocks);
    f->blocks[f->n_block++] = block;
    return block;
}

static bool formula_take(struct formula *f, char c)
{
    f->at += strspn(f->at, " \t\n");
    if (*f->at != c) return false;
    f->at++;
    return true;
}

/* An identifier, or two with a dot between (probe.field). Returns its length. */
static size_t formula_word(struct formula *f, char word[FORMULA_NAME])
{
    size_t n = 0;
    f->at += strspn(f->at, " \t\n");
    if (!isalpha((unsigned char)*f->at) && *f->at != '_') return 0;
    while (n + 1 < FORMULA_NAME && (isalnum((unsigned char)f->at[n]) || f->at[n] == '_' || f->at[n] == '.')) n++;
    memcpy(word, f->at, n);
    word[n] = '\0';
    f->at += n;
    return n;
}

static double formula_apply(char operator, double a, double b)
{
    switch (operator) {
    case '+': return a + b;
    case '-': return a - b;
    case '*': return a * b;
    case '/': return a / b;
    default: return pow(a, b);
    }
}

static int formula_combine(struct formula *f, char operator, struct formula_value * a, const struct formula_value *b)
{
    if (!a->is_column && !b->is_column) {
        a->number = formula_apply(operator, a->number, b->number);
        return STATUS_OK;
    }
    const struct trace *rows = a->is_column ? &a->column : &b->column;
    if (a->is_column && b->is_column &&
        (a->column.n != b->column.n || a->column.t[0] != b->column.t[0] ||
         a->column.t[a->column.n - 1] != b->column.t[b->column.n - 1]))
        return formula_fail(f, f->at, "these columns have different rows; reduce them to numbers first", NULL);
    double *v = formula_block(f, rows->n);
    for (size_t i = 0; i < rows->n; i++)
        v[i] = formula_apply(operator, a->is_column ? a->column.v[i] : a->number,
                             b->is_column ? b->column.v[i] : b->number);
    *a = (struct formula_value){.is_column = true, .column = {rows->n, rows->t, v}};
    return STATUS_OK;
}

static size_t formula_extreme(const struct trace *c, double sign)
{
    size_t best = 0;
    for (size_t i = 1; i < c->n; i++)
        if (sign * c->v[i] > sign * c->v[best]) best = i;
    return best;
}

/* Average over time; of the rows if no time passes. */
static double formula_mean(const struct trace *c)
{
    if (c->n == 1 || c->t[c->n - 1] <= c->t[0]) return c->v[0];
    return table_average(c->n, c->t, c->v, c->t[0], c->t[c->n - 1]);
}

/* A value that is not a number anywhere must reach the result: min and max would skip it. */
static bool formula_has_nan(const struct trace *c)
{
    for (size_t i = 0; i < c->n; i++)
        if (isnan(c->v[i])) return true;
    return false;
}

static bool formula_reduce(const char *name, const struct trace *c, double *ret)
{
    double value;
    if (strcmp(name, "min") == 0) value = c->v[formula_extreme(c, -1)];
    else if (strcmp(name, "max") == 0) value = c->v[formula_extreme(c, 1)];
    else if (strcmp(name, "argmin") == 0) value = c->t[formula_extreme(c, -1)];
    else if (strcmp(name, "argmax") == 0) value = c->t[formula_extreme(c, 1)];
    else if (strcmp(name, "first") == 0) value = c->v[0];
    else if (strcmp(name, "last") == 0) value = c->v[c->n - 1];
    else if (strcmp(name, "mean") == 0) value = formula_mean(c);
    else return false;
    *ret = formula_has_nan(c) ? NAN : value;
    return true;
}

static bool formula_pointwise(const char *name, double (**ret_function)(double))
{
    static const struct {
        const char *name;
        double (*function)(double);
    } functions[] = {{"abs", fabs}, {"sqrt", sqrt}, {"exp", exp}, {"log", log}};
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (strcmp(functions[i].name, name) == 0) {
            *ret_function = functions[i].function;
            return true;
        }
    return false;
}

static void formula_map(struct formula *f, double (*function)(double), struct formula_value *value)
{
    value->number = function(value->number);
    if (!value->is_column) return;
    double *v = formula_block(f, value->column.n);
    for (size_t i = 0; i < value->column.n; i++) v[i] = function(value->column.v[i]);
    value->column.v = v;
}

/* The rows with from <= t <= to, without a copy: rows ascend in time. */
static int formula_between(struct formula *f, struct trace *c, double from, double to)
{
    size_t first = 0, end = c->n;
    if (f->planned) return STATUS_OK;
    while (first < end && c->t[first] < from) first++;
    while (end > first && c->t[end - 1] > to) end--;
    if (first == end) return formula_fail(f, f->at, "no rows in that time span", NULL);
    *c = (struct trace){end - first, c->t + first, c->v + first};
    return STATUS_OK;
}

static int formula_arguments(struct formula *f, struct formula_value *arguments, unsigned *ret_count)
{
    unsigned n = 0;
    do {
        if (n == FORMULA_ARGUMENTS) return formula_fail(f, f->at, "too many arguments", NULL);
        TRY(formula_sum(f, &arguments[n++]));
    } while (formula_take(f, ','));
    if (!formula_take(f, ')')) return formula_fail(f, f->at, "')' expected", NULL);
    *ret_count = n;
    return STATUS_OK;
}

static int formula_unknown_function(const struct formula *f, const char *at, const char *name)
{
    static const char *const functions[] = {"min", "max", "first",   "last", "mean", "argmin", "argmax",
                                            "at",  "abs", "between", "sqrt", "exp",  "log",    NULL};
    const char *near = text_nearest(name, functions);
    char what[2 * FORMULA_NAME + 64];
    snprintf(what, sizeof what,
             "no function '%s'%s%s%s; there are min max first last mean argmin argmax at between abs "
             "sqrt exp log",
             name, near ? "; did you mean '" : "", near ? near : "", near ? "'?" : "");
    return formula_fail(f, at, what, NULL);
}

static int formula_call(struct formula *f, const char *at, const char *name, struct formula_value *ret)
{
    struct formula_value arguments[FORMULA_ARGUMENTS] = {{0}};
    double (*function)(double), number;
    unsigned n = 0;
    TRY(formula_arguments(f, arguments, &n));
    struct trace *column = &arguments[0].column;
    bool timed = !arguments[1].is_column && !arguments[2].is_column;
    if (n == 1 && formula_pointwise(name, &function)) {
        formula_map(f, function, &arguments[0]);
        *ret = arguments[0];
        return STATUS_OK;
    }
    if (arguments[0].is_column && n == 3 && timed && strcmp(name, "between") == 0) {
        TRY(formula_between(f, column, arguments[1].number, arguments[2].number));
        *ret = arguments[0];
        return STATUS_OK;
    }
    if (arguments[0].is_column && n == 1 && formula_reduce(name, column, &number)) {
        *ret = (struct formula_value){.number = number};
        return STATUS_OK;
    }
    if (arguments[0].is_column && n == 2 && timed && strcmp(name, "at") == 0) {
        bool early = arguments[1].number<column->t[0], late = arguments[1].number> column->t[column->n - 1];
        if (!f->planned && (early || late)) return formula_fail(f, at, "the run has no such time in", name);
        *ret =
            (struct formula_value){.number = table_interpolate(column->n, column->t, column->v, arguments[1].number)};
        return STATUS_OK;
    }
    struct trace probe = {1, &arguments[1].number, &arguments[1].number};
    if (formula_reduce(name, &probe, &number) || strcmp(name, "at") == 0 || strcmp(name, "between") == 0 ||
        formula_pointwise(name, &function))
        return formula_fail(f, at, "wrong arguments (a column of the run comes first) for", name);
    return formula_unknown_function(f, at, name);
}

static int formula_name(struct formula *f, const char *at, const char *name, struct formula_value *ret)
{
    *ret = (struct formula_value){0};
    if (f->names->column(f->names->context, name, &ret->column)) {
        ret->is_column = true;
        if (ret->column.n == 0) return formula_fail(f, at, "the run wrote no rows of", name);
        return STATUS_OK;
    }
    if (f->names->number(f->names->context, name, &ret->number)) return STATUS_OK;
    if (strcmp(name, "pi") == 0) {
        ret->number = 3.14159265358979323846;
        return STATUS_OK;
    }
    struct text what = {0};
    const char *near = text_nearest(name, f->names->known);
    text_add(&what, "no column or parameter '%s'", name);
    if (near) text_add(&what, "; did you mean '%s'?", near);
    text_add(&what, " There are");
    for (const char *const *known = f->names->known; *known; known++) text_add(&what, " %s", *known);
    int code = formula_fail(f, at, what.at, NULL);
    text_done(&what);
    return code;
}

static int formula_primary(struct formula *f, struct formula_value *ret)
{
    char name[FORMULA_NAME];
    *ret = (struct formula_value){0};
    if (formula_take(f, '(')) {
        TRY(formula_sum(f, ret));
        return formula_take(f, ')') ? STATUS_OK : formula_fail(f, f->at, "')' expected", NULL);
    }
    f->at += strspn(f->at, " \t\n");
    const char *at = f->at;
    if (formula_word(f, name))
        return formula_take(f, '(') ? formula_call(f, at, name, ret) : formula_name(f, at, name, ret);
    size_t length = text_number(f->at, &ret->number);
    f->at += length;
    if (length == 0) return formula_fail(f, f->at, "a number, a column or '(' expected", NULL);
    return STATUS_OK;
}

static int formula_power(struct formula *f, struct formula_value *ret)
{
    bool minus = false;
    struct formula_value exponent, zero = {0};
    if (++f->depth > FORMULA_DEPTH) return formula_fail(f, f->at, "nested too deeply", NULL);
    while (formula_take(f, '-')) minus = !minus;
    TRY(formula_primary(f, ret));
    if (formula_take(f, '^')) {
        TRY(formula_power(f, &exponent));
        TRY(formula_combine(f, '^', ret, &exponent));
    }
    if (minus) {
        TRY(formula_combine(f, '-', &zero, ret));
        *ret = zero;
    }
    f->depth--;
    return STATUS_OK;
}

static int formula_product(struct formula *f, struct formula_value *ret)
{
    struct formula_value next;
    TRY(formula_power(f, ret));
    for (;;) {
        char operator= formula_take(f, '*') ? '*' : formula_take(f, '/') ? '/' : 0;
        if (!operator) return STATUS_OK;
        TRY(formula_power(f, &next));
        TRY(formula_combine(f, operator, ret, &next));
    }
}

static int formula_sum(struct formula *f, struct formula_value *ret)
{
    struct formula_value next;
    TRY(formula_product(f, ret));
    for (;;) {
        char operator= formula_take(f, '+') ? '+' : formula_take(f, '-') ? '-' : 0;
        if (!operator) return STATUS_OK;
        TRY(formula_product(f, &next));
        TRY(formula_combine(f, operator, ret, &next));
    }
}

static int formula_read(struct formula *f, double *ret_value)
{
    struct formula_value value = {0};
    int code = formula_sum(f, &value);
    f->at += strspn(f->at, " \t\n");
    if (!code && *f->at) code = formula_fail(f, f->at, "not understood from here:", f->at);
    if (!code && value.is_column)
        code = formula_fail(f, f->text, "the value is a whole column; reduce it with min, max, last, ...", NULL);
    for (size_t i = 0; i < f->n_block; i++) mem_free(f->blocks[i]);
    mem_free(f->blocks);
    *ret_value = value.number;
    return code;
}

int formula_evaluate(const char *text, const struct formula_names *names, double *ret_value)
{
    struct formula f = {.text = text, .at = text, .names = names};
    double value;
    TRY(formula_read(&f, &value));
    *ret_value = value;
    return STATUS_OK;
}

int formula_check(const char *text, const struct formula_names *names)
{
    struct formula f = {.text = text, .at = text, .names = names, .planned = true};
    double value;
    return formula_read(&f, &value);
}
