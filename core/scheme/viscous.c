/* viscous.c - see viscous.h.
 *
 * A tile's velocities and fractions come with the layer of cells around it (tile->around). The faces of each piece of a
 * sweep are worked on in batches, whose gradients are taken in there (viscous_slopes.h). What acts in the cells (the
 * hoop stress, heat) has gradients of the tile's own cells. */
#include "scheme/viscous.h"

#include "base/mem.h"
#include "phys/coefficient.h"
#include "phys/row.h"
#include "scheme/viscous_film.h"
#include "scheme/viscous_heat.h"
#include "scheme/viscous_plain.h"

/* Where the real axis leaves the region of stability of the midpoint rule, with some room. */
#define VISCOUS_REAL 1.8

/* Of one rank. */
struct viscous {
    struct viscous_slopes slopes;
    struct viscous_strain strain;
    struct viscous_mix mix;
    struct viscous_film film;
};

static bool viscous_wanted(const struct model *path)
{
    return path->viscous;
}

static void *viscous_open(const struct term_room *room)
{
    struct viscous *viscous = mem_new(1, sizeof *viscous);
    viscous_slopes_open(room->mesh, &viscous->slopes);
    viscous_mix_open(room->model, &viscous->mix);
    viscous_film_open(room->mesh, room->model, &viscous->film);
    return viscous;
}

static void viscous_close(void *own)
{
    struct viscous *viscous = own;
    viscous_slopes_close(&viscous->slopes);
    viscous_mix_close(&viscous->mix);
    viscous_film_close(&viscous->film);
    mem_free(viscous);
}

static void viscous_begin(struct term_tile *tile)
{
    struct viscous *viscous = tile->own;
    viscous_slopes_look(&viscous->slopes, tile);
    viscous_film_make(&viscous->film, &viscous->slopes, &viscous->mix, &viscous->strain);
}

static void viscous_cells(struct term_tile *tile)
{
    struct viscous *viscous = tile->own;
    viscous_heat_cells(tile, &viscous->slopes, &viscous->strain, &viscous->mix, &viscous->film);
}

/* Takes tau off the flux of momentum, and its power off that of energy. */
static BULLA_KERNEL void viscous_push(const struct viscous_block *block, const double *restrict tau,
                                      const double *restrict u, double *restrict momentum, double *restrict energy)
{
    const size_t n = block->n, row = block->face_row;
    for (size_t r = 0; r < block->rows; r++, tau += n, u += n, momentum += row, energy += row)
#pragma omp simd
        for (size_t i = 0; i < n; i++) {
            double t = tau[i], m = momentum[i], e = energy[i];
            momentum[i] = m - t;
            energy[i] = e - t * u[i];
        }
}

static void viscous_batch(const struct term_piece *piece, const struct viscous_block *block, struct viscous *viscous)
{
    const struct face_work *faces = piece->faces;
    const struct frame *frame = piece->frame;
    const struct viscous_sides sides = {faces->frame + block->face + frame_reach(frame),
                                        FACE_ROOM,
                                        frame->inner,
                                        block->rows,
                                        block->n,
                                        block->face_row};
    double tau[STRAIN_POINTS], speed[STRAIN_POINTS];
    viscous_slopes_strain(&viscous->slopes, block, &viscous->strain);
    viscous_mix_make(&viscous->strain, &sides, &viscous->mix);
    for (unsigned d = 0; d < piece->model->n_velocity; d++) {
        unsigned i = axis_component(frame->axis, d);
        viscous_mix_stress(&viscous->strain, &viscous->mix, i, (unsigned)frame->axis, tau);
        viscous_film_faces(&viscous->film, block, i, tau);
        viscous_slopes_speed(&viscous->slopes, block, i, speed);
        viscous_push(block, tau, speed, faces->momentum + d * FACE_ROOM + block->face, faces->energy + block->face);
    }
}

/* Takes the first rows off a block that lie in one material, or those until the next such row; returns it, or -1. */
static int viscous_part(const struct term_piece *piece, struct viscous_block *rest, struct viscous_block *ret)
{
    struct viscous_block row = *rest;
    int alone = viscous_plain_alone(piece->model, piece->frame, &row, piece->faces);
    size_t rows = 1;
    for (; rows < rest->rows && piece->model->n_alpha; rows++) {
        row.face += row.face_row;
        if (viscous_plain_alone(piece->model, piece->frame, &row, piece->faces) != alone) break;
    }
    viscous_slopes_part(rest, piece->model->n_alpha ? rows : rest->rows, ret);
    return alone;
}

