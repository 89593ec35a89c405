/* cut_flux.c - the fluxes beside rigid bodies: see cut.h. */
#include "scheme/cut.h"

#include "base/mem.h"
#include "scheme/cut_rows.h"
#include "scheme/terms.h"

#include <math.h>
#include <string.h>

/* The Courant number that cut cells may have, and how much more than whole ones. */
#define CUT_FLUX_COURANT 0.6
#define CUT_FLUX_EXCESS 2.0

/* A face that is not as it would be without bodies. */
struct cut_flux_face {
    size_t k;                /* in rows of faces */
    double open, keep;       /* a; how much of F stays */
    double lower, upper;     /* how much of G of the cells on both sides comes in */
    size_t below, above;     /* these, in the compact rows */
    size_t at, line;         /* of the tile: the face's place along the axis, and where its line of cells begins */
    double p_lower, p_upper; /* pressures of these [Pa] */
};

struct cut_flux {
    struct cut_rows *rows;
    size_t *slot; /* [FACE_ROOM] 1 + place of a cell of the frame in the rows; 0: none */
    struct cut_flux_face *faces;
    size_t n_face;
};

static void *cut_flux_open(const struct term_room *room)
{
    struct cut_flux *cut = mem_new(1, sizeof *cut);
    cut->rows = cut_rows_new(room);
    cut->slot = mem_new(FACE_ROOM, sizeof *cut->slot);
    cut->faces = mem_new(FACE_ROOM, sizeof *cut->faces);
    return cut;
}

static void cut_flux_close(void *own)
{
    struct cut_flux *cut = own;
    cut_rows_free(cut->rows);
    mem_free(cut->slot);
    mem_free(cut->faces);
    mem_free(cut);
}

/* Steps leave room for cells in which waves are that much faster: an explicit step is sound up to 1, and asked for is
 * `cfl`. */
static double cut_flux_excess(const struct scene *scene)
{
    double excess = CUT_FLUX_COURANT / scene->scheme.cfl;
    return excess < 1.0 ? 1.0 : excess < CUT_FLUX_EXCESS ? excess : CUT_FLUX_EXCESS;
}

/* What goes straight through a cell along an axis: the part of its faces that looks at no wall. */
static double cut_flux_through(double low, double high, double part)
{
    double least = low < high ? low : high;
    return least < part ? least : part;
}

/* How much of F - G the faces of a cell get: the same along all axes, so that a flow along the wall fills no cell.
 * `excess`: what one axis may bring of a cell's part. */
static double cut_flux_share(const struct rigid_cells *cells, int dim, size_t at, double excess)
{
    double share = 1.0, part = cells->part[at];
    size_t step = 1;
    for (int d = 0; d < dim; step *= cells->size[d], d++) {
        double low = cells->open[d][at], high = cells->open[d][at + step], through = cut_flux_through(low, high, part);
        double rest = low + high - 2.0 * through, room = excess * part - through;
        if (room < share * rest) share = room / rest;
    }
    return share;
}

/* How much of the flux through a face of a cell is that of the cell's wall. */
static double cut_flux_blend(const struct term_piece *piece, const struct rigid_cells *cells, size_t at, size_t step,
                             bool upper)
{
    int axis = piece->frame->axis;
    double low = cells->open[axis][at], high = cells->open[axis][at + step], part = cells->part[at];
    double through = cut_flux_through(low, high, part), face = upper ? high : low;
    if (!(face > through)) return 0.0;
    double share = cut_flux_share(cells, piece->model->dim, at, cut_flux_excess(piece->model->scene));
    return (1.0 - share) * (face - through) / face;
}

/* Has the scene, not the path alone, materials that a cell may be without? Tiles on both sides of a face find the same.
 */
static bool cut_flux_mingles(const struct term_piece *piece)
{
    return piece->model->scene->n_material > 1;
}

/* The compact row of a cell of the frame. */
static size_t cut_flux_slot(const struct term_piece *piece, size_t cell, size_t at)
{
    struct cut_flux *cut = piece->own;
    if (!cut->slot[cell])
        cut->slot[cell] = 1 + cut_rows_add(cut->rows, piece->model, at, cell, piece->faces->frame, FACE_ROOM);
    return cut->slot[cell] - 1;
}

