/* history.c - the measures of a history against exact values, and the file they are written to. */
#include "io/history.h"

#include "io/measure.h"
#include "small.h"

#include <math.h>

static const char columns[] =
    "output:\n  history:\n    columns:\n"
    "      V: {volume: air}\n      m: {mass: air}\n      R: {equivalent-radius: air}\n"
    "      z: {centroid: air}\n      r: {centroid: air, along: r}\n"
    "      above: {volume: air, where: {half-space: {point: [0, 0], normal: [0, 1]}}}\n"
    "      pmax: {max: pressure, in: water}\n      pmin: {min: pressure, in: water}\n"
    "      pmean: {mean: pressure, where: {box: {lower: [0.8 mm, 0.5 mm], upper: [1 mm, 0.75 mm]}}}\n"
    "      speed: {max: velocity, in: water}\n"
    "      mass: {total: mass}\n      pz: {total: momentum_y}\n      jet: {jet-speed: air}\n"
    "      depth: {penetration: air}\n      surface: {isosurface-mean: pressure, in: air}\n"
    "      least: {isosurface-min: pressure, in: air}\n      most: {isosurface-max: pressure, in: air}\n"
    "      flat: {plane-integral: pressure}\n"
    "      skin: {isosurface-mean: temperature_air, in: water}\n"
    "      warm: {mean: temperature_air, in: air}\n"
    "      nothing: {max: pressure, where: {sphere: {center: [0.9 mm, 0], radius: 1 um}}}\n"
    "      ratio: {value: above / V + t}\n";

enum {
    V,
    MASS_AIR,
    RADIUS,
    Z,
    R,
    ABOVE,
    PMAX,
    PMIN,
    PMEAN,
    SPEED,
    MASS,
    PZ,
    JET,
    DEPTH,
    SURFACE,
    LEAST,
    MOST,
    FLAT,
    SKIN,
    WARM,
    NOTHING,
    RATIO,
    COUNT
};

static void start_case(struct small *small)
{
    char *text = mem_print("%s%s", SMALL_AXISYMMETRIC, columns);
    small_start(small, text);
    mem_free(text);
    assert_int_equal(small->scene->output.n_column, COUNT);
}

static void close_to(double value, double expected, double relative)
{
    if (!(fabs(value - expected) <= relative * fabs(expected)))
        fail_msg("%.17g is not %.17g within %g", value, expected, relative);
}

/* The painted bubble: volumes are exact to the sub-cell accuracy of shapes. */
static void test_painted(void **state)
{
    (void)state;
    struct small small;
    struct measures *measures;
    double values[COUNT], radius = 0.5e-3, volume = 4.0 / 3.0 * M_PI * pow(radius, 3);
    start_case(&small);
    assert_int_equal(measure_new(small.state, &measures), 0);
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, values);
    close_to(values[V], volume, 1e-6);
    close_to(values[MASS_AIR], 1.2 * volume, 1e-6);
    close_to(values[RADIUS], radius, 1e-6);
    close_to(values[ABOVE], 0.5 * volume, 1e-6);
    assert_true(fabs(values[Z]) < 1e-9 * radius);
    close_to(values[R], 3.0 / 16.0 * M_PI * radius, 2e-3); /* a cut cell counts at its own centre */
    double h = 1e-3 / 32;
    close_to(values[PMAX], 1e5 + 1e8 * (1e-3 - 0.5 * h), 1e-9);
    close_to(values[PMIN], 1e5 - 1e8 * (1e-3 - 0.5 * h), 1e-6);
    close_to(values[PMEAN], 1e5 + 1e8 * 0.625e-3, 1e-9);
    close_to(values[SPEED], sqrt(5.0), 1e-3); /* a cut cell has that of the contact of two pressures */
    double water = M_PI * 1e-6 * 2e-3 - volume;
    close_to(values[MASS], 1000 * water + 1.2 * volume, 1e-9);
    close_to(values[PZ], 2 * 1000 * water - 3 * 1.2 * volume, 1e-4);
    close_to(values[JET], -3.0, 1e-9);
    assert_true(values[DEPTH] == 0.0);
    assert_true(isnan(values[NOTHING]));
    close_to(values[FLAT], 1e5 * 2e-6, 1e-4);   /* r counts like z; energies mix in cut cells */
    close_to(values[SKIN], values[WARM], 4e-3); /* not cooled by the zeros of water */
    assert_true(isnan(values[RATIO]));          /* left to history.c */
    measure_free(measures);
    small_stop(&small);
}

