/* line.c - see line.h. Leaves of all levels that the line runs through follow each other without
 * gaps; every rank gets them all, sorted by place. */
#include "io/line.h"

#include "base/comm.h"
#include "base/mem.h"

#include <math.h>
#include <stdlib.h>

/* A leaf on the line: its centre, and the volume fraction there. */
struct line_cell {
    double x, alpha;
};

enum { LINE_CELL = sizeof(struct line_cell) / sizeof(double) };

struct line {
    size_t n;
    struct line_cell *cells;
};

/* Index, along another axis, of the cells of a level that the line runs through. */
static int line_row(const struct state *state, const struct level *level, int axis)
{
    const struct mesh *mesh = state->mesh;
    int cells = level->extent[axis] * mesh->n[axis];
    for (int side = 0; side < 2 && axis < mesh->dim; side++)
        if (scene_boundary_is(state->scene, 2 * axis + side, SCENE_BOUNDARY_MIDDLE)) return side ? cells - 1 : 0;
    return cells / 2; /* on finer levels inside the same cell */
}

/* Adds the leaves of a tile that lie on the line; `alpha` are its volume fractions. */
static void line_take(const struct state *state, const struct level *level, const struct tile *tile,
                      const double *alpha, int axis, struct line *line)
{
    const struct mesh *mesh = state->mesh;
    int at[3];
    double corner[3];
    for (int other = 0; other < 3; other++) {
        at[other] = other == axis ? 0 : line_row(state, level, other) - tile->at[other] * mesh->n[other];
        if (at[other] < 0 || at[other] >= mesh->n[other]) return;
    }
    mesh_corner(mesh, level, tile, corner);
    line->cells = mem_grow(line->cells, line->n, line->n + (size_t)mesh->n[axis], sizeof *line->cells);
    for (at[axis] = 0; at[axis] < mesh->n[axis]; at[axis]++) {
        size_t cell = (size_t)(at[0] + mesh->n[0] * (at[1] + mesh->n[1] * at[2]));
        if (tile->covered >> mesh_octant(mesh, cell) & 1) continue;
        line->cells[line->n++] = (struct line_cell){corner[axis] + (at[axis] + 0.5) * level->h[axis], alpha[cell]};
    }
}

static int line_compare(const void *a, const void *b)
{
    double x = ((const struct line_cell *)a)->x, y = ((const struct line_cell *)b)->x;
    return (x > y) - (x < y);
}

/* Joins the pieces of all ranks. */
static void line_join(struct line *line)
{
    double own = (double)line->n, *counts = mem_new((size_t)comm_size(), sizeof *counts), total = 0.0;
    comm_join(&own, 1, counts);
    for (int rank = 0; rank < comm_size(); rank++) total += counts[rank];
    struct line_cell *all = mem_new((size_t)total + 1, sizeof *all);
    comm_join((const double *)line->cells, LINE_CELL * (int)line->n, (double *)all);
    qsort(all, (size_t)total, sizeof *all, line_compare);
    mem_free(line->cells);
    mem_free(counts);
    *line = (struct line){(size_t)total, all};
}

/* Place of the first crossing from one end; NaN if there is none. *ret_into: 1 if the material lies above it, -1 if it
 * lies below. */
static double line_search(const struct line *line, bool from_above, int *ret_into)
{
    *ret_into = 1;
    for (size_t i = 1; i < line->n; i++) {
        const struct line_cell *here = &line->cells[from_above ? line->n - i : i - 1];
        const struct line_cell *next = from_above ? here - 1 : here + 1;
        double a = here->alpha - 0.5, b = next->alpha - 0.5;
        if ((a >= 0.0) == (b >= 0.0)) continue;
        *ret_into = (b > a) == (next->x > here->x) ? 1 : -1;
        return here->x + (next->x - here->x) * a / (a - b);
    }
    return NAN;
}

double line_crossing(const struct state *state, unsigned material, int axis, int *ret_into)
{
    const struct mesh *mesh = state->mesh;
    const struct model *model = state->model;
    struct line line = {0};
    *ret_into = 1;
    if (!model->n_alpha) return NAN;
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        for (unsigned i = 0; i < level->n_local; i++)
            line_take(state, level, &level->tiles[level->first + i],
                      level->u_old[i] + (model->i_alpha + material) * mesh->n_cell, axis, &line);
    }
    line_join(&line);
    bool from_above = line.cells[0].alpha < 0.5 && line.cells[line.n - 1].alpha >= 0.5;
    double place = line_search(&line, from_above, ret_into);
    mem_free(line.cells);
    return place;
}
