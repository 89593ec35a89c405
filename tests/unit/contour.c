/* Level lines: lengths and shapes on uniform cells, across level jumps and at the outer edge. */
#include "base/mem.h"
#include "view/contour.h"
#include "close.h"

struct grid {
    size_t n;
    struct raster_cell *cells;
    double *values;
};

/* [0, 1]^2 in m x m cells; those whose centre is within `fine` of (0.5, 0.5) are quartered. */
static struct grid grid_new(int m, double fine)
{
    struct grid grid = {.cells = mem_new((size_t)(4 * m * m), sizeof *grid.cells)};
    double h = 1.0 / m;
    for (int j = 0; j < m; j++)
        for (int i = 0; i < m; i++) {
            int parts = hypot((i + 0.5) * h - 0.5, (j + 0.5) * h - 0.5) < fine ? 2 : 1;
            for (int k = 0; k < parts * parts; k++) {
                double size = h / parts, x = i * h + k % parts * size, y = j * h + k / parts * size;
                grid.cells[grid.n++] = (struct raster_cell){{{x, x + size}, {y, y + size}}};
            }
        }
    grid.values = mem_new(grid.n, sizeof *grid.values);
    return grid;
}

static void grid_done(struct grid *grid)
{
    mem_free(grid->cells);
    mem_free(grid->values);
}

static void grid_distance(struct grid *grid, double x, double y)
{
    for (size_t c = 0; c < grid->n; c++) {
        const struct raster_cell *cell = &grid->cells[c];
        double dx = 0.5 * (cell->at[0][0] + cell->at[0][1]) - x, dy = 0.5 * (cell->at[1][0] + cell->at[1][1]) - y;
        grid->values[c] = hypot(dx, dy);
    }
}

static void check_circle(int m, double fine, double radius, double tolerance)
{
    struct grid grid = grid_new(m, fine);
    struct contour contour;
    grid_distance(&grid, 0.5, 0.5);
    contour_find(grid.n, grid.cells, grid.values, radius, &contour);
    assert_int_equal(contour.n_line, 1);
    assert_close(contour_length(&contour), 2 * M_PI * radius, tolerance * 2 * M_PI * radius);
    const struct contour_line *line = &contour.lines[0];
    for (int axis = 0; axis < 2; axis++)
        assert_close(line->at[0][axis], line->at[line->n - 1][axis], 1e-12); /* a ring closes */
    for (size_t i = 0; i < line->n; i++)
        assert_close(hypot(line->at[i][0] - 0.5, line->at[i][1] - 0.5), radius, 0.6 / m / m);
    contour_done(&contour);
    grid_done(&grid);
}

static void circle_on_uniform_cells(void **state)
{
    (void)state;
    check_circle(64, 0.0, 0.3, 1e-3);
    check_circle(65, 0.0, 0.3, 1e-3);
}

static void circle_inside_of_finer_cells(void **state)
{
    (void)state;
    check_circle(64, 0.4, 0.3, 1e-3);
}

/* The ring of finer cells ends at the contour: it runs along and across the level jump. */
static void circle_along_the_level_jump(void **state)
{
    (void)state;
    check_circle(64, 0.3, 0.3, 1e-3);
    check_circle(48, 0.31, 0.305, 1e-3);
}

static void linear_data_give_a_straight_line(void **state)
{
    (void)state;
    struct grid grid = grid_new(16, 0.3);
    for (size_t c = 0; c < grid.n; c++)
        grid.values[c] = 0.5 * (grid.cells[c].at[0][0] + grid.cells[c].at[0][1]) + 0.1 * grid.cells[c].at[1][0] +
                         0.1 * grid.cells[c].at[1][1];
    struct contour contour;
    contour_find(grid.n, grid.cells, grid.values, 0.6, &contour);
    assert_int_equal(contour.n_line, 1);
    const struct contour_line *line = &contour.lines[0];
    double ends[2] = {line->at[0][1], line->at[line->n - 1][1]};
    assert_close(fmin(ends[0], ends[1]), 0.0, 1e-12); /* from edge to edge */
    assert_close(fmax(ends[0], ends[1]), 1.0, 1e-12);
    for (size_t i = 0; i < line->n; i++)
        if (line->at[i][1] > 1.0 / 32 && line->at[i][1] < 31.0 / 32)
            assert_close(line->at[i][0] + 0.2 * line->at[i][1], 0.6, 1e-12);
    contour_done(&contour);
    grid_done(&grid);
}

/* A half disc on the lower edge reaches the edge, at a right angle. */
static void half_circle_reaches_the_edge(void **state)
{
    (void)state;
    struct grid grid = grid_new(64, 0.0);
    struct contour contour;
    grid_distance(&grid, 0.5, 0.0);
    contour_find(grid.n, grid.cells, grid.values, 0.3, &contour);
    assert_int_equal(contour.n_line, 1);
    const struct contour_line *line = &contour.lines[0];
    assert_close(line->at[0][1], 0.0, 1e-12);
    assert_close(line->at[line->n - 1][1], 0.0, 1e-12);
    assert_close(contour_length(&contour), M_PI * 0.3, 1e-3 * M_PI * 0.3);
    contour_done(&contour);
    grid_done(&grid);
}

/* Four cells like a chess board: two pieces that do not cross, chosen by the mean. */
static void saddle_is_cut_by_the_mean(void **state)
{
    (void)state;
    struct grid grid = grid_new(2, 0.0);
    static const double values[2][4] = {{1.0, 0.0, 0.0, 0.9}, {0.0, 1.0, 1.0, 0.1}};
    for (int k = 0; k < 2; k++) {
        struct contour contour;
        for (int c = 0; c < 4; c++) grid.values[c] = values[k][c];
        contour_find(4, grid.cells, grid.values, 0.5, &contour);
        assert_int_equal(contour.n_line, 2);
        for (int i = 0; i < 2; i++) { /* both cut off a cell on the same diagonal: (0, 0) and (1, 1), or the other */
            const struct contour_line *line = &contour.lines[i];
            double fall = (line->at[line->n - 1][1] - line->at[0][1]) / (line->at[line->n - 1][0] - line->at[0][0]);
            assert_true(fall < 0.0);
        }
        contour_done(&contour);
    }
    grid_done(&grid);
}

static void nothing_to_draw(void **state)
{
    (void)state;
    struct grid grid = grid_new(4, 0.0);
    struct contour contour;
    contour_find(grid.n, grid.cells, grid.values, 0.5, &contour);
    assert_int_equal(contour.n_line, 0);
    contour_done(&contour);
    contour_find(0, NULL, NULL, 0.5, &contour);
    assert_int_equal(contour.n_line, 0);
    grid_done(&grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(circle_on_uniform_cells),
        cmocka_unit_test(circle_inside_of_finer_cells),
        cmocka_unit_test(circle_along_the_level_jump),
        cmocka_unit_test(linear_data_give_a_straight_line),
        cmocka_unit_test(half_circle_reaches_the_edge),
        cmocka_unit_test(saddle_is_cut_by_the_mean),
        cmocka_unit_test(nothing_to_draw),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
