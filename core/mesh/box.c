/* box.c - see box.h. */
#include "mesh/box.h"

#include <string.h>

size_t box_cells(const struct box *box)
{
    size_t cells = 1;
    for (int d = 0; d < 3; d++) cells *= (size_t)(box->to[d] - box->from[d]);
    return cells;
}

struct box_block box_pack(const struct box *box, double *data)
{
    struct box_block block = {.data = data, .pitch = box_cells(box)};
    for (int d = 0; d < 3; d++) {
        block.from[d] = box->from[d];
        block.size[d] = (size_t)(box->to[d] - box->from[d]);
    }
    return block;
}

/* One cell of each row, `from` and `to` apart: no row is worth a call. */
static void box_column(size_t rows, size_t from, const double *restrict source, size_t to, double *restrict target)
{
    for (size_t j = 0; j < rows; j++) target[j * to] = source[j * from];
}

/* Rows of a plane; pieces beside a tile are one or two cells wide. */
static void box_plane(size_t length, size_t rows, size_t from, const double *source, size_t to, double *target)
{
    if (length <= 2)
        for (size_t i = 0; i < length; i++) box_column(rows, from, source + i, to, target + i);
    else
        for (size_t j = 0; j < rows; j++) memcpy(target + j * to, source + j * from, length * sizeof *target);
}

void box_copy(unsigned n, const struct box *box, const struct box_block *from, const int shift[3],
              const struct box_block *to)
{
    size_t length = (size_t)(box->to[0] - box->from[0]), rows = (size_t)(box->to[1] - box->from[1]);
    size_t source = box_at(from, box->from[0] + shift[0], box->from[1] + shift[1], box->from[2] + shift[2]);
    size_t target = box_at(to, box->from[0], box->from[1], box->from[2]);
    for (unsigned q = 0; q < n; q++)
        for (size_t k = 0; k < (size_t)(box->to[2] - box->from[2]); k++)
            box_plane(length, rows, from->size[0],
                      from->data + (from->fields ? from->fields[q] : q) * from->pitch + source +
                          k * from->size[0] * from->size[1],
                      to->size[0], to->data + q * to->pitch + target + k * to->size[0] * to->size[1]);
}
