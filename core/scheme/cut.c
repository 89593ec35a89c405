/* cut.c - see cut.h. The fluxes: cut_flux.c. */
#include "scheme/cut.h"

#include "base/mem.h"
#include "base/status.h"
#include "scheme/closure.h"
#include "scheme/convection.h"
#include "scheme/cut_rows.h"
#include "scheme/exchange.h"
#include "scheme/terms.h"

#include <string.h>

struct cut {
    const struct rigid *rigid;
    struct cut_rows *rows;
    size_t n_fresh;
    double *fresh, *weight; /* [n_field + 1][n_cell]: what cells that open are filled with; NULL unless bodies move */
};

bool cut_wanted(const struct model *path)
{
    return path->scene->n_rigid > 0;
}

static bool cut_moves(const struct scene *scene)
{
    bool any = false;
    for (unsigned k = 0; k < scene->n_rigid; k++) any = any || scene->rigids[k].moves;
    return any;
}

static void *cut_open(const struct term_room *room)
{
    const struct model *model = room->model;
    struct cut *cut = mem_new(1, sizeof *cut);
    cut->rigid = room->mesh->rigid;
    cut->rows = cut_rows_new(room);
    if (!cut_moves(model->scene)) return cut;
    cut->n_fresh = (model->n_field + 1) * room->mesh->n_cell;
    cut->fresh = mem_new(cut->n_fresh, sizeof *cut->fresh);
    cut->weight = cut->fresh + model->n_field * room->mesh->n_cell;
    return cut;
}

static void cut_close(void *own)
{
    struct cut *cut = own;
    cut_rows_free(cut->rows);
    mem_free(cut->fresh);
    mem_free(cut);
}

/* Of a script that says where a body is. */
static int cut_failure(const void *own, const char **ret_message, const char **ret_place)
{
    *ret_place = "where bodies are";
    return rigid_failure(((const struct cut *)own)->rigid, ret_message);
}

/* --- what is covered, before faces are made --- */

/* The nearest open cell along a line on one side of a covered one, or `i` if there is none so near that its edges look
 * here. */
static int cut_nearest(const struct cut_rows_line *line, const double *now, int i, int way)
{
    for (int k = i + way, left = line->ghosts; left > 0 && k >= -line->ghosts && k < line->n + line->ghosts;
         k += way, left--)
        if (now[cut_rows_place(line, k)] > 0.0) return k;
    return i;
}

/* Copies the nearest open cell into a covered one; of two as near their mean. False: none on the line. */
static bool cut_copy(const struct term_piece *piece, const struct cut_rows_line *line, const double *now, int i)
{
    int below = cut_nearest(line, now, i, -1), above = cut_nearest(line, now, i, 1);
    if (below == i && above == i) return false;
    if (below == i || (above != i && above - i < i - below)) below = above;
    else if (above == i || i - below < above - i) above = below;
    for (unsigned k = 0; k < piece->model->n_active; k++) {
        double *row = piece->faces->frame + piece->model->active[k] * FACE_ROOM;
        row[cut_rows_cell(line, i)] = 0.5 * (row[cut_rows_cell(line, below)] + row[cut_rows_cell(line, above)]);
    }
    return true;
}

/* A covered cell of the tile that opens in this step will hold what it is filled with: by the axes along which its wall
 * lies. */
static void cut_keep(const struct term_piece *piece, const struct rigid_cells *cells, const struct cut_rows_line *line,
                     int i, size_t cell)
{
    const struct cut *cut = piece->own;
    double wall = cells->wall[piece->frame->axis][cut_rows_place(line, i)], weight = wall * wall + 1e-300;
    for (unsigned k = 0; k < piece->model->n_active; k++) {
        unsigned q = piece->model->active[k];
        cut->fresh[q * piece->tile->n_cell + cell] +=
            weight * piece->faces->frame[q * FACE_ROOM + cut_rows_cell(line, i)];
    }
    cut->weight[cell] += weight;
}

static void cut_begin(struct term_tile *tile)
{
    const struct cut *cut = tile->own;
    if (cut->fresh) memset(cut->fresh, 0, cut->n_fresh * sizeof *cut->fresh);
}

/* Is a cell open whose slope looks at a covered one that lies open on the other side, too, or farther than its
 * neighbour? What that is filled with is not the same in all frames that see it. */
