/* box.c - see box.h. */
#include "mesh/box.h"

#include "bulla/module.h"

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

/* Rows that are worth a loop, of a dozen cells, and no call. */
static BULLA_KERNEL void box_rows(size_t rows, size_t length, size_t from, const double *restrict source, size_t to,
                                  double *restrict target)
{
    for (size_t j = 0; j < rows; j++) {
        const double *restrict row = source + j * from;
        double *restrict end = target + j * to;
#pragma omp simd
        for (size_t i = 0; i < length; i++) end[i] = row[i];
    }
}

/* Rows of a layer; pieces beside a tile are one or two cells wide. */
static void box_layer(const struct box_move *move, const double *source, double *target)
{
    size_t from = move->from.row, to = move->to.row, length = move->length;
    if (length <= 2)
        for (size_t i = 0; i < length; i++) box_column(move->rows, from, source + i, to, target + i);
    else box_rows(move->rows, length, from, source, to, target);
}

static struct box_end box_end(const struct box_block *block, int i, int j, int k)
{
    return (struct box_end){box_at(block, i, j, k), block->size[0], block->size[0] * block->size[1]};
}

struct box_move box_move(const struct box *box, const struct box_block *from, const int shift[3],
                         const struct box_block *to)
{
    const int *at = box->from;
    return (struct box_move){.length = (size_t)(box->to[0] - at[0]),
                             .rows = (size_t)(box->to[1] - at[1]),
                             .layers = (size_t)(box->to[2] - at[2]),
                             .from = box_end(from, at[0] + shift[0], at[1] + shift[1], at[2] + shift[2]),
                             .to = box_end(to, at[0], at[1], at[2])};
}

void box_move_all(unsigned n, const struct box_move *move, const double *from, size_t from_pitch,
                  const unsigned char *fields, double *to, size_t to_pitch)
{
    for (unsigned q = 0; q < n; q++) {
        const double *source = from + (fields ? fields[q] : q) * from_pitch + move->from.first;
        double *target = to + q * to_pitch + move->to.first;
        for (size_t k = 0; k < move->layers; k++)
            box_layer(move, source + k * move->from.layer, target + k * move->to.layer);
    }
}

void box_copy(unsigned n, const struct box *box, const struct box_block *from, const int shift[3],
              const struct box_block *to)
{
    const struct box_move move = box_move(box, from, shift, to);
    box_move_all(n, &move, from->data, from->pitch, from->fields, to->data, to->pitch);
}