/* The face between cells i - 1 and i of a line. */
static void cut_flux_face(const struct term_piece *piece, const struct rigid_cells *cells,
                          const struct cut_rows_line *line, size_t first, int i)
{
    struct cut_flux *cut = piece->own;
    int axis = piece->frame->axis;
    size_t above = cut_rows_place(line, i), below = above - line->stride, cell = cut_rows_cell(line, i);
    struct cut_flux_face face = {.k = cell - piece->frame->ghosts * piece->frame->inner,
                                 .open = cells->open[axis][above],
                                 .at = (size_t)i,
                                 .line = first};
    if (face.open > 0.0) {
        face.lower = cut_flux_blend(piece, cells, below, line->stride, true);
        face.upper = cut_flux_blend(piece, cells, above, line->stride, false);
    }
    double both = face.lower + face.upper;
    if (face.open == 1.0 && both == 0.0) return;
    if (both > 1.0) { /* a pocket: both walls, and nothing else */
        face.lower /= both;
        face.upper /= both;
    }
    face.keep = both < 1.0 ? 1.0 - both : 0.0;
    if (face.lower > 0.0 || (both > 0.0 && (piece->tile->masked || cut_flux_mingles(piece))))
        face.below = cut_flux_slot(piece, cell - line->step, below);
    if (face.upper > 0.0 || (both > 0.0 && (piece->tile->masked || cut_flux_mingles(piece))))
        face.above = cut_flux_slot(piece, cell, above);
    cut->faces[cut->n_face++] = face;
}

static void cut_flux_find(const struct term_piece *piece, const struct rigid_cells *cells)
{
    struct cut_flux *cut = piece->own;
    const struct frame *frame = piece->frame;
    cut->n_face = cut->rows->n = 0;
    memset(cut->slot, 0, frame->count * sizeof *cut->slot);
    for (size_t o = 0; o < frame->outer; o++)
        for (size_t c = 0; c < frame->inner; c++) {
            struct cut_rows_line line = cut_rows_line(frame, piece->tile->mesh, cells, o, c);
            size_t first = frame_tile_at(frame, o, 0) + c;
            for (int i = 0; i <= line.n; i++) cut_flux_face(piece, cells, &line, first, i);
        }
    cut_rows_press(cut->rows, piece->model, cells, piece->tile->masked);
}

/* In a repeated attempt: what of a wall's pressure in a cell comes through to a lighter neighbour, by their impedances
 * as of a sound wave: p_w where both are alike, that of the neighbour where it is much lighter. Water that is pressed
 * against a wall would else press as hard on the air beside it. */
static double cut_flux_pressure(const struct cut_rows *rows, const struct model *model, size_t cell, size_t beside)
{
    double Z = rows->rho[cell] * sqrt(rows->c2[cell]), lighter = rows->rho[beside] * sqrt(rows->c2[beside]);
    double p = rows->w[model->i_E * rows->stride + beside], less = Z > lighter ? (Z - lighter) / (Z + lighter) : 0.0;
    return rows->p[cell] + less * (p - rows->p[cell]);
}

static void cut_flux_press(const struct term_piece *piece)
{
    struct cut_flux *cut = piece->own;
    const struct cut_rows *rows = cut->rows;
    bool meet = piece->tile->masked && cut_flux_mingles(piece); /* both cells are in the rows */
    for (size_t f = 0; f < cut->n_face; f++) {
        struct cut_flux_face *face = &cut->faces[f];
        size_t below = face->below, above = face->above;
        if (face->lower > 0.0)
            face->p_lower = meet ? cut_flux_pressure(rows, piece->model, below, above) : rows->p[below];
        if (face->upper > 0.0)
            face->p_upper = meet ? cut_flux_pressure(rows, piece->model, above, below) : rows->p[above];
    }
}

/* The wall gives cell i of the rows back what the pressure p at a face has more than its own; `per`: area of the face
 * over the volume of the cell [1/m], less than 0 above the cell. */
static void cut_flux_give(const struct term_piece *piece, size_t cell, size_t i, double p, double per)
{
    const struct model *model = piece->model;
    const struct cut_rows *rows = ((const struct cut_flux *)piece->own)->rows;
    unsigned axis = model->i_u + (unsigned)piece->frame->axis;
    double *rates = piece->tile->rates + cell, push = per * (p - rows->p[i]);
    rates[axis * piece->tile->n_cell] -= push;
    rates[model->i_E * piece->tile->n_cell] -= push * rows->w[axis * rows->stride + i];
}

/* Where the pressure at a face is not that on the wall: on the part that looks at the wall both are to cancel. Rates
 * are those of whole cells, as those of the fluxes. */
