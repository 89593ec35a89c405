/* read.c - see read.h. Cells are rebuilt from the points and the connectivity of the file, as any
 * other reader would, so that what is read is what was written. */
#include "io/read.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "io/filelist.h"
#include "io/h5in.h"
#include "io/parts.h"

#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of snapshots, and the columns of their blocks: level, i, j, k, rank, covered octants. */
enum { READ_FORMAT = 2, READ_BLOCK = 6 };

static int read_broken(const struct h5 *file, const char *what)
{
    return status_fail(STATUS_RUN, "%s: %s: not a snapshot of bulla, or a broken one", file->path, what);
}

static int read_materials(struct snapshot *snapshot, char *list)
{
    for (char *name = list; *name;) {
        size_t length = strcspn(name, ",");
        snapshot->materials =
            mem_grow(snapshot->materials, snapshot->n_material, snapshot->n_material + 1u, sizeof *snapshot->materials);
        snprintf(snapshot->materials[snapshot->n_material++], READ_NAME, "%.*s", (int)length, name);
        name += length + (name[length] == ',');
    }
    mem_free(list);
    return STATUS_OK;
}

static int read_head(struct h5 *file, struct snapshot *snapshot)
{
    double format = 0, step = 0, dim = 0, beta = 0;
    char *materials = NULL;
    TRY(h5in_attribute(file, "/bulla", "format", 1, &format));
    if (format != READ_FORMAT)
        return status_fail(STATUS_RUN, "%s: snapshot format %g; this program reads format %d", file->path, format,
                           READ_FORMAT);
    TRY(h5in_attribute_text(file, "/bulla", "version", &snapshot->version));
    TRY(h5in_attribute_text(file, "/bulla", "case", &snapshot->name));
    TRY(h5in_attribute_text(file, "/bulla", "title", &snapshot->title));
    TRY(h5in_attribute(file, "/", "time", 1, &snapshot->time));
    TRY(h5in_attribute(file, "/", "iteration", 1, &step));
    TRY(h5in_attribute(file, "/bulla", "dim", 1, &dim));
    TRY(h5in_attribute(file, "/bulla", "beta", 1, &beta));
    TRY(h5in_attribute(file, "/bulla", "lower", 3, snapshot->domain[0]));
    TRY(h5in_attribute(file, "/bulla", "upper", 3, snapshot->domain[1]));
    if (!(dim >= 1 && dim <= 3 && beta >= 0 && beta <= 2)) return read_broken(file, "no dimension from 1 to 3");
    snapshot->step = (long)step;
    snapshot->dim = (int)dim;
    snapshot->beta = (int)beta;
    TRY(h5in_attribute_text(file, "/bulla", "materials", &materials));
    return read_materials(snapshot, materials);
}

/* A data set of exactly this shape, in memory of its own. */
static int read_table(struct h5 *file, const char *path, size_t rows, unsigned columns, double **ret_values)
{
    size_t there = 0;
    unsigned wide = 0;
    TRY(h5in_shape(file, path, &there, &wide));
    if (there != rows || wide != columns) return read_broken(file, path);
    double *values = mem_new(rows * (columns ? columns : 1), sizeof *values);
    int code = h5in_read(file, path, values);
    if (code) mem_free(values);
    else *ret_values = values;
    return code;
}

/* Smallest box around the corners of each cell. */
static int read_boxes(struct h5 *file, struct snapshot *snapshot, const double *corners, const double (*x)[3],
                      size_t points)
{
    size_t n = (size_t)1 << snapshot->dim;
    snapshot->lower = mem_new(snapshot->n_cell, sizeof *snapshot->lower);
    snapshot->upper = mem_new(snapshot->n_cell, sizeof *snapshot->upper);
    for (size_t cell = 0; cell < snapshot->n_cell; cell++)
        for (size_t c = 0; c < n; c++) {
            double point = corners[cell * n + c];
            if (!(point >= 0 && point < (double)points)) return read_broken(file, "/VTKHDF/Connectivity");
            for (int axis = 0; axis < 3; axis++) {
                double at = x[(size_t)point][axis];
                double *lower = &snapshot->lower[cell][axis], *upper = &snapshot->upper[cell][axis];
                *lower = c == 0 || at < *lower ? at : *lower;
                *upper = c == 0 || at > *upper ? at : *upper;
            }
        }
    return STATUS_OK;
}

/* Octants of a tile that are not under finer tiles. */
static size_t read_open(const struct snapshot *snapshot, const double *block)
{
    unsigned octants = 1u << snapshot->dim, covered = (unsigned)block[5];
    return octants - (size_t)__builtin_popcount(covered & ((1u << octants) - 1u));
}

