/* cut.c - see cut.h. */
#include "scheme/cut.h"

#include "base/mem.h"
#include "base/status.h"
#include "phys/mix.h"
#include "scheme/closure.h"
#include "scheme/convection.h"
#include "scheme/cut_wall.h"
#include "scheme/exchange.h"
#include "scheme/terms.h"

#include <string.h>

/* The Courant number that cut cells may have, and how much more than whole ones. */
#define CUT_COURANT 0.6
#define CUT_EXCESS 2.0

/* Cells beside a wall in one place: compact rows of their primitives and conserved fields. */
struct cut_rows {
    size_t stride; /* room */
    size_t n;
    size_t *at;            /* in the block of struct rigid_cells */
    size_t *from;          /* where they were gathered */
    double *w, *u;         /* [n_field] rows each */
    double *p, *scratch;   /* wall pressure */
};

/* A face that is not as it would be without bodies. */
struct cut_face {
    size_t k;            /* in rows of faces */
    double open, keep;   /* a; how much of F stays */
    double lower, upper; /* how much of G of the cells on both sides comes in */
    size_t below, above; /* these, in the compact rows */
};

struct cut {
    const struct rigid *rigid;
    struct cut_rows rows;
    size_t *slot; /* [FACE_ROOM] 1 + place of a cell of the frame in the rows; 0: none */
    struct cut_face *faces;
    size_t n_face;
    double *fresh, *weight; /* [n_field + 1][n_cell]: what cells that open are filled with; NULL unless bodies move */
};

static bool cut_wanted(const struct model *path)
{
    return path->scene->n_rigid > 0;
}

static struct rigid_times cut_times(const struct term_tile *tile)
{
    return (struct rigid_times){tile->begun, tile->begun + tile->dt, tile->t};
}

static const struct rigid_cells *cut_cells(const struct term_tile *tile)
{
    return rigid_at(tile->mesh, tile->level, tile->tile, cut_times(tile));
}

static void *cut_open(const struct term_room *room)
{
    const struct model *model = room->model;
    struct cut *cut = mem_new(1, sizeof *cut);
    cut->rigid = room->mesh->rigid;
    size_t n = FACE_ROOM > room->mesh->n_cell ? FACE_ROOM : room->mesh->n_cell;
    cut->rows.stride = n;
    cut->rows.at = mem_new(n, sizeof *cut->rows.at);
    cut->rows.from = mem_new(n, sizeof *cut->rows.from);
    cut->rows.w = mem_new(2 * model->n_field * n, sizeof *cut->rows.w);
    cut->rows.u = cut->rows.w + model->n_field * n;
    cut->rows.p = mem_new((model->n_material + 4) * n, sizeof *cut->rows.p);
    cut->rows.scratch = cut->rows.p + n;
    cut->slot = mem_new(FACE_ROOM, sizeof *cut->slot);
    cut->faces = mem_new(FACE_ROOM, sizeof *cut->faces);
    for (unsigned k = 0; k < model->scene->n_rigid && !cut->fresh; k++)
        if (model->scene->rigids[k].moves)
            cut->fresh = mem_new((model->n_field + 1) * room->mesh->n_cell, sizeof *cut->fresh);
    if (cut->fresh) cut->weight = cut->fresh + model->n_field * room->mesh->n_cell;
    return cut;
}

static void cut_close(void *own)
{
    struct cut *cut = own;
    mem_free(cut->rows.at);
    mem_free(cut->rows.from);
    mem_free(cut->rows.w);
    mem_free(cut->rows.p);
    mem_free(cut->slot);
    mem_free(cut->faces);
    mem_free(cut->fresh);
    mem_free(cut);
}

/* Of a script that says where a body is. */
static int cut_failure(const void *own, const char **ret_message, const char **ret_place)
{
    *ret_place = "where bodies are";
    return rigid_failure(((const struct cut *)own)->rigid, ret_message);
}

/* --- lines of a frame --- */

/* A line of a piece along its axis: where its cell 0 lies in the frame and in the block of parts, and steps along it. */
struct cut_line {
    size_t frame, step, block, stride;
    int n, ghosts;
};

