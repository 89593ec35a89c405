/* vtkhdf.c - see vtkhdf.h. Everything is made tile by tile on request of h5out, so that no copy
 * of the whole state exists beside the state. */
#include "io/vtkhdf.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/h5out.h"
#include "io/nodes.h"

#include <stdio.h>
#include <string.h>

enum { VTKHDF_CHUNK_TILES = 64, VTKHDF_CHUNK_ROWS = 65536 };

/* One file being written. */
struct vtkhdf {
    struct h5 *file;
    const struct state *state;
    const struct mesh *mesh;
    struct nodes *nodes;
    size_t n_cell, chunk; /* cells of all tiles; cells compressed together */
    struct h5out_range cells[MESH_LEVELS], points[MESH_LEVELS];
    int corners;                /* of a cell */
    const struct derive *field; /* being written */
    enum h5_type type;
    double *values;   /* [3][cells of a tile] */
    int32_t *numbers; /* [points of a tile] */
    double (*x)[3];   /* [points of a tile] */
};

size_t vtkhdf_first_cell(const struct mesh *mesh, int level, unsigned tile)
{
    size_t tiles = tile;
    for (int l = 0; l < level; l++) tiles += mesh->levels[l].n_tile;
    return tiles * mesh->n_cell;
}

/* Level and tile in which a cell lies. */
static unsigned vtkhdf_tile(const struct mesh *mesh, size_t cell, int *ret_level)
{
    size_t tile = cell / mesh->n_cell;
    int level = 0;
    while (tile >= mesh->levels[level].n_tile) tile -= mesh->levels[level++].n_tile;
    *ret_level = level;
    return (unsigned)tile;
}

/* Runs begin and end between tiles: chunks hold whole tiles. */
static void vtkhdf_fill_field(void *context, size_t first, size_t count, void *out)
{
    struct vtkhdf *part = context;
    size_t n = part->mesh->n_cell, components = part->field->components, at = 0;
    float *narrow = out;
    double *wide = out;
    for (size_t cell = first; cell < first + count; cell += n) {
        int level;
        unsigned local = vtkhdf_tile(part->mesh, cell, &level);
        local -= part->mesh->levels[level].first;
        derive_tile(part->state->model, part->mesh, level, local, part->state->t, part->field, part->values);
        for (size_t i = 0; i < n; i++)
            for (size_t q = 0; q < components; q++, at++) {
                double value = part->values[q * n + i];
                if (part->type == H5_F64) wide[at] = value;
                else narrow[at] = (float)value;
            }
    }
}

static void vtkhdf_fill_points(void *context, size_t first, size_t count, void *out)
{
    struct vtkhdf *part = context;
    double(*x)[3] = out;
    for (int l = 0; l < part->mesh->n_level; l++) {
        const struct level *level = &part->mesh->levels[l];
        const size_t *start = part->nodes->first[l];
        for (unsigned tile = level->first; tile < level->first + level->n_local; tile++) {
            if (start[tile + 1] <= first || start[tile] >= first + count) continue;
            nodes_positions(part->nodes, part->mesh, l, tile, part->x);
            size_t from = start[tile] > first ? start[tile] : first;
            size_t to = start[tile + 1] < first + count ? start[tile + 1] : first + count;
            memcpy(x + (from - first), part->x + (from - start[tile]), (to - from) * sizeof *x);
        }
    }
}

