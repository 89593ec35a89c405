/* levels_io.c - what histories and ledgers say of a mesh of three levels: every place counts once, with its finest
 * cell. Cells under finer ones hold nonsense wherever nobody may look at them. */
#include "io/h5in.h"
#include "io/info.h"
#include "io/ledger.h"
#include "io/measure.h"
#include "io/read.h"
#include "io/snapshot.h"
#include "judge/norm.h"
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
    assert_int_equal(small->scene->output.n_column, COUNT);
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
    close_to(values[SPEED], sqrt(5.0), 1e-3); /* a cut cell has that of the contact of two pressures */
    close_to(values[MASS], 1000 * water + 1.2 * volume, 1e-9);
    close_to(values[PZ], 2 * 1000 * water - 3 * 1.2 * volume, 1e-4);
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
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, values);
    expect_painted(values);
    refine(&small);
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, values);
    expect_painted(values);
    levels_spoil(small.state);
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, values);
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
        if (fabs(coarse.total[q]) > 0.0) close_to(fine.total[q], coarse.total[q], 1e-4); /* cut cells hold contacts */
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
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, values);
    assert_true(fabs(values[SURFACE] - 1e5) < 0.01 * 1e8 * radius);
    assert_true(values[DEPTH] == 0.0);
    make_ball(small.state, radius, 0.1e-3);
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, values);
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
    measure_take(measures, small.state, SMALL_NOW(small.state), NULL, values);
    assert_true(values[DEPTH] == 0.0);
    measure_free(measures);
    small_stop(&small);
}

/* Points of a plot file in the order of their places. */
static int compare_points(const void *a, const void *b)
{
    const double *x = a, *y = b;
    for (int axis = 0; axis < 3; axis++)
        if (fabs(x[axis] - y[axis]) > 1e-12) return x[axis] < y[axis] ? -1 : 1;
    return 0;
}

/* No two points in one place, none that nobody uses; n_point of them. */
static void expect_points(const char *path, size_t n_cell, int dim, size_t n_point)
{
    struct h5 *file;
    size_t rows, corners = n_cell << dim;
    unsigned wide;
    assert_int_equal(h5_open(path, &file), 0);
    assert_int_equal(h5in_shape(file, "/VTKHDF/Points", &rows, &wide), 0);
    assert_int_equal(rows, n_point);
    double(*x)[3] = mem_new(rows, sizeof *x), *ids = mem_new(corners, sizeof *ids);
    char *used = mem_new(rows, 1);
    assert_int_equal(h5in_read(file, "/VTKHDF/Points", *x), 0);
    assert_int_equal(h5in_read(file, "/VTKHDF/Connectivity", ids), 0);
    for (size_t i = 0; i < corners; i++) used[(size_t)ids[i]] = 1;
    for (size_t i = 0; i < rows; i++) assert_true(used[i]);
    qsort(x, rows, sizeof *x, compare_points);
    for (size_t i = 1; i < rows; i++) assert_true(compare_points(x[i - 1], x[i]) < 0);
    mem_free(used);
    mem_free(ids);
    mem_free(x);
    h5_abandon(file);
}

/* Cells fill the domain, each at its level's width and with the values of its leaf. */
static void expect_cells(const struct snapshot *snapshot, const struct state *state)
{
    const struct mesh *mesh = state->mesh;
    const struct snapshot_field *density = read_field(snapshot, "density"), *level = read_field(snapshot, "level");
    double volume = 0.0, domain = 1.0;
    size_t in_tiles = 0;
    for (int axis = 0; axis < mesh->dim; axis++) domain *= mesh->upper[axis] - mesh->lower[axis];
    for (size_t i = 0; i < snapshot->n_tile; i++) in_tiles += snapshot->tiles[i].n_cell;
    assert_int_equal(in_tiles, snapshot->n_cell);
    for (size_t i = 0; i < snapshot->n_cell; i++) {
        double size = 1.0, x[3] = {0}, rho = 0.0;
        int l;
        size_t cell;
        for (int axis = 0; axis < mesh->dim; axis++) {
            x[axis] = 0.5 * (snapshot->lower[i][axis] + snapshot->upper[i][axis]);
            size *= snapshot->upper[i][axis] - snapshot->lower[i][axis];
        }
        volume += size;
        unsigned at;
        assert_true(mesh_locate(mesh, x, &l, &at, &cell));
        const double *w = mesh->levels[l].w[at];
        for (unsigned m = 0; m < 2; m++)
            rho +=
                w[(state->model->i_alpha + m) * mesh->n_cell + cell] * w[(state->model->i_m + m) * mesh->n_cell + cell];
        assert_true(level->data[i] == l);
        assert_true(density->data[i] == rho);
        close_to(snapshot->upper[i][0] - snapshot->lower[i][0], mesh->levels[l].h[0], 1e-9);
    }
    close_to(volume, domain, 1e-12);
}

