/* chombo.c - see chombo.h. */
#include "io/chombo.h"

#include "base/mem.h"
#include "io/h5out.h"

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
                               struct h5out_column **ret_columns)
{
    unsigned most = 3 * fields->n, n = 0;
    char(*names)[2 * SCENE_NAME] = mem_new(2 * (size_t)most + 1, sizeof *names); /* names, then paths */
    struct h5out_column *columns = mem_new((size_t)most + 1, sizeof *columns);
    for (unsigned i = 0; i < fields->n; i++) {
        const struct derive *field = &fields->at[i];
        for (unsigned q = 0; q < field->components; q++, n++) {
            if (field->components == 1) snprintf(names[n], sizeof *names, "%s", field->name);
            else snprintf(names[n], sizeof *names, "%s_%c", field->name, "xyz"[q]);
            snprintf(names[most + n], sizeof *names, "/VTKHDF/CellData/%s", field->name);
            columns[n] = (struct h5out_column){names[most + n], field->components > 1 ? field->components : 0, q};
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

/* Box of `count` tiles from tile coordinates `at` on, in cells of the level, both ends included. */
static void chombo_cells(const struct mesh *mesh, const struct level *level, const int at[3], const int count[3],
                         int32_t *ret_box)
{
    for (int axis = 0; axis < mesh->dim; axis++) {
        int32_t origin = (int32_t)lround(mesh->lower[axis] / level->h[axis]);
        ret_box[axis] = origin + at[axis] * mesh->n[axis];
        ret_box[mesh->dim + axis] = ret_box[axis] + count[axis] * mesh->n[axis] - 1;
    }
}

static void chombo_boxes(struct h5 *file, const struct mesh *mesh, const struct level *level, const char *group)
{
    char path[CHOMBO_PATH];
    unsigned width = 2 * (unsigned)mesh->dim;
    int32_t *boxes = mem_new((size_t)level->n_tile * width, sizeof *boxes);
    for (unsigned tile = 0; tile < level->n_tile; tile++)
        chombo_cells(mesh, level, level->tiles[tile].at, (const int[]){1, 1, 1}, boxes + (size_t)tile * width);
    snprintf(path, sizeof path, "%s/boxes", group);
    h5out_records(file, path, chombo_box(mesh->dim), width, level->n_tile, boxes);
    mem_free(boxes);
}

static void chombo_offsets(struct h5 *file, const struct mesh *mesh, const struct level *level, const char *group,
                           unsigned n)
{
    char path[CHOMBO_PATH];
    int64_t *offsets = mem_new((size_t)level->n_tile + 1, sizeof *offsets);
    for (unsigned tile = 0; tile <= level->n_tile; tile++) offsets[tile] = (int64_t)(tile * n * mesh->n_cell);
    snprintf(path, sizeof path, "%s/data:offsets=0", group);
    h5out_array(file, path, H5_I64, (size_t)level->n_tile + 1, 0, offsets);
    mem_free(offsets);
}

static void chombo_level_attributes(struct h5 *file, const struct state *state, int l, const char *group)
{
    const struct mesh *mesh = state->mesh;
    const struct level *level = &mesh->levels[l];
    int32_t refine = CHOMBO_REFINE, domain[6];
    chombo_cells(mesh, level, (const int[]){0, 0, 0}, level->extent, domain);
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

static void chombo_level(struct h5 *file, const struct state *state, int l, struct h5out_view *view)
{
    const struct mesh *mesh = state->mesh;
    const struct level *level = &mesh->levels[l];
    char group[CHOMBO_PATH / 2], path[CHOMBO_PATH];
    snprintf(group, sizeof group, "/level_%d", l);
    chombo_level_attributes(file, state, l, group);
    chombo_boxes(file, mesh, level, group);
    chombo_offsets(file, mesh, level, group, view->n_column);
    chombo_data_attributes(file, mesh->dim, group, view->n_column);
    view->first = vtkhdf_first_cell(mesh, l, 0);
    view->n_group = level->n_tile;
    snprintf(path, sizeof path, "%s/data:datatype=0", group);
    h5out_interleave(file, path, view);
}

void chombo_write(struct h5 *file, const struct state *state, const struct vtkhdf_fields *fields)
{
    const struct mesh *mesh = state->mesh;
    char(*names)[2 * SCENE_NAME];
    struct h5out_column *columns;
    unsigned n = chombo_columns(fields, &names, &columns);
    struct h5out_view view = {.type = fields->type,
                              .n_column = n,
                              .columns = columns,
                              .total = vtkhdf_first_cell(mesh, mesh->n_level, 0),
                              .group = mesh->n_cell};
    chombo_root(file, mesh, n, names);
    for (int l = 0; l < mesh->n_level; l++) chombo_level(file, state, l, &view);
    mem_free(columns);
    mem_free(names);
}
