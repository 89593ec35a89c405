/* conduction_pace.c - see conduction_pace.h. */
#include "scheme/conduction_pace.h"

#include "phys/traction.h"
#include "scheme/conduction_law.h"
#include "scheme/distance.h"
#include "scheme/heed.h"

/* Heat that a kilogram holds of anything, at least [J/kg/K]: laws that hold less stand where they know nothing, as a
 * gas does that shares a cell with a solid in tension (solve/guard.h). */
#define CONDUCTION_PACE_LEAST 1.0

/* The largest diffusivity k_l/c_l of the materials that count. */
static BULLA_KERNEL void conduction_pace_diffuse(size_t n, const double *restrict k, const double *restrict sets,
                                                 const double *restrict rho, const double *restrict c,
                                                 double *restrict most)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double room = c[i], D = k[i] / room, old = most[i], larger = D > old ? D : old;
        double known = room > CONDUCTION_PACE_LEAST * rho[i] ? larger : old;
        most[i] = sets[i] > 0.0 ? known : old;
    }
}

static BULLA_KERNEL void conduction_pace_hurry(size_t n, double a, const double *restrict D, double *restrict rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) rate[i] += a * D[i];
}

/* The same of n <= CONDUCTION_LAW_BATCH cells with primitives w. */
static void conduction_pace_swiftest(const struct model *path, size_t n, size_t stride, const double *w, double *D)
{
    double one[CONDUCTION_LAW_BATCH], T[CONDUCTION_LAW_BATCH], c[CONDUCTION_LAW_BATCH], k[CONDUCTION_LAW_BATCH],
        room[CONDUCTION_LAW_BATCH], sets[CONDUCTION_LAW_BATCH];
    const double *sum = heed_density(path, n, stride, w, room);
    struct traction_pressures parts;
    traction_part(path, n, stride, w, &parts);
    for (size_t i = 0; i < n; i++) one[i] = 1.0, D[i] = 0.0;
    for (unsigned l = 0; l < path->n_material; l++) {
        const double *rho = w + (path->i_m + l) * stride;
        if (!conduction_law_is(path, l)) continue;
        const double *p = traction_pressure(path, n, l, w + path->i_E * stride, &parts);
        conduction_law_capacity(&path->eos[l], n, rho, p, T, c);
        conduction_law_ask(path, l, n, T, p, rho, k);
        heed_parts(n, path->n_alpha ? w + (path->i_alpha + l) * stride : one, rho, sum, sets);
        conduction_pace_diffuse(n, k, sets, rho, c, D);
    }
}

void conduction_pace_add(const struct term_pace *pace, double *rate)
{
    const struct model *path = pace->model;
    double D[CONDUCTION_LAW_BATCH]; /* dt = cfl / rate */
    double factor = distance_squares(pace->level, path->dim) * (DISTANCE_PACE * path->scene->scheme.cfl);
    for (size_t from = 0; from < pace->n_cell; from += CONDUCTION_LAW_BATCH) {
        size_t n = pace->n_cell - from < CONDUCTION_LAW_BATCH ? pace->n_cell - from : CONDUCTION_LAW_BATCH;
        conduction_pace_swiftest(path, n, pace->n_cell, pace->w + from, D);
        conduction_pace_hurry(n, factor, D, rate + from);
    }
}
