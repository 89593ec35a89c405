/* Which cells of a liquid are the last before its vapour: by what lies beside them, along every axis, behind the edge
 * of their tile too, whichever materials the vapour and its gases are. */
#include "scheme/shore.h"

#include "scheme/patch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

enum { SIDE = 6, PATCH = (SIDE + 2) * (SIDE + 2) * (SIDE + 2) };

static double room[2 * PATCH];

static struct scene_phase pair = {.onset = 0.99};

/* Family of materials `first` (liquid), `first` + 1 and + 2 of `n`; the vapour alone may stand first of all. */
static struct model family(unsigned n, unsigned liquid, unsigned vapour, unsigned gas)
{
    struct model path = {.n_phase = 1, .fronts = true, .n_around_alpha = n - 1, .n_around = n - 1};
    path.phases[0] = (struct model_phase){.n = gas < n ? 3 : 2, .member = {liquid, vapour, gas}, .scene = &pair};
    return path;
}

/* Marks of cells in which vapour fills thin(i, j, k), ghosts included; all else is liquid. */
static void marks(int dim, double (*thin)(int i, int j, int k), unsigned char *ret)
{
    static double around[PATCH];
    struct mesh mesh = {.dim = dim, .n = {SIDE, dim > 1 ? SIDE : 1, dim > 2 ? SIDE : 1}};
    mesh.n_cell = (size_t)(mesh.n[0] * mesh.n[1] * mesh.n[2]);
    const struct box_block block = rim_block(&mesh, 1, around);
    const struct model path = family(2, 0, 1, 9);
    for (int k = dim > 2 ? -1 : 0; k < mesh.n[2] + (dim > 2); k++)
        for (int j = dim > 1 ? -1 : 0; j < mesh.n[1] + (dim > 1); j++)
            for (int i = -1; i <= SIDE; i++) around[box_at(&block, i, j, k)] = thin(i, j, k);
    assert_true(shore_marks(&path, &mesh) == mesh.n_cell);
    shore_look(&path, &mesh, around, room, ret);
}

static const double *row; /* from the ghost before to the ghost behind */

static double line(int i, int j, int k)
{
    (void)j, (void)k;
    return row[i + 1];
}

static void same(const double *cells, const char *expected)
{
    unsigned char mark[SIDE];
    row = cells;
    marks(1, line, mark);
    for (int i = 0; i < SIDE; i++) assert_int_equal(mark[i], expected[i] - '0');
}

