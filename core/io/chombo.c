/* chombo.c - see chombo.h. */
#include "io/chombo.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/h5out.h"
#include "io/h5view.h"

#include <math.h>
#include <stdio.h>

enum { CHOMBO_PATH = 64, CHOMBO_REFINE = 2 };

static const char *const chombo_box_2d[] = {"lo_i", "lo_j", "hi_i", "hi_j"};
static const char *const chombo_box_3d[] = {"lo_i", "lo_j", "lo_k", "hi_i", "hi_j", "hi_k"};
static const char *const chombo_vector[] = {"intvecti", "intvectj", "intvectk"};

static const char *const *chombo_box(int dim)
{
    return dim == 2 ? chombo_box_2d : chombo_box_3d;
}

/* One column per component: a vector's components get the names of the scalar fields. */
static unsigned chombo_columns(const struct vtkhdf_fields *fields, char (**ret_names)[2 * SCENE_NAME],
                               struct h5view_column **ret_columns)
{
    unsigned most = 3 * fields->n, n = 0;
    char(*names)[2 * SCENE_NAME] = mem_new(2 * (size_t)most + 1, sizeof *names); /* names, then paths */
    struct h5view_column *columns = mem_new((size_t)most + 1, sizeof *columns);
    for (unsigned i = 0; i < fields->n; i++) {
        const struct derive *field = &fields->at[i];
        for (unsigned q = 0; q < field->components; q++, n++) {
            if (field->components == 1) snprintf(names[n], sizeof *names, "%s", field->name);
            else snprintf(names[n], sizeof *names, "%s_%c", field->name, "xyz"[q]);
            snprintf(names[most + n], sizeof *names, "/VTKHDF/CellData/%s", field->name);
            columns[n] = (struct h5view_column){names[most + n], field->components > 1 ? field->components : 0, q};
        }
    }
    *ret_names = names;
    *ret_columns = columns;
    return n;
}

static void chombo_root(struct h5 *file, const struct mesh *mesh, unsigned n, char (*names)[2 * SCENE_NAME])
{
    int32_t levels = mesh->n_level, finest = levels - 1, components = (int32_t)n, dim = mesh->dim;
    h5_attribute(file, "/", "num_levels", H5_I32, 0, &levels);
    h5_attribute(file, "/", "max_level", H5_I32, 0, &finest);
    h5_attribute(file, "/", "num_components", H5_I32, 0, &components);
    for (unsigned q = 0; q < n; q++) {
        char name[CHOMBO_PATH];
        snprintf(name, sizeof name, "component_%u", q);
        h5_attribute_text(file, "/", name, names[q]);
    }
    h5_group(file, "/Chombo_global");
    h5_attribute(file, "/Chombo_global", "SpaceDim", H5_I32, 0, &dim);
}

/* Box of `count` cells from cell `at` of a level on, both ends included. */
static void chombo_cells(const struct mesh *mesh, const struct level *level, const int at[3], const int count[3],
                         int32_t *ret_box)
{
    for (int axis = 0; axis < mesh->dim; axis++) {
        int32_t origin = (int32_t)lround(mesh->lower[axis] / level->h[axis]);
        ret_box[axis] = origin + at[axis];
        ret_box[mesh->dim + axis] = ret_box[axis] + count[axis] - 1;
    }
}

/* For h5out: a level of which boxes and offsets are told. */
struct chombo_blocks {
    const struct leaves *leaves;
    int l;
    unsigned n_column;
};

/* Blocks of a level, of all ranks: tiles, then octants. */
static size_t chombo_count(const struct leaves *leaves, int l)
{
    return leaves->runs[l][0].all + leaves->runs[l][1].all;
}

/* Boxes of own blocks from number `first` of the level on. */
static void chombo_fill_boxes(void *context, size_t first, size_t count, void *out)
{
    const struct chombo_blocks *blocks = context;
    const struct leaves_run *runs = blocks->leaves->runs[blocks->l];
    const struct mesh *mesh = blocks->leaves->mesh;
    const struct level *level = &mesh->levels[blocks->l];
    int32_t *boxes = out;
    for (size_t i = first; i < first + count; i++, boxes += 2 * mesh->dim) {
        const struct leaves_run *run = &runs[i >= runs[0].all];
        unsigned block = run->from + (unsigned)(i - (run == runs ? 0 : runs[0].all) - run->before);
        const int *tile = level->tiles[blocks->leaves->blocks[block].tile].at;
        int at[3], cells[3];
        leaves_box(blocks->leaves, block, at, cells);
        for (int axis = 0; axis < 3; axis++) at[axis] += tile[axis] * mesh->n[axis];
        chombo_cells(mesh, level, at, cells, boxes);
    }
}

static int chombo_boxes(struct h5 *file, const struct leaves *leaves, int l, const char *group)
{
    char path[CHOMBO_PATH];
    const struct leaves_run *runs = leaves->runs[l];
    unsigned width = 2 * (unsigned)leaves->mesh->dim;
    struct chombo_blocks context = {leaves, l, 0};
    const struct h5out_range ranges[LEAVES_KINDS] = {{runs[0].before, runs[0].n},
                                                     {runs[0].all + runs[1].before, runs[1].n}};
    const struct h5out_rows rows = {.type = H5_I32,
                                    .columns = width,
                                    .members = chombo_box(leaves->mesh->dim),
                                    .total = chombo_count(leaves, l),
                                    .chunk = H5OUT_TABLE / (width * sizeof(int32_t)),
                                    .central = true,
                                    .n_range = LEAVES_KINDS,
                                    .ranges = ranges,
                                    .fill = chombo_fill_boxes,
                                    .context = &context};
    snprintf(path, sizeof path, "%s/boxes", group);
    return h5out_write(file, path, &rows);
}