/* Corners of leaves, counted by brute force on the finest lattice. */
static size_t count_points(const struct snapshot *snapshot, int dim)
{
    size_t n = snapshot->n_cell << dim, count = 1;
    double(*x)[3] = mem_new(n, sizeof *x);
    for (size_t i = 0; i < snapshot->n_cell; i++)
        for (size_t c = 0; c < (size_t)1 << dim; c++)
            for (int axis = 0; axis < dim; axis++)
                x[(i << dim) + c][axis] = (c >> axis & 1 ? snapshot->upper : snapshot->lower)[i][axis];
    qsort(x, n, sizeof *x, compare_points);
    for (size_t i = 1; i < n; i++) count += compare_points(x[i - 1], x[i]) != 0;
    mem_free(x);
    return count;
}

static void expect_file(struct small *small)
{
    struct snapshots *snapshots;
    struct snapshot *snapshot;
    assert_int_equal(snapshot_new(small->state, &snapshots), 0);
    assert_int_equal(snapshot_write(snapshots, small->state, SMALL_NOW(small->state), "{}"), 0);
    snapshot_free(snapshots);
    char *path = small_path(small, "fields/tiny_000000.hdf");
    int code = read_snapshot(path, NULL, &snapshot), dim = small->state->mesh->dim;
    if (code) print_error("%s\n", status_text());
    assert_int_equal(code, 0);
    assert_int_equal(snapshot->n_level, 3);
    expect_cells(snapshot, small->state);
    expect_points(path, snapshot->n_cell, dim, count_points(snapshot, dim));
    read_free(snapshot);
    mem_free(path);
}

/* What `bulla info` says of the levels. */
static void expect_info(const struct small *small)
{
    char *path = small_path(small, "fields/tiny_000000.hdf"), *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_int_equal(info_print(out, path), 0);
    fclose(out);
    assert_non_null(strstr(text, "\nlevels    3\n  0       8 tiles (2 under finer ones), 1024 cells, 3.125e-05 m wide\n"
                                 "  1       16 tiles (0 under finer ones), 3520 cells, 1.5625e-05 m wide\n"));
    free(text);
    mem_free(path);
}

#define FIELDS "output: {snapshots: {every: 1 us, precision: double, fields: [density, level, velocity]}}\n"

static void test_file(void **state)
{
    (void)state;
    struct small small;
    small_start_levels(&small, SMALL_AXISYMMETRIC FIELDS, 2);
    refine(&small);
    levels_spoil(small.state);
    expect_file(&small);
    expect_info(&small);
    small_stop(&small);
}

static bool left(const double *x)
{
    return x[0] < 0.9;
}

static bool middle(const double *x)
{
    return x[0] > 0.3 && x[0] < 0.6;
}

static void test_file_line(void **state)
{
    (void)state;
    struct small small;
    small_start_levels(
        &small,
        "bulla: 1\ndomain: {lower: [0], upper: [1], cells: [40], boundaries: {x-: outflow, x+: outflow}}\n"
        "mesh: {tile: 8}\n" SMALL_MATERIALS
        "initial: [{everywhere: true, material: air, density: = 1 + x, pressure: 1e5}]\n"
        "run: {until: 1 ms}\n" FIELDS,
        2);
    levels_add(small.state, left);
    levels_add(small.state, middle);
    expect_file(&small);
    small_stop(&small);
}

static bool corner(const double *x)
{
    return x[0] + x[1] + x[2] < 3.0 || x[0] > 2.4; /* x is periodic */
}

static bool deep(const double *x)
{
    return x[0] + x[1] + x[2] < 1.0;
}

static void test_file_volume(void **state)
{
    (void)state;
    struct small small;
    small_start_levels(
        &small,
        "bulla: 1\ndomain:\n  lower: [0, 0, 0]\n  upper: [3, 2, 1]\n  cells: [12, 8, 4]\n"
        "  boundaries: {x-: periodic, x+: periodic, y-: outflow, y+: outflow, z-: outflow, z+: outflow}\n"
        "mesh: {tile: 4}\n" SMALL_MATERIALS
        "initial: [{everywhere: true, material: air, density: = 1 + x, pressure: 1e5}]\n"
        "run: {until: 1 ms}\n" FIELDS,
        2);
    levels_add(small.state, corner);
    levels_add(small.state, deep);
    expect_file(&small);
    small_stop(&small);
}

static bool inside(const double *x)
{
    return fabs(x[0] - 0.5) < 0.3 && fabs(x[1] - 0.5) < 0.3;
}

static bool core(const double *x)
{
    return fabs(x[0] - 0.5) < 0.13 && fabs(x[1] - 0.5) < 0.13;
}