/* Corners of the cells in VTK's order: a line; a quad counter-clockwise; a hexahedron's bottom, then its top. */
static void vtkhdf_connect(const struct vtkhdf *part, int32_t *ret_corners)
{
    static const int turn[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const int *n = part->mesh->n, *points = part->nodes->n;
    for (int k = 0; k < n[2]; k++)
        for (int j = 0; j < n[1]; j++)
            for (int i = 0; i < n[0]; i++)
                for (int c = 0; c < part->corners; c++) {
                    int point = i + turn[c][0] + points[0] * (j + turn[c][1] + points[1] * (k + turn[c][2]));
                    *ret_corners++ = part->numbers[point];
                }
}

static void vtkhdf_fill_connectivity(void *context, size_t first, size_t count, void *out)
{
    struct vtkhdf *part = context;
    size_t corners = (size_t)part->corners, step = part->mesh->n_cell;
    int32_t *at = out;
    for (size_t cell = first / corners; cell < (first + count) / corners; cell += step, at += corners * step) {
        int level;
        unsigned tile = vtkhdf_tile(part->mesh, cell, &level);
        nodes_of_tile(part->nodes, part->mesh, level, tile, part->numbers);
        vtkhdf_connect(part, at);
    }
}

static void vtkhdf_fill_offsets(void *context, size_t first, size_t count, void *out)
{
    const struct vtkhdf *part = context;
    int32_t *offsets = out;
    for (size_t i = 0; i < count; i++) offsets[i] = (int32_t)((first + i) * (size_t)part->corners);
}

static void vtkhdf_fill_types(void *context, size_t first, size_t count, void *out)
{
    static const unsigned char types[] = {[1] = 3, [2] = 9, [3] = 12}; /* VTK_LINE, VTK_QUAD, VTK_HEXAHEDRON */
    const struct vtkhdf *part = context;
    (void)first;
    memset(out, types[part->mesh->dim], count);
}

/* Which cells and points this rank writes, level by level. */
static void vtkhdf_divide(struct vtkhdf *part)
{
    for (int l = 0; l < part->mesh->n_level; l++) {
        const struct level *level = &part->mesh->levels[l];
        unsigned end = level->first + level->n_local;
        const size_t *start = part->nodes->first[l];
        part->cells[l] =
            (struct h5out_range){vtkhdf_first_cell(part->mesh, l, level->first), level->n_local * part->mesh->n_cell};
        part->points[l] = (struct h5out_range){start[level->first], start[end] - start[level->first]};
        part->n_cell += level->n_tile * part->mesh->n_cell;
    }
}

static void vtkhdf_begin(struct vtkhdf *part)
{
    const struct mesh *mesh = part->mesh;
    size_t tiles = VTKHDF_CHUNK_ROWS / mesh->n_cell;
    if (tiles > VTKHDF_CHUNK_TILES) tiles = VTKHDF_CHUNK_TILES;
    part->chunk = mesh->n_cell * (tiles ? tiles : 1);
    part->corners = 1 << mesh->dim;
    part->nodes = nodes_new(mesh);
    part->values = mem_new(3 * mesh->n_cell, sizeof *part->values);
    part->numbers = mem_new(part->nodes->n_point, sizeof *part->numbers);
    part->x = mem_new(part->nodes->n_point, sizeof *part->x);
    vtkhdf_divide(part);
}

static void vtkhdf_end(struct vtkhdf *part)
{
    nodes_free(part->nodes);
    mem_free(part->values);
    mem_free(part->numbers);
    mem_free(part->x);
}

/* Ranges of rows that are `factor` per cell; the last rank adds `more` rows at the end. */
static void vtkhdf_scale(const struct vtkhdf *part, size_t factor, size_t more, struct h5out_range *ret_ranges)
{
    int last = part->mesh->n_level - 1;
    for (int l = 0; l <= last; l++)
        ret_ranges[l] = (struct h5out_range){part->cells[l].first * factor, part->cells[l].count * factor};
    if (comm_rank() == comm_size() - 1) ret_ranges[last].count += more;
}

static int vtkhdf_write_points(struct vtkhdf *part)
{
    struct h5out_rows rows = {.type = H5_F64,
                              .columns = 3,
                              .total = part->nodes->total,
                              .chunk = part->chunk,
                              .n_range = (unsigned)part->mesh->n_level,
                              .ranges = part->points,
                              .fill = vtkhdf_fill_points,
                              .context = part};
    return h5out_write(part->file, "/VTKHDF/Points", &rows);
}

static int vtkhdf_write_cells(struct vtkhdf *part)
{
    struct h5out_range ranges[MESH_LEVELS];
    size_t corners = (size_t)part->corners;
    struct h5out_rows rows = {.type = H5_I32,
                              .n_range = (unsigned)part->mesh->n_level,
                              .ranges = ranges,
                              .context = part};
    vtkhdf_scale(part, corners, 0, ranges);
    rows.total = part->n_cell * corners;
    rows.chunk = part->chunk * corners;
    rows.fill = vtkhdf_fill_connectivity;
    TRY(h5out_write(part->file, "/VTKHDF/Connectivity", &rows));
    vtkhdf_scale(part, 1, 1, ranges);
    rows.total = part->n_cell + 1;
    rows.chunk = part->chunk;
    rows.fill = vtkhdf_fill_offsets;
    TRY(h5out_write(part->file, "/VTKHDF/Offsets", &rows));
    vtkhdf_scale(part, 1, 0, ranges);
    rows.total = part->n_cell;
    rows.type = H5_U8;
    rows.fill = vtkhdf_fill_types;
    return h5out_write(part->file, "/VTKHDF/Types", &rows);
}

static int vtkhdf_write_counts(struct vtkhdf *part)
{
    int64_t points = (int64_t)part->nodes->total, cells = (int64_t)part->n_cell, ids = cells * part->corners;
    if (ids > INT32_MAX || points > INT32_MAX)
        return status_fail(STATUS_RUN, "%s: %lld cells are more than a plot file can hold (%d)", part->file->path,
                           (long long)cells, INT32_MAX / part->corners);
    h5out_array(part->file, "/VTKHDF/NumberOfPoints", H5_I64, 1, 0, &points);
    h5out_array(part->file, "/VTKHDF/NumberOfCells", H5_I64, 1, 0, &cells);
    h5out_array(part->file, "/VTKHDF/NumberOfConnectivityIds", H5_I64, 1, 0, &ids);
    return STATUS_OK;
}

static int vtkhdf_write_field(struct vtkhdf *part, const struct derive *field)
{
    char path[SCENE_NAME + 32];
    snprintf(path, sizeof path, "/VTKHDF/CellData/%s", field->name);
    part->field = field;
    struct h5out_rows rows = {.type = part->type,
                              .columns = field->components > 1 ? field->components : 0,
                              .total = part->n_cell,
                              .chunk = part->chunk,
                              .n_range = (unsigned)part->mesh->n_level,
                              .ranges = part->cells,
                              .fill = vtkhdf_fill_field,
                              .context = part};
    TRY(h5out_write(part->file, path, &rows));
    h5out_unit(part->file, path, field->unit);
    return STATUS_OK;
}

static void vtkhdf_write_frame(struct vtkhdf *part)
{
    static const char *const groups[] = {"/VTKHDF", "/VTKHDF/CellData", "/VTKHDF/PointData", "/VTKHDF/FieldData"};
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++) h5_group(part->file, groups[i]);
    h5_attribute(part->file, "/VTKHDF", "Version", H5_I64, 2, (int64_t[]){1, 0});
    h5_attribute_text(part->file, "/VTKHDF", "Type", "UnstructuredGrid");
    h5out_array(part->file, "/VTKHDF/FieldData/TimeValue", H5_F64, 1, 0, &part->state->t);
}

int vtkhdf_write(struct h5 *file, const struct state *state, const struct vtkhdf_fields *fields)
{
    struct vtkhdf part = {.file = file, .state = state, .mesh = state->mesh, .type = fields->type};
    vtkhdf_begin(&part);
    vtkhdf_write_frame(&part);
    int code = vtkhdf_write_counts(&part);
    if (!code) code = vtkhdf_write_points(&part);
    if (!code) code = vtkhdf_write_cells(&part);
    for (unsigned i = 0; !code && i < fields->n; i++) code = vtkhdf_write_field(&part, &fields->at[i]);
    vtkhdf_end(&part);
    return code;
}
