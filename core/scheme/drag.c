/* drag.c - see drag.h. */
#include "scheme/drag.h"

#include "phys/row.h"
#include "scheme/swell.h"

#include <string.h>

/* k_l of a material of a path. */
static double drag_of(const struct model *path, unsigned l)
{
    return path->scene->material[path->first + l].drag;
}

static bool drag_wanted(const struct model *path)
{
    bool any = false;
    for (unsigned l = 0; l < path->n_material; l++) any = any || drag_of(path, l) > 0.0;
    return any;
}

/* k += a alpha, or a where the material is alone; rho += alpha rho_l likewise. */
static BULLA_KERNEL void drag_mean(size_t n, double a, const double *restrict alpha, const double *restrict rho_l,
                                   double *restrict k, double *restrict rho)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double part = alpha[i], r = rho[i], sum = k[i];
        k[i] = sum + a * part;
        rho[i] = r + part * rho_l[i];
    }
}

/* k and rho of n cells of the primitives w. */
static void drag_means(const struct model *path, size_t n, size_t stride, const double *w, double *k, double *rho)
{
    double one[SWELL_BATCH];
    for (size_t i = 0; i < n; i++) one[i] = 1.0;
    memset(k, 0, n * sizeof *k);
    memset(rho, 0, n * sizeof *rho);
    for (unsigned l = 0; l < path->n_material; l++)
        drag_mean(n, drag_of(path, l), path->n_alpha ? w + (path->i_alpha + l) * stride : one,
                  w + (path->i_m + l) * stride, k, rho);
}

static BULLA_KERNEL void drag_slow(size_t n, const double *restrict k, const double *restrict u,
                                   double *restrict momentum, double *restrict speed2)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double v = u[i], m = momentum[i], s = speed2[i];
        momentum[i] = m - k[i] * v;
        speed2[i] = s + v * v;
    }
}

static BULLA_KERNEL void drag_heat(size_t n, double k, const double *restrict speed2, double *restrict heat)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) heat[i] = k * speed2[i];
}

/* The heat of each material moves volume. */
static void drag_swell(const struct term_tile *tile, size_t from, size_t n, const double *speed2)
{
    const struct model *path = tile->model;
    const double *w = tile->w + from, *p = w + path->i_E * tile->n_cell;
    double heat[SWELL_BATCH], rho_e[SWELL_BATCH], rho_c2[SWELL_BATCH];
    struct swell swell; /* large: filled as far as it is used */
    swell_begin(&swell, path, n);
    for (unsigned l = 0; l < path->n_material; l++) {
        const struct model_eos *eos = &path->eos[l];
        const double *rho = w + (path->i_m + l) * tile->n_cell;
        eos->law->state(eos->self, n, rho, p, rho_e, rho_c2);
        drag_heat(n, drag_of(path, l), speed2, heat);
        swell_material(&swell, l, w + (path->i_alpha + l) * tile->n_cell, rho, p, rho_c2, heat, NULL);
    }
    swell_share(&swell, tile, from);
}

static void drag_cells(struct term_tile *tile)
{
    const struct model *path = tile->model;
    for (size_t from = 0; from < tile->n_cell; from += SWELL_BATCH) {
        size_t n = tile->n_cell - from < SWELL_BATCH ? tile->n_cell - from : SWELL_BATCH;
        double k[SWELL_BATCH], rho[SWELL_BATCH], speed2[SWELL_BATCH] = {0};
        drag_means(path, n, tile->n_cell, tile->w + from, k, rho);
        for (unsigned d = 0; d < path->n_velocity; d++) {
            size_t row = (path->i_u + d) * tile->n_cell + from;
            drag_slow(n, k, tile->w + row, tile->rates + row, speed2);
        }
        if (path->kapila) drag_swell(tile, from, n, speed2);
    }
}

/* Velocities fall by k/rho per second. */
static void drag_pace(const struct term_pace *pace, double *rate)
{
    for (size_t from = 0; from < pace->n_cell; from += SWELL_BATCH) {
        size_t n = pace->n_cell - from < SWELL_BATCH ? pace->n_cell - from : SWELL_BATCH;
        double k[SWELL_BATCH], rho[SWELL_BATCH];
        drag_means(pace->model, n, pace->n_cell, pace->w + from, k, rho);
        row_divide(n, rho, k);
        row_add(n, k, rate + from);
    }
}

static void drag_say(const struct scene *scene, struct text *text)
{
    const char *comma = ": ";
    for (unsigned l = 0; l < scene->n_material; l++) {
        if (!(scene->material[l].drag > 0.0)) continue;
        text_add(text, "%s%s %g kg/m3/s", comma, scene->material[l].name, scene->material[l].drag);
        comma = ", ";
    }
}

const struct term drag_term = {
    .name = "drag",
    .owner = "core/scheme/drag.c",
    .equation = "d(rho u)/dt -= sum alpha_l k_l u; its work is heat",
    .wanted = drag_wanted,
    .cells = drag_cells,
    .pace = drag_pace,
    .say = drag_say,
};
