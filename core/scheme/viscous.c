/* viscous.c - see viscous.h.
 *
 * A tile's velocities and fractions come with the layer of cells around it (tile->around). Of each piece of a sweep they are
 * put into rows beside those of the frame, with their slopes along the faces; then batches of faces are worked on. What
 * acts in the cells (the hoop stress, heat) has gradients of the tile's own cells. */
#include "scheme/viscous.h"

#include "base/mem.h"
#include "phys/coefficient.h"
#include "scheme/viscous_heat.h"
#include "scheme/viscous_plain.h"

/* Where the real axis leaves the region of stability of the midpoint rule, with some room. */
#define VISCOUS_REAL 1.8

/* Of one rank. */
struct viscous {
    struct viscous_slopes slopes;
    struct viscous_strain strain;
    struct viscous_mix mix;
};

static bool viscous_wanted(const struct model *path)
{
    return path->viscous;
}

static void *viscous_open(const struct term_room *room)
{
    struct viscous *viscous = mem_new(1, sizeof *viscous);
    viscous_slopes_open(room->mesh, &viscous->slopes);
    return viscous;
}

static void viscous_close(void *own)
{
    struct viscous *viscous = own;
    viscous_slopes_close(&viscous->slopes);
    mem_free(viscous);
}

static void viscous_begin(struct term_tile *tile)
{
    struct viscous *viscous = tile->own;
    viscous_slopes_look(&viscous->slopes, tile);
}

static void viscous_cells(struct term_tile *tile)
{
    struct viscous *viscous = tile->own;
    viscous_heat_cells(tile, &viscous->slopes, &viscous->strain, &viscous->mix);
}

static BULLA_KERNEL void viscous_difference(size_t n, size_t step, double per_h, const double *restrict a,
                                            double *restrict slope)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) slope[i] = (a[i + step] - a[i]) * per_h;
}

static BULLA_KERNEL void viscous_mean(size_t n, size_t step, const double *restrict a, double *restrict mean)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) mean[i] = 0.5 * (a[i] + a[i + step]);
}

/* A piece under way. */
struct viscous_piece {
    const struct term_tile *tile;
    const struct frame *frame;
    const struct viscous_slopes *slopes;
    size_t shift; /* from a face to the cell before it, in rows of the frame */
};

/* Derivatives of one quantity at n faces from `face` on. */
static void viscous_derive(const struct viscous_piece *piece, size_t face, size_t n, unsigned quantity,
                           double (*ret)[STRAIN_POINTS])
{
    const struct frame *frame = piece->frame;
    size_t at = face + piece->shift;
    viscous_difference(n, frame->inner, 1.0 / piece->tile->level->h[frame->axis],
                       viscous_slopes_row(piece->slopes, quantity, 0) + at, ret[frame->axis]);
    for (unsigned k = 1; k < (unsigned)piece->tile->mesh->dim; k++)
        viscous_mean(n, frame->inner, viscous_slopes_row(piece->slopes, quantity, k) + at,
                     ret[axis_component(frame->axis, k)]);
}

/* Place of a face across the radius among the centroids: that of the cell before it. */
static size_t viscous_column(const struct viscous_piece *piece, size_t face)
{
    size_t x = (face + piece->shift) % frame_layers(piece->frame) - (piece->frame->ghosts - 1);
    return x > piece->frame->n ? piece->frame->n : x; /* between two lines: not used */
}

/* Faces across the radius: differences over the distances of centroids, and u_r/r. At r = 0, where the area is 0, that is
 * du_r/dr. */
static void viscous_curve_radial(const struct viscous_piece *piece, size_t face, size_t n,
                                 struct viscous_strain *strain)
{
    const double *u = viscous_slopes_row(piece->slopes, 0, 0) + face + piece->shift, *r = piece->slopes->centroid;
    double h = piece->tile->level->h[0];
    for (size_t i = 0; i < n; i++) {
        size_t x = viscous_column(piece, face + i);
        double stretch = h / (r[x + 1] - r[x]), sum = r[x] + r[x + 1];
        for (unsigned d = 0; d < strain->path->n_velocity; d++) strain->gradient[d][0][i] *= stretch;
        if (piece->slopes->colour) strain->colour[0][i] *= stretch;
        strain->hoop[i] = sum > 0.0 ? (u[i] + u[i + 1]) / sum : strain->gradient[0][0][i];
    }
}

