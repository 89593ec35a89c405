/* sample.c - see sample.h. The cells around a point are found once per mesh: the rank that holds the point says of
 * which level they are. Each rank fills in those that it holds, a maximum over the ranks brings them together, and
 * every rank interpolates the same numbers in the same way. */
#include "io/sample.h"

#include "base/comm.h"
#include "base/mem.h"

#include <math.h>
#include <string.h>

enum { SAMPLE_CORNERS = 8 };

/* The cells around a point, x fastest: up to 2 per axis. */
struct sample_point {
    int level;
    int at[SAMPLE_CORNERS][3]; /* cell of the level */
    double weight[SAMPLE_CORNERS];
};

struct sample {
    unsigned n, n_corner;
    double (*at)[3];
    struct sample_point *points;
    unsigned revision; /* of the mesh in which points were found */
    double *tile;      /* [3][cells of a tile] the field there */
};

/* Lower of the two cells of a level around a coordinate, and the share of the upper one. */
static int sample_bracket(const struct mesh *mesh, const struct level *level, int axis, double x, double *ret_share)
{
    int cells = level->extent[axis] * mesh->n[axis];
    double place = (x - mesh->lower[axis]) / level->h[axis] - 0.5, below = floor(place);
    *ret_share = place - below;
    if (mesh->periodic[axis]) return (int)below;
    if (below < 0.0) *ret_share = 0.0;
    if (below >= cells - 1) *ret_share = 0.0;
    return below < 0.0 ? 0 : below >= cells - 1 ? cells - 1 : (int)below;
}

/* The tile of a level that holds a cell, or -1 (there is none, or nothing of it is here); ret_cell: the cell in it. */
static int sample_tile(const struct mesh *mesh, const struct level *level, const int at[3], size_t *ret_cell)
{
    const int *n = mesh->n, tile[3] = {at[0] / n[0], at[1] / n[1], at[2] / n[2]};
    *ret_cell = (size_t)(at[0] % n[0] + n[0] * (at[1] % n[1] + n[1] * (at[2] % n[2])));
    return mesh_find(mesh, level, tile);
}

/* The cells of a level around x; false if one of them is not there (or, where x is on another rank, not known). */
static bool sample_surround(const struct mesh *mesh, int l, const double x[3], struct sample_point *point)
{
    const struct level *level = &mesh->levels[l];
    int below[3] = {0};
    double share[3] = {0};
    bool there = true;
    point->level = l;
    for (int axis = 0; axis < mesh->dim; axis++) below[axis] = sample_bracket(mesh, level, axis, x[axis], &share[axis]);
    for (int corner = 0; corner < 1 << mesh->dim; corner++) {
        size_t cell;
        point->weight[corner] = 1.0;
        for (int axis = 0; axis < 3; axis++) {
            bool upper = corner >> axis & 1;
            int cells = level->extent[axis] * mesh->n[axis];
            int at = below[axis] + (upper && (share[axis] > 0.0));
            point->at[corner][axis] = (at + cells) % cells;
            if (axis < mesh->dim) point->weight[corner] *= upper ? share[axis] : 1.0 - share[axis];
        }
        there = there && sample_tile(mesh, level, point->at[corner], &cell) >= 0;
    }
    return there;
}

/* The finest level that has all cells around x, if x is on this rank; else -1. */
static double sample_level(const struct mesh *mesh, const double x[3], struct sample_point *point)
{
    size_t cell;
    unsigned local;
    int l;
    if (!mesh_locate(mesh, x, &l, &local, &cell)) return -1.0;
    return sample_surround(mesh, l, x, point) ? l : l - 1;
}

/* Finds the cells around every point: at the start, and again when tiles have come or gone. Collective. */
static void sample_look(struct sample *sample, const struct mesh *mesh)
{
    double *levels = mem_new(sample->n, sizeof *levels);
    for (unsigned i = 0; i < sample->n; i++) levels[i] = sample_level(mesh, sample->at[i], &sample->points[i]);
    comm_max(levels, (int)sample->n);
    for (unsigned i = 0; i < sample->n; i++) sample_surround(mesh, (int)levels[i], sample->at[i], &sample->points[i]);
    sample->revision = mesh->revision;
    mem_free(levels);
}