/* Linear fields have the same gradients on all levels and at all faces between them. */
static void test_gradients(void **state)
{
    (void)state;
    struct small small;
    struct derive vorticity, schlieren;
    small_start_levels(&small,
                       "bulla: 1\ndomain: {lower: [0, 0], upper: [1, 1], cells: [32, 32],\n"
                       "  boundaries: {x-: outflow, x+: outflow, y-: outflow, y+: outflow}}\n"
                       "mesh: {tile: 8}\nmaterials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}\n"
                       "initial: [{everywhere: true, material: air, density: = 1 + x + 2 * y, pressure: 1e5,"
                       " velocity: [= -3 * y, = 3 * x]}]\nrun: {until: 1 ms}\n",
                       2);
    levels_add(small.state, inside);
    levels_add(small.state, core);
    const struct mesh *mesh = small.state->mesh;
    double *out = mem_new(3 * mesh->n_cell, sizeof *out), *leaf = mem_new(mesh->n_cell, sizeof *leaf);
    for (int l = 0; l < 3; l++) /* primitives of averages of u are not linear: those of the field are */
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++)
            for (size_t i = 0; i < mesh->n_cell; i++) {
                double corner[3], *w = mesh->levels[l].w[t];
                mesh_corner(mesh, &mesh->levels[l], &mesh->levels[l].tiles[t], corner);
                double x = corner[0] + ((double)(i % 8) + 0.5) * mesh->levels[l].h[0];
                double y = corner[1] + ((double)(i / 8) + 0.5) * mesh->levels[l].h[1];
                w[small.state->model->i_u * mesh->n_cell + i] = -3.0 * y;
                w[(small.state->model->i_u + 1) * mesh->n_cell + i] = 3.0 * x;
            }
    int hidden = mesh_find(mesh, &mesh->levels[0], (const int[]){1, 1, 0});
    mesh->levels[0].w[hidden][63] = 1e6; /* in the middle: nobody has it beside him */
    assert_int_equal(derive_find(small.state->model, "vorticity", &vorticity), 0);
    assert_int_equal(derive_find(small.state->model, "schlieren", &schlieren), 0);
    struct derive_moment moment = derive_moment(small.state->model, mesh, 0.0);
    derive_prepare(&moment, &vorticity);
    derive_prepare(&moment, &schlieren);
    close_to(schlieren.scale, sqrt(5.0), 1e-9);
    for (int l = 0; l < 3; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++) {
            const struct tile *tile = &mesh->levels[l].tiles[t];
            derive_tile(small.state->model, mesh, l, t, 0.0, &vorticity, out);
            mesh_leaves(mesh, tile, leaf);
            for (size_t i = 0; i < mesh->n_cell; i++) {
                int x = tile->at[0] * 8 + (int)(i % 8), y = tile->at[1] * 8 + (int)(i / 8), last = (32 << l) - 1;
                bool edge = x == 0 || y == 0 || x == last || y == last; /* one-sided there */
                if (leaf[i] > 0.0 && !edge) close_to(out[2 * mesh->n_cell + i], 6.0, 1e-9);
            }
        }
    mem_free(leaf);
    mem_free(out);
    small_stop(&small);
}

#define LINE                                                                                            \
    "bulla: 1\ndomain: {lower: [0], upper: [1], cells: [40], boundaries: {x-: outflow, x+: outflow}}\n" \
    "mesh: {tile: 8}\nmaterials: {air: {eos: {type: ideal-gas, gamma: 1.4}}}\n"                         \
    "initial: [{everywhere: true, material: air, density: = 1 + x, pressure: 1e5}]\nrun: {until: 1 ms}\n" FIELDS

/* Errors count by the size of cells: a tenth too much in the finest cells, which fill a part of the domain. */
static void test_norms(void **state)
{
    (void)state;
    struct small small;
    struct snapshots *snapshots;
    double part = 0.0, norm;
    small_start_levels(&small, LINE, 2);
    assert_int_equal(snapshot_new(small.state, &snapshots), 0);
    assert_int_equal(snapshot_write(snapshots, small.state, SMALL_NOW(small.state), "{}"), 0);
    levels_add(small.state, left);
    levels_add(small.state, middle);
    struct level *finest = &small.state->mesh->levels[2];
    for (unsigned t = 0; t < finest->n_tile; t++)
        for (size_t i = 0; i < 8; i++, part += finest->h[0]) finest->w[t][i] += 0.1;
    assert_true(part > 0.2 && part < 0.5);
    small_skip(&small, 1e-3);
    assert_int_equal(snapshot_write(snapshots, small.state, SMALL_NOW(small.state), "{}"), 0);
    snapshot_free(snapshots);
    char kind[] = "L1", field[] = "density", initial[] = "initial", *out = small_path(&small, "");
    char *profile = small_path(&small, "profile.csv");
    FILE *file = fopen(profile, "w");
    fputs("x,density\n0,1\n1,2\n", file);
    fclose(file);
    struct scene_expect expect = {.norm = kind, .field = field, .reference = profile, .scale = 1.0};
    assert_int_equal(norm_of_field(small.scene, &expect, out, &norm), 0);
    close_to(norm, 0.1 * part, 1e-9);
    expect.reference = initial;
    assert_int_equal(norm_of_field(small.scene, &expect, out, &norm), 0);
    close_to(norm, 0.1 * part, 1e-9);
    mem_free(profile);
    mem_free(out);
    small_stop(&small);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_measures),    cmocka_unit_test(test_ledger),    cmocka_unit_test(test_surface),
        cmocka_unit_test(test_crossing),    cmocka_unit_test(test_file),      cmocka_unit_test(test_file_line),
        cmocka_unit_test(test_file_volume), cmocka_unit_test(test_gradients), cmocka_unit_test(test_norms),
    };
    if (registry_init()) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
