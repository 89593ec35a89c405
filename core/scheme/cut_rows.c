/* cut_rows.c - see cut_rows.h. */
#include "scheme/cut_rows.h"

#include "base/mem.h"
#include "phys/mix.h"

struct cut_rows *cut_rows_new(const struct term_room *room)
{
    const struct model *model = room->model;
    struct cut_rows *rows = mem_new(1, sizeof *rows);
    size_t n = FACE_ROOM > room->mesh->n_cell ? FACE_ROOM : room->mesh->n_cell;
    rows->stride = n;
    rows->at = mem_new(2 * n, sizeof *rows->at);
    rows->from = rows->at + n;
    rows->w = mem_new(2 * model->n_field * n, sizeof *rows->w);
    rows->u = rows->w + model->n_field * n;
    rows->p = mem_new((model->n_material + 4) * n, sizeof *rows->p);
    rows->scratch = rows->p + n;
    rows->rho = rows->scratch; /* as cut_wall_pressure leaves them */
    rows->c2 = rows->rho + n;
    return rows;
}

void cut_rows_free(struct cut_rows *rows)
{
    if (!rows) return;
    mem_free(rows->at);
    mem_free(rows->w);
    mem_free(rows->p);
    mem_free(rows);
}

const struct rigid_cells *cut_rows_cells(const struct term_tile *tile)
{
    struct rigid_times times = {tile->begun, tile->begun + tile->dt, tile->t};
    return rigid_at(tile->mesh, tile->level, tile->tile, times);
}

/* Place of a line of the frame, counted over outer and inner, in the tile. */
struct cut_rows_line cut_rows_line(const struct frame *frame, const struct mesh *mesh, const struct rigid_cells *cells,
                                   size_t o, size_t c)
{
    struct cut_rows_line line = {.frame = frame_at(frame, o, 0) + c,
                                 .step = frame->inner,
                                 .stride = 1,
                                 .n = (int)frame->n,
                                 .ghosts = (int)frame->ghosts};
    size_t inner = frame->inner_from + c, outer = frame->outer_from + o;
    int at[3] = {0};
    for (int d = 0; d < 3; d++) {
        size_t n = (size_t)mesh->n[d], *rest = d < frame->axis ? &inner : &outer;
        if (d == frame->axis) continue;
        at[d] = (int)(*rest % n);
        *rest /= n;
    }
    for (int d = 0; d < frame->axis; d++) line.stride *= cells->size[d];
    line.block = rigid_offset(cells, at);
    return line;
}

size_t cut_rows_add(struct cut_rows *rows, const struct model *model, size_t at, size_t from, const double *w,
                    size_t pitch)
{
    size_t i = rows->n++;
    rows->at[i] = at;
    rows->from[i] = from;
    for (unsigned k = 0; k < model->n_active; k++)
        rows->w[model->active[k] * rows->stride + i] = w[model->active[k] * pitch + from];
    return i;
}

void cut_rows_press(struct cut_rows *rows, const struct model *model, const struct rigid_cells *cells, bool stop)
{
    const struct cut_wall wall = {model, rows->n, rows->stride, rows->w, cells, rows->at, rows->scratch};
    if (!rows->n) return;
    cut_wall_pressure(&wall, rows->p);
    cut_wall_slide(&wall, stop, rows->w);
    mix_conserved(model, rows->n, rows->stride, rows->w, rows->u);
}
