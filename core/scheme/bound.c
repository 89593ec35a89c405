/* bound.c - see bound.h: what boundaries keep from the start. The layers behind them are filled in bound_fill.c. */
#include "scheme/bound.h"

#include "base/mem.h"
#include "base/status.h"
#include "paint/paint.h"
#include "phys/mix.h"
#include "scheme/bound_layer.h"
#include "scheme/source_value.h"

#include <string.h>

/* Cells of a face of a tile. */
static size_t bound_face_cells(const struct mesh *mesh, int axis)
{
    return mesh->n_cell / (size_t)mesh->n[axis];
}

bool bound_has_rays(const struct model *model, int face)
{
    const struct scene_boundary *boundary = &model->scene->domain.boundary[face / 2][face % 2];
    return boundary->type == SCENE_NONREFLECTING && boundary->beam.path == SCENE_BEAM_ORIGIN && !model->elastic;
}

static void bound_keep_reference(struct bound *bound, unsigned local, int axis, int side, const double *w)
{
    const struct mesh *mesh = bound->mesh;
    const struct model *model = bound->model;
    size_t cells = bound_face_cells(mesh, axis), n = (size_t)mesh->n[axis], inner = 1;
    unsigned others = bound_has_rays(model, 2 * axis + side) ? model->n_velocity - 1 : 0;
    for (int d = 0; d < axis; d++) inner *= (size_t)mesh->n[d];
    double *reference = mem_new((2 + others) * cells, sizeof *reference);
    const double *p = w + model->i_E * mesh->n_cell, *u = w + (model->i_u + (unsigned)axis) * mesh->n_cell;
    for (size_t c = 0; c < cells; c++) {
        size_t cell = (c / inner * n + (side ? n - 1 : 0)) * inner + c % inner;
        reference[c] = p[cell];
        reference[cells + c] = side ? u[cell] : -u[cell];
        for (unsigned k = 0; k < others; k++) {
            unsigned q = model->i_u + ((unsigned)axis + 1 + k) % model->n_velocity;
            reference[(2 + k) * cells + c] = w[q * mesh->n_cell + cell];
        }
    }
    bound->reference[local * MESH_FACES + (unsigned)(2 * axis + side)] = reference;
}

static struct bound *bound_start(const struct model *model, const struct mesh *mesh, const struct level *level)
{
    struct bound *bound = mem_new(1, sizeof *bound);
    *bound = (struct bound){.model = model, .mesh = mesh, .level = level, .n_local = level->n_local};
    bound->reference = mem_new((size_t)level->n_local * MESH_FACES, sizeof *bound->reference);
    if (model->forced && model->scene->sources) bound->sources = source_value_new(model, mesh);
    return bound;
}

static bool bound_refers(const struct bound *bound, unsigned local, int face)
{
    return bound->level->neighbours[local][face].kind == NEIGHBOUR_BOUNDARY &&
           scene_boundary_is(bound->model->scene, face, SCENE_BOUNDARY_REFERS);
}

struct bound *bound_new(const struct model *model, const struct mesh *mesh, const struct level *level)
{
    struct bound *bound = bound_start(model, mesh, level);
    for (unsigned t = 0; t < level->n_local; t++)
        for (int face = 0; face < 2 * mesh->dim; face++)
            if (bound_refers(bound, t, face)) bound_keep_reference(bound, t, face / 2, face % 2, level->w[t]);
    return bound;
}

/* References of one tile from its initial state; u and w are scratch of a tile's block. */
static int bound_paint_tile(struct bound *bound, unsigned local, double *u, double *w)
{
    const struct mesh *mesh = bound->mesh;
    const struct level *level = bound->level;
    size_t n_cell = mesh->n_cell;
    bool painted = false;
    for (int face = 0; face < 2 * mesh->dim; face++) {
        if (!bound_refers(bound, local, face)) continue;
        if (!painted) {
            TRY(paint_tile(bound->model, mesh, level, &level->tiles[level->first + local], u));
            for (size_t i = 0; i < n_cell; i++) w[bound->model->i_E * n_cell + i] = 1e5; /* where an iteration starts */
            mix_primitives(bound->model, n_cell, n_cell, u, w);
        }
        painted = true;
        bound_keep_reference(bound, local, face / 2, face % 2, w);
    }
    return STATUS_OK;
}

struct bound *bound_paint(const struct model *model, const struct mesh *mesh, const struct level *level,
                          struct bound *before, const int *from)
{
    struct bound *bound = bound_start(model, mesh, level);
    double *u = mem_new(2 * model->n_field * mesh->n_cell, sizeof *u), *w = u + model->n_field * mesh->n_cell;
    for (unsigned t = 0; t < level->n_local && !bound->status; t++) {
        if (!from || from[t] < 0) {
            bound->status = bound_paint_tile(bound, t, u, w);
            continue;
        }
        double **old = before->reference + (size_t)from[t] * MESH_FACES;
        memcpy(bound->reference + (size_t)t * MESH_FACES, old, MESH_FACES * sizeof *old);
        memset(old, 0, MESH_FACES * sizeof *old);
    }
    if (bound->status) bound->message = mem_text(status_text());
    mem_free(u);
    bound_free(before);
    return bound;
}

void bound_free(struct bound *bound)
{
    if (!bound) return;
    for (size_t i = 0; i < (size_t)bound->n_local * MESH_FACES; i++) mem_free(bound->reference[i]);
    mem_free(bound->reference);
    mem_free(bound->message);
    source_value_free(bound->sources);
    mem_free(bound);
}

void bound_copy(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w)
{
    (void)data;
    (void)local;
    (void)pitch;
    bound_layer_fill(frame, side, false, 1.0, w);
}