/* Place of a line of the frame, counted over outer and inner, in the tile. */
static struct cut_line cut_line(const struct frame *frame, const struct mesh *mesh, const struct rigid_cells *cells,
                                size_t o, size_t c)
{
    struct cut_line line = {.frame = frame_at(frame, o, 0) + c,
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

static size_t cut_place(const struct cut_line *line, int i)
{
    return line->block + (size_t)(i * (ptrdiff_t)line->stride);
}

static size_t cut_cell(const struct cut_line *line, int i)
{
    return line->frame + (size_t)(i * (ptrdiff_t)line->step);
}

/* --- what is covered, before faces are made --- */

/* The nearest open cell along a line on one side of a covered one, or `i` if there is none within reach. */
static int cut_nearest(const struct cut_line *line, const double *now, int i, int way)
{
    for (int k = i + way; k >= -line->ghosts && k < line->n + line->ghosts; k += way)
        if (now[cut_place(line, k)] > 0.0) return k;
    return i;
}

/* Copies the nearest open cell into a covered one; of two as near their mean. False: none on the line. */
static bool cut_copy(const struct term_piece *piece, const struct cut_line *line, const double *now, int i)
{
    int below = cut_nearest(line, now, i, -1), above = cut_nearest(line, now, i, 1);
    if (below == i && above == i) return false;
    if (below == i || (above != i && above - i < i - below)) below = above;
    else if (above == i || i - below < above - i) above = below;
    for (unsigned k = 0; k < piece->model->n_active; k++) {
        double *row = piece->faces->frame + piece->model->active[k] * FACE_ROOM;
        row[cut_cell(line, i)] = 0.5 * (row[cut_cell(line, below)] + row[cut_cell(line, above)]);
    }
    return true;
}

/* A covered cell of the tile that opens in this step will hold what it is filled with: by the axes along which its wall lies. */
static void cut_keep(const struct term_piece *piece, const struct rigid_cells *cells, const struct cut_line *line, int i,
                     size_t cell)
{
    const struct cut *cut = piece->own;
    double wall = cells->wall[piece->frame->axis][cut_place(line, i)], weight = wall * wall + 1e-300;
    for (unsigned k = 0; k < piece->model->n_active; k++) {
        unsigned q = piece->model->active[k];
        cut->fresh[q * piece->tile->n_cell + cell] +=
            weight * piece->faces->frame[q * FACE_ROOM + cut_cell(line, i)];
    }
    cut->weight[cell] += weight;
}

static void cut_begin(struct term_tile *tile)
{
    const struct cut *cut = tile->own;
    size_t rows = (size_t)(cut->weight - cut->fresh) + tile->n_cell;
    if (cut->fresh && cut_cells(tile)) memset(cut->fresh, 0, rows * sizeof *cut->fresh);
}

static void cut_frame(const struct term_piece *piece)
{
    const struct cut *cut = piece->own;
    const struct frame *frame = piece->frame;
    const struct rigid_cells *cells = cut_cells(piece->tile);
    for (size_t o = 0; cells && o < frame->outer; o++)
        for (size_t c = 0; c < frame->inner; c++) {
            struct cut_line line = cut_line(frame, piece->tile->mesh, cells, o, c);
            for (int i = -line.ghosts; i < line.n + line.ghosts; i++) {
                size_t at = cut_place(&line, i);
                if (cells->now[at] > 0.0 || !cut_copy(piece, &line, cells->now, i)) continue;
                if (i < 0 || i >= line.n || !cut->fresh || cells->part[at] == 0.0) continue;
                cut_keep(piece, cells, &line, i, frame_tile_at(frame, o, (size_t)i) + c);
            }
        }
}

/* --- compact rows --- */

static size_t cut_row_add(struct cut_rows *rows, const struct model *model, size_t at, size_t from, const double *w,
                          size_t pitch)
{
    size_t i = rows->n++;
    rows->at[i] = at;
    rows->from[i] = from;
    for (unsigned k = 0; k < model->n_active; k++)
        rows->w[model->active[k] * rows->stride + i] = w[model->active[k] * pitch + from];
    return i;
}

/* Pressure on the walls, then what slides along them: the velocity towards a wall is taken away. */
static void cut_rows_press(struct cut_rows *rows, const struct model *model, const struct rigid_cells *cells, bool stop)
{
    const struct cut_wall wall = {model, rows->n, rows->stride, rows->w, cells, rows->at, rows->scratch};
    if (!rows->n) return;
    cut_wall_pressure(&wall, rows->p);
    cut_wall_slide(&wall, stop, rows->w);
    mix_conserved(model, rows->n, rows->stride, rows->w, rows->u);
}

/* --- fluxes --- */

/* Steps leave room for cells in which waves are that much faster: an explicit step is sound up to 1, and asked for is `cfl`. */
static double cut_excess(const struct scene *scene)
{
    double excess = CUT_COURANT / scene->scheme.cfl;
    return excess < 1.0 ? 1.0 : excess < CUT_EXCESS ? excess : CUT_EXCESS;
}

/* What goes straight through a cell along an axis: the part of its faces that looks at no wall. */
static double cut_through(double low, double high, double part)
{
    double least = low < high ? low : high;
    return least < part ? least : part;
}

/* How much of F - G the faces of a cell get: the same along all axes, so that a flow along the wall fills no cell. `excess`: what
 * one axis may bring of a cell's part. */
static double cut_share(const struct rigid_cells *cells, int dim, size_t at, double excess)
{
    double share = 1.0, part = cells->part[at];
    size_t step = 1;
    for (int d = 0; d < dim; step *= cells->size[d], d++) {
        double low = cells->open[d][at], high = cells->open[d][at + step], through = cut_through(low, high, part);
        double rest = low + high - 2.0 * through, room = excess * part - through;
        if (room < share * rest) share = room / rest;
    }
    return share;
}

/* How much of the flux through a face of a cell is that of the cell's wall. */
static double cut_blend(const struct term_piece *piece, const struct rigid_cells *cells, size_t at, size_t step, bool upper)
{
    int axis = piece->frame->axis;
    double low = cells->open[axis][at], high = cells->open[axis][at + step], part = cells->part[at];
    double through = cut_through(low, high, part), face = upper ? high : low;
    if (!(face > through)) return 0.0;
    double share = cut_share(cells, piece->model->dim, at, cut_excess(piece->model->scene));
    return (1.0 - share) * (face - through) / face;
}

/* The compact row of a cell of the frame. */
static size_t cut_slot(const struct term_piece *piece, size_t cell, size_t at)
{
    struct cut *cut = piece->own;
    if (!cut->slot[cell])
        cut->slot[cell] = 1 + cut_row_add(&cut->rows, piece->model, at, cell, piece->faces->frame, FACE_ROOM);
    return cut->slot[cell] - 1;
}

/* The face between cells i - 1 and i of a line. */
static void cut_face(const struct term_piece *piece, const struct rigid_cells *cells, const struct cut_line *line, int i)
{
    struct cut *cut = piece->own;
    int axis = piece->frame->axis;
    size_t above = cut_place(line, i), below = above - line->stride, cell = cut_cell(line, i);
    struct cut_face face = {.k = cell - piece->frame->ghosts * piece->frame->inner, .open = cells->open[axis][above]};
    if (face.open > 0.0) {
        face.lower = cut_blend(piece, cells, below, line->stride, true);
        face.upper = cut_blend(piece, cells, above, line->stride, false);
    }
    double both = face.lower + face.upper;
    if (face.open == 1.0 && both == 0.0) return;
    if (both > 1.0) { /* a pocket: both walls, and nothing else */
        face.lower /= both;
        face.upper /= both;
    }
    face.keep = both < 1.0 ? 1.0 - both : 0.0;
    if (face.lower > 0.0) face.below = cut_slot(piece, cell - line->step, below);
    if (face.upper > 0.0) face.above = cut_slot(piece, cell, above);
    cut->faces[cut->n_face++] = face;
}

static void cut_find(const struct term_piece *piece, const struct rigid_cells *cells)
{
    struct cut *cut = piece->own;
    const struct frame *frame = piece->frame;
    cut->n_face = cut->rows.n = 0;
    memset(cut->slot, 0, frame->count * sizeof *cut->slot);
    for (size_t o = 0; o < frame->outer; o++)
        for (size_t c = 0; c < frame->inner; c++) {
            struct cut_line line = cut_line(frame, piece->tile->mesh, cells, o, c);
            for (int i = 0; i <= line.n; i++) cut_face(piece, cells, &line, i);
        }
    cut_rows_press(&cut->rows, piece->model, cells, piece->tile->masked);
}

/* G of one flux in a compact row: of what slides along the wall. */
static double cut_wall_flux(const struct term_piece *piece, const struct term_flux *flux, size_t i)
{
    const struct cut_rows *rows = &((const struct cut *)piece->own)->rows;
    const struct model *model = piece->model;
    unsigned axis = model->i_u + (unsigned)piece->frame->axis;
    double speed = rows->w[axis * rows->stride + i], G = flux->rate == axis ? rows->p[i] : 0.0;
    if (flux->rate < model->n_field) G += speed * rows->u[flux->rate * rows->stride + i];
    if (flux->rate == model->i_E) G += speed * rows->p[i];
    if (flux->below == piece->faces->u) return speed;
    for (unsigned l = 0; l < model->n_alpha; l++)
        if (flux->below == piece->faces->carried + l * FACE_ROOM)
            G = speed * rows->w[(model->i_alpha + l) * rows->stride + i] * rows->w[model->i_E * rows->stride + i];
    return G;
}

static void cut_change(const struct term_piece *piece, const struct term_flux *flux, double *row)
{
    const struct cut *cut = piece->own;
    for (size_t f = 0; f < cut->n_face; f++) {
        const struct cut_face *face = &cut->faces[f];
        double value = face->keep * row[face->k];
        if (face->lower > 0.0) value += face->lower * cut_wall_flux(piece, flux, face->below);
        if (face->upper > 0.0) value += face->upper * cut_wall_flux(piece, flux, face->above);
        row[face->k] = face->open * value;
    }
}

/* Is this row a flux further up in the list, too? */
static bool cut_is_done(const struct terms *terms, int axis, unsigned index, const double *row)
{
    for (unsigned i = 0; i < index; i++)
        if (terms->flux[axis][i].below == row || terms->flux[axis][i].above == row) return true;
    return false;
}

static void cut_faces(const struct term_piece *piece)
{
    const struct rigid_cells *cells = cut_cells(piece->tile);
    const struct terms *terms = piece->terms;
    int axis = piece->frame->axis;
    if (!cells) return;
    cut_find(piece, cells);
    for (unsigned i = 0; i < terms->n_flux[axis]; i++) {
        const struct term_flux *flux = &terms->flux[axis][i];
        double *below = (double *)flux->below, *above = (double *)flux->above;
        if (!cut_is_done(terms, axis, i, below)) cut_change(piece, flux, below);
        if (above != below && !cut_is_done(terms, axis, i, above)) cut_change(piece, flux, above);
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
                size_t i = cut_row_add(rows, model, offset, cell, w, mesh->n_cell);
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
static void cut_push(const struct term_tile *tile, const struct rigid_cells *cells, const struct cut_rows *rows, size_t i)
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
static void cut_carry(const struct term_tile *tile, const struct rigid_cells *cells, const struct cut_rows *rows, size_t i)
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

/* A cell that was covered when the step began has no state to begin with: it is what it is filled with, or what it has become
 * by the time of the primitives, and goes on from there. */
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
    struct cut_rows *rows = &cut->rows;
    const struct rigid_cells *cells = cut_cells(tile);
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
    struct cut_rows *rows = &cut->rows;
    cut_gather(NULL, rows, force->model, force->mesh, cells, force->w);
    cut_rows_press(rows, force->model, cells, false);
    for (size_t i = 0; i < rows->n; i++)
        if (cells->now[rows->at[i]] > 0.0 && cells->body[rows->at[i]] == rigid)
            sum += rows->p[i] * cells->wall[axis][rows->at[i]] * force->volume[rows->from[i]];
    cut_close(cut);
    return sum;
}

static void cut_pace(const struct term_pace *pace, double *rate)
{
    double most = 0.0, add = 0.0;
    for (unsigned k = 0; k < pace->model->scene->n_rigid; k++)
        most = pace->model->scene->rigids[k].fastest > most ? pace->model->scene->rigids[k].fastest : most;
    for (int d = 0; d < pace->model->dim; d++) add += most / pace->level->h[d];
    for (size_t i = 0; add > 0.0 && i < pace->n_cell; i++) rate[i] += add;
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
    .pace = cut_pace,
    .say = cut_say,
};

const struct term cut_face_term = {
    .name = "walls",
    .owner = "core/scheme/cut.c",
    .equation = "F -> G + alpha (F - G) on the parts of faces that look at a body",
    .wanted = cut_wanted,
    .moves = true,
    .open = cut_open,
    .close = cut_close,
    .faces = cut_faces,
};
