/* cut_flux.c - the fluxes beside rigid bodies: see cut.h. */
#include "scheme/cut.h"

#include "base/mem.h"
#include "scheme/cut_rows.h"
#include "scheme/terms.h"

#include <string.h>

/* The Courant number that cut cells may have, and how much more than whole ones. */
#define CUT_FLUX_COURANT 0.6
#define CUT_FLUX_EXCESS 2.0

/* A face that is not as it would be without bodies. */
struct cut_flux_face {
    size_t k;            /* in rows of faces */
    double open, keep;   /* a; how much of F stays */
    double lower, upper; /* how much of G of the cells on both sides comes in */
    size_t below, above; /* these, in the compact rows */
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
                          const struct cut_rows_line *line, int i)
{
    struct cut_flux *cut = piece->own;
    int axis = piece->frame->axis;
    size_t above = cut_rows_place(line, i), below = above - line->stride, cell = cut_rows_cell(line, i);
    struct cut_flux_face face = {.k = cell - piece->frame->ghosts * piece->frame->inner,
                                 .open = cells->open[axis][above]};
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
    if (face.lower > 0.0 || (both > 0.0 && piece->tile->masked))
        face.below = cut_flux_slot(piece, cell - line->step, below);
    if (face.upper > 0.0 || (both > 0.0 && piece->tile->masked)) face.above = cut_flux_slot(piece, cell, above);
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
            for (int i = 0; i <= line.n; i++) cut_flux_face(piece, cells, &line, i);
        }
    cut_rows_press(cut->rows, piece->model, cells, piece->tile->masked);
}

/* G of one flux in a compact row: of what slides along the wall, or with it. A repeated attempt takes what comes into
 * the cell from the one `before` the face: what the wall's cell holds of a material, that one may not have. */
static double cut_flux_push(const struct term_piece *piece, const struct term_flux *flux, size_t i, size_t before,
                            double inward)
{
    const struct cut_rows *rows = ((const struct cut_flux *)piece->own)->rows;
    const struct model *model = piece->model;
    unsigned axis = model->i_u + (unsigned)piece->frame->axis;
    double speed = rows->w[axis * rows->stride + i], G = flux->rate == axis ? rows->p[i] : 0.0;
    size_t from = piece->tile->masked && speed * inward > 0.0 ? before : i;
    if (flux->rate < model->n_field) G += speed * rows->u[flux->rate * rows->stride + from];
    if (flux->rate == model->i_E) G += speed * rows->p[i];
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
        if (face->lower > 0.0) value += face->lower * cut_flux_push(piece, flux, face->below, face->above, -1.0);
        if (face->upper > 0.0) value += face->upper * cut_flux_push(piece, flux, face->above, face->below, 1.0);
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
    for (unsigned i = 0; i < terms->n_flux[axis]; i++) {
        const struct term_flux *flux = &terms->flux[axis][i];
        double *below = (double *)flux->below, *above = (double *)flux->above;
        if (!cut_flux_is_done(terms, axis, i, below)) cut_flux_change(piece, flux, below);
        if (above != below && !cut_flux_is_done(terms, axis, i, above)) cut_flux_change(piece, flux, above);
    }
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
