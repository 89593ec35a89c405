/* snapshot.c - plot files object by object: the layout that ParaView and yt were seen to open. With two
 * files as arguments: do they hold the same numbers (but for ranks and provenance)? */
#include "io/snapshot.h"

#include "base/text.h"
#include "io/read.h"
#include "small.h"
#include "solve/advance.h"

#include <hdf5.h>
#include <math.h>
#include <sys/stat.h>
#include <unistd.h>

/* One object: "/VTKHDF/Points f8 [2145,3]"; "+" marks virtual data. */
static herr_t note(hid_t file, const char *name, const H5O_info_t *info, void *context)
{
    struct text *list = context;
    if (info->type == H5O_TYPE_GROUP) {
        text_add(list, "%s/\n", strcmp(name, ".") ? name : "");
        return 0;
    }
    hid_t set = H5Dopen2(file, name, H5P_DEFAULT), type = H5Dget_type(set), space = H5Dget_space(set);
    hid_t layout = H5Dget_create_plist(set);
    hsize_t extent[3] = {0};
    int rank = H5Sget_simple_extent_dims(space, extent, NULL);
    H5T_class_t kind = H5Tget_class(type);
    const char *letter = kind == H5T_FLOAT ? "f" : kind == H5T_COMPOUND ? "record" : kind == H5T_STRING ? "text" : "i";
    text_add(list, "%s %s%zu", name, letter, kind == H5T_STRING ? 0 : H5Tget_size(type));
    for (int i = 0; i < rank; i++) text_add(list, " %llu", (unsigned long long)extent[i]);
    text_add(list, H5Pget_layout(layout) == H5D_VIRTUAL ? " +\n" : "\n");
    H5Pclose(layout);
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(set);
    return 0;
}

static void list_objects(const char *path, struct text *list)
{
    hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(file >= 0);
    H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, note, list, H5O_INFO_BASIC);
    H5Fclose(file);
}

static void write_one(struct small *small, const char *text, const char *objects)
{
    struct snapshots *snapshots;
    struct text list = {0};
    small_start(small, text);
    assert_int_equal(snapshot_new(small->state, &snapshots), 0);
    int code = snapshot_write(snapshots, small->state, SMALL_NOW(small->state), "{}");
    if (code) print_error("%s\n", status_text());
    assert_int_equal(code, 0);
    snapshot_free(snapshots);
    char *path = small_path(small, "fields/tiny_000000.hdf");
    list_objects(path, &list);
    assert_string_equal(list.at, objects);
    text_done(&list);
    mem_free(path);
}

static hid_t open_file(const struct small *small, const char *name)
{
    char *path = small_path(small, name);
    hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(file >= 0);
    mem_free(path);
    return file;
}

static void read_numbers(hid_t file, const char *name, hid_t type, void *out)
{
    hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
    assert_true(set >= 0);
    assert_true(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, out) >= 0);
    H5Dclose(set);
}

static double attribute(hid_t file, const char *object, const char *name, int class, size_t size)
{
    double value = NAN;
    hid_t found = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(found >= 0);
    hid_t type = H5Aget_type(found);
    assert_int_equal(H5Tget_class(type), class);
    assert_int_equal(H5Tget_size(type), size);
    assert_true(H5Aread(found, H5T_NATIVE_DOUBLE, &value) >= 0);
    H5Tclose(type);
    H5Aclose(found);
    return value;
}

static void expect_text(hid_t file, const char *object, const char *name, const char *expected)
{
    char text[256] = "";
    hid_t found = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(found >= 0);
    hid_t type = H5Aget_type(found);
    assert_int_equal(H5Tget_class(type), H5T_STRING);
    assert_int_equal(H5Tis_variable_str(type), 0);
    assert_int_equal(H5Tget_size(type), strlen(expected));
    assert_int_equal(H5Tget_strpad(type), H5T_STR_NULLPAD);
    assert_true(H5Aread(found, type, text) >= 0);
    assert_string_equal(text, expected);
    H5Tclose(type);
    H5Aclose(found);
}