static void test_line(void **state)
{
    (void)state;
    same((const double[]){1.0, 1.0, 0.995, 0.7, 0.3, 0.0, 0.0, 0.0}, "111000");
    same((const double[]){0.0, 0.0, 0.0, 0.3, 0.7, 0.995, 1.0, 1.0}, "000111");
    same((const double[]){0.995, 0.2, 0.1, 0.0, 0.0, 0.0, 0.4, 0.99}, "100001"); /* what is dry lies in other tiles */
    same((const double[]){0.9, 0.2, 0.1, 0.0, 0.0, 0.0, 0.4, 0.98}, "000000");
    same((const double[]){0.0, 0.0, 0.3, 0.6, 0.4, 0.0, 0.0, 0.0}, "001000");               /* a bubble of some cells */
    same((const double[]){0.0, 0.0, 0.3, 0.4, 0.3, 0.0, 0.0, 0.0}, "000000");               /* of too few */
    same((const double[]){0.7, 0.7, 0.7 + 1e-9, 0.7, 0.7, 0.7 - 1e-9, 0.7, 0.7}, "111111"); /* a mixture */
    same((const double[]){0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, "000000");
}

static int axis, sign;

/* Dry from cell 3 on along the axis, a cell of 0.6 before it; a dry cell beyond an edge of another. */
static double slab(int i, int j, int k)
{
    const int at[3] = {i, j, k};
    int along = sign > 0 ? at[axis] : SIDE - 1 - at[axis];
    return along >= 3 ? 1.0 : along == 2 ? 0.6 : along == 1 ? 0.2 : 0.0;
}

static void test_axes(void **state)
{
    (void)state;
    unsigned char mark[SIDE * SIDE * SIDE];
    for (int dim = 1; dim <= 3; dim++)
        for (axis = 0; axis < dim; axis++)
            for (sign = -1; sign <= 1; sign += 2) {
                int n[3] = {SIDE, dim > 1 ? SIDE : 1, dim > 2 ? SIDE : 1}, c = 0;
                marks(dim, slab, mark);
                for (int k = 0; k < n[2]; k++)
                    for (int j = 0; j < n[1]; j++)
                        for (int i = 0; i < n[0]; i++, c++) {
                            const int at[3] = {i, j, k};
                            int along = sign > 0 ? at[axis] : SIDE - 1 - at[axis];
                            assert_int_equal(mark[c], along >= 2);
                        }
            }
}

static double corner(int i, int j, int k)
{
    (void)k;
    return i >= 3 && j >= 3 ? 1.0 : 0.1;
}

/* Across an edge is not beside. */
static void test_corner(void **state)
{
    (void)state;
    unsigned char mark[SIDE * SIDE];
    marks(2, corner, mark);
    assert_int_equal(mark[2 * SIDE + 2], 0);
    assert_int_equal(mark[3 * SIDE + 2], 1);
    assert_int_equal(mark[2 * SIDE + 3], 1);
}

/* A gas counts with the vapour, and the first material is what the others leave. */
static void test_materials(void **state)
{
    (void)state;
    static double around[2 * (SIDE + 2)];
    const struct mesh mesh = {.dim = 1, .n = {SIDE, 1, 1}, .n_cell = SIDE};
    unsigned char mark[SIDE];
    for (int i = 0; i < SIDE + 2; i++) {
        around[i] = i < 4 ? 0.0 : 1.0;                           /* material 1: liquid above */
        around[SIDE + 2 + i] = i < 3 ? 0.5 : i == 3 ? 0.4 : 0.0; /* material 2: gas */
    }
    around[3] = 0.3;
    struct model path = family(3, 1, 0, 2);
    shore_look(&path, &mesh, around, room, mark);
    for (int i = 0; i < SIDE; i++) assert_int_equal(mark[i], i <= 2); /* thin: 1, 1, 1, 0.7, 0, 0, 0, 0 */
    path = family(3, 1, 2, 9);                                        /* the gas alone: 0.5 at most */
    shore_look(&path, &mesh, around, room, mark);
    for (int i = 0; i < SIDE; i++) assert_int_equal(mark[i], i <= 1);
    path = family(3, 0, 1, 2);
    path.phases[0].member[0] = 9, path.phases[0].member[1] = 0, path.phases[0].member[2] = 1;
    path.first = 1; /* a path of materials 1 and 2 */
    shore_look(&path, &mesh, around, room, mark);
    for (int i = 0; i < SIDE; i++) assert_int_equal(mark[i], i != 1); /* 0.5, 0.5, 0.7, 1 .. */
}

/* Marks of a line of materials 0 to 4 by two families of these members and onsets. */
static void pairs(const struct model_phase *one, const struct model_phase *other, const double part[4][SIDE + 2],
                  unsigned char *ret)
{
    const struct mesh mesh = {.dim = 1, .n = {SIDE, 1, 1}, .n_cell = SIDE};
    const struct model path = {.n_phase = 2, .fronts = true, .n_around_alpha = 4, .phases = {*one, *other}};
    assert_true(shore_marks(&path, &mesh) == (size_t)(2 * SIDE));
    assert_true(shore_room(&path, &mesh) <= sizeof room / sizeof *room);
    shore_look(&path, &mesh, part[0], room, ret);
}

static void each(const unsigned char *mark, const char *first, const char *second)
{
    for (int i = 0; i < SIDE; i++) {
        assert_int_equal(mark[i], first[i] - '0');
        assert_int_equal(mark[SIDE + i], second[i] - '0');
    }
}

/* Two liquids, each with its vapour and an onset of its own: neither sees the other's vapour or onset, and the marks
 * stand in the order of the pairs. What is the shore of one pair lies where the other has none. */
static void test_pairs(void **state)
{
    (void)state;
    static const double part[4][SIDE + 2] = {{0.9, 0.4, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0},  /* 1: vapour of 3 */
                                             {0.0, 0.0, 0.0, 0.0, 0.0, 0.2, 0.7, 0.7},  /* 2: vapour of 0 */
                                             {0.1, 0.6, 1.0, 1.0, 0.5, 0.0, 0.0, 0.0},  /* 3 */
                                             {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}}; /* 4: a gas of the second */
    static struct scene_phase early = {.onset = 0.6}, late = {.onset = 0.9};
    const struct model_phase first = {.n = 2, .member = {0, 2}, .scene = &early},
                             second = {.n = 3, .member = {3, 1, 4}, .scene = &late},
                             eager = {.n = 3, .member = {3, 1, 4}, .scene = &early},
                             lazy = {.n = 2, .member = {0, 2}, .scene = &late};
    unsigned char mark[2 * SIDE];
    pairs(&first, &second, part, mark);
    each(mark, "000011", "100000");
    pairs(&second, &first, part, mark);
    each(mark, "100000", "000011");
    pairs(&lazy, &eager, part, mark); /* no cell is as dry as 0.9; that of 0.7 is beyond the surface of heat */
    each(mark, "000001", "100000");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_line),      cmocka_unit_test(test_axes),  cmocka_unit_test(test_corner),
        cmocka_unit_test(test_materials), cmocka_unit_test(test_pairs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
