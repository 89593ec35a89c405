/* box.h - boxes of cells cut out of blocks of cells, in the coordinates of one tile.
 *
 * Cell (0, 0, 0) is the first of a tile, so that what lies around it has negative coordinates or such from n on. A
 * block says where its first cell lies: a tile with layers around it, the layers behind one face, and what
 * came packed from another rank are all blocks. */
#ifndef BOX_H
#define BOX_H

#include <stddef.h>

/* Cells from[d] <= i < to[d]; one cell along axes that are not used. */
struct box {
    int from[3], to[3];
};

/* Fields over a box of cells, x fastest; field q at data + q * pitch, or, of a block with others between them, at data
 * + fields[q] * pitch. */
struct box_block {
    double *data;
    int from[3];
    size_t size[3], pitch;
    const unsigned char *fields; /* NULL: all */
};

size_t box_cells(const struct box *box);

/* The block that is just that box. */
struct box_block box_pack(const struct box *box, double *data);

/* Offset of a cell in a component of a block. */
static inline size_t box_at(const struct box_block *block, int i, int j, int k)
{
    return ((size_t)(k - block->from[2]) * block->size[1] + (size_t)(j - block->from[1])) * block->size[0] +
           (size_t)(i - block->from[0]);
}

/* What copying a box between blocks of these shapes comes to, for who copies it often: rows and layers of cells, where
 * the first one lies in a component of both blocks, and how far rows and layers lie apart. */
struct box_move {
    size_t length, rows, layers;
    struct box_end {
        size_t first, row, layer;
    } from, to;
};

struct box_move box_move(const struct box *box, const struct box_block *from, const int shift[3],
                         const struct box_block *to);

/* Components q (or fields[q], if given) of `from` to components q of `to`, which lie from_pitch and to_pitch apart. */
void box_move_all(unsigned n, const struct box_move *move, const double *from, size_t from_pitch,
                  const unsigned char *fields, double *to, size_t to_pitch);

/* Copies the cells of a box (coordinates of `to`) of n fields; cell c comes from c + shift of `from`. `to` has all. */
void box_copy(unsigned n, const struct box *box, const struct box_block *from, const int shift[3],
              const struct box_block *to);

#endif
