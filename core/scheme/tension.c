/* tension.c - see tension.h. In one dimension pieces are whole tiles, and rows of faces follow those of cells; in two
 * and three the curvature is a row of the frame (solve/curve.h). */
#include "scheme/tension.h"

#include "paint/paint_curvature.h"
#include "phys/row.h"
#include "scheme/terms.h"

#include <math.h>
#include <string.h>

/* No weight worth a quotient. */
#define TENSION_NONE 1e-300

static bool tension_wanted(const struct model *path)
{
    return path->n_pair > 0;
}

static unsigned tension_rows(const struct model *path)
{
    return path->dim > 1 ? 0 : path->n_pair;
}

static void tension_list(struct terms *terms, int axis, unsigned first, const struct face_work *faces)
{
    const double *row = faces ? faces->tension : NULL;
    struct term_flux force = {.below = row,
                              .above = row,
                              .rate = terms->model->i_u + (unsigned)axis,
                              .kind = TERM_FORCE};
    (void)first;
    terms_flux(terms, axis, force, "tension", "");
}

/* beta/r of the faces above the cells of a frame; 0 at the centre. */
static void tension_radial(const struct term_piece *piece, double *curve)
{
    const struct frame *frame = piece->frame;
    const struct mesh *mesh = piece->tile->mesh;
    int first = piece->tile->tile->at[0] * mesh->n[0] - (int)frame->ghosts + 1;
    for (size_t j = 0; j < frame->count; j++) {
        double r = mesh->lower[0] + (first + (int)j) * piece->tile->level->h[0];
        curve[j] = r == 0.0 ? 0.0 : mesh->beta / r;
    }
}

/* In one dimension: the curvature of the faces, whose size is known and whose sign says what is inside. */
static BULLA_KERNEL void tension_turn(size_t n, const double *restrict a, const double *restrict b,
                                      double *restrict curve)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a0 = a[i], a1 = a[i + 1], b0 = b[i], b1 = b[i + 1], size = curve[i];
        double am = 0.5 * (a0 + a1), bm = 0.5 * (b0 + b1), g = bm * (a1 - a0) - am * (b1 - b0);
        double outward = g > 0.0 ? -size : 0.0;
        curve[i] = g < 0.0 ? size : outward;
    }
}

/* In the plane and in space: the mean of both cells, with (a b)^2, which is largest in the middle of a front. */
static BULLA_KERNEL void tension_between(size_t n, size_t step, const double *restrict kappa, const double *restrict a,
                                         const double *restrict b, double *restrict curve)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double below = a[i] * b[i], above = a[i + step] * b[i + step], v = below * below, w = above * above;
        double sum = v + w, k = v * kappa[i] + w * kappa[i + step];
        curve[i] = k / (sum > TENSION_NONE ? sum : 1.0);
    }
}

/* What a pair adds to the force and the lags of the faces above n cells with a curvature. */
static BULLA_KERNEL void tension_face(size_t n, size_t step, double sigma, const double *restrict curve,
                                      const double *restrict a, const double *restrict b, double *restrict force,
                                      double *restrict lag_a, double *restrict lag_b)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a0 = a[i], a1 = a[i + step], b0 = b[i], b1 = b[i + step], f = force[i], up = lag_a[i], down = lag_b[i];
        double am = 0.5 * (a0 + a1), bm = 0.5 * (b0 + b1), g = bm * (a1 - a0) - am * (b1 - b0);
        double jump = sigma * curve[i];
        force[i] = f + jump * g;
        lag_a[i] = up + bm * jump;
        lag_b[i] = down - am * jump;
    }
}

/* Both cells hold half of what acts on the face between them. */
static BULLA_KERNEL void tension_halve(size_t n, double *restrict force)
{
#pragma omp simd
    for (size_t j = 0; j < n; j++) force[j] *= 0.5;
}

/* Curvature at the faces above the cells of a frame. */
static void tension_curve(const struct term_piece *piece, const struct model_pair *pair, double *curve)
{
    const struct frame *frame = piece->frame;
    const double *w = piece->faces->frame, *alpha = w + piece->model->i_alpha * FACE_ROOM;
    const double *a = alpha + pair->inside * FACE_ROOM, *b = alpha + pair->outside * FACE_ROOM;
    size_t n = frame->count - frame->inner;
    if (piece->model->dim > 1) {
        tension_between(n, frame->inner, w + pair->i_kappa * FACE_ROOM, a, b, curve);
        return;
    }
    tension_radial(piece, curve);
    tension_turn(n, a, b, curve);
}

/* In one dimension cells have theirs from this stage on. */
static void tension_cell(const struct term_piece *piece, unsigned k)
{
    const struct frame *frame = piece->frame;
    const struct model_pair *pair = &piece->model->pairs[k];
    const double *alpha = piece->faces->frame + piece->model->i_alpha * FACE_ROOM + frame->ghosts - 1;
    double size[METRIC_CELLS];
    if (piece->model->dim > 1) return;
    paint_curvature_size(piece->tile->metric, frame->n, size);
    paint_curvature_cells(frame->n, size, alpha + pair->inside * FACE_ROOM, alpha + pair->outside * FACE_ROOM,
                          piece->tile->rates + (terms_first(piece->terms, &tension_term) + k) * piece->tile->n_cell);
}

