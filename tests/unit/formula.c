/* formula.c - expressions over columns: values, what is refused and where; and the tables they come from. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/status.h"
#include "case/formula.h"
#include "case/script_host.h"
#include "case/table.h"

static const double t[] = {0, 1, 2, 4}, V[] = {8, 2, 4, 6}, p[] = {-1, 3, -5, 2}, bad[] = {1, NAN, 2, 3};
static const double tp[] = {0, 0.5, 4}, wall[] = {10, 20, 30};

static struct script_host *host;
static struct formula *run, *plan;

static void add(const char *name, size_t n, const double *times, const double *values)
{
    formula_add(run, name, &(struct trace){n, times, values});
    formula_plan(plan, name);
}

static int make_columns(void **state)
{
    (void)state;
    host = script_host_new();
    script_set_number(host, "R0", 0.5);
    script_set_number(host, "mean_V", 2.0);
    script_set_number(host, "exp", 3.0); /* a parameter goes before a function */
    run = formula_new(host, false);
    plan = formula_new(host, true);
    add("t", 4, t, t);
    add("V", 4, t, V);
    add("p", 4, t, p);
    add("bad", 4, t, bad);
    add("none", 0, t, V);
    add("wall.pressure", 3, tp, wall);
    add("wall.velocity_x", 3, tp, wall);
    add("p.density", 4, t, V); /* a probe that is called like a column */
    return 0;
}

static int free_columns(void **state)
{
    (void)state;
    formula_free(plan);
    formula_free(run);
    script_host_free(host);
    return 0;
}

static void test_values(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double value;
    } cases[] = {
        {"1 + 2 * 3 - 4 / 8", 6.5},
        {"-2^2", -4},
        {"2^3^2", 512},
        {"2^-1", 0.5},
        {"(1 + 2) * -(3)", -9},
        {"1e-3 * 2.5E2", 0.25},
        {"min(V)", 2},
        {"max(V)/first(V)", 1},
        {"last(V) - min(V)", 4},
        {"argmin(V)", 1},
        {"argmax(p)", 1},
        {"dip_time(V) - peak_time(-V)", 0},
        {"dip_time(V)", 1.25},
        {"peak_time(V) + dip_time(between(V, 1, 4))", 1}, /* ends of columns */
        {"dip_time((t - 3)^2)", 3},                       /* rows 1 and 2 apart */
        {"zero_time(V - 5)", 0.5},
        {"zero_time(V - 5, 2)", 3},
        {"max(abs(p))", 5},
        {"mean(V)", (5 * 1 + 3 * 1 + 5 * 2) / 4.0},
        {"at(V, 3)", 5},
        {"at(V, 0)", 8},
        {"at(V, argmin(V) + 0.5)", 3},
        {"max(between(V, 0.5, 3))", 4},
        {"argmax(between(V, 0.5, 4))", 4},
        {"max(V * p + 1)", 13},
        {"min(2 * V / p)", -16},
        {"max(-p)", 5},
        {"min(V)/R0", 4},
        {"sqrt(16) + math.exp(0) + log(1) + exp", 8},
        {"max(sqrt(V)) ^ 2", 8},
        {"max(wall.pressure) - at(wall.pressure, 0.25)", 15},
        {"last(t)", 4},
        {"2*pi", 6.283185307179586},
        {"math.pi - pi", 0},
        {"min(3, 2) + max(1, 7, 5) + math.min(V)", 11},
        {"max(p.density) + max(p)", 11},
        {"(V and 1 or 2) -- a comment", 1},
        {"max(math.sin(V)) - math.max(math.sin(2), math.sin(4), math.sin(6), math.sin(8))", 0},
        {"max(V // 3) + max(V % 5)", 6},
        {"last(math.atan(V, 2)) - math.atan(3)", 0},
        {"log(8, 2) + abs(-R0) + mean_V", 5.5},
        {"min(V) < 3 and max(V) or 0", 8},
        {"at(wall.pressure,\n 0.25)", 15},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = NAN;
        if (formula_value(run, cases[i].text, &value, NULL)) fail_msg("%s: %s", cases[i].text, status_text());
        if (!(fabs(value - cases[i].value) <= 1e-14 * fabs(cases[i].value)))
            fail_msg("%s = %.17g, wanted %.17g", cases[i].text, value, cases[i].value);
        if (formula_value(plan, cases[i].text, &value, NULL)) fail_msg("planned: %s", status_text());
    }
}