/* The corners of every cell are where the cell is, in VTK's order, and no point is there twice. */
static void expect_grid(hid_t file, int dim, size_t n_cell, size_t n_point)
{
    size_t corners = (size_t)1 << dim;
    double(*x)[3] = mem_new(n_point, sizeof *x);
    int32_t *ids = mem_new(n_cell * corners, sizeof *ids), *offsets = mem_new(n_cell + 1, sizeof *offsets);
    char *used = mem_new(n_point, 1);
    read_numbers(file, "VTKHDF/Points", H5T_NATIVE_DOUBLE, x);
    read_numbers(file, "VTKHDF/Connectivity", H5T_NATIVE_INT32, ids);
    read_numbers(file, "VTKHDF/Offsets", H5T_NATIVE_INT32, offsets);
    static const int turn[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const double *first = x[ids[0]];
    double h = x[ids[1]][0] - first[0];
    for (size_t cell = 0; cell < n_cell; cell++) {
        assert_int_equal(offsets[cell], cell * corners);
        for (size_t c = 0; c < corners; c++) {
            const double *here = x[ids[cell * corners + c]], *base = x[ids[cell * corners]];
            used[ids[cell * corners + c]] = 1;
            for (int axis = 0; axis < 3; axis++)
                assert_true(fabs(here[axis] - base[axis] - turn[c][axis] * h) < 1e-9 * h);
        }
    }
    assert_int_equal(offsets[n_cell], n_cell * corners);
    for (size_t i = 0; i < n_point; i++) assert_true(used[i]);
    for (size_t i = 0; i < n_point; i++)
        for (size_t k = i + 1; k < n_point; k++) /* shared points are one point */
            if (fabs(x[i][0] - x[k][0]) + fabs(x[i][1] - x[k][1]) + fabs(x[i][2] - x[k][2]) < 0.5 * h)
                fail_msg("points %zu and %zu are in one place", i, k);
    mem_free(used);
    mem_free(offsets);
    mem_free(ids);
    mem_free(x);
}

static void test_axisymmetric(void **state)
{
    (void)state;
    struct small small;
    write_one(&small, SMALL_AXISYMMETRIC "output: {snapshots: {every: 1 us, fields: [density, velocity, alpha_air]}}\n",
              "/\nChombo_global/\nVTKHDF/\nVTKHDF/CellData/\nVTKHDF/CellData/alpha_air f4 2048\n"
              "VTKHDF/CellData/density f4 2048\nVTKHDF/CellData/velocity f4 2048 3\nVTKHDF/Connectivity i4 8192\n"
              "VTKHDF/FieldData/\nVTKHDF/FieldData/TimeValue f8 1\nVTKHDF/NumberOfCells i8 1\n"
              "VTKHDF/NumberOfConnectivityIds i8 1\nVTKHDF/NumberOfPoints i8 1\nVTKHDF/Offsets i4 2049\n"
              "VTKHDF/PointData/\nVTKHDF/Points f8 2145 3\nVTKHDF/Types i1 2048\nbulla/\nbulla/blocks i4 8 6\n"
              "bulla/case.yaml text0\nbulla/provenance.json text0\nlevel_0/\nlevel_0/boxes record16 8\n"
              "level_0/data:datatype=0 f4 10240 +\nlevel_0/data:offsets=0 i8 9\nlevel_0/data_attributes/\n");
    hid_t file = open_file(&small, "fields/tiny_000000.hdf");
    expect_text(file, "VTKHDF", "Type", "UnstructuredGrid");
    expect_text(file, "VTKHDF/CellData/velocity", "units", "m/s");
    expect_text(file, ".", "component_2", "velocity_y");
    expect_text(file, "level_0/data_attributes", "objectType", "FArrayBox");
    expect_text(file, "bulla", "materials", "water,air");
    expect_text(file, "bulla", "title", "A bubble, half of it");
    assert_true(attribute(file, ".", "num_components", H5T_INTEGER, 4) == 5);
    assert_true(attribute(file, ".", "num_levels", H5T_INTEGER, 4) == 1);
    assert_true(attribute(file, ".", "max_level", H5T_INTEGER, 4) == 0);
    assert_true(attribute(file, ".", "iteration", H5T_INTEGER, 4) == 0);
    assert_true(attribute(file, ".", "time", H5T_FLOAT, 8) == 0);
    assert_true(attribute(file, "Chombo_global", "SpaceDim", H5T_INTEGER, 4) == 2);
    assert_true(attribute(file, "level_0", "ref_ratio", H5T_INTEGER, 4) == 2);
    assert_true(attribute(file, "level_0", "dx", H5T_FLOAT, 8) == small.state->mesh->levels[0].h[0]);
    assert_true(attribute(file, "level_0/data_attributes", "comps", H5T_INTEGER, 4) == 5);
    expect_grid(file, 2, 2048, 2145);
    unsigned char types[2048];
    read_numbers(file, "VTKHDF/Types", H5T_NATIVE_UCHAR, types);
    for (int i = 0; i < 2048; i++) assert_int_equal(types[i], 9);
    H5Fclose(file);
    small_stop(&small);
}

/* The Chombo view: boxes of 16 x 16 in the order of the tiles, components one after the other. */
static void test_view(void **state)
{
    (void)state;
    struct small small;
    struct snapshots *snapshots;
    small_start(&small, SMALL_AXISYMMETRIC "output: {snapshots: {every: 1 us, fields: [density, velocity]}}\n");
    assert_int_equal(snapshot_new(small.state, &snapshots), 0);
    assert_int_equal(snapshot_write(snapshots, small.state, SMALL_NOW(small.state), "{}"), 0);
    snapshot_free(snapshots);
    hid_t file = open_file(&small, "fields/tiny_000000.hdf");
    static float data[4 * 2048], density[2048], velocity[2048][3];
    static int32_t boxes[8][4], blocks[8][6];
    int64_t offsets[9];
    read_numbers(file, "level_0/data:datatype=0", H5T_NATIVE_FLOAT, data);
    read_numbers(file, "VTKHDF/CellData/density", H5T_NATIVE_FLOAT, density);
    read_numbers(file, "VTKHDF/CellData/velocity", H5T_NATIVE_FLOAT, velocity);
    read_numbers(file, "level_0/data:offsets=0", H5T_NATIVE_INT64, offsets);
    read_numbers(file, "bulla/blocks", H5T_NATIVE_INT32, blocks);
    hid_t set = H5Dopen2(file, "level_0/boxes", H5P_DEFAULT), type = H5Dget_type(set);
    assert_true(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, boxes) >= 0);
    H5Tclose(type);
    H5Dclose(set);
    for (size_t block = 0; block < 8; block++) {
        assert_int_equal(offsets[block], block * 4 * 256);
        for (int axis = 0; axis < 2; axis++) {
            int lower = 16 * blocks[block][1 + axis] - (axis ? 32 : 0); /* z starts at -1 mm = -32 cells */
            assert_int_equal(boxes[block][axis], lower);
            assert_int_equal(boxes[block][2 + axis], lower + 15);
        }
        for (size_t i = 0; i < 256; i++) {
            const float *at = data + block * 4 * 256 + i;
            assert_true(at[0] == density[block * 256 + i]);
            for (size_t q = 0; q < 3; q++) assert_true(at[(q + 1) * 256] == velocity[block * 256 + i][q]);
        }
    }
    assert_int_equal(offsets[8], 8 * 4 * 256);
    H5Fclose(file);
    small_stop(&small);
}

