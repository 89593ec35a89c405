/* line.c - see line.h. Read from level 0, which always holds the averages of finer levels. */
#include "io/line.h"

#include "base/comm.h"
#include "base/mem.h"

#include <math.h>

/* Index, along another axis, of the cells that the line runs through. */
static int line_row(const struct state *state, int axis)
{
    const struct mesh *mesh = state->mesh;
    int cells = mesh->levels[0].extent[axis] * mesh->n[axis];
    for (int side = 0; side < 2 && axis < mesh->dim; side++) {
        enum scene_boundary_type type = state->scene->boundary[axis][side].type;
        if (type == SCENE_AXIS || type == SCENE_SYMMETRY) return side ? cells - 1 : 0;
    }
    return cells / 2;
}

/* Copies the volume fractions of a local tile that lie on the line. */
static void line_take(const struct mesh *mesh, const struct tile *tile, const double *alpha, int axis, const int row[3],
                      double *line)
{
    int at[3];
    for (int other = 0; other < 3; other++) {
        at[other] = row[other] - tile->at[other] * mesh->n[other];
        if (other != axis && (at[other] < 0 || at[other] >= mesh->n[other])) return;
    }
    for (at[axis] = 0; at[axis] < mesh->n[axis]; at[axis]++)
        line[tile->at[axis] * mesh->n[axis] + at[axis]] = alpha[at[0] + mesh->n[0] * (at[1] + mesh->n[1] * at[2])];
}

/* Index, in cells from the first centre, of the first crossing from one end; NaN if there is none. */
static double line_search(const double *line, int n, int from, int step)
{
    for (int i = from; i + step >= 0 && i + step < n; i += step) {
        double here = line[i] - 0.5, next = line[i + step] - 0.5;
        if ((here >= 0.0) != (next >= 0.0)) return i + step * here / (here - next);
    }
    return NAN;
}

double line_crossing(const struct state *state, unsigned material, int axis)
{
    const struct mesh *mesh = state->mesh;
    const struct model *model = state->model;
    const struct level *level = &mesh->levels[0];
    if (!model->n_alpha) return NAN;
    int n = level->extent[axis] * mesh->n[axis], row[3];
    double *line = mem_new((size_t)n, sizeof *line);
    for (int i = 0; i < n; i++) line[i] = -INFINITY;
    for (int other = 0; other < 3; other++) row[other] = line_row(state, other);
    for (unsigned i = 0; i < level->n_local; i++)
        line_take(mesh, &level->tiles[level->first + i], level->u_old[i] + (model->i_alpha + material) * mesh->n_cell,
                  axis, row, line);
    comm_max(line, n);
    bool from_above = line[0] < 0.5 && line[n - 1] >= 0.5;
    double index = from_above ? line_search(line, n, n - 1, -1) : line_search(line, n, 0, 1);
    mem_free(line);
    return mesh->lower[axis] + (index + 0.5) * level->h[axis];
}