static bool cut_looks_through(const struct cut_rows_line *line, const double *now, int i)
{
    bool far = line->ghosts > SCENE_GHOSTS;
    if (!(now[cut_rows_place(line, i)] > 0.0)) return false;
    for (int way = -1; way <= 1; way += 2) {
        bool next = now[cut_rows_place(line, i + way)] > 0.0, behind = now[cut_rows_place(line, i + 2 * way)] > 0.0;
        if (far ? !next || !behind : !next && behind) return true;
    }
    return false;
}

static void cut_frame(const struct term_piece *piece)
{
    const struct cut *cut = piece->own;
    const struct frame *frame = piece->frame;
    const struct rigid_cells *cells = cut_rows_cells(piece->tile);
    for (size_t o = 0; cells && o < frame->outer; o++)
        for (size_t c = 0; c < frame->inner; c++) {
            struct cut_rows_line line = cut_rows_line(frame, piece->tile->mesh, cells, o, c);
            for (int i = -1; i <= line.n; i++)
                if (cut_looks_through(&line, cells->now, i)) piece->faces->flat[cut_rows_cell(&line, i)] = 1.0;
            for (int i = -line.ghosts; i < line.n + line.ghosts; i++) {
                size_t at = cut_rows_place(&line, i);
                if (cells->now[at] > 0.0 || !cut_copy(piece, &line, cells->now, i)) continue;
                if (i < 0 || i >= line.n || !cut->fresh || cells->part[at] == 0.0) continue;
                cut_keep(piece, cells, &line, i, frame_tile_at(frame, o, (size_t)i) + c);
            }
        }
}

/* --- rates --- */

static bool cut_is_wall(const struct rigid_cells *cells, int dim, size_t at)
{
    bool any = cells->part[at] < 1.0;
    for (int d = 0; d < dim; d++) any = any || cells->wall[d][at] != 0.0;
    return any;
}

/* Cells of the tile that have a wall, or are covered; with the primitives that they are filled with where they open. */
static void cut_gather(const struct cut *cut, struct cut_rows *rows, const struct model *model, const struct mesh *mesh,
                       const struct rigid_cells *cells, const double *w)
{
    size_t cell = 0;
    int at[3];
    rows->n = 0;
    for (at[2] = 0; at[2] < mesh->n[2]; at[2]++)
        for (at[1] = 0; at[1] < mesh->n[1]; at[1]++)
            for (at[0] = 0; at[0] < mesh->n[0]; at[0]++, cell++) {
                size_t offset = rigid_offset(cells, at);
                if (!cut_is_wall(cells, mesh->dim, offset)) continue;
                size_t i = cut_rows_add(rows, model, offset, cell, w, mesh->n_cell);
                if (!cut || !cut->fresh || !(cut->weight[cell] > 0.0)) continue;
                for (unsigned k = 0; k < model->n_active; k++) {
                    unsigned q = model->active[k];
                    rows->w[q * rows->stride + i] = cut->fresh[q * mesh->n_cell + cell] / cut->weight[cell];
                }
            }
}

/* How fast the wall of a cell gives room [1/s]: W . U. */
static double cut_room(const struct rigid_cells *cells, int dim, size_t at)
{
    double room = 0.0;
    for (int d = 0; d < dim && cells->speed[d]; d++) room += cells->wall[d][at] * cells->speed[d][at];
    return room;
}

/* The push of the wall on what is in a cell. */
static void cut_push(const struct term_tile *tile, const struct rigid_cells *cells, const struct cut_rows *rows,
                     size_t i)
{
    const struct model *model = tile->model;
    size_t at = rows->at[i], cell = rows->from[i], n = tile->n_cell;
    for (int d = 0; d < model->dim; d++)
        tile->rates[(model->i_u + (unsigned)d) * n + cell] -= cells->wall[d][at] * rows->p[i];
    tile->rates[model->i_E * n + cell] -= cut_room(cells, model->dim, at) * rows->p[i];
    if (!cells->plane) return;
    const struct metric *metric = tile->metric;
    size_t c = cell % (size_t)tile->mesh->n[0];
    double round = (metric->area[c + 1] - metric->area[c]) / metric->volume[c];
    tile->rates[model->i_u * n + cell] += tile->hoop[cell] * (cells->plane[at] - 1.0) * round;
}