/* Which cells belong to which tile: by level, whole tiles before others. */
static int read_place_tiles(struct h5 *file, struct snapshot *snapshot, const double *blocks)
{
    size_t octants = (size_t)1 << snapshot->dim, open = 0, first = 0;
    for (size_t i = 0; i < snapshot->n_tile; i++) {
        const double *block = blocks + i * READ_BLOCK;
        if (!(block[0] >= 0 && (i == 0 || block[0] >= block[-READ_BLOCK]))) return read_broken(file, "/bulla/blocks");
        open += read_open(snapshot, block);
    }
    if (!open || snapshot->n_cell * octants % open) return read_broken(file, "/bulla/blocks");
    size_t whole = snapshot->n_cell * octants / open; /* cells of a tile */
    for (size_t from = 0, to = 0; from < snapshot->n_tile; from = to) {
        while (to < snapshot->n_tile && blocks[to * READ_BLOCK] == blocks[from * READ_BLOCK]) to++;
        for (int kind = 0; kind < 2; kind++)
            for (size_t i = from; i < to; i++) {
                const double *block = blocks + i * READ_BLOCK;
                size_t part = read_open(snapshot, block);
                if ((part == octants) != (kind == 0)) continue;
                size_t n_cell = whole * part / octants;
                snapshot->tiles[i] = (struct snapshot_tile){(int)block[0], (int)block[4], first, n_cell};
                first += n_cell;
            }
        snapshot->n_level = (int)blocks[from * READ_BLOCK] + 1;
    }
    return STATUS_OK;
}

static int read_tiles(struct h5 *file, struct snapshot *snapshot)
{
    unsigned columns = 0;
    double *blocks = NULL;
    TRY(h5in_shape(file, "/bulla/blocks", &snapshot->n_tile, &columns));
    TRY(read_table(file, "/bulla/blocks", snapshot->n_tile, READ_BLOCK, &blocks));
    snapshot->tiles = mem_new(snapshot->n_tile, sizeof *snapshot->tiles);
    int code = read_place_tiles(file, snapshot, blocks);
    mem_free(blocks);
    return code;
}

static int read_cells(struct h5 *file, struct snapshot *snapshot)
{
    size_t points = 0;
    unsigned columns = 0;
    double *corners = NULL, *x = NULL;
    TRY(h5in_shape(file, "/VTKHDF/Types", &snapshot->n_cell, &columns));
    TRY(read_tiles(file, snapshot));
    TRY(h5in_shape(file, "/VTKHDF/Points", &points, &columns));
    TRY(read_table(file, "/VTKHDF/Points", points, 3, &x));
    int code = read_table(file, "/VTKHDF/Connectivity", snapshot->n_cell << snapshot->dim, 0, &corners);
    if (!code) code = read_boxes(file, snapshot, corners, (const double(*)[3])x, points);
    mem_free(corners);
    mem_free(x);
    return code;
}

static void read_extremes(struct snapshot_field *field, size_t n_cell)
{
    field->least = INFINITY;
    field->most = -INFINITY;
    for (size_t i = 0; i < n_cell; i++) {
        const double *v = field->data + i * field->components;
        double value = field->components == 3 ? sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) : v[0];
        if (!isfinite(value)) continue;
        if (value < field->least) field->least = value;
        if (value > field->most) field->most = value;
    }
    if (field->least > field->most) field->least = field->most = NAN;
}

static int read_one(struct h5 *file, struct snapshot *snapshot, const char *name)
{
    size_t rows = 0;
    unsigned columns = 0;
    char *unit = NULL, *path = mem_print("/VTKHDF/CellData/%s", name);
    struct snapshot_field *field = &snapshot->fields[snapshot->n_field];
    int code = h5in_shape(file, path, &rows, &columns);
    if (!code && columns != 0 && columns != 3) code = read_broken(file, path);
    if (!code) code = h5in_attribute_text(file, path, "units", &unit);
    if (!code) code = read_table(file, path, snapshot->n_cell, columns, &field->data);
    if (!code) {
        snprintf(field->name, sizeof field->name, "%s", name);
        snprintf(field->unit, sizeof field->unit, "%s", unit);
        field->components = columns ? columns : 1;
        read_extremes(field, snapshot->n_cell);
        snapshot->n_field++;
    }
    mem_free(unit);
    mem_free(path);
    return code;
}

/* The names must be in the file; what is in the file is said otherwise. */
static int read_check_names(const struct h5 *file, const char *const *names, char *const *there)
{
    for (; *names; names++) {
        size_t i = 0;
        while (there[i] && strcmp(there[i], *names)) i++;
        if (there[i]) continue;
        struct text list = {0};
        for (i = 0; there[i]; i++) text_add(&list, "%s%s", i ? ", " : "", there[i]);
        const char *nearest = text_nearest(*names, (const char *const *)there);
        int code = status_fail(STATUS_CASE, "%s: no field '%s'%s%s%s; it has: %s", file->path, *names,
                               nearest ? " (did you mean '" : "", nearest ? nearest : "", nearest ? "'?)" : "",
                               list.at ? list.at : "none");
        text_done(&list);
        return code;
    }
    return STATUS_OK;
}