static void test_line(void **state)
{
    (void)state;
    struct small small;
    write_one(&small,
              "bulla: 1\ndomain: {lower: [0], upper: [1], cells: [40], boundaries: {x-: outflow, x+: outflow}}\n"
              "mesh: {tile: 8}\n" SMALL_MATERIALS
              "initial:\n  - {everywhere: true, material: air, density: 1, pressure: 1e5}\nrun: {until: 1 ms}\n"
              "output: {snapshots: {every: 1 ms, fields: [density, velocity], precision: double}}\n",
              "/\nVTKHDF/\nVTKHDF/CellData/\nVTKHDF/CellData/density f8 40\nVTKHDF/CellData/velocity f8 40 3\n"
              "VTKHDF/Connectivity i4 80\nVTKHDF/FieldData/\nVTKHDF/FieldData/TimeValue f8 1\n"
              "VTKHDF/NumberOfCells i8 1\nVTKHDF/NumberOfConnectivityIds i8 1\nVTKHDF/NumberOfPoints i8 1\n"
              "VTKHDF/Offsets i4 41\nVTKHDF/PointData/\nVTKHDF/Points f8 41 3\nVTKHDF/Types i1 40\nbulla/\n"
              "bulla/blocks i4 5 6\nbulla/case.yaml text0\nbulla/provenance.json text0\n");
    hid_t file = open_file(&small, "fields/tiny_000000.hdf");
    unsigned char types[40];
    read_numbers(file, "VTKHDF/Types", H5T_NATIVE_UCHAR, types);
    assert_int_equal(types[7], 3);
    expect_grid(file, 1, 40, 41);
    H5Fclose(file);
    small_stop(&small);
}