static void test_nan_is_never_skipped(void **state)
{
    (void)state;
    double value = 0;
    assert_int_equal(formula_value(run, "max(bad)", &value, NULL), STATUS_OK);
    assert_true(isnan(value));
    assert_int_equal(formula_value(run, "min(abs(bad))", &value, NULL), STATUS_OK);
    assert_true(isnan(value));
    assert_int_equal(formula_value(run, "zero_time(bad)", &value, NULL), STATUS_OK);
    assert_true(isnan(value));
}

/* Refused when it is checked, and again over a run: the part of the text that is wrong, and a piece of the message. */
static void test_refusals(void **state)
{
    (void)state;
    static const struct {
        const char *text, *part, *message;
    } cases[] = {
        {"min(walls.pressure)", "walls", "no column, probe or parameter 'walls'"},
        {"2 * minn(V)", "minn", "no function 'minn'; did you mean 'min'? known are min max first"},
        {"max(wall.presure)", "wall.presure", "did you mean 'wall.pressure'"},
        {"3 * quux", "quux", "no column, probe or parameter 'quux'; known are t V p"},
        {"1 and nope or 3", "nope", "'nope'"},
        {"max(VV) + 1", "VV", "did you mean 'V'"},
        {"max(V) + wall", "wall", "'wall' is a probe; which of its fields, as in 'wall.pressure'"},
        {"max(V.pressure)", "V.pressure", "no column, probe or parameter 'V.pressure'"},
        {"V", "V", "reduce it"},
        {"V + 1", "V + 1", "reduce it"},
        {"V > 1 and 2 or 3", "1", "attempt to compare number with column"},
        {"min(V) > 1", "min(V) > 1", "the value is a boolean"},
        {"'4'", "'4'", "the value is a string"},
        {"1 +", "+", "unexpected symbol near <eof>"},
        {"", "", "an expression is needed"},
        {" -- nothing", " -- nothing", "an expression is needed"},
        {"(1 + 2", "2", "')' expected"},
        {"min(V", "V", "')' expected"},
        {"1) + (2", ")", "near ')'"},
        {"1 2", "2", "near '2'"},
        {"1, 2", ",", "near ','"},
        {"min(1)", "min", "min: a column of the run is needed, not a number"},
        {"max(V) + min(V, p)", "min", "min takes one column, or numbers"},
        {"min(1, V)", "min", "a number is needed as argument 2, not a column"},
        {"min()", "min", "min takes one column, or numbers"},
        {"first(R0)", "first", "first: a column of the run is needed, not a number"},
        {"first(first(V)) + first(V)", "first", "first: a column of the run is needed, not a number"},
        {"last(V) - at(V)", "at", "at takes a column and a time"},
        {"at(1, V)", "at", "at: a column of the run is needed, not a number"},
        {"at(V, V)", "at", "at: a time is needed as argument 2, not a column"},
        {"2 * zero_time(V, 1, 2)", "zero_time", "zero_time takes a column, and which of its passages through 0"},
        {"zero_time(V - 5, V)", "zero_time", "which passage is needed as argument 2, not a column"},
        {"zero_time(V - 5, 0)", "zero_time", "passages are counted from 1, not from 0.0"},
        {"max(between(V, 1))", "between", "between takes a column and two times"},
        {"max(V) + abs(nil)", "abs", "a number or a column is needed as argument 1, not a nil"},
        {"abs()", "abs", "abs takes a number or a column"},
        {"max(V + 'x')", "+", "a column and a string cannot be combined"},
        {"math.sgrt(2)", "math", "field 'sgrt'"},
        {"R0(3)", "R0", "attempt to call a number value (global 'R0')"},
        {"V(1)", "V", "attempt to call a column value (global 'V')"},
        {"(function() V = 1 end)()", "1", "a global ('V') cannot be written here"},
        {"(function() while true do end end)()", "do", "ran for too long"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int planned = 0; planned < 2; planned++) {
            struct formula_fault fault;
            double value = 42;
            assert_int_equal(formula_value(planned ? plan : run, cases[i].text, &value, &fault), STATUS_CASE);
            if (!strstr(status_text(), cases[i].message)) fail_msg("%s: %s", cases[i].text, status_text());
            if (fault.length != strlen(cases[i].part) ||
                strncmp(cases[i].text + fault.at, cases[i].part, fault.length) != 0)
                fail_msg("%s: '%.*s', %s", cases[i].text, (int)fault.length, cases[i].text + fault.at, status_text());
            assert_true(value == 42);
            formula_fault_done(&fault);
        }
    char deep[2000];
    memset(deep, '(', sizeof deep - 1);
    deep[sizeof deep - 1] = '\0';
    double value;
    assert_int_equal(formula_value(run, deep, &value, NULL), STATUS_CASE);
    assert_non_null(strstr(status_text(), "overflow"));
}

/* What only a run can tell: no reason to refuse a case. */
static void test_faults_of_a_run(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"at(V, 5)", "character 1: at: the run has no such time: 5.0 is outside of 0.0 to 4.0"},
        {"1 + max(between(V, 2.5, 3))", "character 9: between: no rows in that time span, 2.5 to 3.0"},
        {"max(none)", "character 1: the run wrote no rows of 'none'"},
        {"zero_time(V - 5, 3)", "zero_time: the column passes through 0 2 times from 0.0 to 4.0, not 3.0 times"},
        {"1 - max(none + 1)", "character 14: the run wrote no rows of 'none'"},
        {"max(V * wall.pressure)", "character 7: these columns have different rows"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = 42;
        assert_int_equal(formula_value(run, cases[i].text, &value, NULL), STATUS_CASE);
        if (!strstr(status_text(), cases[i].message)) fail_msg("%s: %s", cases[i].text, status_text());
        assert_int_equal(formula_value(plan, cases[i].text, &value, NULL), STATUS_OK);
    }
    double value;
    assert_int_equal(formula_value(run, "min(V)/0", &value, NULL), STATUS_OK);
    assert_true(isinf(value));
    assert_int_equal(formula_value(run, "0/0 * max(V)", &value, NULL), STATUS_OK);
    assert_true(isnan(value));
}

