/* mirror.h - the cells of a snapshot and their mirror images about the middle of the domain.
 *
 * A scene that is symmetric must stay so to the bit: the same sums in the same order on both sides. Every cell is
 * compared with the one cell that lies in its image, so nothing is averaged and nothing rounded. */
#ifndef MIRROR_H
#define MIRROR_H

#include "io/read.h"

/* One number per cell of a snapshot, `stride` apart. */
struct mirror_side {
    const struct snapshot *snapshot;
    const double *values;
    unsigned stride;
    double sign; /* 1; -1 for the component of a vector along the axis, which the mirror turns round */
};

/* Calls `visit` once for each cell of the snapshot, with its size (the product of its widths), its value and that of
 * its image across `axis` (0, 1, 2); where the mesh itself is not symmetric the image is infinite. */
void mirror_visit(const struct mirror_side *side, int axis,
                  void (*visit)(void *data, double size, double value, double image), void *data);

#endif
