/* Reading CSV files of numbers: forms that are accepted, and one message per flaw. */
#include "case/series.h"

#include "base/mem.h"
#include "base/status.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char path[] = "/tmp/bulla-series-XXXXXX";

static int make_file(void **state)
{
    (void)state;
    int file = mkstemp(path);
    return file < 0 ? 1 : close(file);
}

static int drop_file(void **state)
{
    (void)state;
    return unlink(path);
}

static int read_text(const char *text, size_t length, struct series *ret_series)
{
    FILE *file = fopen(path, "w");
    fwrite(text, 1, length, file);
    fclose(file);
    return series_read(path, ret_series);
}

static struct series good(const char *text)
{
    struct series series;
    if (read_text(text, strlen(text), &series)) fail_msg("%s", status_text());
    return series;
}

static const double *column(const struct series *series, const char *name)
{
    const double *values = NULL;
    if (series_column(series, name, &values)) fail_msg("%s", status_text());
    return values;
}

static void reads_forms(void **state)
{
    (void)state;
    struct series series = good("# measured\n\n t , p\n0,1\n  1e-6, -2.5e3 \r\n");
    assert_int_equal(series.n_row, 2);
    assert_true(column(&series, "t")[1] == 1e-6 && column(&series, "p")[1] == -2500.0 &&
                column(&series, "2")[0] == 1.0);
    assert_int_equal(series.lines[1], 5);
    series_done(&series);
    series = good("1 2\t3\n4  5 6");
    assert_true(series.n_column == 3 && series.n_row == 2 && column(&series, "3")[1] == 6.0 && !series.names);
    series_done(&series);
    series = good("\xef\xbb\xbf\"t\";\"p\"\n0;1\n");
    assert_true(column(&series, "p")[0] == 1.0);
    series_done(&series);
    series = good("# columns: t/tc, p[Pa], R (cells)\n1,2,3\n");
    assert_true(column(&series, "t/tc")[0] == 1.0 && column(&series, "p")[0] == 2.0 && column(&series, "R")[0] == 3.0);
    series_done(&series);
    series = good("# columns: a, b, c\n1,2\n");
    assert_true(!series.names && column(&series, "2")[0] == 2.0);
    series_done(&series);
    series = good("7\n");
    assert_true(series.n_column == 1 && column(&series, "1")[0] == 7.0);
    series_done(&series);
    series_done(&(struct series){0});
}

/* What stands in brackets behind a name is a unit, and the name is found without it. */
static void knows_units(void **state)
{
    (void)state;
    static const char *const forms[] = {"t[us],p [MPa]\n1,2\n", "t [us]\tp (MPa)\n1 2\n",
                                        "# columns: t [us], p[MPa]\n1,2\n", "\"t (us)\";\"p [MPa]\"\n1;2\n"};
    for (unsigned i = 0; i < sizeof forms / sizeof *forms; i++) {
        struct series series = good(forms[i]);
        assert_int_equal(series.n_column, 2);
        assert_string_equal(series.units[0], "us");
        assert_string_equal(series.units[1], "MPa");
        assert_true(column(&series, "t")[0] == 1.0 && column(&series, "p")[0] == 2.0);
        series_done(&series);
    }
    struct series series = good("t_us,p [MPa],p\n1,2,3\n");
    assert_true(!series.units[0] && column(&series, "p")[0] == 3.0 && column(&series, "p [MPa]")[0] == 2.0);
    series_done(&series);
}

static void grows(void **state)
{
    (void)state;
    FILE *file = fopen(path, "w");
    for (int i = 0; i < 5000; i++) fprintf(file, "%d,%d\n", i, 2 * i);
    fclose(file);
    struct series series;
    assert_int_equal(series_read(path, &series), 0);
    const double *twice = column(&series, "2");
    for (int i = 0; i < 5000; i++) assert_true(twice[i] == 2.0 * i && series.lines[i] == (unsigned)i + 1);
    assert_int_equal(series_ascending(&series, "1"), 0);
    series_done(&series);
}

static void refuses(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {
        {"t,p\n0,1\n1,x\n", ":3: column 2: 'x' is not a number"},
        {"0,1\n1,\n", ":2: column 2: '' is not a number"},
        {"0,1\n1\n", ":2: fewer than 2 columns"},
        {"0,1\n1,2,3\n", ":2: more than 2 columns"},
        {"0,1\n1,2,\n", ":2: more than 2 columns"},
        {"0;1,5\n", ":1: column 2: '1,5' is not a number (the decimal point is '.')"},
        {"0,1\n1,nan\n", "'nan' is not a number"},
        {"0,1\n1,1e999\n", "'1e999' is not a number"},
        {"0,1\n1,2 # no\n", "'2 # no' is not a number"},
        {"1,two\n", ":1: column 2: 'two' is not a number"},
        {"", ":0: no numbers in this file"},
        {"# only\n", ":1: no numbers"},
        {"t,p\n", ":1: no numbers"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct series series;
        if (read_text(wrong[i][0], strlen(wrong[i][0]), &series) != STATUS_CASE) fail_msg("accepted: %s", wrong[i][0]);
        if (strncmp(status_text(), path, strlen(path)) != 0 || !strstr(status_text(), wrong[i][1]))
            fail_msg("'%s', wanted '%s'", status_text(), wrong[i][1]);
    }
    struct series series;
    assert_int_equal(read_text("1,2\n3\0,4\n", 9, &series), STATUS_CASE);
    assert_non_null(strstr(status_text(), ":2: not a text file"));
    assert_int_equal(read_text("1,2\n3\0,4", 8, &series), STATUS_CASE);
    assert_non_null(strstr(status_text(), ":2: not a text file"));
    char *endless = mem_new(70000, 1);
    memset(endless, '1', 69999);
    assert_int_equal(read_text(endless, 69999, &series), STATUS_CASE);
    assert_non_null(strstr(status_text(), ":1: the line is longer than 65535 bytes"));
    mem_free(endless);
    assert_int_equal(series_read("/dev/zero", &series), STATUS_CASE);
    assert_non_null(strstr(status_text(), "/dev/zero: it is a pipe or a device"));
    assert_int_equal(series_read("/nowhere/p.csv", &series), STATUS_CASE);
    assert_non_null(strstr(status_text(), "/nowhere/p.csv: No such file"));
    assert_int_equal(series_read("/tmp", &series), STATUS_CASE);
}

static void names_columns(void **state)
{
    (void)state;
    struct series series = good("t,p\n0,1\n0,2\n");
    const double *values;
    assert_int_equal(series_column(&series, "q", &values), STATUS_CASE);
    assert_non_null(strstr(status_text(), "no column 'q'; there are 1 (t), 2 (p)"));
    assert_int_equal(series_column(&series, "3", &values), STATUS_CASE);
    assert_int_equal(series_column(&series, "0", &values), STATUS_CASE);
    assert_int_equal(series_ascending(&series, "t"), STATUS_CASE);
    assert_non_null(strstr(status_text(), ":3: column 't' must ascend, but 0 comes after 0"));
    assert_int_equal(series_ascending(&series, "p"), 0);
    series_done(&series);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_forms), cmocka_unit_test(knows_units),   cmocka_unit_test(grows),
        cmocka_unit_test(refuses),     cmocka_unit_test(names_columns),
    };
    return cmocka_run_group_tests(tests, make_file, drop_file);
}