struct sample *sample_new(const struct mesh *mesh, unsigned n, const double (*at)[3])
{
    struct sample *sample = mem_new(1, sizeof *sample);
    sample->n = n;
    sample->n_corner = 1u << mesh->dim;
    sample->at = mem_new(n, sizeof *sample->at);
    memcpy(sample->at, at, n * sizeof *at);
    sample->points = mem_new(n, sizeof *sample->points);
    sample->tile = mem_new(3 * mesh->n_cell, sizeof *sample->tile);
    sample_look(sample, mesh);
    return sample;
}

void sample_free(struct sample *sample)
{
    if (!sample) return;
    mem_free(sample->at);
    mem_free(sample->points);
    mem_free(sample->tile);
    mem_free(sample);
}

/* Rows of corners: one per component, and the fractions of the field's material. */
static unsigned sample_rows(const struct derive *field)
{
    return field->components + (derive_material(field) >= 0);
}

unsigned sample_room(const struct sample *sample, const struct derive *field)
{
    return sample_rows(field) * sample->n_corner;
}

/* Values of a cell of the tile that is in sample->tile, one per row of corners. */
static void sample_put(const struct sample *sample, const struct state *state, const struct derive *field,
                       const double *u, size_t cell, double *to)
{
    const struct model *model = state->model;
    size_t n = state->mesh->n_cell;
    int material = derive_material(field);
    for (unsigned q = 0; q < field->components; q++, to += sample->n_corner) *to = sample->tile[q * n + cell];
    if (material < 0) return;
    double alpha = model->n_alpha ? u[(model->i_alpha + (unsigned)material) * n + cell] : 1.0;
    *to = sample->tile[cell] != 0.0 ? alpha : 0.0;
}

void sample_collect(struct sample *sample, const struct state *state, const struct derive *field, unsigned first,
                    unsigned n, double *parts)
{
    const struct mesh *mesh = state->mesh;
    unsigned room = sample_room(sample, field);
    int at_level = -1, at_tile = -1; /* the tile that is in sample->tile */
    if (sample->revision != mesh->revision) sample_look(sample, mesh);
    for (size_t i = 0; i < (size_t)n * room; i++) parts[i] = -INFINITY;
    for (unsigned i = 0; i < n; i++) {
        const struct sample_point *point = &sample->points[first + i];
        const struct level *level = &mesh->levels[point->level];
        for (unsigned corner = 0; corner < sample->n_corner; corner++) {
            size_t cell;
            int tile = sample_tile(mesh, level, point->at[corner], &cell);
            if (tile < 0 || level->tiles[tile].rank != comm_rank()) continue;
            unsigned local = (unsigned)tile - level->first;
            if (tile != at_tile || point->level != at_level)
                derive_tile(state->model, mesh, point->level, local, state->t, field, sample->tile);
            at_tile = tile;
            at_level = point->level;
            sample_put(sample, state, field, level->u_old[local], cell, parts + (size_t)i * room + corner);
        }
    }
}

void sample_blend(const struct sample *sample, const struct derive *field, unsigned first, unsigned n,
                  const double *parts, unsigned stride, double *ret_values)
{
    unsigned n_corner = sample->n_corner;
    bool weighed = derive_material(field) >= 0;
    for (unsigned i = 0; i < n; i++, parts += sample_room(sample, field))
        for (unsigned q = 0; q < field->components; q++) {
            const double *weight = sample->points[first + i].weight, *row = parts + q * n_corner;
            const double *alpha = parts + field->components * n_corner;
            double sum = 0.0, whole = 0.0;
            for (unsigned corner = 0; corner < n_corner; corner++) {
                double part = weighed ? weight[corner] * alpha[corner] : weight[corner];
                if (!(weight[corner] > 0.0)) continue;
                sum += part * row[corner];
                whole += part;
            }
            double value = !weighed ? sum : whole > 0.0 ? sum / whole : (double)NAN;
            ret_values[(size_t)i * stride + q] = isinf(value) ? NAN : value; /* a NaN is lost in the maximum */
        }
}