static int read_fields(struct h5 *file, struct snapshot *snapshot, const char *const *names)
{
    unsigned n = 0, wanted = 0;
    char **there;
    TRY(h5in_names(file, "/VTKHDF/CellData", &n, &there));
    int code = names ? read_check_names(file, names, there) : STATUS_OK;
    if (!names) names = (const char *const *)there;
    while (names[wanted]) wanted++;
    snapshot->fields = mem_new(wanted + 1u, sizeof *snapshot->fields);
    for (unsigned i = 0; !code && i < wanted; i++) code = read_one(file, snapshot, names[i]);
    for (unsigned i = 0; i < n; i++) mem_free(there[i]);
    mem_free(there);
    return code;
}

/* Without its parts a file would read as if its fields were empty. */
static int read_check_parts(struct h5 *file)
{
    struct parts_list list;
    struct seal seal;
    char *text = NULL;
    if (!h5in_has(file, "/bulla/parts")) return STATUS_OK;
    TRY(h5in_text(file, "/bulla/parts", &text));
    int code = parts_read(file->path, text, &list);
    mem_free(text);
    TRY(code);
    for (unsigned i = 0; !code && i < list.n; i++) code = parts_check(file->path, &list, i, seal_read, &seal);
    parts_done(&list);
    return code;
}

int read_snapshot(const char *path, const char *const *names, struct snapshot **ret_snapshot)
{
    struct h5 *file;
    TRY(h5_open(path, &file));
    struct snapshot *snapshot = mem_new(1, sizeof *snapshot);
    int code = h5in_has(file, "/bulla") ? STATUS_OK : read_broken(file, "no group /bulla");
    if (!code) code = read_head(file, snapshot);
    if (!code) code = read_check_parts(file);
    if (!code) code = read_cells(file, snapshot);
    if (!code) code = read_fields(file, snapshot, names);
    h5_abandon(file);
    if (code) read_free(snapshot);
    else *ret_snapshot = snapshot;
    return code;
}

int read_names(const char *path, unsigned *ret_n, char ***ret_names)
{
    struct h5 *file;
    TRY(h5_open(path, &file));
    int code = h5in_names(file, "/VTKHDF/CellData", ret_n, ret_names);
    h5_abandon(file);
    return code;
}

void read_free(struct snapshot *snapshot)
{
    if (!snapshot) return;
    for (unsigned i = 0; i < snapshot->n_field; i++) mem_free(snapshot->fields[i].data);
    mem_free(snapshot->fields);
    mem_free(snapshot->materials);
    mem_free(snapshot->tiles);
    mem_free(snapshot->upper);
    mem_free(snapshot->lower);
    mem_free(snapshot->version);
    mem_free(snapshot->title);
    mem_free(snapshot->name);
    mem_free(snapshot);
}

const struct snapshot_field *read_field(const struct snapshot *snapshot, const char *name)
{
    for (unsigned i = 0; i < snapshot->n_field; i++)
        if (!strcmp(snapshot->fields[i].name, name)) return &snapshot->fields[i];
    return NULL;
}

/* The one list of snapshots in a folder; release with mem_free. */
static int read_find_list(const char *folder, char **ret_path)
{
    glob_t found;
    char *pattern = mem_print("%s/*.hdf.series", folder);
    int code = STATUS_OK;
    if (glob(pattern, 0, NULL, &found) == 0 && found.gl_pathc == 1) *ret_path = mem_text(found.gl_pathv[0]);
    else if (found.gl_pathc > 1)
        code = status_fail(STATUS_RUN, "%s: snapshots of several cases: %s, %s", folder, found.gl_pathv[0],
                           found.gl_pathv[1]);
    else code = status_fail(STATUS_RUN, "%s: no list of snapshots (<case>.hdf.series)", folder);
    globfree(&found);
    mem_free(pattern);
    return code;
}

int read_series(const char *directory, struct snapshot_series *ret_series)
{
    char *folder = mem_print("%s/fields", directory), *path = NULL;
    struct filelist list = {0};
    int code = read_find_list(folder, &path);
    if (!code) code = filelist_read(path, &list);
    if (!code) {
        *ret_series =
            (struct snapshot_series){list.n, mem_new(list.n, sizeof(char *)), mem_new(list.n, sizeof(double))};
        for (size_t i = 0; i < list.n; i++) {
            ret_series->paths[i] = mem_print("%s/%s", folder, list.names[i]);
            ret_series->times[i] = list.times[i];
        }
    }
    filelist_done(&list);
    mem_free(path);
    mem_free(folder);
    return code;
}

void read_series_done(struct snapshot_series *series)
{
    for (size_t i = 0; i < series->n; i++) mem_free(series->paths[i]);
    mem_free(series->paths);
    mem_free(series->times);
    *series = (struct snapshot_series){0};
}
