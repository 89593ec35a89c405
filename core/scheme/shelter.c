/* shelter.c - see shelter.h. */
#include "scheme/shelter.h"

#include "phys/row.h"
#include "scheme/terms.h"

#include <string.h>

bool shelter_wanted(const struct model *path)
{
    bool both = path->n_solid > 0 && path->n_solid < path->n_material && path->n_alpha > 0;
    return path->scene->scheme.sheltered && both && path->n_stretch > 0;
}

static unsigned shelter_rows(const struct model *path)
{
    return path->n_velocity * (unsigned)path->dim;
}

static const double *shelter_row(const double *base, unsigned d)
{
    return base ? base + d * FACE_ROOM : NULL;
}

static void shelter_list(struct terms *terms, int axis, unsigned first, const struct face_work *faces)
{
    static const struct face_work none;
    static const char *const ways[] = {"", "1", "2"};
    const struct model *model = terms->model;
    unsigned dim = (unsigned)model->dim;
    if (!faces) faces = &none;
    for (unsigned d = 0; d < model->n_velocity; d++)
        terms_flux(terms, axis,
                   (struct term_flux){.below = shelter_row(faces->seen_right, d),
                                      .above = shelter_row(faces->seen_left, d),
                                      .rate = first + axis_component(axis, d) * dim + (unsigned)axis,
                                      .kind = TERM_DIFFERENCE,
                                      .sides = true},
                   "seen", ways[d]);
}

/* Solids of which less than 1 - 1/this comes to a face see nothing of it. */
#define SHELTER_STEEP 2.0

/* How far the solids of the cells see their edges. */
static BULLA_KERNEL void shelter_share(size_t n, const double *restrict edge, const double *restrict cell,
                                       double *restrict beta)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double e = edge[i], a = cell[i], part = 1.0 - SHELTER_STEEP * (1.0 - e / a);
        part = part > 0.0 ? part : 0.0;
        beta[i] = e < a ? part : 1.0;
    }
}

static BULLA_KERNEL void shelter_see(size_t n, const double *restrict beta, const double *restrict own,
                                     const double *restrict face, double *restrict seen)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double b = beta[i], u = own[i], v = face[i], part = u + b * (v - u);
        seen[i] = b < 1.0 ? part : v;
    }
}

/* What the cells on one side of the faces see; `cells`: their primitives, `slide` velocities along the face. */
static void shelter_side(const struct term_piece *piece, const struct bulla_side *side, const double *cells,
                         const double *slide, double *seen)
{
    const struct model *model = piece->model;
    const struct face_work *faces = piece->faces;
    double edge[FACE_ROOM], cell[FACE_ROOM], beta[FACE_ROOM];
    size_t n = faces->faces.n;
    memset(edge, 0, n * sizeof *edge);
    memset(cell, 0, n * sizeof *cell);
    for (unsigned s = 0; s < model->n_solid; s++) {
        unsigned l = model->solids[s].material;
        row_add(n, side->alpha[l], edge);
        row_add(n, cells + (model->i_alpha + l) * FACE_ROOM, cell);
    }
    shelter_share(n, edge, cell, beta);
    for (unsigned d = 0; d < model->n_velocity; d++) {
        const double *own = cells + (model->i_u + axis_component(piece->frame->axis, d)) * FACE_ROOM;
        shelter_see(n, beta, own, d ? slide + (d - 1) * FACE_ROOM : faces->u, seen + d * FACE_ROOM);
    }
}

static void shelter_faces(const struct term_piece *piece)
{
    const struct face_work *work = piece->faces;
    const double *cells = work->frame + frame_reach(piece->frame);
    shelter_side(piece, &work->faces.left, cells, work->slide_left, work->seen_left);
    shelter_side(piece, &work->faces.right, cells + piece->frame->inner, work->slide_right, work->seen_right);
}

const double *shelter_gradient(const struct term_tile *tile)
{
    if (!shelter_wanted(tile->model)) return NULL;
    return tile->rates + terms_first(tile->terms, &shelter_term) * tile->n_cell;
}

static BULLA_KERNEL void shelter_add(size_t n, const double *restrict face, const double *restrict seen,
                                     double *restrict missing)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double m = missing[i];
        missing[i] = m + (face[i] - seen[i]);
    }
}

void shelter_missing(const struct term_tile *tile, size_t n, const double *face, const double *seen, double *missing)
{
    unsigned dim = (unsigned)tile->model->dim;
    memset(missing, 0, n * sizeof *missing);
    for (unsigned d = 0; d < dim; d++) {
        size_t at = (d * dim + d) * tile->n_cell;
        shelter_add(n, face + at, seen + at, missing);
    }
}

const struct term shelter_term = {
    .name = "shelter",
    .owner = "core/scheme/shelter.c",
    .equation = "L of solids from u_cell + beta (u* - u_cell), beta by the share of them that is there",
    .wanted = shelter_wanted,
    .rows = shelter_rows,
    .list = shelter_list,
    .faces = shelter_faces,
};