/* A velocity at faces: the mean of both cells; across the radius by the distances of centroids. */
static void viscous_speed(const struct viscous_piece *piece, size_t face, size_t n, unsigned d, double *ret)
{
    const double *u = viscous_slopes_row(piece->slopes, d, 0) + face + piece->shift, *r = piece->slopes->centroid;
    viscous_mean(n, piece->frame->inner, u, ret);
    if (!piece->tile->mesh->beta || piece->frame->axis > 0) return;
    for (size_t i = 0; i < n; i++) {
        size_t x = viscous_column(piece, face + i);
        double part = (piece->slopes->radius[x] - r[x]) / (r[x + 1] - r[x]);
        ret[i] = u[i] + part * (u[i + 1] - u[i]);
    }
}

/* Faces along the radius: both cells have the same r. */
static void viscous_curve_axial(const struct viscous_piece *piece, size_t face, size_t n, struct viscous_strain *strain)
{
    const struct frame *frame = piece->frame;
    const double *u = viscous_slopes_row(piece->slopes, 0, 0) + face + piece->shift, *r = piece->slopes->centroid;
    for (size_t i = 0; i < n; i++) {
        size_t x = frame->inner_from + (face + piece->shift + i) % frame->inner;
        strain->hoop[i] = 0.5 * (u[i] + u[i + frame->inner]) / r[x + 1];
    }
}

/* Takes tau off the flux of momentum, and its power off that of energy. */
static BULLA_KERNEL void viscous_push(size_t n, const double *restrict tau, const double *restrict u,
                                      double *restrict momentum, double *restrict energy)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double t = tau[i], m = momentum[i], e = energy[i];
        momentum[i] = m - t;
        energy[i] = e - t * u[i];
    }
}

/* Strain and its stress at n faces from `face` on. */
static void viscous_stress(const struct viscous_piece *piece, const struct face_work *faces, size_t face, size_t n,
                           struct viscous *viscous)
{
    struct viscous_strain *strain = &viscous->strain;
    const struct term_tile *tile = piece->tile;
    const struct frame *frame = piece->frame;
    strain->path = tile->model;
    strain->n = n;
    for (unsigned d = 0; d < strain->path->n_velocity; d++) viscous_derive(piece, face, n, d, strain->gradient[d]);
    if (piece->slopes->colour) viscous_derive(piece, face, n, SLOPES_COLOUR, strain->colour);
    if (tile->mesh->beta && frame->axis == 0) viscous_curve_radial(piece, face, n, strain);
    if (tile->mesh->beta && frame->axis > 0) viscous_curve_axial(piece, face, n, strain);
    viscous_strain_make(strain, viscous_strain_longest(tile->mesh->dim, tile->level->h));
    const struct viscous_sides sides = {faces->frame + face + piece->shift, FACE_ROOM, frame->inner};
    viscous_mix_make(strain, &sides, &viscous->mix);
}

static void viscous_batch(const struct viscous_piece *piece, struct face_work *faces, size_t face, size_t n,
                          struct viscous *viscous)
{
    const struct frame *frame = piece->frame;
    double tau[STRAIN_POINTS], speed[STRAIN_POINTS];
    viscous_stress(piece, faces, face, n, viscous);
    for (unsigned d = 0; d < piece->tile->model->n_velocity; d++) {
        unsigned i = axis_component(frame->axis, d);
        viscous_mix_stress(&viscous->strain, &viscous->mix, i, (unsigned)frame->axis, tau);
        viscous_speed(piece, face, n, i, speed);
        viscous_push(n, tau, speed, faces->momentum + d * FACE_ROOM + face, faces->energy + face);
    }
}

