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

/* A row; pieces beside a tile are one or two cells wide, which are worth no call. */
static inline void box_row(size_t n, const double *restrict from, double *restrict to)
{
    if (n > 2) memcpy(to, from, n * sizeof *to);
    else
        for (size_t i = 0; i < n; i++) to[i] = from[i];
}

void box_copy(unsigned n, const struct box *box, const struct box_block *from, const int shift[3],
              const struct box_block *to)
{
    size_t length = (size_t)(box->to[0] - box->from[0]);
    for (unsigned q = 0; q < n; q++)
        for (int k = box->from[2]; k < box->to[2]; k++) {
            const double *source = from->data + (from->fields ? from->fields[q] : q) * from->pitch +
                                   box_at(from, box->from[0] + shift[0], box->from[1] + shift[1], k + shift[2]);
            double *target = to->data + q * to->pitch + box_at(to, box->from[0], box->from[1], k);
            for (int j = box->from[1]; j < box->to[1]; j++, source += from->size[0], target += to->size[0])
                box_row(length, source, target);
        }
}
