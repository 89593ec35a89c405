/* source_value.c - see source_value.h. */
#include "scheme/source_value.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/scene_boundary.h"
#include "case/script_table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Names of one value in a Lua table: "force_x" and "force.1", or one alone. */
struct source_value_names {
    char text[SOURCE_VALUE_NAMES][SCENE_NAME + 24];
    const char *list[SOURCE_VALUE_NAMES];
};

static void source_value_name(struct source_value *values, struct source_value_names *names, unsigned slot,
                              const char *group, const char *plain, const char *element)
{
    for (int spelling = 0; spelling < (element ? 2 : 1); spelling++) {
        char *text = names->text[values->n_name];
        if (!element) snprintf(text, sizeof *names->text, "%s", group);
        else snprintf(text, sizeof *names->text, spelling ? "%s.%s" : "%s_%s", group, spelling ? element : plain);
        names->list[values->n_name] = text;
        values->slot[values->n_name++] = (unsigned char)slot;
    }
}

/* What a Lua table may hold in this scene. */
static void source_value_name_all(struct source_value *values)
{
    static const char *const axis[] = {"x", "y", "z"}, *const number[] = {"1", "2", "3"};
    struct source_value_names *names = mem_new(1, sizeof *names);
    const struct model *model = values->model;
    for (unsigned d = 0; d < model->n_velocity; d++) {
        source_value_name(values, names, SCENE_SOURCE_ACCELERATION + d, "acceleration", axis[d], number[d]);
        source_value_name(values, names, SCENE_SOURCE_FORCE + d, "force", axis[d], number[d]);
    }
    source_value_name(values, names, SCENE_SOURCE_HEATING, "heating", NULL, NULL);
    for (unsigned l = 0; l < model->n_material; l++) {
        const char *material = model->scene->material[l].name;
        source_value_name(values, names, SCENE_SOURCE_HEATING_OF + l, "heating", material, material);
        source_value_name(values, names, SCENE_SOURCE_MASS + l, "mass", material, material);
        if (model->n_alpha) source_value_name(values, names, SCENE_SOURCE_FRACTION + l, "alpha", material, material);
    }
    for (unsigned c = 0; c < model->n_stretch; c++)
        source_value_name(values, names, SCENE_SOURCE_STRETCH + c, "stretch", model_tensor[c], model_tensor[c]);
    values->names = script_table(model->scene->host, names->list, values->n_name);
    mem_free(names);
}

struct source_value *source_value_new(const struct model *model, const struct mesh *mesh)
{
    const struct scene_sources *sources = model->scene->sources;
    struct source_value *values = mem_new(1, sizeof *values);
    values->model = values->path = model;
    values->mesh = mesh;
    if (sources->script) source_value_name_all(values);
    values->rows = mem_new((size_t)SCENE_SOURCES * SOURCE_VALUE_BATCH, sizeof *values->rows);
    for (unsigned s = 0; s < SCENE_SOURCES; s++) {
        const struct scene_value *value = &sources->value[s];
        bool named = value->given;
        for (unsigned i = 0; i < values->n_name; i++) named = named || values->slot[i] == s;
        if (!named) continue;
        values->row[s] = values->rows + (size_t)s * SOURCE_VALUE_BATCH;
        if (value->given && value->script) values->varying[values->n_varying++] = (unsigned char)s;
        else
            for (size_t i = 0; i < SOURCE_VALUE_BATCH; i++) values->row[s][i] = value->given ? value->number : 0.0;
    }
    return values;
}

void source_value_free(struct source_value *values)
{
    if (!values) return;
    mem_free(values->rows);
    mem_free(values->message);
    mem_free(values);
}

/* Position of the lower face of cell `index` of a level. */
static double source_value_plane(const struct mesh *mesh, const struct level *level, int axis, int index)
{
    int cells = level->extent[axis] * mesh->n[axis];
    return (mesh->lower[axis] * (cells - index) + mesh->upper[axis] * index) / cells;
}

void source_value_places(struct source_value *values, const struct level *level, const struct tile *tile)
{
    const struct mesh *mesh = values->mesh;
    for (int d = 0; d < mesh->dim; d++)
        for (int i = 0; i < mesh->n[d]; i++) {
            int cell = tile->at[d] * mesh->n[d] + i;
            values->x[d][i] = metric_centroid(d ? 0 : mesh->beta, source_value_plane(mesh, level, d, cell),
                                              source_value_plane(mesh, level, d, cell + 1));
        }
}

/* The first failure: in which cell of which tile. */
static void source_value_fail(struct source_value *values, const struct tile *tile, int status, const double x[3],
                              const size_t cell[3])
{
    if (values->status) return;
    values->status = status;
    values->message = mem_text(status_text());
    snprintf(values->place, sizeof values->place,
             "tile (%d, %d, %d), sources at (%.9g, %.9g, %.9g) m, in cell (%zu, %zu, %zu)", tile->at[0], tile->at[1],
             tile->at[2], x[0], x[1], x[2], cell[0], cell[1], cell[2]);
}