static void viscous_faces(const struct term_piece *piece)
{
    struct viscous *viscous = piece->own;
    struct viscous_walk walk = {&viscous->slopes, piece->frame, 0, 0};
    struct viscous_block rest, part, block;
    while (viscous_slopes_next(&walk, &rest))
        while (rest.rows) {
            int alone = viscous_part(piece, &rest, &part);
            if (alone >= 0) viscous_plain_faces(&viscous->slopes, piece->frame, (unsigned)alone, &part, piece->faces);
            else
                while (viscous_slopes_batch(&part, &block)) viscous_batch(piece, &block, viscous);
        }
}

/* Directions beyond the axes go around the axis or the centre. */
static void viscous_component(struct viscous *viscous, unsigned i, unsigned j, double *tau)
{
    struct viscous_strain *strain = &viscous->strain;
    const struct model *path = strain->path;
    double film[STRAIN_POINTS];
    bool hoop = path->beta && i == j && i >= (unsigned)path->dim;
    if (hoop) viscous_mix_hoop(strain, &viscous->mix, tau);
    else viscous_mix_stress(strain, &viscous->mix, i, j, tau);
    if (!strain->interface) return;
    viscous_strain_across(strain);
    if (hoop) viscous_mix_film_hoop(strain, viscous->mix.film, film);
    else viscous_mix_film(strain, viscous->mix.film, i, j, film);
    row_add(strain->n, film, tau);
}

void viscous_stress_field(const struct term_tile *tile, void *own, unsigned i, unsigned j, double *tau)
{
    struct viscous *viscous = own;
    size_t length = (size_t)tile->mesh->n[0], all = tile->n_cell / length;
    viscous_slopes_look(&viscous->slopes, tile);
    for (size_t first = 0; first < all;) {
        const struct viscous_block block = viscous_slopes_cells(&viscous->slopes, first, STRAIN_POINTS / length);
        const struct viscous_sides sides = {tile->w + block.face, tile->n_cell, 0, block.rows, block.n, block.n};
        viscous_slopes_strain(&viscous->slopes, &block, &viscous->strain);
        viscous_mix_make(&viscous->strain, &sides, &viscous->mix);
        viscous_component(viscous, i, j, tau + block.face);
        first += block.rows;
    }
}

void viscous_dissipation_field(const struct term_tile *tile, void *own, double *heat)
{
    struct viscous *viscous = own;
    viscous_slopes_look(&viscous->slopes, tile);
    viscous_heat_field(tile, &viscous->slopes, &viscous->strain, &viscous->mix, heat);
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

/* The same of viscosities that are numbers. */
static BULLA_KERNEL void viscous_spread_number(size_t n, const double *restrict alpha, const double *restrict rho_l,
                                               double number, double *restrict rho, double *restrict spread)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], r = rho[i], s = spread[i];
        rho[i] = r + a * rho_l[i];
        spread[i] = s + a * number;
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

/* What material l adds to n cells from `from` on; alpha: its fraction. */
static void viscous_pace_material(const struct term_pace *pace, unsigned l, size_t from, size_t n, const double *alpha,
                                  double *rho, double *spread)
{
    const struct model *path = pace->model;
    const struct model_viscosity *law = &path->viscosity[l];
    const double *w = pace->w + from, *rho_l = w + (path->i_m + l) * pace->n_cell;
    const struct coefficient_points points = {n, NULL, w + path->i_E * pace->n_cell, rho_l};
    double mu[STRAIN_POINTS], zeta[STRAIN_POINTS];
    if (coefficient_is_number(&law->mu)) {
        viscous_spread_number(n, alpha, rho_l, 4.0 / 3.0 * law->mu.number + law->zeta, rho, spread);
        return;
    }
    coefficient_viscosities_most(law, &path->eos[l], &points, mu, zeta);
    viscous_spread(n, alpha, rho_l, mu, zeta, rho, spread);
}

static void viscous_pace_batch(const struct term_pace *pace, double per, size_t from, size_t n, double *rate)
{
    const struct model *path = pace->model;
    double rho[STRAIN_POINTS], spread[STRAIN_POINTS], one[STRAIN_POINTS];
    for (size_t i = 0; i < n; i++) rho[i] = 0.0, spread[i] = 0.0, one[i] = 1.0;
    for (unsigned l = 0; l < path->n_material; l++) {
        const double *alpha = path->n_alpha ? pace->w + (path->i_alpha + l) * pace->n_cell + from : one;
        viscous_pace_material(pace, l, from, n, alpha, rho, spread);
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
    .equation = "d(rho u)/dt += div tau, d(rho E)/dt += div(tau u); layers across a surface, films along it",
    .wanted = viscous_wanted,
    .diffuses = true,
    .open = viscous_open,
    .close = viscous_close,
    .begin = viscous_begin,
    .faces = viscous_faces,
    .cells = viscous_cells,
    .pace = viscous_pace,
    .say = viscous_say,
};
