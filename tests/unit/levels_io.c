/* levels_io.c - what histories and ledgers say of a mesh of three levels: every place counts once, with its finest
 * cell. Cells under finer ones hold nonsense wherever nobody may look at them. */
#include "io/ledger.h"
#include "io/measure.h"
#include "levels_io.h"

#include <math.h>

static const char columns[] =
    "output:\n  history:\n    columns:\n"
    "      V: {volume: air}\n      m: {mass: air}\n      R: {equivalent-radius: air}\n"
    "      z: {centroid: air}\n      r: {centroid: air, along: r}\n"
    "      above: {volume: air, where: {half-space: {point: [0, 0], normal: [0, 1]}}}\n"
    "      pmax: {max: pressure, in: water}\n      pmin: {min: pressure, in: water}\n"
    "      pmean: {mean: pressure, where: {box: {lower: [0, 0.5 mm], upper: [1 mm, 0.75 mm]}}}\n"
    "      speed: {max: velocity, in: water}\n"
    "      mass: {total: mass}\n      pz: {total: momentum_y}\n      jet: {jet-speed: air}\n"
    "      depth: {penetration: air}\n      surface: {isosurface-mean: pressure, in: air}\n";

enum { V, MASS_AIR, RADIUS, Z, R, ABOVE, PMAX, PMIN, PMEAN, SPEED, MASS, PZ, JET, DEPTH, SURFACE, COUNT };

static bool near(const double *x)
{
    return hypot(x[0], x[1]) < 0.85e-3;
}

/* The surface of the bubble, but only its upper half. */
static bool above(const double *x)
{
    return x[1] > 0.0 && fabs(hypot(x[0], x[1]) - 0.5e-3) < 0.07e-3;
}

static void start_case(struct small *small)
{
    char *text = mem_print("%s%s", SMALL_AXISYMMETRIC, columns);
    small_start_levels(small, text, 2);
    mem_free(text);
    assert_int_equal(small->scene->n_column, COUNT);
}

static void refine(struct small *small)
{
    const struct mesh *mesh = small->state->mesh;
    levels_add(small->state, near);
    levels_add(small->state, above);
    assert_int_equal(mesh->n_level, 3);
    assert_int_equal(mesh->levels[1].n_tile, 16); /* of 32 places: some tiles are covered, some in part, some not */
    assert_in_range(mesh->levels[2].n_tile, 6, 24);
}

static void close_to(double value, double expected, double relative)
{
    if (!(fabs(value - expected) <= relative * fabs(expected)))
        fail_msg("%.17g is not %.17g within %g", value, expected, relative);
}

static void expect_painted(const double *values)
{
    double radius = 0.5e-3, volume = 4.0 / 3.0 * M_PI * pow(radius, 3), h = 1e-3 / 32;
    double water = M_PI * 1e-6 * 2e-3 - volume;
    close_to(values[V], volume, 1e-6);
    close_to(values[MASS_AIR], 1.2 * volume, 1e-6);
    close_to(values[RADIUS], radius, 1e-6);
    close_to(values[ABOVE], 0.5 * volume, 1e-6);
    assert_true(fabs(values[Z]) < 1e-3 * radius);
    close_to(values[R], 3.0 / 16.0 * M_PI * radius, 2e-3);
    close_to(values[PMAX], 1e5 + 1e8 * (1e-3 - 0.5 * h), 1e-9);
    close_to(values[PMIN], 1e5 - 1e8 * (1e-3 - 0.5 * h), 1e-6);
    close_to(values[PMEAN], 1e5 + 1e8 * 0.625e-3, 1e-9);
    close_to(values[SPEED], sqrt(5.0), 1e-9);
    close_to(values[MASS], 1000 * water + 1.2 * volume, 1e-9);
    close_to(values[PZ], 2 * 1000 * water - 3 * 1.2 * volume, 1e-9);
    close_to(values[JET], -3.0, 1e-9);
}

