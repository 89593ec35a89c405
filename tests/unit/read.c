/* read.c - snapshots back in memory, `bulla info`, and files that are none. */
#include "io/read.h"

#include "io/info.h"
#include "io/snapshot.h"
#include "mesh/metric.h"
#include "small.h"

#include <hdf5.h>
#include <math.h>
#include <sys/stat.h>

static void write_snapshot(struct small *small, const char *text)
{
    struct snapshots *snapshots;
    small_start(small, text);
    assert_int_equal(snapshot_new(small->state, &snapshots), 0);
    assert_int_equal(snapshot_write(snapshots, small->state, SMALL_NOW(small->state), "{\"ranks\": 1}"), 0);
    snapshot_free(snapshots);
}

/* Cells are where the mesh has them, fields are what derive gives, exactly in float64. */
static void expect_state(const struct snapshot *snapshot, const struct state *state)
{
    const struct mesh *mesh = state->mesh;
    const struct level *level = &mesh->levels[0];
    double *values = mem_new(3 * mesh->n_cell, sizeof *values);
    for (unsigned f = 0; f < snapshot->n_field; f++) {
        struct derive field;
        assert_int_equal(derive_find(state->model, snapshot->fields[f].name, &field), 0);
        assert_string_equal(snapshot->fields[f].unit, field.unit);
        assert_int_equal(snapshot->fields[f].components, field.components);
        derive_prepare(SMALL_NOW(state), &field);
        for (unsigned i = 0; i < level->n_local; i++) {
            derive_tile(state->model, mesh, 0, i, state->t, &field, values);
            for (size_t cell = 0; cell < mesh->n_cell; cell++)
                for (unsigned q = 0; q < field.components; q++)
                    assert_true(snapshot->fields[f].data[(i * mesh->n_cell + cell) * field.components + q] ==
                                values[q * mesh->n_cell + cell]);
        }
    }
    for (unsigned i = 0; i < level->n_tile; i++)
        for (size_t cell = 0; cell < mesh->n_cell; cell++) {
            double corner[3];
            size_t row = i * mesh->n_cell + cell;
            mesh_corner(mesh, level, &level->tiles[i], corner);
            const size_t at[2] = {cell % (size_t)mesh->n[0], cell / (size_t)mesh->n[0]};
            for (int axis = 0; axis < 2; axis++) {
                double h = level->h[axis];
                assert_true(fabs(snapshot->lower[row][axis] - (corner[axis] + (double)at[axis] * h)) < 1e-9 * h);
                assert_true(fabs(snapshot->upper[row][axis] - snapshot->lower[row][axis] - h) < 1e-9 * h);
            }
            assert_true(snapshot->lower[row][2] == 0.0 && snapshot->upper[row][2] == 0.0);
        }
    mem_free(values);
}

static void test_round_trip(void **state)
{
    (void)state;
    struct small small;
    struct snapshot *snapshot;
    write_snapshot(&small, SMALL_AXISYMMETRIC "output: {snapshots: {every: 1 us, precision: double,"
                                              " fields: [density, velocity, pressure, alpha_air]}}\n");
    char *path = small_path(&small, "fields/tiny_000000.hdf");
    int code = read_snapshot(path, NULL, &snapshot);
    if (code) print_error("%s\n", status_text());
    assert_int_equal(code, 0);
    assert_string_equal(snapshot->title, "A bubble, half of it");
    assert_string_equal(snapshot->name, "tiny");
    assert_string_equal(snapshot->version, BULLA_VERSION);
    assert_int_equal(snapshot->dim, 2);
    assert_int_equal(snapshot->beta, 1);
    assert_int_equal(snapshot->step, 0);
    assert_true(snapshot->time == 0.0);
    assert_int_equal(snapshot->n_cell, 2048);
    assert_true(snapshot->domain[0][1] == -1e-3 && snapshot->domain[1][0] == 1e-3);
    assert_int_equal(snapshot->n_material, 2);
    assert_string_equal(snapshot->materials[0], "water");
    assert_string_equal(snapshot->materials[1], "air");
    assert_int_equal(snapshot->n_field, 4);
    assert_true(read_field(snapshot, "alpha_air")->least == 0.0);
    assert_true(read_field(snapshot, "alpha_air")->most == 1.0);
    assert_true(fabs(read_field(snapshot, "velocity")->most - 3.0) < 1e-9);
    assert_null(read_field(snapshot, "mach"));
    expect_state(snapshot, small.state);
    read_free(snapshot);
    mem_free(path);
    small_stop(&small);
}

