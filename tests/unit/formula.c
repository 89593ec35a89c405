/* formula.c - expressions over columns, and the tables they come from. */
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
#include "case/table.h"
#include "judge/formula.h"

static const double t[] = {0, 1, 2, 4}, V[] = {8, 2, 4, 6}, p[] = {-1, 3, -5, 2}, bad[] = {1, NAN, 2, 3};
static const double tp[] = {0, 0.5, 4}, wall[] = {10, 20, 30};

static bool column(void *context, const char *name, struct trace *ret)
{
    (void)context;
    if (strcmp(name, "t") == 0) *ret = (struct trace){4, t, t};
    else if (strcmp(name, "V") == 0) *ret = (struct trace){4, t, V};
    else if (strcmp(name, "p") == 0) *ret = (struct trace){4, t, p};
    else if (strcmp(name, "bad") == 0) *ret = (struct trace){4, t, bad};
    else if (strcmp(name, "none") == 0) *ret = (struct trace){0, t, V};
    else if (strcmp(name, "wall.pressure") == 0) *ret = (struct trace){3, tp, wall};
    else return false;
    return true;
}

static bool number(void *context, const char *name, double *ret)
{
    (void)context;
    if (strcmp(name, "R0") != 0) return false;
    *ret = 0.5;
    return true;
}

static const char *const known[] = {"t", "V", "p", "bad", "none", "wall.pressure", "R0", NULL};
static const struct formula_names names = {NULL, column, number, known};

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
        {"sqrt(16) + exp(0) + log(1)", 5},
        {"max(sqrt(V)) ^ 2", 8},
        {"max(wall.pressure) - at(wall.pressure, 0.25)", 15},
        {"last(t)", 4},
        {"2*pi", 6.283185307179586},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = NAN;
        if (formula_evaluate(cases[i].text, &names, &value)) fail_msg("%s: %s", cases[i].text, status_text());
        if (!(fabs(value - cases[i].value) <= 1e-14 * fabs(cases[i].value)))
            fail_msg("%s = %.17g, wanted %.17g", cases[i].text, value, cases[i].value);
    }
}

static void test_nan_is_never_skipped(void **state)
{
    (void)state;
    double value = 0;
    assert_int_equal(formula_evaluate("max(bad)", &names, &value), STATUS_OK);
    assert_true(isnan(value));
    assert_int_equal(formula_evaluate("min(abs(bad))", &names, &value), STATUS_OK);
    assert_true(isnan(value));
}

static void test_refusals(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"min(walls.pressure)", "did you mean 'wall.pressure'"},
        {"minn(V)", "did you mean 'min'"},
        {"max(wall.presure)", "did you mean 'wall.pressure'"},
        {"V", "reduce it"},
        {"V + 1", "reduce it"},
        {"1 +", "expected"},
        {"", "expected"},
        {"(1 + 2", "')' expected"},
        {"min(V", "')' expected"},
        {"1 2", "not understood"},
        {"min(1)", "wrong arguments"},
        {"min(V, p)", "wrong arguments"},
        {"at(V)", "wrong arguments"},
        {"at(1, V)", "wrong arguments"},
        {"at(V, 5)", "no such time"},
        {"max(between(V, 2.5, 3))", "no rows"},
        {"max(none)", "no rows"},
        {"max(V * wall.pressure)", "different rows"},
        {"abs(1, 2, 3, 4)", "too many"},
        {"3 * nope", "no column or parameter 'nope'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = 42;
        assert_int_equal(formula_evaluate(cases[i].text, &names, &value), STATUS_CASE);
        if (!strstr(status_text(), cases[i].message)) fail_msg("%s: %s", cases[i].text, status_text());
        assert_true(value == 42);
    }
    char deep[2000];
    memset(deep, '(', sizeof deep - 1);
    deep[sizeof deep - 1] = '\0';
    double value;
    assert_int_equal(formula_evaluate(deep, &names, &value), STATUS_CASE);
    assert_non_null(strstr(status_text(), "deep"));
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
        cmocka_unit_test(test_values),   cmocka_unit_test(test_nan_is_never_skipped),
        cmocka_unit_test(test_refusals), cmocka_unit_test(test_tables),
        cmocka_unit_test(test_no_text),  cmocka_unit_test(test_interpolation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