static void test_volume(void **state)
{
    (void)state;
    struct small small;
    small_start(&small,
                "bulla: 1\ndomain:\n  lower: [0, 0, 0]\n  upper: [3, 2, 1]\n  cells: [12, 8, 4]\n"
                "  boundaries: {x-: periodic, x+: periodic, y-: outflow, y+: outflow, z-: outflow, z+: outflow}\n"
                "mesh: {tile: 4}\n" SMALL_MATERIALS
                "initial:\n  - {everywhere: true, material: air, density: = 1 + x, pressure: 1e5}\n"
                "run: {until: 1 ms}\n");
    struct snapshots *snapshots;
    assert_int_equal(snapshot_new(small.state, &snapshots), 0);
    assert_int_equal(snapshot_write(snapshots, small.state, SMALL_NOW(small.state), "{}"), 0);
    snapshot_free(snapshots);
    hid_t file = open_file(&small, "fields/tiny_000000.hdf");
    expect_grid(file, 3, 384, 13 * 9 * 5); /* the two ends of a periodic axis are two places */
    H5Fclose(file);
    small_stop(&small);
}

/* Files appear whole and once; the list grows with them and forgets a future that did not happen. */
static void test_series(void **state)
{
    (void)state;
    struct small small;
    struct snapshots *snapshots;
    struct snapshot_series series;
    small_start(&small, SMALL_AXISYMMETRIC);
    char *out = small_path(&small, ""), *draft = small_path(&small, "fields/tiny_000000.hdf.tmp");
    for (int i = 0; i < 3; i++, small_skip(&small, 1e-7)) {
        if (i == 0) assert_int_equal(snapshot_new(small.state, &snapshots), 0);
        assert_int_equal(snapshot_write(snapshots, small.state, SMALL_NOW(small.state), "{}"), 0);
        assert_int_equal(snapshot_write(snapshots, small.state, SMALL_NOW(small.state), "{}"), 0);
    }
    snapshot_free(snapshots);
    assert_int_equal(access(draft, F_OK), -1);
    assert_int_equal(read_series(out, &series), 0);
    assert_int_equal(series.n, 3);
    assert_true(series.times[1] == 1e-7);
    read_series_done(&series);
    small.state->t = 1e-7; /* taken up again after the second file */
    small.state->step = 1;
    assert_int_equal(snapshot_new(small.state, &snapshots), 0);
    small_skip(&small, 3e-8);
    assert_int_equal(snapshot_write(snapshots, small.state, SMALL_NOW(small.state), "{}"), 0);
    snapshot_free(snapshots);
    assert_int_equal(read_series(out, &series), 0);
    assert_int_equal(series.n, 3);
    assert_true(series.times[2] == 1e-7 + 3e-8);
    assert_int_equal(access(series.paths[2], R_OK), 0);
    read_series_done(&series);
    mem_free(draft);
    mem_free(out);
    small_stop(&small);
}

