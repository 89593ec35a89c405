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
    const struct leaves *leaves;
    struct nodes *nodes;
    struct vtkhdf_cells *kept;
    bool again;   /* `kept` is of this mesh */
    size_t chunk; /* cells compressed together */
    unsigned n_range;
    struct h5out_range cells[LEAVES_KINDS * MESH_LEVELS], points[MESH_LEVELS];
    int corners;                /* of a cell */
    const struct derive *field; /* being written */
    enum h5_type type;
    int level; /* of the tile that values or numbers are of; -1: none */
    unsigned tile;
    double *values;   /* [3][cells of a tile] */
    int32_t *numbers; /* [points of a tile] */
    double (*x)[3];   /* [points of a tile] */
};

/* A part of a block that is asked for. */
struct vtkhdf_part {
    unsigned block;
    size_t from, to; /* cells of the block */
};

/* The part from cell `cell` on, up to `end` at most. */
static struct vtkhdf_part vtkhdf_part(const struct vtkhdf *out, size_t cell, size_t end)
{
    unsigned block = leaves_find(out->leaves, cell);
    size_t first = out->leaves->blocks[block].first, last = first + leaves_cells(out->leaves, block);
    return (struct vtkhdf_part){block, cell - first, (last < end ? last : end) - first};
}

/* Makes the tile of a block the one at hand; false if it was that already. */
static bool vtkhdf_turn(struct vtkhdf *out, unsigned block)
{
    const struct leaves_block *at = &out->leaves->blocks[block];
    bool same = at->level == out->level && at->tile == out->tile;
    out->level = at->level;
    out->tile = at->tile;
    return !same;
}

/* Place in its tile of cell i of the box of a block. */
static void vtkhdf_place(const int from[3], const int count[3], size_t i, int ret_at[3])
{
    size_t n0 = (size_t)count[0], n1 = (size_t)count[1];
    ret_at[0] = from[0] + (int)(i % n0);
    ret_at[1] = from[1] + (int)(i / n0 % n1);
    ret_at[2] = from[2] + (int)(i / (n0 * n1));
}

/* The next cell of the box. */
static void vtkhdf_next(const int from[3], const int count[3], int ret_at[3])
{
    for (int axis = 0; axis < 3; axis++) {
        if (++ret_at[axis] < from[axis] + count[axis]) return;
        ret_at[axis] = from[axis];
    }
}

/* Writes the values of a part; returns how many numbers that were. */
static size_t vtkhdf_put(struct vtkhdf *out, const struct vtkhdf_part *part, void *to)
{
    const struct mesh *mesh = out->mesh;
    const int *n = mesh->n;
    size_t components = out->field->components, count = 0;
    float *narrow = to;
    double *wide = to;
    int from[3], box[3], at[3];
    if (vtkhdf_turn(out, part->block))
        derive_tile(out->state->model, mesh, out->level, out->tile - mesh->levels[out->level].first, out->state->t,
                    out->field, out->values);
    leaves_box(out->leaves, part->block, from, box);
    vtkhdf_place(from, box, part->from, at);
    for (size_t i = part->from; i < part->to; i++, vtkhdf_next(from, box, at)) {
        const double *value = out->values + at[0] + n[0] * (at[1] + n[1] * at[2]);
        for (size_t q = 0; q < components; q++, count++) {
            if (out->type == H5_F64) wide[count] = value[q * mesh->n_cell];
            else narrow[count] = (float)value[q * mesh->n_cell];
        }
    }
    return count;
}

static void vtkhdf_fill_field(void *context, size_t first, size_t count, void *to)
{
    struct vtkhdf *out = context;
    char *at = to;
    for (size_t cell = first, end = first + count; cell < end;) {
        struct vtkhdf_part part = vtkhdf_part(out, cell, end);
        at += vtkhdf_put(out, &part, at) * h5_type_size(out->type);
        cell += part.to - part.from;
    }
}

static void vtkhdf_fill_points(void *context, size_t first, size_t count, void *to)
{
    struct vtkhdf *out = context;
    double(*x)[3] = to;
    for (int l = 0; l < out->mesh->n_level; l++) {
        const struct level *level = &out->mesh->levels[l];
        for (unsigned tile = level->first; tile < level->first + level->n_local; tile++) {
            size_t start = out->nodes->tiles[l][tile].first, end = start + out->nodes->tiles[l][tile].n;
            if (end <= first || start >= first + count) continue;
            nodes_positions(out->nodes, out->mesh, l, tile, out->x);
            size_t low = start > first ? start : first, high = end < first + count ? end : first + count;
            memcpy(x + (low - first), out->x + (low - start), (high - low) * sizeof *x);
        }
    }
}

/* Corners of the cells of a part in VTK's order: a line; a quad counter-clockwise; a hexahedron's bottom, then its
 * top. */
