/* matrix.c - the rows of a case's matrix, and the orders observed between them. */
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
#include "batch/matrix.h"
#include "batch/study.h"

static char folder[] = "/tmp/bulla-matrix-XXXXXX";

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return chdir("/") || rmdir(folder);
}

static const char *write_case(char path[128], const char *name, const char *text)
{
    snprintf(path, 128, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    return path;
}

static void test_rows(void **state)
{
    (void)state;
    char path[128];
    struct matrix matrix;
    write_case(path, "a.yaml",
               "title: A wave\ndomain: {cells: [64, 32]}\n"
               "matrix:\n  domain.cells: [[32, 16], [128, 64]]\n  scheme.limiter: [mc, \"min:mod\"]\n");
    assert_int_equal(matrix_read(path, NULL, &matrix), STATUS_OK);
    assert_string_equal(matrix.title, "A wave");
    assert_true(matrix.count == 64 * 32);
    assert_int_equal(matrix.n_row, 4);
    assert_string_equal(matrix.rows[0].sets[0], "domain.cells=[32, 16]");
    assert_string_equal(matrix.rows[0].sets[1], "scheme.limiter=mc");
    assert_string_equal(matrix.rows[1].sets[1], "scheme.limiter=min:mod");
    assert_string_equal(matrix.rows[2].sets[0], "domain.cells=[128, 64]");
    assert_string_equal(matrix.rows[2].cells, "128 x 64");
    assert_true(matrix.rows[3].count == 8192 && matrix.rows[3].dim == 2);
    matrix_done(&matrix);
    unlink(path);
}

static void test_no_matrix_and_parents(void **state)
{
    (void)state;
    char base[128], child[128];
    struct matrix matrix;
    write_case(base, "base.yaml", "title: Base\ndomain: {cells: [100]}\n");
    write_case(child, "child.yaml", "extends: base.yaml\ntitle: Child\n");
    assert_int_equal(matrix_read(child, NULL, &matrix), STATUS_OK);
    assert_string_equal(matrix.title, "Child");
    assert_int_equal(matrix.n_row, 1);
    assert_int_equal(matrix.n_set, 0);
    assert_string_equal(matrix.rows[0].cells, "100");
    matrix_done(&matrix);
    unlink(base);
    unlink(child);
}

static void test_refusals(void **state)
{
    (void)state;
    static const char *const bad[] = {"matrix: [1, 2]\n", "matrix: {domain.cells: 5}\n",
                                      "matrix: {domain.cells: []}\n"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char path[128];
        struct matrix matrix;
        write_case(path, "bad.yaml", bad[i]);
        assert_int_equal(matrix_read(path, NULL, &matrix), STATUS_CASE);
        assert_non_null(strstr(status_text(), "list"));
        unlink(path);
    }
}

static void test_orders(void **state)
{
    (void)state;
    char path[128];
    struct study study;
    write_case(path, "wave.yaml",
               "domain: {cells: [32, 32]}\nmatrix: {domain.cells: [[16, 16], [32, 32], [64, 64]]}\n");
    assert_int_equal(study_new(path, &study), STATUS_OK);
    assert_string_equal(study.id, "wave");
    struct study_value values[3] = {{.value = 0.08, .order = 1.9, .is_norm = true},
                                    {.value = 0.02, .order = 1.9, .is_norm = true, .passed = true},
                                    {.value = 0.005, .order = 1.9, .is_norm = true, .passed = true}};
    for (unsigned i = 0; i < 3; i++)
        study.rows[i] = (struct study_row){.judged = i > 0, .n_value = 1, .values = &values[i]};
    assert_true(isnan(study_order(&study, 1, 0, 0)));
    assert_true(fabs(study_order(&study, 0, 1, 0) - 2) < 1e-12);
    study.rows[0].code = STATUS_EXPECT; /* too coarse to be judged */
    assert_true(study_passed(&study));
    study.rows[1].code = STATUS_EXPECT;
    assert_false(study_passed(&study));
    study.rows[1].code = STATUS_OK;
    values[2].value = 0.01; /* order 1 at last, 1.5 over all */
    assert_false(study_passed(&study));
    values[0].value = 1; /* 3.3 over all */
    assert_true(study_passed(&study));
    values[0].value = 0.08;
    values[2].value = NAN;
    assert_false(study_passed(&study));
    values[2].value = 0.005;
    study.rows[0].code = STATUS_RUN; /* a run that dies is never fine */
    assert_false(study_passed(&study));
    for (unsigned i = 0; i < 3; i++) study.rows[i] = (struct study_row){0};
    study_done(&study);
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows),
        cmocka_unit_test(test_no_matrix_and_parents),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_orders),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
