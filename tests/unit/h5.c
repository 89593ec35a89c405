/* h5.c - HDF5 through checked calls: what is written is read back, and failures say which file and why. */
#include "io/h5.h"

#include "base/mem.h"
#include "base/status.h"
#include "io/h5in.h"
#include "io/h5out.h"
#include "io/h5view.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char path[64];

static int start(void **state)
{
    (void)state;
    strcpy(path, "/tmp/bulla-h5-XXXXXX");
    int id = mkstemp(path);
    return id < 0 ? -1 : close(id);
}

static int stop(void **state)
{
    (void)state;
    return remove(path);
}

/* Row r, column c holds 10 r + c. */
static void fill(void *context, size_t first, size_t count, void *out)
{
    size_t *calls = context, columns = 3;
    float *values = out;
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < columns; c++) values[i * columns + c] = (float)(10 * (first + i) + c);
    ++*calls;
}

static void test_rows(void **state)
{
    (void)state;
    struct h5 *file;
    size_t calls = 0, n = 200003, rows = 0;
    unsigned columns = 0;
    const struct h5out_range halves[2] = {{0, 1000}, {1000, n - 1000}};
    struct h5out_rows table = {.type = H5_F32,
                               .columns = 3,
                               .total = n,
                               .chunk = 4096,
                               .n_range = 2,
                               .ranges = halves,
                               .fill = fill,
                               .context = &calls};
    assert_int_equal(h5_create(path, &file), 0);
    h5_group(file, "/part");
    assert_int_equal(h5out_write(file, "/part/table", &table), 0);
    h5out_unit(file, "/part/table", "m/s");
    assert_int_equal(h5_close(file), 0);
    assert_true(calls > 1); /* in runs, not at once */
    double *values = mem_new(3 * n, sizeof *values);
    char *unit;
    assert_int_equal(h5_open(path, &file), 0);
    assert_true(h5in_has(file, "/part/table"));
    assert_false(h5in_has(file, "/part/chair"));
    assert_false(h5in_has(file, "/nowhere/table"));
    assert_int_equal(h5in_shape(file, "/part/table", &rows, &columns), 0);
    assert_int_equal(rows, n);
    assert_int_equal(columns, 3);
    assert_int_equal(h5in_read(file, "/part/table", values), 0);
    for (size_t i = 0; i < 3 * n; i++)
        if (values[i] != (double)(float)(10 * (i / 3) + i % 3))
            fail_msg("row %zu column %zu: %g", i / 3, i % 3, values[i]);
    assert_int_equal(h5in_attribute_text(file, "/part/table", "units", &unit), 0);
    assert_string_equal(unit, "m/s");
    h5_abandon(file);
    mem_free(unit);
    mem_free(values);
}

/* Bits without any order: deflate would make them longer and is left out. */
static double noise(size_t i)
{
    uint64_t x = (i + 1) * 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    x = (x ^ x >> 31) & ~(1ull << 62); /* no infinities */
    double value;
    memcpy(&value, &x, sizeof value);
    return value;
}

static void fill_noise(void *context, size_t first, size_t count, void *out)
{
    double *values = out;
    (void)context;
    for (size_t i = 0; i < count; i++) values[i] = noise(first + i);
}

static void test_noise(void **state)
{
    (void)state;
    struct h5 *file;
    size_t n = 10000;
    const struct h5out_range all = {0, n};
    struct h5out_rows table = {
        .type = H5_F64, .total = n, .chunk = 4096, .n_range = 1, .ranges = &all, .fill = fill_noise};
    double *values = mem_new(n, sizeof *values);
    assert_int_equal(h5_create(path, &file), 0);
    assert_int_equal(h5out_write(file, "/noise", &table), 0);
    assert_int_equal(h5_close(file), 0);
    assert_int_equal(h5_open(path, &file), 0);
    assert_int_equal(h5in_read(file, "/noise", values), 0);
    for (size_t i = 0; i < n; i++) assert_true(values[i] == noise(i));
    h5_abandon(file);
    mem_free(values);
}