/* Rows may take more memory and time than scripts have by themselves. */
static void test_long_columns(void **state)
{
    (void)state;
    enum { ROWS = 2000000 };
    double *rows = malloc(ROWS * sizeof *rows), value;
    assert_non_null(rows);
    for (int i = 0; i < ROWS; i++) rows[i] = i;
    struct formula *big = formula_new(host, false);
    formula_add(big, "x", &(struct trace){ROWS, rows, rows});
    const char *text =
        "max(((x + 1) + ((x + 2) + ((x + 3) + ((x + 4) + ((x + 5) + (x + 6)))))) - 6 * x) + last(sqrt(x^2))";
    if (formula_value(big, text, &value, NULL)) fail_msg("%s", status_text());
    assert_true(value == 21 + ROWS - 1);
    formula_free(big);
    free(rows);
}

static void read_text(const char *text, enum table_kind kind, int code, struct table *table)
{
    char path[] = "/tmp/bulla-table-XXXXXX";
    int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, text, strlen(text)), strlen(text));
    close(fd);
    int got = table_read(path, kind, table);
    unlink(path);
    assert_int_equal(got, code);
}

static void test_tables(void **state)
{
    (void)state;
    struct table table;
    read_text("# R06\n# columns: x, rho, p at the wall[Pa], T (nan: no cv), t/tc\n0,1,2,nan,3\n1,4,5,nan,6\n",
              TABLE_OF_RUN, STATUS_OK, &table);
    assert_int_equal(table.n_row, 2);
    assert_int_equal(table.n_column, 5);
    assert_true(table_column(&table, "p")[1] == 5);
    assert_true(isnan(table_column(&table, "T")[0]));
    assert_true(table_column(&table, "t/tc")[1] == 6);
    assert_null(table_column(&table, "nope"));
    table_done(&table);
    read_text("step,t,V\n0,0,1.5\n1,0.25,-2e3\n2,0.", TABLE_OF_RUN, STATUS_OK, &table); /* killed while writing */
    assert_int_equal(table.n_row, 2);
    assert_true(table_column(&table, "V")[1] == -2000);
    table_done(&table);
    read_text("step,t,V\n0,0.5,77\n1,0.6", TABLE_OF_RUN, STATUS_OK, &table); /* and as long as the row before */
    assert_int_equal(table.n_row, 1);
    table_done(&table);
    read_text("t,V\n0,0.5\n1,0.625", TABLE_OF_RUN, STATUS_OK, &table); /* more digits were to come */
    assert_int_equal(table.n_row, 1);
    table_done(&table);
    read_text("t,V\n0,0.5\n1,0.625", TABLE_GIVEN, STATUS_OK, &table); /* an editor that ends no last line */
    assert_int_equal(table.n_row, 2);
    assert_int_equal(table.lines[1], 3);
    table_done(&table);
    read_text("t,p,V\n0,0.5,1\n1,0.6", TABLE_GIVEN, STATUS_RUN, &table);
    assert_non_null(strstr(status_text(), ":3: not a row of 3 numbers"));
    read_text("step,t,V\n", TABLE_OF_RUN, STATUS_OK, &table);
    assert_int_equal(table.n_row, 0);
    table_done(&table);
    read_text("x,y\n0,1\n0,oops\n1,2\n", TABLE_GIVEN, STATUS_RUN, &table);
    assert_non_null(strstr(status_text(), ":3:"));
    read_text("1,2\n", TABLE_GIVEN, STATUS_RUN, &table);
    read_text("", TABLE_GIVEN, STATUS_RUN, &table);
}