static void test_failure(void **state)
{
    (void)state;
    struct small small;
    struct snapshots *snapshots;
    small_start(&small, SMALL_AXISYMMETRIC);
    assert_int_equal(snapshot_new(small.state, &snapshots), 0);
    char *folder = small_path(&small, "fields");
    assert_int_equal(rmdir(folder), 0);
    assert_int_equal(snapshot_write(snapshots, small.state, SMALL_NOW(small.state), "{}"), STATUS_RUN);
    assert_non_null(strstr(status_text(), "tiny_000000.hdf"));
    assert_non_null(strstr(status_text(), "No such file"));
    snapshot_free(snapshots);
    mem_free(folder);
    small_stop(&small);
}

/* Compares the data of one object of two files. */
struct comparison {
    hid_t other;
    int sets, differences;
};

static herr_t compare(hid_t file, const char *name, const H5O_info_t *info, void *context)
{
    struct comparison *comparison = context;
    if (info->type != H5O_TYPE_DATASET || !strcmp(name, "bulla/provenance.json")) return 0;
    /* Views of other sets take half a second to open. */
    if (strstr(name, "/data:datatype=") && !getenv("BULLA_WHOLE")) return 0;
    hid_t set[2] = {H5Dopen2(file, name, H5P_DEFAULT), H5Dopen2(comparison->other, name, H5P_DEFAULT)};
    comparison->sets++;
    char *bytes[2] = {NULL, NULL};
    size_t length[2] = {0, 1};
    for (int i = 0; i < 2 && set[i] >= 0; i++) {
        hid_t type = H5Dget_type(set[i]), space = H5Dget_space(set[i]);
        length[i] = (size_t)H5Sget_simple_extent_npoints(space) * H5Tget_size(type);
        bytes[i] = mem_new(length[i] + 1, 1);
        H5Dread(set[i], type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes[i]);
        H5Sclose(space);
        H5Tclose(type);
        H5Dclose(set[i]);
        if (!strcmp(name, "bulla/blocks")) /* but for the ranks */
            for (size_t row = 0; row < length[i] / 24; row++) memset(bytes[i] + row * 24 + 16, 0, 4);
    }
    if (length[0] != length[1] || memcmp(bytes[0], bytes[1], length[0])) {
        fprintf(stderr, "%s differs\n", name);
        comparison->differences++;
    }
    mem_free(bytes[0]);
    mem_free(bytes[1]);
    return 0;
}

static int compare_files(char **paths)
{
    hid_t file = H5Fopen(paths[0], H5F_ACC_RDONLY, H5P_DEFAULT);
    struct comparison comparison = {.other = H5Fopen(paths[1], H5F_ACC_RDONLY, H5P_DEFAULT)};
    if (file < 0 || comparison.other < 0) return 2;
    H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, compare, &comparison, H5O_INFO_BASIC);
    H5Fclose(file);
    H5Fclose(comparison.other);
    return comparison.sets < 5 ? 2 : comparison.differences != 0;
}

/* A bubble on three levels that come and go. */
static const char moving[] =
    "bulla: 1\ndomain:\n  geometry: axisymmetric\n  lower: [0, -1 mm]\n  upper: [1 mm, 1 mm]\n"
    "  cells: [16, 32]\n  boundaries: {x-: axis, x+: outflow, y-: outflow, y+: outflow}\n"
    "mesh: {tile: 8, levels: 2, regrid-every: 2, buffer: 2, refine: [{gradient: pressure, above: 0.05, relative: "
    "true}]}\n" SMALL_MATERIALS "initial:\n  - {everywhere: true, material: water, density: 1000, pressure: 1e5}\n"
    "  - {half-space: {point: [0, 0.7 mm], normal: [0, 1]}, material: water, density: 1010, pressure: 3e7}\n"
    "  - {sphere: {center: [0, 0], radius: 0.5 mm}, material: air, density: 1.2, pressure: 1e5}\n"
    "run: {until: 1 us}\noutput: {snapshots: {every: 1 us, fields: [density, velocity]}}\n";

/* Gives the file of this step another name. */
static char *take_file(const struct small *small, const char *as)
{
    char *name = mem_print("fields/tiny_%06ld.hdf", small->state->step), *path = small_path(small, name);
    char *to = small_path(small, as);
    assert_int_equal(rename(path, to), 0);
    mem_free(path);
    mem_free(name);
    return to;
}