static void tension_frame(const struct term_piece *piece)
{
    const struct model *path = piece->model;
    const struct frame *frame = piece->frame;
    struct face_work *faces = piece->faces;
    const double *alpha = faces->frame + path->i_alpha * FACE_ROOM;
    double curve[FACE_ROOM], rise[FACE_ROOM + FRAME_CELLS]; /* large: filled as far as they are used */
    double *force = rise + frame->inner; /* of the face above each cell; below the first there is none */
    size_t n = frame->count - frame->inner;
    memset(rise, 0, (frame->count + frame->inner) * sizeof *rise);
    for (unsigned k = 0; k < path->n_pair; k++) {
        const struct model_pair *pair = &path->pairs[k];
        tension_curve(piece, pair, curve);
        tension_face(n, frame->inner, pair->sigma, curve, alpha + pair->inside * FACE_ROOM,
                     alpha + pair->outside * FACE_ROOM, force, faces->lag + pair->inside * FACE_ROOM,
                     faces->lag + pair->outside * FACE_ROOM);
        tension_cell(piece, k);
    }
    memcpy(faces->tension, force + frame_reach(frame), frame_edged(frame) * sizeof *force);
    tension_halve(n, force);
    face_rise(faces, frame, rise, force);
}

/* What the surface that came to a cell since u has stored, sigma kappa d alpha, is taken from its energy. */
static BULLA_KERNEL void tension_store(size_t n, double sigma, const double *restrict kappa, const double *restrict a0,
                                       const double *restrict b0, const double *restrict a1, const double *restrict b1,
                                       double *restrict energy)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = 0.5 * (a0[i] + a1[i]), b = 0.5 * (b0[i] + b1[i]), e = energy[i], jump = sigma * kappa[i];
        energy[i] = e - jump * (b * (a1[i] - a0[i]) - a * (b1[i] - b0[i]));
    }
}

static size_t tension_apply(const struct term_tile *tile, double *u_new)
{
    const struct model *path = tile->model;
    size_t n = tile->n_cell;
    for (unsigned k = 0; k < path->n_pair; k++) {
        const struct model_pair *pair = &path->pairs[k];
        size_t a = (path->i_alpha + pair->inside) * n, b = (path->i_alpha + pair->outside) * n;
        const double *kappa = path->dim > 1 ? tile->w + pair->i_kappa * n
                                            : tile->rates + (terms_first(tile->terms, &tension_term) + k) * n;
        tension_store(n, pair->sigma, kappa, tile->u + a, tile->u + b, u_new + a, u_new + b, u_new + path->i_E * n);
        memcpy(u_new + pair->i_kappa * n, kappa, n * sizeof *u_new);
    }
    return 0;
}

/* rate += per sqrt(1/(rho_a + rho_b)) where both are. */
static BULLA_KERNEL void tension_hurry(size_t n, double per, const double *restrict a, const double *restrict b,
                                       const double *restrict rho_a, const double *restrict rho_b,
                                       double *restrict rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double both = a[i] * b[i], r = rate[i], more = per / sqrt(rho_a[i] + rho_b[i]);
        rate[i] = both > 0.0 ? r + more : r;
    }
}

/* 1/dt = ... + sqrt(4 pi sigma/((rho_a + rho_b) h^3)): waves of the length of two cells. */
static void tension_pace(const struct term_pace *pace, double *rate)
{
    const struct model *path = pace->model;
    double h = pace->level->h[0];
    if (path->dim == 1) return;
    for (int d = 1; d < path->dim; d++) h = pace->level->h[d] < h ? pace->level->h[d] : h;
    for (unsigned k = 0; k < path->n_pair; k++) {
        const struct model_pair *pair = &path->pairs[k];
        const double *alpha = pace->w + path->i_alpha * pace->n_cell, *rho = pace->w + path->i_m * pace->n_cell;
        double per = path->scene->scheme.cfl * sqrt(4.0 * M_PI * pair->sigma / (h * h * h));
        tension_hurry(pace->n_cell, per, alpha + pair->inside * pace->n_cell, alpha + pair->outside * pace->n_cell,
                      rho + pair->inside * pace->n_cell, rho + pair->outside * pace->n_cell, rate);
    }
}

static void tension_say(const struct scene *scene, struct text *text)
{
    for (unsigned k = 0; k < scene->n_tension; k++) {
        const struct scene_tension *pair = &scene->tension[k];
        text_add(text, "%s%s+%s %g N/m", k ? ", " : ": ", scene->material[pair->one].name,
                 scene->material[pair->other].name, pair->sigma);
    }
}

const struct term tension_term = {
    .name = "tension",
    .owner = "core/scheme/tension.c",
    .equation = "d(rho u)/dt += sigma kappa grad alpha, d(rho E)/dt -= sigma kappa d alpha/dt; p_l lag behind p",
    .wanted = tension_wanted,
    .rows = tension_rows,
    .list = tension_list,
    .frame = tension_frame,
    .apply = tension_apply,
    .pace = tension_pace,
    .say = tension_say,
};