/* A file that is no text, or one endless line, is no reason to take all memory. */
static void test_no_text(void **state)
{
    (void)state;
    struct table table;
    char path[] = "/tmp/bulla-table-XXXXXX";
    int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(ftruncate(fd, (off_t)20 << 30), 0);
    assert_int_equal(table_read(path, TABLE_GIVEN, &table), STATUS_RUN);
    assert_non_null(strstr(status_text(), ":1: "));
    assert_int_equal(ftruncate(fd, 0), 0);
    char *line = malloc(2 << 20);
    assert_non_null(line);
    memset(line, '1', 2 << 20);
    assert_int_equal(pwrite(fd, line, 2 << 20, 0), 2 << 20);
    assert_int_equal(table_read(path, TABLE_GIVEN, &table), STATUS_RUN);
    assert_non_null(strstr(status_text(), "longer than"));
    free(line);
    close(fd);
    unlink(path);
}

static void test_interpolation(void **state)
{
    (void)state;
    const double x[] = {0, 1, 1, 3}, y[] = {0, 2, 4, 0}; /* a jump at 1 */
    assert_true(table_interpolate(4, x, y, 0.5) == 1);
    assert_true(table_interpolate(4, x, y, 2) == 2);
    assert_true(table_interpolate(4, x, y, -1) == 0 && table_interpolate(4, x, y, 9) == 0);
    assert_true(fabs(table_average(4, x, y, 0, 3) - 5.0 / 3) < 1e-15);
    assert_true(fabs(table_average(4, x, y, 0.5, 2) - (0.75 + 3) / 1.5) < 1e-15);
    assert_true(fabs(table_average(4, x, y, 1.5, 2) - 2.5) < 1e-15);
    assert_true(fabs(table_average(4, x, y, 0.5, 1) - 1.5) < 1e-15); /* the jump lies on an edge */
    assert_true(fabs(table_average(4, x, y, 1, 2) - 3) < 1e-15);
    assert_true(table_average(4, x, y, -2, -1) == 0 && table_average(4, x, y, 4, 5) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_long_columns), /* first: after an endless script all others have less time */
        cmocka_unit_test(test_values),        cmocka_unit_test(test_nan_is_never_skipped),
        cmocka_unit_test(test_refusals),      cmocka_unit_test(test_faults_of_a_run),
        cmocka_unit_test(test_tables),        cmocka_unit_test(test_no_text),
        cmocka_unit_test(test_interpolation),
    };
    return cmocka_run_group_tests(tests, make_columns, free_columns);
}