/* Gives the cell that holds x a fraction and a density of air, in both arrays. */
static void put_air(struct small *small, double x, double y, double alpha, double rho)
{
    const struct mesh *mesh = small->state->mesh;
    const struct model *model = small->state->model;
    size_t cell, n = mesh->n_cell;
    int l;
    unsigned tile;
    mesh_locate(mesh, (const double[3]){x, y, 0}, &l, &tile, &cell);
    for (int k = 0; k < 2; k++) {
        double *to = k ? mesh->levels[0].w[tile] : mesh->levels[0].u_old[tile];
        to[(model->i_alpha + 1) * n + cell] = alpha;
        to[model->i_alpha * n + cell] = 1.0 - alpha;
        to[(model->i_m + 1) * n + cell] = k ? rho : alpha * rho;
    }
}

/* Gas in name only has no part in what the gas is like: traces without mass, of 1e15 K at the pressure around them,
 * voids of 1e12 K; nor has a gas under tension (a temperature below 0). */
static void test_massless(void **state)
{
    (void)state;
    struct small small;
    struct measures *measures;
    double before[6], after[6];
    char *text = mem_print("%s%s", SMALL_AXISYMMETRIC,
                           "output: {history: {columns: {T: {mean: temperature_air, in: air},"
                           " T_max: {max: temperature_air, in: air}, T_min: {min: temperature_air},"
                           " T_all: {mean: temperature_air}, skin: {isosurface-max: temperature_air, in: water},"
                           " V: {volume: air}}}}\n");
    small_start(&small, text);
    assert_int_equal(measure_new(small.state, &measures), 0);
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, before);
    assert_true(before[0] > 280.0 && before[0] < 300.0 && before[1] < 310.0);
    close_to(before[3], before[0], 0.02); /* not of the zeros in water */
    for (int i = 0; i < 20; i++) put_air(&small, (0.6 + 0.015 * i) * 1e-3, 0.5e-3, 1e-11, 1e-20);
    for (int i = 0; i < 4; i++) put_air(&small, (0.6 + 0.05 * i) * 1e-3, 0.9e-3, 0.97, 1e-11);
    put_air(&small, 0.7e-3, 0.1e-3, 1e-4, 1e-2);
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, after);
    assert_true(after[5] > 1.001 * before[5]);                        /* voids are volume */
    for (int i = 0; i < 5; i++) close_to(after[i], before[i], 1e-12); /* but no gas */
    struct mesh *mesh = small.state->mesh;
    size_t n = mesh->n_cell, cell;
    int l;
    unsigned tile;
    mesh_locate(mesh, (const double[3]){0.1e-3, 0.1e-3, 0}, &l, &tile, &cell);
    mesh->levels[0].w[tile][small.state->model->i_E * n + cell] = -1e6;
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, after);
    close_to(after[0], before[0], 1e-3);
    close_to(after[2], before[2], 1e-12);
    measure_free(measures);
    small_stop(&small);
    mem_free(text);
}

/* Sets alpha of air to a smooth ball around (0, z) and the pressure to 1e5 + 1e12 y^2. */
static void make_ball(struct state *state, double radius, double z)
{
    const struct mesh *mesh = state->mesh;
    const struct model *model = state->model;
    const struct level *level = &mesh->levels[0];
    size_t n = mesh->n_cell;
    for (unsigned i = 0; i < level->n_local; i++)
        for (size_t cell = 0; cell < n; cell++) {
            double corner[3];
            mesh_corner(mesh, level, &level->tiles[level->first + i], corner);
            double x = corner[0] + ((double)(cell % 16) + 0.5) * level->h[0];
            double y = corner[1] + ((double)(cell / 16) + 0.5) * level->h[1];
            double alpha = 0.5 * (1.0 - tanh((hypot(x, y - z) - radius) / (2.0 * level->h[0])));
            for (int k = 0; k < 2; k++) {
                double *to = k ? level->w[i] : level->u_old[i];
                to[(model->i_alpha + 1) * n + cell] = alpha;
                to[model->i_alpha * n + cell] = 1.0 - alpha;
            }
            level->w[i][model->i_E * n + cell] = 1e5 + 1e12 * y * y;
        }
}

