/* probes.c - values at points: exact for linear fields, constant beyond the last centre, periodic where the
 * domain is, linear in time between steps. */
#include "io/probes.h"

#include "levels_io.h"

#include <math.h>

#define PROBES                                                       \
    "output:\n  probes:\n    every: 0.25 us\n"                       \
    "    a: {at: [0.9 mm, 0.31 mm], fields: [pressure, velocity]}\n" \
    "    top: {at: [0.9 mm, 1 mm], fields: [pressure]}\n"            \
    "    seam: {at: [0.5 mm, 0.5 mm], fields: [pressure]}\n"

/* The number in row `row` (0: the first below the header) and column `column` of probes.csv. */
static double cell(const struct small *small, int row, int column)
{
    char *text = small_text(small, "probes.csv"), *at = text;
    for (int i = 0; i <= row; i++) {
        at = strchr(at, '\n');
        assert_non_null(at);
        at++;
    }
    for (int i = 0; i < column; i++) at = strchr(at, ',') + 1;
    double value = strtod(at, NULL);
    mem_free(text);
    return value;
}

static int rows(const struct small *small)
{
    char *text = small_text(small, "probes.csv");
    int count = -1;
    for (const char *at = text; *at; at++) count += *at == '\n';
    mem_free(text);
    return count;
}

static void close_to(double value, double expected)
{
    if (!(fabs(value - expected) <= 1e-9 * fabs(expected))) fail_msg("%.17g is not %.17g", value, expected);
}

/* Raises the pressure everywhere and moves on in time. */
static void step_on(struct small *small, double dt, double dp)
{
    const struct mesh *mesh = small->state->mesh;
    unsigned i_E = small->state->model->i_E;
    for (unsigned i = 0; i < mesh->levels[0].n_local; i++)
        for (size_t c = 0; c < mesh->n_cell; c++) mesh->levels[0].w[i][i_E * mesh->n_cell + c] += dp;
    small_skip(small, dt);
}

static void test_space(void **state)
{
    (void)state;
    struct small small;
    struct probes *probes;
    small_start(&small, SMALL_AXISYMMETRIC PROBES);
    assert_int_equal(probes_new(small.state, &probes), 0);
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    probes_free(probes);
    char *text = small_text(&small, "probes.csv");
    assert_ptr_equal(strstr(text, "t,a.pressure,a.velocity_x,a.velocity_y,a.velocity_z,top.pressure,seam.pressure\n0,"),
                     text);
    mem_free(text);
    close_to(cell(&small, 0, 1), 1e5 + 1e8 * 0.31e-3);
    close_to(cell(&small, 0, 2), 1.0);
    close_to(cell(&small, 0, 3), 2.0);
    assert_true(cell(&small, 0, 4) == 0.0);
    close_to(cell(&small, 0, 5), 1e5 + 1e8 * (1e-3 - 0.5e-3 / 32));
    close_to(cell(&small, 0, 6), 1e5 + 1e8 * 0.5e-3);
    small_stop(&small);
}

/* A probe of a material that is not there says so, one beside it has the material's own value, not mixed with zeros. */
static void test_absent(void **state)
{
    (void)state;
    struct small small;
    struct probes *probes;
    small_start(&small, SMALL_AXISYMMETRIC "output:\n  probes:\n    in: {at: [0.1 mm, 0], fields: [temperature_air]}\n"
                                           "    edge: {at: [0.51 mm, 0], fields: [temperature_air]}\n"
                                           "    out: {at: [0.9 mm, 0], fields: [temperature_air]}\n");
    assert_int_equal(probes_new(small.state, &probes), 0);
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    probes_free(probes);
    assert_true(cell(&small, 0, 1) > 280.0);
    assert_true(fabs(cell(&small, 0, 2) - cell(&small, 0, 1)) < 5.0);
    assert_true(isnan(cell(&small, 0, 3)));
    small_stop(&small);
}