static void chombo_fill_offsets(void *context, size_t first, size_t count, void *out)
{
    const struct chombo_blocks *blocks = context;
    const struct leaves_run *runs = blocks->leaves->runs[blocks->l];
    int64_t *offsets = out;
    for (size_t i = first; i < first + count; i++) {
        size_t tiles = i < runs[0].all ? i : runs[0].all;
        *offsets++ = (int64_t)((tiles * runs[0].cells + (i - tiles) * runs[1].cells) * blocks->n_column);
    }
}

/* Where the data of each block begin, and the last end: rank 0 knows it from their numbers alone. */
static int chombo_offsets(struct h5 *file, const struct leaves *leaves, int l, const char *group, unsigned n_column)
{
    char path[CHOMBO_PATH];
    size_t n = chombo_count(leaves, l) + 1;
    struct chombo_blocks context = {leaves, l, n_column};
    const struct h5out_range range = {0, comm_rank() == 0 ? n : 0};
    const struct h5out_rows rows = {.type = H5_I64,
                                    .total = n,
                                    .chunk = H5OUT_TABLE / sizeof(int64_t),
                                    .central = true,
                                    .n_range = 1,
                                    .ranges = &range,
                                    .fill = chombo_fill_offsets,
                                    .context = &context};
    snprintf(path, sizeof path, "%s/data:offsets=0", group);
    return h5out_write(file, path, &rows);
}

static void chombo_level_attributes(struct h5 *file, const struct state *state, int l, const char *group)
{
    const struct mesh *mesh = state->mesh;
    const struct level *level = &mesh->levels[l];
    int32_t refine = CHOMBO_REFINE, domain[6];
    int cells[3];
    for (int axis = 0; axis < 3; axis++) cells[axis] = level->extent[axis] * mesh->n[axis];
    chombo_cells(mesh, level, (const int[]){0, 0, 0}, cells, domain);
    h5_group(file, group);
    h5_attribute(file, group, "dx", H5_F64, 0, &level->h[0]);
    h5_attribute(file, group, "dt", H5_F64, 0, &state->dt);
    h5_attribute(file, group, "time", H5_F64, 0, &state->t);
    h5_attribute(file, group, "ref_ratio", H5_I32, 0, &refine);
    h5_attribute_record(file, group, "prob_domain", chombo_box(mesh->dim), 2 * (unsigned)mesh->dim, domain);
}

static void chombo_data_attributes(struct h5 *file, int dim, const char *group, unsigned n)
{
    char path[CHOMBO_PATH];
    const int32_t components = (int32_t)n, none[3] = {0};
    snprintf(path, sizeof path, "%s/data_attributes", group);
    h5_group(file, path);
    h5_attribute(file, path, "comps", H5_I32, 0, &components);
    h5_attribute_text(file, path, "objectType", "FArrayBox");
    h5_attribute_record(file, path, "ghost", chombo_vector, (unsigned)dim, none);
    h5_attribute_record(file, path, "outputGhost", chombo_vector, (unsigned)dim, none);
}

static int chombo_level(struct h5 *file, const struct state *state, const struct leaves *leaves, int l,
                        struct h5view *view)
{
    struct h5view_groups runs[LEAVES_KINDS];
    char group[CHOMBO_PATH / 2], path[CHOMBO_PATH];
    snprintf(group, sizeof group, "/level_%d", l);
    chombo_level_attributes(file, state, l, group);
    TRY(chombo_boxes(file, leaves, l, group));
    TRY(chombo_offsets(file, leaves, l, group, view->n_column));
    chombo_data_attributes(file, state->mesh->dim, group, view->n_column);
    for (int kind = 0; kind < LEAVES_KINDS; kind++) {
        const struct leaves_run *run = &leaves->runs[l][kind];
        runs[kind] = (struct h5view_groups){run->first, run->cells, run->all};
    }
    view->runs = runs;
    view->n_run = LEAVES_KINDS;
    snprintf(path, sizeof path, "%s/data:datatype=0", group);
    h5view_write(file, path, view);
    return STATUS_OK;
}

int chombo_write(struct h5 *file, const struct state *state, const struct leaves *leaves,
                 const struct vtkhdf_fields *fields)
{
    const struct mesh *mesh = state->mesh;
    char(*names)[2 * SCENE_NAME];
    struct h5view_column *columns;
    unsigned n = chombo_columns(fields, &names, &columns);
    struct h5view view = {.type = fields->type, .n_column = n, .columns = columns, .total = leaves->n_cell};
    chombo_root(file, mesh, n, names);
    int code = STATUS_OK;
    for (int l = 0; !code && l < mesh->n_level; l++) code = chombo_level(file, state, leaves, l, &view);
    mem_free(columns);
    mem_free(names);
    return code;
}