/* A surface that has moved, and a field on it whose mean is known: y^2 has R^2 / 3 on a sphere. */
static void test_surface(void **state)
{
    (void)state;
    struct small small;
    struct measures *measures;
    double values[COUNT], h = 1e-3 / 32, radius = 0.5e-3;
    start_case(&small);
    make_ball(small.state, radius, 0.0);
    assert_int_equal(measure_new(small.state, &measures), 0);
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, values);
    close_to(values[SURFACE], 1e5 + 1e12 * radius * radius / 3.0, 0.01);
    close_to(values[LEAST], 1e5, 0.01); /* at the equator, and at the poles */
    close_to(values[MOST], 1e5 + 1e12 * radius * radius, 0.01);
    assert_true(values[DEPTH] == 0.0);
    make_ball(small.state, radius, 0.1e-3);
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, values);
    assert_true(fabs(values[DEPTH] - 0.1e-3) < 0.05 * h);
    measure_free(measures);
    small_stop(&small);
}

/* Which end of a material counts: that of the piece which touches an end of the axis. */
static void test_crossing(void **state)
{
    (void)state;
    struct small small;
    struct measures *measures;
    double values[4];
    small_start(&small,
                "bulla: 1\ndomain: {lower: [0], upper: [1], cells: [40], boundaries: {x-: outflow, x+: outflow}}\n"
                "mesh: {tile: 8}\n" SMALL_MATERIALS
                "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                "  - {box: {lower: [0.5], upper: [0.75]}, material: air, density: 1, pressure: 1e5}\n"
                "run: {until: 1 ms}\n"
                "output: {history: {columns: {L: {volume: air}, a: {equivalent-radius: air},"
                " w: {penetration: water}, x: {centroid: air}}}}\n");
    assert_int_equal(measure_new(small.state, &measures), 0);
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, values);
    close_to(values[0], 0.25, 1e-12);
    close_to(values[1], 0.125, 1e-12);
    assert_true(values[2] == 0.0);
    close_to(values[3], 0.625, 1e-12);
    measure_free(measures);
    small_stop(&small);
}

/* Depths are counted into the material: a surface that moves up goes into what is above and out of what is below. */
static void test_depth(void **state)
{
    (void)state;
    struct small small;
    struct measures *measures;
    double values[3];
    small_start(&small,
                "bulla: 1\ndomain: {lower: [0], upper: [1], cells: [40], boundaries: {x-: outflow, x+: outflow}}\n"
                "mesh: {tile: 8}\n" SMALL_MATERIALS
                "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
                "  - {box: {lower: [0.5], upper: [1]}, material: air, density: 1, pressure: 1e5}\n"
                "run: {until: 1 ms}\n"
                "output: {history: {columns: {w: {penetration: water}, a: {penetration: air, along: x},"
                " p: {plane-integral: pressure, in: air}}}}\n");
    assert_int_equal(measure_new(small.state, &measures), 0);
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, values);
    assert_true(values[0] == 0.0 && values[1] == 0.0);
    close_to(values[2], 0.5e5, 1e-12);
    const struct level *level = &small.state->mesh->levels[0];
    for (unsigned i = 0; i < level->n_local; i++)
        for (size_t cell = 0; cell < 8; cell++) {
            double x = (8 * level->tiles[level->first + i].at[0] + (double)cell + 0.5) / 40;
            level->u_old[i][8 + cell] = x < 0.57 ? 0.0 : x < 0.6 ? 0.75 : 1.0; /* air */
            level->u_old[i][cell] = 1.0 - level->u_old[i][8 + cell];
        }
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, values);
    double moved = 0.5875 - 0.025 / 3.0 - 0.5; /* between the centres 0.5625 (0) and 0.5875 (0.75) */
    close_to(values[1], moved, 1e-12);
    close_to(values[0], -moved, 1e-12);
    measure_free(measures);
    small_stop(&small);
}