/* The files have the same numbers, and the same length; bytes differ where objects know when they were made. */
static void expect_same(char **paths)
{
    struct stat info[2];
    assert_int_equal(compare_files(paths), 0);
    for (int i = 0; i < 2; i++) assert_int_equal(stat(paths[i], &info[i]), 0);
    assert_int_equal(info[0].st_size, info[1].st_size);
}

/* What is written at once is written beside the run, too, with points and cells that were kept from the file before
 * where the mesh is the same. */
static void test_beside(void **state)
{
    (void)state;
    struct small small;
    struct snapshots *beside, *now;
    int regrids = 0;
    small_start_levels(&small, moving, 2);
    assert_true(small.scene->output.snapshot_memory == 256 * 0x1p20);
    assert_int_equal(snapshot_new(small.state, &beside), 0);
    snapshot_beside(beside);
    for (int i = 0; i < 9; i++) {
        char *paths[2];
        assert_int_equal(snapshot_write(beside, small.state, SMALL_NOW(small.state), "{}"), 0);
        assert_true(snapshot_pending(beside));
        assert_int_equal(snapshot_wait(beside), 0);
        assert_false(snapshot_pending(beside) || snapshot_busy(beside));
        paths[0] = take_file(&small, "beside");
        assert_int_equal(snapshot_new(small.state, &now), 0);
        assert_int_equal(snapshot_write(now, small.state, SMALL_NOW(small.state), "{}"), 0);
        assert_false(snapshot_pending(now));
        snapshot_free(now);
        paths[1] = take_file(&small, "now");
        expect_same(paths);
        mem_free(paths[0]);
        mem_free(paths[1]);
        assert_int_equal(advance_step(small.state, INFINITY), 0);
        regrids = (int)small.state->counts.regrids;
    }
    assert_in_range(regrids, 1, 8); /* meshes that change, and that stay */
    snapshot_free(beside);
    small_stop(&small);
}

/* What fails beside the run is said by the next call that asks; its file is not listed and leaves no draft. */
static void test_beside_fails(void **state)
{
    (void)state;
    struct small small;
    struct snapshots *snapshots;
    struct snapshot_series series;
    small_start(&small, SMALL_AXISYMMETRIC "output: {snapshots: {every: 1 us, fields: [density]}}\n");
    char *out = small_path(&small, ""), *full = small_path(&small, "fields/tiny_000001.hdf.tmp");
    assert_int_equal(snapshot_new(small.state, &snapshots), 0);
    snapshot_beside(snapshots);
    assert_int_equal(snapshot_write(snapshots, small.state, SMALL_NOW(small.state), "{}"), 0);
    small_skip(&small, 1e-7);
    assert_int_equal(symlink("/dev/full", full), 0);
    assert_int_equal(snapshot_write(snapshots, small.state, SMALL_NOW(small.state), "{}"), 0);
    assert_int_equal(snapshot_wait(snapshots), STATUS_RUN);
    assert_non_null(strstr(status_text(), "tiny_000001.hdf.tmp: cannot write: No space left on device"));
    assert_int_equal(access(full, F_OK), -1);
    assert_int_equal(snapshot_wait(snapshots), 0);
    assert_int_equal(snapshot_write(snapshots, small.state, SMALL_NOW(small.state), "{}"), 0); /* there is room again */
    assert_int_equal(snapshot_wait(snapshots), 0);
    snapshot_free(snapshots);
    assert_int_equal(read_series(out, &series), 0);
    assert_int_equal(series.n, 2);
    for (size_t i = 0; i < series.n; i++) assert_int_equal(access(series.paths[i], R_OK), 0);
    read_series_done(&series);
    mem_free(full);
    mem_free(out);
    small_stop(&small);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_axisymmetric), cmocka_unit_test(test_view),         cmocka_unit_test(test_line),
        cmocka_unit_test(test_volume),       cmocka_unit_test(test_series),       cmocka_unit_test(test_failure),
        cmocka_unit_test(test_beside),       cmocka_unit_test(test_beside_fails),
    };
    if (argc == 3) return compare_files(argv + 1);
    if (registry_init()) return 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