static void test_attributes(void **state)
{
    (void)state;
    struct h5 *file;
    const int64_t version[2] = {1, 0};
    const double time = 1.25e-7;
    const int32_t step = 17;
    assert_int_equal(h5_create(path, &file), 0);
    h5_attribute(file, "/", "Version", H5_I64, 2, version);
    h5_attribute(file, "/", "time", H5_F64, 0, &time);
    h5_attribute(file, "/", "step", H5_I32, 0, &step);
    h5_attribute_text(file, "/", "title", "10 \xc2\xb5m");
    h5_attribute_text(file, "/", "empty", "");
    h5out_text(file, "/case.yaml", "bulla: 1\n");
    assert_int_equal(h5_close(file), 0);
    double numbers[2];
    char *text;
    assert_int_equal(h5_open(path, &file), 0);
    assert_int_equal(h5in_attribute(file, "/", "Version", 2, numbers), 0);
    assert_true(numbers[0] == 1.0 && numbers[1] == 0.0);
    assert_int_equal(h5in_attribute(file, "/", "time", 1, numbers), 0);
    assert_true(numbers[0] == time);
    assert_int_equal(h5in_attribute_text(file, "/", "title", &text), 0);
    assert_string_equal(text, "10 \xc2\xb5m");
    mem_free(text);
    assert_int_equal(h5in_attribute_text(file, "/", "empty", &text), 0);
    assert_string_equal(text, "");
    mem_free(text);
    assert_int_equal(h5in_text(file, "/case.yaml", &text), 0);
    assert_string_equal(text, "bulla: 1\n");
    mem_free(text);
    assert_int_equal(h5in_attribute(file, "/", "step", 3, numbers), STATUS_RUN);
    assert_non_null(strstr(status_text(), "step"));
    h5_abandon(file);
}

static void test_interleave(void **state)
{
    (void)state;
    struct h5 *file;
    const float a[6] = {0, 1, 2, 3, 4, 5};
    const float b[18] = {0, 10, 20, 1, 11, 21, 2, 12, 22, 3, 13, 23, 4, 14, 24, 5, 15, 25};
    const struct h5view_column columns[2] = {{"/a", 0, 0}, {"/b", 3, 1}};
    const struct h5view_groups runs[3] = {{0, 2, 2}, {4, 2, 0}, {4, 1, 2}}; /* pairs, none, single rows */
    const struct h5view view = {
        .type = H5_F32, .n_column = 2, .columns = columns, .total = 6, .n_run = 3, .runs = runs};
    const double expected[12] = {0, 1, 10, 11, 2, 3, 12, 13, 4, 14, 5, 15};
    double values[12];
    assert_int_equal(h5_create(path, &file), 0);
    h5out_array(file, "/a", H5_F32, 6, 0, a);
    h5out_array(file, "/b", H5_F32, 6, 3, b);
    h5view_write(file, "/view", &view);
    assert_int_equal(h5_close(file), 0);
    assert_int_equal(h5_open(path, &file), 0);
    assert_int_equal(h5in_read(file, "/view", values), 0);
    assert_memory_equal(values, expected, sizeof expected);
    h5_abandon(file);
}

static void test_failures(void **state)
{
    (void)state;
    struct h5 *file;
    assert_int_equal(h5_create("/nowhere/at/all.hdf", &file), STATUS_RUN);
    assert_non_null(strstr(status_text(), "/nowhere/at/all.hdf: cannot create it"));
    assert_non_null(strstr(status_text(), "No such file"));
    assert_int_equal(h5_open("/nowhere/at/all.hdf", &file), STATUS_RUN);
    assert_non_null(strstr(status_text(), "No such file"));
    assert_int_equal(h5_open("CMakeLists.txt", &file), STATUS_RUN);
    assert_string_equal(status_text(), "CMakeLists.txt: not an HDF5 file");
    assert_int_equal(h5_create(path, &file), 0);
    h5_group(file, "/no/such/parent");
    h5_group(file, "/fine");
    assert_int_equal(h5_close(file), STATUS_RUN);
    assert_non_null(strstr(status_text(), "cannot make a group"));
}

/* A full disk: the message names the reason and what is free. */
static void test_full_disk(void **state)
{
    (void)state;
    struct h5 *file;
    char full[] = "/dev/full";
    if (access(full, W_OK)) skip();
    int code = h5_create(full, &file);
    if (!code) code = h5_close(file);
    assert_int_equal(code, STATUS_RUN);
    assert_non_null(strstr(status_text(), "/dev/full: cannot"));
    assert_non_null(strstr(status_text(), "No space left"));
    assert_non_null(strstr(status_text(), "MB are free"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_rows, start, stop),
        cmocka_unit_test_setup_teardown(test_noise, start, stop),
        cmocka_unit_test_setup_teardown(test_attributes, start, stop),
        cmocka_unit_test_setup_teardown(test_interleave, start, stop),
        cmocka_unit_test_setup_teardown(test_failures, start, stop),
        cmocka_unit_test(test_full_disk),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