static void test_time(void **state)
{
    (void)state;
    struct small small;
    struct probes *probes;
    small_start(&small, SMALL_AXISYMMETRIC PROBES);
    double start = 1e5 + 1e8 * 0.31e-3;
    assert_int_equal(probes_new(small.state, &probes), 0);
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    step_on(&small, 0.4e-6, 1e4); /* t = 0.4 us */
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    step_on(&small, 0.7e-6, 1e4); /* t = 1.1 us */
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    assert_int_equal(rows(&small), 5);
    const double times[5] = {0, 0.25e-6, 0.5e-6, 0.75e-6, 1e-6};
    const double rise[5] = {0, 0.625e4, 1e4 + 1e4 / 7, 1e4 + 5e4 / 10, 1e4 + 6e4 / 7};
    for (int i = 0; i < 5; i++) {
        close_to(cell(&small, i, 0), times[i]);
        close_to(cell(&small, i, 1), start + rise[i]);
    }
    assert_int_equal(probes_finish(probes, small.state, SMALL_NOW(small.state)), 0);
    assert_int_equal(probes_finish(probes, small.state, SMALL_NOW(small.state)), 0);
    assert_int_equal(rows(&small), 6);
    close_to(cell(&small, 5, 0), 1.1e-6);
    close_to(cell(&small, 5, 1), start + 2e4);
    probes_free(probes);
    small.state->t = 0.6e-6; /* taken up again: rows up to 0.5 us stay, the next is due at 0.75 us */
    assert_int_equal(probes_new(small.state, &probes), 0);
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    assert_int_equal(rows(&small), 3);
    step_on(&small, 0.3e-6, 1e4);
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    assert_int_equal(rows(&small), 4);
    close_to(cell(&small, 3, 0), 0.75e-6);
    close_to(cell(&small, 3, 1), start + 2.5e4);
    probes_free(probes);
    small_stop(&small);
}

static void test_steps(void **state)
{
    (void)state;
    struct small small;
    struct probes *probes;
    small_start(&small,
                "bulla: 1\ndomain: {lower: [0], upper: [1], cells: [40], boundaries: {x-: periodic, x+: periodic}}\n"
                "mesh: {tile: 8}\n" SMALL_MATERIALS
                "initial:\n  - {everywhere: true, material: air, density: = 1 + x, pressure: 1e5}\n"
                "run: {until: 1 ms}\n"
                "output: {probes: {every: 2 steps, end: {at: [0], fields: [density]}}}\n");
    assert_int_equal(probes_new(small.state, &probes), 0);
    for (int i = 0; i < 5; i++, small_skip(&small, 0.5))
        assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    probes_free(probes);
    assert_int_equal(rows(&small), 3);
    close_to(cell(&small, 1, 0), 1.0);
    close_to(cell(&small, 0, 1), 1.5); /* half way between the last cell and the first */
    small_stop(&small);
}

static bool near(const double *x)
{
    return hypot(x[0], x[1]) < 0.85e-3;
}

/* Points in fine cells, and on both sides of where the fine level ends: exact for a linear field at all of them, and
 * found anew when the mesh changes. */
static void test_levels(void **state)
{
    (void)state;
    struct small small;
    struct probes *probes;
    small_start_levels(&small,
                       SMALL_AXISYMMETRIC "output:\n  probes:\n"
                                          "    fine: {at: [0.6 mm, 0.31 mm], fields: [pressure, level]}\n"
                                          "    inner: {at: [0.6 mm, 0.4999 mm], fields: [pressure]}\n"
                                          "    outer: {at: [0.6 mm, 0.5001 mm], fields: [pressure]}\n"
                                          "    side: {at: [0.7499 mm, 0.4999 mm], fields: [pressure]}\n",
                       1);
    assert_int_equal(probes_new(small.state, &probes), 0);
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    levels_add(small.state, near);
    small_skip(&small, 0.5);
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    levels_spoil(small.state);
    small_skip(&small, 0.5);
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    probes_free(probes);
    const double places[4] = {0.31e-3, 0.4999e-3, 0.5001e-3, 0.4999e-3};
    const int columns[4] = {1, 3, 4, 5};
    for (int i = 0; i < 4; i++)
        for (int row = 0; row < 2; row++) close_to(cell(&small, row, columns[i]), 1e5 + 1e8 * places[i]);
    assert_true(cell(&small, 0, 2) == 0.0 && cell(&small, 1, 2) == 1.0);
    close_to(cell(&small, 2, 1), 1e5 + 1e8 * places[0]); /* nothing of it comes from under the fine level */
    small_stop(&small);
}

static void test_none(void **state)
{
    (void)state;
    struct small small;
    struct probes *probes;
    small_start(&small, SMALL_AXISYMMETRIC);
    assert_int_equal(probes_new(small.state, &probes), 0);
    assert_null(probes);
    assert_int_equal(probes_record(probes, small.state, SMALL_NOW(small.state)), 0);
    assert_int_equal(probes_finish(probes, small.state, SMALL_NOW(small.state)), 0);
    probes_free(probes);
    small_stop(&small);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_space),  cmocka_unit_test(test_time), cmocka_unit_test(test_steps),
        cmocka_unit_test(test_levels), cmocka_unit_test(test_none), cmocka_unit_test(test_absent),
    };
    if (registry_init()) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