static void vtkhdf_connect(struct vtkhdf *out, const struct vtkhdf_part *part, int32_t *ret_corners)
{
    static const int turn[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    const int *points = out->nodes->n;
    int from[3], box[3], at[3];
    if (vtkhdf_turn(out, part->block)) nodes_of_tile(out->nodes, out->mesh, out->level, out->tile, out->numbers);
    leaves_box(out->leaves, part->block, from, box);
    vtkhdf_place(from, box, part->from, at);
    for (size_t i = part->from; i < part->to; i++, vtkhdf_next(from, box, at)) {
        for (int c = 0; c < out->corners; c++)
            *ret_corners++ =
                out->numbers[at[0] + turn[c][0] + points[0] * (at[1] + turn[c][1] + points[1] * (at[2] + turn[c][2]))];
    }
}

static void vtkhdf_fill_connectivity(void *context, size_t first, size_t count, void *to)
{
    struct vtkhdf *out = context;
    size_t corners = (size_t)out->corners, end = (first + count) / corners;
    int32_t *at = to;
    for (size_t cell = first / corners; cell < end;) {
        struct vtkhdf_part part = vtkhdf_part(out, cell, end);
        vtkhdf_connect(out, &part, at);
        at += (part.to - part.from) * corners;
        cell += part.to - part.from;
    }
}

static void vtkhdf_fill_offsets(void *context, size_t first, size_t count, void *to)
{
    const struct vtkhdf *out = context;
    int32_t *offsets = to;
    for (size_t i = 0; i < count; i++) offsets[i] = (int32_t)((first + i) * (size_t)out->corners);
}

static void vtkhdf_fill_types(void *context, size_t first, size_t count, void *to)
{
    static const unsigned char types[] = {[1] = 3, [2] = 9, [3] = 12}; /* VTK_LINE, VTK_QUAD, VTK_HEXAHEDRON */
    const struct vtkhdf *out = context;
    (void)first;
    memset(to, types[out->mesh->dim], count);
}

/* Which cells and points this rank writes, level by level. */
static void vtkhdf_divide(struct vtkhdf *out)
{
    for (int l = 0; l < out->mesh->n_level; l++) {
        for (int kind = 0; kind < LEAVES_KINDS; kind++) {
            const struct leaves_run *run = &out->leaves->runs[l][kind];
            out->cells[out->n_range++] = (struct h5out_range){run->local_first, run->local};
        }
        out->points[l] = (struct h5out_range){out->nodes->first[l], out->nodes->own[l]};
    }
}

void vtkhdf_forget(struct vtkhdf_cells *cells)
{
    nodes_free(cells->nodes);
    h5out_forget(&cells->points);
    h5out_forget(&cells->connectivity);
    h5out_forget(&cells->offsets);
    h5out_forget(&cells->types);
    *cells = (struct vtkhdf_cells){.most = cells->most};
}

/* Bytes of points and connections. */
static size_t vtkhdf_bytes(const struct vtkhdf *out)
{
    size_t cell = (size_t)out->corners * sizeof(int32_t) + sizeof(int32_t) + 1;
    return out->nodes->total * 3 * sizeof(double) + out->leaves->n_cell * cell;
}

/* Goes on with the points of the file before, if they are those of this mesh. */
static void vtkhdf_recall(struct vtkhdf *out, struct vtkhdf_cells *cells)
{
    out->again = cells->is_kept && cells->revision == out->mesh->revision;
    if (!out->again) {
        vtkhdf_forget(cells);
        cells->nodes = nodes_new(out->mesh);
        cells->revision = out->mesh->revision;
    }
    out->nodes = cells->nodes;
    out->kept = vtkhdf_bytes(out) / (size_t)out->file->writers <= cells->most ? cells : NULL;
    out->again = out->again && out->kept;
}

static void vtkhdf_begin(struct vtkhdf *out, struct vtkhdf_cells *cells)
{
    const struct mesh *mesh = out->mesh;
    size_t tiles = VTKHDF_CHUNK_ROWS / mesh->n_cell;
    if (tiles > VTKHDF_CHUNK_TILES) tiles = VTKHDF_CHUNK_TILES;
    out->chunk = mesh->n_cell * (tiles ? tiles : 1);
    out->corners = 1 << mesh->dim;
    vtkhdf_recall(out, cells);
    out->values = mem_new(3 * mesh->n_cell, sizeof *out->values);
    out->numbers = mem_new(out->nodes->n_point, sizeof *out->numbers);
    out->x = mem_new(out->nodes->n_point, sizeof *out->x);
    vtkhdf_divide(out);
}

static void vtkhdf_end(struct vtkhdf *out)
{
    mem_free(out->values);
    mem_free(out->numbers);
    mem_free(out->x);
}

/* Ranges of rows that are `factor` per cell; the last rank adds `more` rows at the end. */
static void vtkhdf_scale(const struct vtkhdf *out, size_t factor, size_t more, struct h5out_range *ret_ranges)
{
    for (unsigned i = 0; i < out->n_range; i++)
        ret_ranges[i] = (struct h5out_range){out->cells[i].first * factor, out->cells[i].count * factor};
    if (more && comm_rank() == comm_size() - 1) {
        struct h5out_range *last = &ret_ranges[out->n_range - 1];
        if (!last->count) last->first = out->leaves->n_cell * factor;
        last->count += more;
    }
}

static int vtkhdf_write_points(struct vtkhdf *out)
{
    struct h5out_rows rows = {.type = H5_F64,
                              .columns = 3,
                              .total = out->nodes->total,
                              .chunk = out->chunk,
                              .kept = out->kept ? &out->kept->points : NULL,
                              .again = out->again,
                              .n_range = (unsigned)out->mesh->n_level,
                              .ranges = out->points,
                              .fill = vtkhdf_fill_points,
                              .context = out};
    return h5out_write(out->file, "/VTKHDF/Points", &rows);
}

static int vtkhdf_write_cells(struct vtkhdf *out)
{
    struct h5out_range ranges[LEAVES_KINDS * MESH_LEVELS];
    size_t corners = (size_t)out->corners;
    struct vtkhdf_cells *kept = out->kept;
    struct h5out_rows rows = {
        .type = H5_I32, .again = out->again, .n_range = out->n_range, .ranges = ranges, .context = out};
    vtkhdf_scale(out, corners, 0, ranges);
    rows.total = out->leaves->n_cell * corners;
    rows.chunk = out->chunk * corners;
    rows.fill = vtkhdf_fill_connectivity;
    rows.kept = kept ? &kept->connectivity : NULL;
    out->level = -1;
    TRY(h5out_write(out->file, "/VTKHDF/Connectivity", &rows));
    vtkhdf_scale(out, 1, 1, ranges);
    rows.total = out->leaves->n_cell + 1;
    rows.chunk = out->chunk;
    rows.fill = vtkhdf_fill_offsets;
    rows.kept = kept ? &kept->offsets : NULL;
    TRY(h5out_write(out->file, "/VTKHDF/Offsets", &rows));
    vtkhdf_scale(out, 1, 0, ranges);
    rows.total = out->leaves->n_cell;
    rows.type = H5_U8;
    rows.fill = vtkhdf_fill_types;
    rows.kept = kept ? &kept->types : NULL;
    return h5out_write(out->file, "/VTKHDF/Types", &rows);
}

static int vtkhdf_write_counts(struct vtkhdf *out)
{
    int64_t points = (int64_t)out->nodes->total, cells = (int64_t)out->leaves->n_cell, ids = cells * out->corners;
    if (ids > INT32_MAX || points > INT32_MAX)
        return status_fail(STATUS_RUN, "%s: %lld cells are more than a plot file can hold (%d)", out->file->path,
                           (long long)cells, INT32_MAX / out->corners);
    h5out_array(out->file, "/VTKHDF/NumberOfPoints", H5_I64, 1, 0, &points);
    h5out_array(out->file, "/VTKHDF/NumberOfCells", H5_I64, 1, 0, &cells);
    h5out_array(out->file, "/VTKHDF/NumberOfConnectivityIds", H5_I64, 1, 0, &ids);
    return STATUS_OK;
}

static int vtkhdf_write_field(struct vtkhdf *out, const struct derive *field)
{
    char path[SCENE_NAME + 32];
    snprintf(path, sizeof path, "/VTKHDF/CellData/%s", field->name);
    out->field = field;
    out->level = -1;
    struct h5out_rows rows = {.type = out->type,
                              .columns = field->components > 1 ? field->components : 0,
                              .total = out->leaves->n_cell,
                              .chunk = out->chunk,
                              .n_range = out->n_range,
                              .ranges = out->cells,
                              .fill = vtkhdf_fill_field,
                              .context = out};
    TRY(h5out_write(out->file, path, &rows));
    h5out_unit(out->file, path, field->unit);
    return STATUS_OK;
}

static void vtkhdf_write_frame(struct vtkhdf *out)
{
    static const char *const groups[] = {"/VTKHDF", "/VTKHDF/CellData", "/VTKHDF/PointData", "/VTKHDF/FieldData"};
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++) h5_group(out->file, groups[i]);
    h5_attribute(out->file, "/VTKHDF", "Version", H5_I64, 2, (int64_t[]){1, 0});
    h5_attribute_text(out->file, "/VTKHDF", "Type", "UnstructuredGrid");
    h5out_array(out->file, "/VTKHDF/FieldData/TimeValue", H5_F64, 1, 0, &out->state->t);
}

int vtkhdf_write(struct h5 *file, const struct state *state, const struct leaves *leaves,
                 const struct vtkhdf_fields *fields, struct vtkhdf_cells *cells)
{
    struct vtkhdf out = {.file = file, .state = state, .mesh = state->mesh, .leaves = leaves, .type = fields->type};
    vtkhdf_begin(&out, cells);
    vtkhdf_write_frame(&out);
    int code = vtkhdf_write_counts(&out);
    if (!code) code = vtkhdf_write_points(&out);
    if (!code) code = vtkhdf_write_cells(&out);
    cells->is_kept = !code && out.kept;
    for (unsigned i = 0; !code && i < fields->n; i++) code = vtkhdf_write_field(&out, &fields->at[i]);
    vtkhdf_end(&out);
    return code;
}
