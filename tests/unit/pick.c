/* Cells picked out of a row (phys/pick.h): each that is not 0 in one of the rows, in order and once, whatever the
 * length; and nothing else is touched when packed values go back. */
#include "phys/pick.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

enum { MOST = 1100, ROWS = 3 };

/* Rows that are 0 but for the cells whose number a hash lets through: few, some or all of them. */
static void fill(size_t n, unsigned out_of, double row[ROWS][MOST])
{
    for (unsigned k = 0; k < ROWS; k++)
        for (size_t i = 0; i < n; i++) {
            size_t hash = (i * 2654435761u + k * 40503u) >> 7;
            row[k][i] = hash % out_of == 0 ? (i % 2 ? -1e-300 : 3.0) : i % 3 ? 0.0 : -0.0;
        }
}

static void test_pick(void **state)
{
    (void)state;
    static double row[ROWS][MOST];
    static const size_t length[] = {0, 1, 7, 63, 64, 65, 511, 512, 513, 1099};
    static const unsigned sparse[] = {1, 2, 9, 150};
    for (size_t c = 0; c < sizeof length / sizeof *length; c++)
        for (size_t s = 0; s < sizeof sparse / sizeof *sparse; s++) {
            size_t n = length[c], expected = 0;
            unsigned at[MOST];
            fill(n, sparse[s], row);
            size_t count = pick_nonzero(n, ROWS, MOST, row[0], at);
            for (size_t i = 0; i < n; i++)
                if (row[0][i] != 0.0 || row[1][i] != 0.0 || row[2][i] != 0.0) assert_int_equal(at[expected++], i);
            assert_int_equal(count, expected);
        }
}

static void test_marks(void **state)
{
    (void)state;
    unsigned char mark[130] = {0};
    unsigned at[130];
    mark[0] = mark[63] = mark[64] = mark[129] = 1;
    assert_int_equal(pick_marked(130, 1000, mark, at), 4);
    assert_int_equal(at[0], 1000);
    assert_int_equal(at[1], 1063);
    assert_int_equal(at[2], 1064);
    assert_int_equal(at[3], 1129);
    assert_int_equal(pick_marked(129, 0, mark, at), 3);
}

static void test_rows(void **state)
{
    (void)state;
    const unsigned at[] = {1, 4, 5};
    double row[] = {10, 11, 12, 13, 14, 15}, packed[3];
    pick_take(3, at, row, packed);
    assert_true(packed[0] == 11 && packed[1] == 14 && packed[2] == 15);
    for (size_t i = 0; i < 3; i++) packed[i] += 100.0;
    pick_put(3, at, packed, row);
    assert_true(row[1] == 111 && row[4] == 114 && row[5] == 115);
    assert_true(row[0] == 10 && row[2] == 12 && row[3] == 13);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_pick),
        cmocka_unit_test(test_marks),
        cmocka_unit_test(test_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