/* What the wall leaves room for comes in as the cell is. */
static void cut_carry(const struct term_tile *tile, const struct rigid_cells *cells, const struct cut_rows *rows,
                      size_t i)
{
    const struct model *model = tile->model;
    double room = cut_room(cells, model->dim, rows->at[i]), p = rows->w[model->i_E * rows->stride + i];
    size_t cell = rows->from[i], n = tile->n_cell, first = terms_first(tile->terms, &convection_term);
    if (room == 0.0) return;
    for (unsigned k = 0; k < model->n_active; k++)
        tile->rates[model->active[k] * n + cell] -= room * rows->u[model->active[k] * rows->stride + i];
    if (!model->n_alpha) return;
    tile->rates[first * n + cell] -= room;
    if (!closure_wanted(model)) return;
    for (unsigned l = 0; l < model->n_alpha; l++)
        tile->rates[(terms_first(tile->terms, &exchange_term) + l) * n + cell] -=
            room * rows->w[(model->i_alpha + l) * rows->stride + i] * p;
}

/* From rates of a whole cell to those of its part. */
static void cut_divide(const struct term_tile *tile, double part, size_t cell)
{
    const struct model *model = tile->model;
    double per = part > 0.0 ? 1.0 / part : 0.0;
    for (unsigned k = 0; k < model->n_active; k++) tile->rates[model->active[k] * tile->n_cell + cell] *= per;
    for (unsigned q = model->n_field; q < tile->terms->n_rates; q++) tile->rates[q * tile->n_cell + cell] *= per;
}

/* A cell that was covered when the step began has no state to begin with: it is what it is filled with, or what it has
 * become by the time of the primitives, and goes on from there. */
static void cut_start(const struct term_tile *tile, const struct cut_rows *rows, size_t i, double rest)
{
    const struct model *model = tile->model;
    size_t cell = rows->from[i], n = tile->n_cell;
    for (unsigned q = model->n_field; q < tile->terms->n_rates; q++) tile->rates[q * n + cell] = 0.0;
    for (unsigned k = 0; k < model->n_active; k++) {
        unsigned q = model->active[k];
        double *rate = &tile->rates[q * n + cell], start = rows->u[q * rows->stride + i];
        *rate = (model_is_fraction(model, q) ? 0.0 : rest * *rate) + (start - tile->u[q * n + cell]) / tile->dt;
    }
}

static void cut_rates(struct term_tile *tile)
{
    struct cut *cut = tile->own;
    struct cut_rows *rows = cut->rows;
    const struct rigid_cells *cells = cut_rows_cells(tile);
    if (!cells) return;
    cut_gather(cut, rows, tile->model, tile->mesh, cells, tile->w);
    cut_rows_press(rows, tile->model, cells, tile->masked);
    for (size_t i = 0; i < rows->n; i++) {
        double part = cells->part[rows->at[i]];
        cut_push(tile, cells, rows, i);
        cut_carry(tile, cells, rows, i);
        cut_divide(tile, part, rows->from[i]);
        if (part > 0.0 && cells->was[rows->at[i]] == 0.0)
            cut_start(tile, rows, i, (tile->begun + tile->dt - tile->t) / tile->dt);
    }
}

double cut_force(const struct cut_force *force, unsigned rigid, int axis)
{
    const struct rigid_cells *cells =
        rigid_at(force->mesh, force->level, force->tile, (struct rigid_times){force->t, force->t, force->t});
    double sum = 0.0;
    if (!cells) return 0.0;
    struct cut *cut = cut_open(&(struct term_room){.model = force->model, .mesh = force->mesh});
    struct cut_rows *rows = cut->rows;
    cut_gather(NULL, rows, force->model, force->mesh, cells, force->w);
    cut_rows_press(rows, force->model, cells, false);
    for (size_t i = 0; i < rows->n; i++)
        if (cells->now[rows->at[i]] > 0.0 && cells->body[rows->at[i]] == rigid)
            sum +=
                rows->p[i] *
                (axis == CUT_POWER ? cut_room(cells, force->mesh->dim, rows->at[i]) : cells->wall[axis][rows->at[i]]) *
                force->volume[rows->from[i]];
    cut_close(cut);
    return sum;
}

static void cut_say(const struct scene *scene, struct text *text)
{
    for (unsigned k = 0; k < scene->n_rigid; k++)
        text_add(text, "%s%s%s", k ? ", " : ": ", scene->rigids[k].name, scene->rigids[k].moves ? " (moves)" : "");
}

const struct term cut_term = {
    .name = "bodies",
    .owner = "core/scheme/cut.c",
    .equation = "theta du/dt = -div(a F) - W . F_wall: cells that rigid bodies cut",
    .wanted = cut_wanted,
    .moves = true,
    .open = cut_open,
    .close = cut_close,
    .failure = cut_failure,
    .begin = cut_begin,
    .frame = cut_frame,
    .cells = cut_rates,
    .say = cut_say,
};
