/* normal.c - see normal.h. */
#include "scheme/normal.h"

#include "base/mem.h"
#include "phys/pick.h"
#include "phys/row.h"
#include "scheme/patch.h"

#include <limits.h>
#include <math.h>
#include <string.h>

/* Steps of fractions that small count less. */
#define NORMAL_TRACE 1e-3

static bool normal_wanted(const struct model *path)
{
    return path->n_normal > 0;
}

/* Fraction of the solids of a row of cells: of the first material there is what the others leave. */
static void normal_colour(const struct model *model, size_t n, size_t pitch, const double *around, double *colour)
{
    bool first = false;
    unsigned char solid[SCENE_MATERIALS] = {0};
    for (unsigned s = 0; s < model->n_solid; s++) {
        solid[model->solids[s].material] = 1;
        first = first || model->solids[s].material == 0;
    }
    for (size_t i = 0; i < n; i++) colour[i] = first ? 1.0 : 0.0;
    for (unsigned l = 1; l < model->n_alpha; l++) {
        const double *alpha = around + (l - 1) * pitch;
        if (first && !solid[l]) row_take(n, alpha, colour);
        if (!first && solid[l]) row_add(n, alpha, colour);
    }
}

/* Difference along one axis, over the neighbours across the two others; a step of 0 is an axis that is not there. */
static double normal_difference(const double *c, ptrdiff_t along, ptrdiff_t one, ptrdiff_t two)
{
    const double *b = c - along, *a = c + along;
    double middle = a[0] - b[0];
    if (!one) return middle;
    double sides = (a[one] - b[one]) + (a[-one] - b[-one]);
    if (!two) return 0.25 * (sides + 2.0 * middle);
    double others = (a[two] - b[two]) + (a[-two] - b[-two]);
    double corners = ((a[one + two] - b[one + two]) + (a[-one - two] - b[-one - two])) +
                     ((a[one - two] - b[one - two]) + (a[two - one] - b[two - one]));
    return 0.0625 * (corners + 2.0 * (sides + others) + 4.0 * middle);
}

/* Cells about a tile, and how they lie. */
struct normal_block {
    struct box_block box;
    ptrdiff_t stride[3];
    double ratio[3]; /* h of axis 0 over those of the axes */
    const double *colour;
};

static void normal_cell(int dim, const struct normal_block *block, size_t at, double ret[3])
{
    const double *c = block->colour + at;
    const ptrdiff_t *stride = block->stride;
    double square = 0.0, size = 0.0;
    for (int a = 0; a < dim; a++) {
        double d = normal_difference(c, stride[a], stride[(a + 1) % dim], dim > 2 ? stride[(a + 2) % dim] : 0);
        size += d * d;
        ret[a] = d * block->ratio[a];
        square += ret[a] * ret[a];
    }
    size = sqrt(size) / NORMAL_TRACE;
    double scale = square > 0.0 ? (size < 1.0 ? size : 1.0) / sqrt(square) : 0.0;
    for (int a = 0; a < dim; a++) ret[a] *= scale;
}

/* Marks cells of which a neighbour along an axis differs. */
static BULLA_KERNEL void normal_uneven(size_t n, const double *restrict before, const double *restrict here,
                                       const double *restrict behind, unsigned char *restrict uneven)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double c = here[i];
        int differs = (before[i] != c) | (behind[i] != c);
        uneven[i] |= differs ? 1 : 0;
    }
}

/* Cells from the first of the tile to the last that do not hold what all their neighbours hold, some beside the tile
 * among them: the others have no normal. Returns how many there are. */
static size_t normal_cells(const struct mesh *mesh, const struct normal_block *block, unsigned char *uneven,
                           unsigned *at)
{
    size_t first = box_at(&block->box, 0, 0, 0), n = box_at(&block->box, mesh->n[0], mesh->n[1] - 1, mesh->n[2] - 1);
    const double *c = block->colour + first;
    n -= first;
    memset(uneven, 0, n);
    for (int a = 0; a < mesh->dim; a++) normal_uneven(n, c - block->stride[a], c, c + block->stride[a], uneven);
    return pick_marked(n, (unsigned)first, uneven, at);
}

/* The normals of a row of the tile, whose cells `from` to `end` of the block are; those cells are the next of `at`.
 * Returns the first that is not. */
static const unsigned *normal_row(const struct mesh *mesh, const struct normal_block *block, size_t from,
                                  const unsigned *at, double *ret_normal)
{
    size_t end = from + (size_t)mesh->n[0];
    while (*at < from) at++;
    for (; *at < end; at++) {
        double n[3];
        normal_cell(mesh->dim, block, *at, n);
        for (int a = 0; a < mesh->dim; a++) ret_normal[(size_t)a * mesh->n_cell + (*at - from)] = n[a];
    }
    return at;
}

void normal_make(const struct model *model, const struct mesh *mesh, const double *h, const double *around,
                 double *ret_normal)
{
    struct normal_block block = {.box = rim_block(mesh, 1, NULL)};
    size_t cells = block.box.pitch;
    double *colour = mem_new(1, cells * (sizeof *colour + sizeof(unsigned) + 1) + sizeof(unsigned));
    unsigned *some = (unsigned *)(colour + cells);
    const unsigned *at = some;
    for (int a = 0; a < 3; a++) {
        block.stride[a] = a == 0 ? 1 : block.stride[a - 1] * (ptrdiff_t)block.box.size[a - 1];
        block.ratio[a] = a < mesh->dim ? h[0] / h[a] : 1.0;
    }
    block.colour = colour;
    normal_colour(model, cells, cells, around, colour);
    memset(ret_normal, 0, (size_t)mesh->dim * mesh->n_cell * sizeof *ret_normal);
    some[normal_cells(mesh, &block, (unsigned char *)(some + cells + 1), some)] = UINT_MAX;
    for (int k = 0; k < mesh->n[2]; k++)
        for (int j = 0; j < mesh->n[1]; j++, ret_normal += mesh->n[0])
            at = normal_row(mesh, &block, box_at(&block.box, 0, j, k), at, ret_normal);
    mem_free(colour);
}

static size_t normal_apply(const struct term_tile *tile, double *u_new)
{
    normal_make(tile->model, tile->mesh, tile->level->h, tile->around, u_new + tile->model->i_normal * tile->n_cell);
    return 0;
}

const struct term normal_term = {
    .name = "normal",
    .owner = "core/scheme/normal.c",
    .equation = "n = grad alpha_s/|grad alpha_s|: on it the materials of a cell have one traction",
    .wanted = normal_wanted,
    .apply = normal_apply,
};
