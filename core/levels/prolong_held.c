/* prolong_held.c - see prolong_held.h. */
#include "levels/prolong_held.h"

#include "base/mem.h"

struct prolong_held {
    const struct model *model;
    const struct mesh *mesh;
    struct source_value *values;
    double *rows;
    const double *row[3];
};

struct prolong_held *prolong_held_new(const struct model *model, const struct mesh *mesh, size_t cells)
{
    if (!model->forced || !model->scene->sources) return NULL;
    struct prolong_held *held = mem_new(1, sizeof *held);
    held->model = model;
    held->mesh = mesh;
    held->values = source_value_new(model, mesh);
    held->rows = mem_new((size_t)mesh->dim * cells, sizeof *held->rows);
    for (int axis = 0; axis < mesh->dim; axis++)
        if (source_weight_any(model->scene, axis)) held->row[axis] = held->rows + (size_t)axis * cells;
    return held;
}

void prolong_held_free(struct prolong_held *held)
{
    if (!held) return;
    source_value_free(held->values);
    mem_free(held->rows);
    mem_free(held);
}

const double *const *prolong_held_rows(const struct prolong_held *held)
{
    return held->row;
}

/* Density at one place of the block. */
static double prolong_held_density(const struct model *model, const struct prolong_held_block *block, size_t at)
{
    double rho = 0.0;
    for (unsigned l = 0; l < model->n_material; l++) {
        double alpha = model->n_alpha ? block->w[(model->i_alpha + l) * block->cells + at] : 1.0;
        rho += alpha * block->w[(model->i_m + l) * block->cells + at];
    }
    return rho;
}

static void prolong_held_cell(struct prolong_held *held, const struct prolong_held_block *block, const int cell[3])
{
    size_t at = block->origin;
    for (int d = 0; d < held->mesh->dim; d++) at += (size_t)cell[d] * block->stride[d]; /* wraps back from -1 */
    double rho = prolong_held_density(held->model, block, at);
    for (int axis = 0; axis < held->mesh->dim; axis++) {
        const struct source_value_place place = {block->level, block->tile, block->t, axis};
        if (!held->row[axis]) continue;
        double a = source_value_cell(held->values, &place, cell);
        held->rows[(size_t)axis * block->cells + at] = rho * a * block->level->h[axis];
    }
}

void prolong_held_fill(struct prolong_held *held, const struct prolong_held_block *block)
{
    int from[3] = {0}, to[3] = {1, 1, 1}, at[3];
    for (int d = 0; d < held->mesh->dim; d++) {
        from[d] = (int)block->from[d] - 1;
        to[d] = (int)block->to[d] + 1;
    }
    for (at[2] = from[2]; at[2] < to[2]; at[2]++)
        for (at[1] = from[1]; at[1] < to[1]; at[1]++)
            for (at[0] = from[0]; at[0] < to[0]; at[0]++) prolong_held_cell(held, block, at);
}