static void test_names(void **state)
{
    (void)state;
    struct small small;
    struct snapshot *snapshot;
    const char *wanted[] = {"pressure", NULL}, *wrong[] = {"presure", NULL};
    write_snapshot(&small, SMALL_AXISYMMETRIC "output: {snapshots: {every: 1 us, fields: [density, pressure]}}\n");
    char *path = small_path(&small, "fields/tiny_000000.hdf");
    assert_int_equal(read_snapshot(path, wanted, &snapshot), 0);
    assert_int_equal(snapshot->n_field, 1);
    assert_string_equal(snapshot->fields[0].name, "pressure");
    read_free(snapshot);
    assert_int_equal(read_snapshot(path, wrong, &snapshot), STATUS_CASE);
    assert_non_null(strstr(status_text(), "no field 'presure' (did you mean 'pressure'?); it has: density, pressure"));
    mem_free(path);
    small_stop(&small);
}

static void test_info(void **state)
{
    (void)state;
    struct small small;
    char text[2048] = "";
    write_snapshot(&small, SMALL_AXISYMMETRIC "output: {snapshots: {every: 1 us, fields: [density, velocity]}}\n");
    char *path = small_path(&small, "fields/tiny_000000.hdf");
    FILE *out = fmemopen(text, sizeof text, "w");
    assert_int_equal(info_print(out, path), 0);
    fclose(out);
    assert_non_null(strstr(text, "tiny: A bubble, half of it\n"));
    assert_non_null(strstr(text, "2D axisymmetric (x = r, y = z), [0, 0.001] x [-0.001, 0.001] m"));
    assert_non_null(strstr(text, "cells     2048, 3.125e-05 m wide"));
    assert_non_null(strstr(text, "materials water, air"));
    assert_non_null(strstr(text, "density   kg/m3"));
    assert_non_null(strstr(text, "(magnitude)"));
    mem_free(path);
    small_stop(&small);
}

static void expect_refused(const char *path, const char *reason)
{
    struct snapshot *snapshot;
    assert_int_equal(read_snapshot(path, NULL, &snapshot), STATUS_RUN);
    if (!strstr(status_text(), path) || !strstr(status_text(), reason))
        fail_msg("'%s' names not %s or not %s", status_text(), path, reason);
}

/* Every truncation and every missing piece is an error with the file's name, never a crash. */
static void test_broken(void **state)
{
    (void)state;
    struct small small;
    static const char *const pieces[] = {"/VTKHDF/Types", "/VTKHDF/Points", "/VTKHDF/Connectivity", "/VTKHDF/CellData",
                                         "/bulla"};
    write_snapshot(&small, SMALL_AXISYMMETRIC);
    char *path = small_path(&small, "fields/tiny_000000.hdf"), *copy = small_path(&small, "copy.hdf"), *command;
    expect_refused("/nowhere/x.hdf", "No such file");
    expect_refused("CMakeLists.txt", "not an HDF5 file");
    struct stat info;
    assert_int_equal(stat(path, &info), 0);
    for (long size = 0; size < info.st_size; size += 4999) {
        command = mem_print("head -c %ld '%s' > '%s'", size, path, copy);
        assert_int_equal(system(command), 0);
        expect_refused(copy, size < 8 ? "not an HDF5 file" : "truncated");
        mem_free(command);
    }
    for (size_t i = 0; i < sizeof pieces / sizeof *pieces; i++) {
        command = mem_print("cp '%s' '%s'", path, copy);
        assert_int_equal(system(command), 0);
        mem_free(command);
        hid_t file = H5Fopen(copy, H5F_ACC_RDWR, H5P_DEFAULT);
        assert_true(H5Ldelete(file, pieces[i], H5P_DEFAULT) >= 0);
        H5Fclose(file);
        expect_refused(copy, i < 4 ? pieces[i] : "no group /bulla");
    }
    hid_t file = H5Fcreate(copy, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(file);
    expect_refused(copy, "not a snapshot of bulla");
    mem_free(copy);
    mem_free(path);
    small_stop(&small);
}

static void test_no_series(void **state)
{
    (void)state;
    struct snapshot_series series;
    assert_int_equal(read_series("tests", &series), STATUS_RUN);
    assert_non_null(strstr(status_text(), "tests/fields: no list of snapshots"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip), cmocka_unit_test(test_names),     cmocka_unit_test(test_info),
        cmocka_unit_test(test_broken),     cmocka_unit_test(test_no_series),
    };
    if (registry_init()) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