/* Rows as they must stand in the file; each step once; values from the columns before. */
static void test_file(void **state)
{
    (void)state;
    struct small small;
    struct history *history;
    start_case(&small);
    assert_int_equal(history_new(small.state, &history), 0);
    for (int i = 0; i < 4; i++, small_skip(&small, 0.125)) {
        assert_int_equal(history_write(history, small.state, SMALL_NOW(small.state)), 0);
        assert_int_equal(history_write(history, small.state, SMALL_NOW(small.state)), 0);
    }
    history_free(history);
    char *text = small_text(&small, "history.csv");
    assert_non_null(strstr(text, "step,t,dt,V,m,R,z,r,above,pmax,pmin,pmean,speed,mass,pz,jet,depth,surface,least,most,"
                                 "flat,skin,warm,nothing,ratio,"
                                 "guard_fallback,guard_relaxed,guard_clipped,guard_retries\n0,0,"));
    assert_non_null(strstr(text, "\n3,0.375,0.125,"));
    assert_null(strstr(text, "\n4,"));
    assert_non_null(strstr(text, ",nan,"));
    int rows = 0;
    for (const char *at = text; *at; at++) rows += *at == '\n';
    assert_int_equal(rows, 5);
    const char *last = strstr(text, "\n3,") + 1;
    double cells[3 + COUNT];
    for (int i = 0; i < 3 + COUNT; i++, last = strchr(last, ',') + 1) cells[i] = strtod(last, NULL);
    close_to(cells[3 + RATIO], cells[3 + ABOVE] / cells[3 + V] + 0.375, 1e-15);
    mem_free(text);
    small_stop(&small);
}

/* A run that is taken up at step 1 forgets the rows after it, and a row that was cut short. */
static void test_resume(void **state)
{
    (void)state;
    struct small small;
    struct history *history;
    start_case(&small);
    assert_int_equal(history_new(small.state, &history), 0);
    for (int i = 0; i < 4; i++, small_skip(&small, 0.125))
        assert_int_equal(history_write(history, small.state, SMALL_NOW(small.state)), 0);
    history_free(history);
    char *path = small_path(&small, "history.csv");
    FILE *stream = fopen(path, "a");
    fputs("4,0.5,0.12", stream);
    fclose(stream);
    small.state->step = 1;
    small.state->t = 0.125;
    assert_int_equal(history_new(small.state, &history), 0);
    small_skip(&small, 0.25);
    assert_int_equal(history_write(history, small.state, SMALL_NOW(small.state)), 0);
    history_free(history);
    char *text = small_text(&small, "history.csv");
    assert_non_null(strstr(text, "\n1,0.125,"));
    assert_non_null(strstr(text, "\n2,0.375,0.25,"));
    assert_null(strstr(text, "\n3,"));
    assert_null(strstr(text, "\n4,"));
    mem_free(text);
    mem_free(path);
    small_stop(&small);
}

static void test_failure(void **state)
{
    (void)state;
    struct small small;
    struct history *history;
    start_case(&small);
    char *folder = small_path(&small, ""), *path = small_path(&small, "history.csv");
    assert_int_equal(history_new(small.state, &history), 0);
    history_free(history);
    assert_int_equal(remove(path), 0);
    assert_int_equal(symlink("/dev/full", path), 0);
    assert_int_equal(history_new(small.state, &history), STATUS_RUN);
    assert_non_null(strstr(status_text(), "history.csv: cannot write: No space left"));
    mem_free(path);
    mem_free(folder);
    small_stop(&small);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_painted), cmocka_unit_test(test_surface),  cmocka_unit_test(test_crossing),
        cmocka_unit_test(test_depth),   cmocka_unit_test(test_file),     cmocka_unit_test(test_resume),
        cmocka_unit_test(test_failure), cmocka_unit_test(test_massless),
    };
    if (registry_init()) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