/* Measures that were made for one level follow the mesh to three. */
static void test_measures(void **state)
{
    (void)state;
    struct small small;
    struct measures *measures;
    double values[COUNT];
    start_case(&small);
    assert_int_equal(measure_new(small.state, &measures), 0);
    measure_take(measures, small.state, values);
    expect_painted(values);
    refine(&small);
    measure_take(measures, small.state, values);
    expect_painted(values);
    levels_spoil(small.state);
    measure_take(measures, small.state, values);
    expect_painted(values);
    measure_free(measures);
    small_stop(&small);
}

static void test_ledger(void **state)
{
    (void)state;
    struct small small;
    struct ledger coarse, fine, spoilt;
    start_case(&small);
    ledger_take(small.state, &coarse);
    refine(&small);
    ledger_take(small.state, &fine);
    assert_int_equal(coarse.n, fine.n);
    for (unsigned q = 0; q < fine.n; q++)
        if (fabs(coarse.total[q]) > 0.0) close_to(fine.total[q], coarse.total[q], 1e-6);
    levels_spoil(small.state);
    ledger_take(small.state, &spoilt);
    for (unsigned q = 0; q < fine.n; q++) assert_true(spoilt.total[q] == fine.total[q]);
    small_stop(&small);
}

/* Sets alpha of air on all levels to a smooth ball around (0, z), and the pressure to 1e5 + 1e8 y. */
static void make_ball(struct state *state, double radius, double z)
{
    const struct mesh *mesh = state->mesh;
    const struct model *model = state->model;
    size_t n = mesh->n_cell;
    for (int l = 0; l < mesh->n_level; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++)
            for (size_t cell = 0; cell < n; cell++) {
                const struct level *level = &mesh->levels[l];
                double corner[3], *u = level->u_old[t], *w = level->w[t];
                mesh_corner(mesh, level, &level->tiles[t], corner);
                double x = corner[0] + ((double)(cell % 16) + 0.5) * level->h[0];
                double y = corner[1] + ((double)(cell / 16) + 0.5) * level->h[1];
                double alpha = 0.5 * (1.0 - tanh((hypot(x, y - z) - radius) / (2.0 * mesh->levels[0].h[0])));
                u[(model->i_alpha + 1) * n + cell] = w[(model->i_alpha + 1) * n + cell] = alpha;
                u[model->i_alpha * n + cell] = w[model->i_alpha * n + cell] = 1.0 - alpha;
                w[model->i_E * n + cell] = 1e5 + 1e8 * y;
            }
}

/* The upper half of the surface is finer than the lower: neither may count more. */
static void test_surface(void **state)
{
    (void)state;
    struct small small;
    struct measures *measures;
    double values[COUNT], h = 1e-3 / 32, radius = 0.5e-3;
    start_case(&small);
    refine(&small);
    make_ball(small.state, radius, 0.0);
    assert_int_equal(measure_new(small.state, &measures), 0);
    measure_take(measures, small.state, values);
    assert_true(fabs(values[SURFACE] - 1e5) < 0.01 * 1e8 * radius);
    assert_true(values[DEPTH] == 0.0);
    make_ball(small.state, radius, 0.1e-3);
    measure_take(measures, small.state, values);
    assert_true(fabs(values[DEPTH] - 0.1e-3) < 0.02 * h);
    measure_free(measures);
    small_stop(&small);
}

/* A line through three levels: the crossing is that of the leaves, not of what lies under them. */
static void test_crossing(void **state)
{
    (void)state;
    struct small small;
    struct measures *measures;
    double values[COUNT];
    start_case(&small);
    refine(&small);
    make_ball(small.state, 0.5e-3, 0.0);
    assert_int_equal(measure_new(small.state, &measures), 0);
    levels_spoil(small.state);
    measure_take(measures, small.state, values);
    assert_true(values[DEPTH] == 0.0);
    measure_free(measures);
    small_stop(&small);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_measures),
        cmocka_unit_test(test_ledger),
        cmocka_unit_test(test_surface),
        cmocka_unit_test(test_crossing),
    };
    if (registry_init()) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