/* The values that vary, at one point, into element i of their rows. */
static int source_value_ask(struct source_value *values, const double x[3], double t, size_t i)
{
    const struct scene_sources *sources = values->model->scene->sources;
    double r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), out[SOURCE_VALUE_NAMES], in[] = {x[0], x[1], x[2], t};
    for (unsigned k = 0; k < values->n_name; k++) {
        const struct scene_value *value = &sources->value[values->slot[k]];
        values->row[values->slot[k]][i] = value->given ? value->number : 0.0;
    }
    for (unsigned k = 0; k < values->n_varying; k++) {
        unsigned s = values->varying[k];
        TRY(scene_value_at(&sources->value[s], x, r, t, &values->row[s][i]));
    }
    if (!sources->script) return STATUS_OK;
    TRY(script_table_call(sources->script, in, 4, values->names, out));
    for (unsigned k = 0; k < values->n_name; k++)
        if (!isnan(out[k])) values->row[values->slot[k]][i] += out[k];
    return STATUS_OK;
}

/* The same for all; a script that fails leaves NaN. */
static void source_value_point(struct source_value *values, const struct tile *tile, const double x[3],
                               const size_t cell[3], double t, size_t i)
{
    int status = source_value_ask(values, x, t, i);
    if (!status) return;
    source_value_fail(values, tile, status, x, cell);
    for (unsigned k = 0; k < values->n_varying; k++) values->row[values->varying[k]][i] = (double)NAN;
    for (unsigned k = 0; k < values->n_name; k++) values->row[values->slot[k]][i] = (double)NAN;
}

void source_value_cells(struct source_value *values, const struct tile *tile, double t, size_t from, size_t n)
{
    const struct mesh *mesh = values->mesh;
    if (!values->n_varying && !values->n_name) return;
    for (size_t i = 0; i < n; i++) {
        double x[3] = {0.0};
        size_t rest = from + i, cell[3] = {0};
        for (int d = 0; d < mesh->dim; d++) {
            cell[d] = rest % (size_t)mesh->n[d];
            rest /= (size_t)mesh->n[d];
            x[d] = values->x[d][cell[d]];
        }
        source_value_point(values, tile, x, cell, t, i);
    }
}

/* Middle of a cell of the domain: once round in a periodic one, else never outside. */
static double source_value_middle(const struct source_value *values, const struct source_value_place *place, int axis,
                                  int cell)
{
    const struct mesh *mesh = values->mesh;
    int cells = place->level->extent[axis] * mesh->n[axis], index = place->tile->at[axis] * mesh->n[axis] + cell;
    if (scene_boundary_is(values->model->scene, 2 * axis, SCENE_BOUNDARY_WRAPS)) index = (index + cells) % cells;
    index = index < 0 ? 0 : index >= cells ? cells - 1 : index;
    return metric_centroid(axis ? 0 : mesh->beta, source_value_plane(mesh, place->level, axis, index),
                           source_value_plane(mesh, place->level, axis, index + 1));
}

double source_value_cell(struct source_value *values, const struct source_value_place *place, const int cell[3])
{
    const struct scene_value *value = &values->model->scene->sources->value[SCENE_SOURCE_ACCELERATION + place->axis];
    double x[3] = {0.0}, a = value->number;
    if (!value->script) return a;
    for (int d = 0; d < values->mesh->dim; d++) x[d] = source_value_middle(values, place, d, cell[d]);
    double r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    return scene_value_at(value, x, r, place->t, &a) ? 0.0 : a;
}

/* The cell of a tile at (outer, i, inner) of a piece. */
static void source_value_index(const struct mesh *mesh, const struct frame *frame, size_t outer, int i, size_t inner,
                               int ret_cell[3])
{
    size_t rest[2] = {frame->inner_from + inner, frame->outer_from + outer};
    for (int d = 0; d < 3; d++) {
        size_t *index = &rest[d > frame->axis], n = (size_t)mesh->n[d];
        ret_cell[d] = d == frame->axis ? i : (int)(*index % n);
        if (d != frame->axis) *index /= n;
    }
}

void source_value_frame(struct source_value *values, const struct source_value_place *place, const struct frame *frame,
                        int from, int to, double *acceleration)
{
    const struct scene_value *value = &values->model->scene->sources->value[SCENE_SOURCE_ACCELERATION + place->axis];
    for (size_t i = 0; i < frame->count; i++) acceleration[i] = value->number;
    if (!value->script) return;
    for (size_t o = 0; o < frame->outer; o++)
        for (int i = from; i < to; i++)
            for (size_t c = 0; c < frame->inner; c++) {
                int cell[3];
                source_value_index(values->mesh, frame, o, i, c, cell);
                acceleration[frame_at(frame, o, i) + c] = source_value_cell(values, place, cell);
            }
}
