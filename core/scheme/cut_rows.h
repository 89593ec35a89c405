/* cut_rows.h - cells beside rigid walls taken out of a frame or a tile, and lines of a frame beside the parts of their
 * cells. Shared by the two ends of the terms of bodies (cut.h). */
#ifndef CUT_ROWS_H
#define CUT_ROWS_H

#include "scheme/cut_wall.h"
#include "scheme/term.h"

#include <stddef.h>

/* Cells beside a wall in one place: compact rows of their primitives and conserved fields. */
struct cut_rows {
    size_t stride; /* room */
    size_t n;
    size_t *at;       /* in the block of struct rigid_cells */
    size_t *from;     /* where they were gathered */
    double *w, *u;    /* [n_field] rows each */
    double *p;        /* wall pressure */
    double *rho, *c2; /* density, and squared speed of sound */
    double *scratch;
};

struct cut_rows *cut_rows_new(const struct term_room *room);
void cut_rows_free(struct cut_rows *rows);

/* What bodies leave around the tile of a stage; NULL where none is near. */
const struct rigid_cells *cut_rows_cells(const struct term_tile *tile);

/* One more cell: number `from` of rows w that are `pitch` apart, at `at` in the block of parts. Returns its place. */
size_t cut_rows_add(struct cut_rows *rows, const struct model *model, size_t at, size_t from, const double *w,
                    size_t pitch);

/* Fills p with the pressure on the walls, rho and c2, then w and u with what slides along them (`stop`: with what their
 * walls carry along). */
void cut_rows_press(struct cut_rows *rows, const struct model *model, const struct rigid_cells *cells, bool stop);

/* A line of a piece along its axis: where its cell 0 lies in the frame and in the block of parts, and steps along
 * it. */
struct cut_rows_line {
    size_t frame, step, block, stride;
    int n, ghosts;
};

/* Line c of outer index o of a frame. */
struct cut_rows_line cut_rows_line(const struct frame *frame, const struct mesh *mesh, const struct rigid_cells *cells,
                                   size_t o, size_t c);

/* Cell i of a line, from -ghosts to n + ghosts - 1: in the block of parts, and in the frame. */
static inline size_t cut_rows_place(const struct cut_rows_line *line, int i)
{
    return line->block + (size_t)(i * (ptrdiff_t)line->stride);
}

static inline size_t cut_rows_cell(const struct cut_rows_line *line, int i)
{
    return line->frame + (size_t)(i * (ptrdiff_t)line->step);
}

#endif