static void cut_flux_return(const struct term_piece *piece)
{
    const struct cut_flux *cut = piece->own;
    const struct term_tile *tile = piece->tile;
    int axis = piece->frame->axis;
    const struct metric *metric = axis == 0 && tile->mesh->beta ? tile->metric : NULL;
    double per = 1.0 / tile->level->h[axis];
    size_t stride = 1;
    for (int d = 0; d < axis; d++) stride *= (size_t)tile->mesh->n[d];
    for (size_t f = 0; f < cut->n_face; f++) {
        const struct cut_flux_face *face = &cut->faces[f];
        size_t i = face->at, cell = face->line + i * stride;
        double lower = face->open * face->lower, upper = face->open * face->upper;
        if (upper > 0.0 && i < piece->frame->n)
            cut_flux_give(piece, cell, face->above, face->p_upper,
                          upper * (metric ? metric->area[i] / metric->volume[i] : per));
        if (lower > 0.0 && i > 0)
            cut_flux_give(piece, cell - stride, face->below, face->p_lower,
                          -lower * (metric ? metric->area[i] / metric->volume[i - 1] : per));
    }
}

/* Does a cell have less than a part of what the one at the wall has of some material? */
static bool cut_flux_misses(const struct cut_rows *rows, const struct model *model, size_t i, size_t before)
{
    for (unsigned l = 0; l < model->n_material; l++) {
        const double *m = rows->u + (model->i_m + l) * rows->stride;
        if (m[before] < 1e-2 * m[i]) return true;
    }
    return false;
}

/* G of one flux in a compact row: of what slides along the wall, or with it. A repeated attempt takes what comes into
 * the cell from the one `before` the face: what the wall's cell holds of a material, that one may not have. */
static double cut_flux_push(const struct term_piece *piece, const struct term_flux *flux, double p, size_t i,
                            size_t before, double inward)
{
    const struct cut_rows *rows = ((const struct cut_flux *)piece->own)->rows;
    const struct model *model = piece->model;
    unsigned axis = model->i_u + (unsigned)piece->frame->axis;
    double speed = rows->w[axis * rows->stride + i], G = flux->rate == axis ? p : 0.0;
    bool upwind = piece->tile->masked || (cut_flux_mingles(piece) && cut_flux_misses(rows, model, i, before));
    size_t from = upwind && speed * inward > 0.0 ? before : i;
    if (flux->rate < model->n_field) G += speed * rows->u[flux->rate * rows->stride + from];
    if (flux->rate == model->i_E) G += speed * p;
    if (flux->below == piece->faces->u) return speed;
    for (unsigned l = 0; l < model->n_alpha; l++)
        if (flux->below == piece->faces->carried + l * FACE_ROOM)
            G = speed * rows->w[(model->i_alpha + l) * rows->stride + from] * rows->w[model->i_E * rows->stride + from];
    return G;
}

static void cut_flux_change(const struct term_piece *piece, const struct term_flux *flux, double *row)
{
    const struct cut_flux *cut = piece->own;
    for (size_t f = 0; f < cut->n_face; f++) {
        const struct cut_flux_face *face = &cut->faces[f];
        double value = face->keep * row[face->k];
        if (face->lower > 0.0)
            value += face->lower * cut_flux_push(piece, flux, face->p_lower, face->below, face->above, -1.0);
        if (face->upper > 0.0)
            value += face->upper * cut_flux_push(piece, flux, face->p_upper, face->above, face->below, 1.0);
        row[face->k] = face->open * value;
    }
}

/* Is this row a flux further up in the list, too? */
static bool cut_flux_is_done(const struct terms *terms, int axis, unsigned index, const double *row)
{
    for (unsigned i = 0; i < index; i++)
        if (terms->flux[axis][i].below == row || terms->flux[axis][i].above == row) return true;
    return false;
}

static void cut_flux_faces(const struct term_piece *piece)
{
    const struct rigid_cells *cells = cut_rows_cells(piece->tile);
    const struct terms *terms = piece->terms;
    int axis = piece->frame->axis;
    if (!cells) return;
    cut_flux_find(piece, cells);
    cut_flux_press(piece);
    for (unsigned i = 0; i < terms->n_flux[axis]; i++) {
        const struct term_flux *flux = &terms->flux[axis][i];
        double *below = (double *)flux->below, *above = (double *)flux->above;
        if (!cut_flux_is_done(terms, axis, i, below)) cut_flux_change(piece, flux, below);
        if (above != below && !cut_flux_is_done(terms, axis, i, above)) cut_flux_change(piece, flux, above);
    }
    if (piece->tile->masked && cut_flux_mingles(piece)) cut_flux_return(piece);
}

const struct term cut_flux_term = {
    .name = "walls",
    .owner = "core/scheme/cut_flux.c",
    .equation = "F -> G + alpha (F - G) on the parts of faces that look at a body",
    .wanted = cut_wanted,
    .moves = true,
    .open = cut_flux_open,
    .close = cut_flux_close,
    .faces = cut_flux_faces,
};