static void viscous_faces(const struct term_piece *piece)
{
    struct viscous *viscous = piece->own;
    const struct frame *frame = piece->frame;
    const struct viscous_piece work = {piece->tile, frame, &viscous->slopes, frame_reach(frame)};
    size_t n = frame_edged(frame) - frame->inner;
    viscous_slopes_gather(&viscous->slopes, frame);
    if (viscous_plain_is(piece->model)) {
        viscous_plain_faces(&viscous->slopes, frame, piece->faces);
        return;
    }
    for (size_t from = 0; from < n; from += STRAIN_POINTS)
        viscous_batch(&work, piece->faces, from, n - from < STRAIN_POINTS ? n - from : STRAIN_POINTS, viscous);
}

/* rho += alpha rho_l, D += alpha (4/3 mu + zeta) */
static BULLA_KERNEL void viscous_spread(size_t n, const double *restrict alpha, const double *restrict rho_l,
                                        const double *restrict mu, const double *restrict zeta, double *restrict rho,
                                        double *restrict spread)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], r = rho[i], s = spread[i];
        rho[i] = r + a * rho_l[i];
        spread[i] = s + a * (4.0 / 3.0 * mu[i] + zeta[i]);
    }
}

static BULLA_KERNEL void viscous_hurry(size_t n, double per, const double *restrict rho, const double *restrict spread,
                                       double *restrict rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double r = rate[i];
        rate[i] = r + per * (spread[i] / rho[i]);
    }
}

static void viscous_pace_batch(const struct term_pace *pace, double per, size_t from, size_t n, double *rate)
{
    const struct model *path = pace->model;
    const double *w = pace->w + from;
    double rho[STRAIN_POINTS] = {0}, spread[STRAIN_POINTS] = {0}, mu[STRAIN_POINTS], zeta[STRAIN_POINTS];
    double one[STRAIN_POINTS];
    for (size_t i = 0; i < n; i++) one[i] = 1.0;
    for (unsigned l = 0; l < path->n_material; l++) {
        const double *alpha = path->n_alpha ? w + (path->i_alpha + l) * pace->n_cell : one;
        const double *rho_l = w + (path->i_m + l) * pace->n_cell;
        const struct coefficient_points points = {n, NULL, w + path->i_E * pace->n_cell, rho_l};
        coefficient_viscosities_most(&path->viscosity[l], &path->eos[l], &points, mu, zeta);
        viscous_spread(n, alpha, rho_l, mu, zeta, rho, spread);
    }
    viscous_hurry(n, per, rho, spread, rate + from);
}

/* 1/dt = signal/cfl + lambda/VISCOUS_REAL, lambda = 4 sum 1/h^2 (4/3 mu + zeta)/rho. */
static void viscous_pace(const struct term_pace *pace, double *rate)
{
    double per = 0.0;
    for (int d = 0; d < pace->model->dim; d++) per += 1.0 / (pace->level->h[d] * pace->level->h[d]);
    per *= 4.0 * pace->model->scene->scheme.cfl / VISCOUS_REAL;
    for (size_t from = 0; from < pace->n_cell; from += STRAIN_POINTS)
        viscous_pace_batch(pace, per, from, pace->n_cell - from < STRAIN_POINTS ? pace->n_cell - from : STRAIN_POINTS,
                           rate);
}

static void viscous_say(const struct scene *scene, struct text *text)
{
    const char *comma = ": ";
    for (unsigned l = 0; l < scene->n_material; l++) {
        if (!scene->material[l].viscosity.module) continue;
        text_add(text, "%s%s %s", comma, scene->material[l].name, scene->material[l].viscosity.module->name);
        comma = ", ";
    }
}

const struct term viscous_term = {
    .name = "viscosity",
    .owner = "core/scheme/viscous.c",
    .equation = "d(rho u)/dt += div tau, d(rho E)/dt += div(tau u); tau of each material's own strain",
    .wanted = viscous_wanted,
    .open = viscous_open,
    .close = viscous_close,
    .begin = viscous_begin,
    .faces = viscous_faces,
    .cells = viscous_cells,
    .pace = viscous_pace,
    .say = viscous_say,
};
