/* map_values.c - see map_values.h. Lines are sampled; pieces of a surface are shared out over the places that
 * they cover, each as wide as the cell that it lies in, so that neither fine places nor coarse cells leave gaps. */
#include "io/map_values.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/region.h"
#include "io/sample.h"
#include "io/surface.h"

#include <math.h>
#include <string.h>

int map_values_init(struct map_values *values, const struct state *state, const struct scene_map *map,
                    struct text *columns)
{
    *values = (struct map_values){.map = map, .n_field = map->n_field};
    values->fields = mem_new(map->n_field, sizeof *values->fields);
    for (unsigned i = 0; i < map->n_field; i++) {
        struct derive *field = &values->fields[i];
        int code = derive_find(state->model, map->fields[i], field);
        if (code) return status_wrap(code, "output.maps.%s.fields: ", map->name);
        unsigned components = map->at ? field->components : 1;
        for (unsigned q = 0; q < components; q++) {
            text_add(columns, ",%s", field->name);
            if (components > 1) text_add(columns, "_%c", "xyz"[q]);
        }
        values->n_value += components;
    }
    values->values = mem_new((size_t)map->n_point * values->n_value, sizeof(double));
    if (map->at) values->sample = sample_new(state->mesh, map->n_point, (const double(*)[3])map->at);
    else if (map->where) values->where = region_new(state->mesh, map->where);
    return STATUS_OK;
}

void map_values_done(struct map_values *values)
{
    sample_free(values->sample);
    region_free(values->where);
    mem_free(values->fields);
    mem_free(values->values);
}

static void map_values_line(struct map_values *values, const struct state *state, const struct derive *field,
                            double *to)
{
    unsigned n = values->map->n_point, room = sample_room(values->sample, field);
    double *parts = mem_new((size_t)n * room, sizeof *parts);
    sample_collect(values->sample, state, field, 0, n, parts);
    comm_max(parts, (int)(n * room));
    sample_blend(values->sample, field, 0, n, parts, values->n_value, to);
    mem_free(parts);
}

/* Adds a piece to the places that it covers; sums: area times value, and area, of each place. */
static void map_values_share(const struct scene_map *map, const struct surface_piece *piece, double (*sums)[2])
{
    double lower = piece->x[map->axis] - 0.5 * piece->h[map->axis], upper = lower + piece->h[map->axis];
    double start = map->place[0] - 0.5 * map->width;
    long first = (long)floor((lower - start) / map->width), last = (long)floor((upper - start) / map->width);
    for (long i = first < 0 ? 0 : first; i <= last && i < (long)map->n_point; i++) {
        double from = start + (double)i * map->width, to = from + map->width;
        double covered = (upper < to ? upper : to) - (lower > from ? lower : from);
        if (!(covered > 0.0)) continue;
        double area = piece->area * covered / piece->h[map->axis];
        sums[i][0] += area * piece->value;
        sums[i][1] += area;
    }
}

static void map_values_surface(struct map_values *values, const struct state *state, const struct derive *field,
                               double *to)
{
    const struct scene_map *map = values->map;
    size_t n_piece;
    double(*sums)[2] = mem_new(map->n_point, sizeof *sums);
    struct surface_piece *pieces = surface_pieces(state, (unsigned)map->material, field, values->where, &n_piece);
    for (size_t i = 0; i < n_piece; i++) map_values_share(map, &pieces[i], sums);
    for (unsigned i = 0; i < map->n_point; i++)
        to[(size_t)i * values->n_value] = sums[i][1] > 0.0 ? sums[i][0] / sums[i][1] : NAN;
    mem_free(pieces);
    mem_free(sums);
}

void map_values_take(struct map_values *values, const struct state *state, struct derive_moment *moment)
{
    double *to = values->values;
    region_follow(values->where, state->mesh);
    for (unsigned i = 0; i < values->n_field; i++) {
        struct derive *field = &values->fields[i];
        derive_prepare(moment, field);
        (values->map->at ? map_values_line : map_values_surface)(values, state, field, to);
        to += values->map->at ? field->components : 1;
    }
}
