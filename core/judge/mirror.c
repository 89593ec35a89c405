/* mirror.c - see mirror.h. Cells are found by twice their centre in units of the least width, an integer that the
 * corners of different levels round to the same. */
#include "judge/mirror.h"

#include "base/mem.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct mirror_cell {
    int64_t at[3]; /* 0 beyond dim */
    int64_t width; /* along axis 0, in least widths: a coarse cell is no image of a finer one */
    size_t index;
};

static int mirror_order(const void *a, const void *b)
{
    const struct mirror_cell *one = a, *other = b;
    for (int d = 0; d < 3; d++)
        if (one->at[d] != other->at[d]) return one->at[d] < other->at[d] ? -1 : 1;
    return one->width < other->width ? -1 : one->width > other->width;
}

static void mirror_least(const struct snapshot *snapshot, double ret_least[3])
{
    for (int d = 0; d < snapshot->dim; d++) {
        ret_least[d] = snapshot->upper[0][d] - snapshot->lower[0][d];
        for (size_t c = 1; c < snapshot->n_cell; c++) {
            double width = snapshot->upper[c][d] - snapshot->lower[c][d];
            if (width < ret_least[d]) ret_least[d] = width;
        }
    }
}

static struct mirror_cell mirror_place(const struct snapshot *snapshot, const double least[3], size_t cell)
{
    struct mirror_cell place = {.index = cell};
    const double *lower = snapshot->lower[cell], *upper = snapshot->upper[cell];
    for (int d = 0; d < snapshot->dim; d++)
        place.at[d] = llround((lower[d] + upper[d] - 2 * snapshot->domain[0][d]) / least[d]);
    place.width = llround((upper[0] - lower[0]) / least[0]);
    return place;
}

static double mirror_size(const struct snapshot *snapshot, size_t cell)
{
    double size = 1.0;
    for (int d = 0; d < snapshot->dim; d++) size *= snapshot->upper[cell][d] - snapshot->lower[cell][d];
    return size;
}

void mirror_visit(const struct mirror_side *side, int axis,
                  void (*visit)(void *data, double size, double value, double image), void *data)
{
    const struct snapshot *snapshot = side->snapshot;
    struct mirror_cell *cells = mem_new(snapshot->n_cell, sizeof *cells);
    double least[3];
    mirror_least(snapshot, least);
    int64_t whole = llround(2 * (snapshot->domain[1][axis] - snapshot->domain[0][axis]) / least[axis]);
    for (size_t c = 0; c < snapshot->n_cell; c++) cells[c] = mirror_place(snapshot, least, c);
    qsort(cells, snapshot->n_cell, sizeof *cells, mirror_order);
    for (size_t c = 0; c < snapshot->n_cell; c++) {
        struct mirror_cell wanted = mirror_place(snapshot, least, c);
        wanted.at[axis] = whole - wanted.at[axis];
        const struct mirror_cell *image = bsearch(&wanted, cells, snapshot->n_cell, sizeof *cells, mirror_order);
        double value = image ? side->sign * side->values[image->index * side->stride] : INFINITY;
        visit(data, mirror_size(snapshot, c), side->values[c * side->stride], value);
    }
    mem_free(cells);
}
