/* edges_front.c - see edges_front.h. */
#include "scheme/edges_front.h"

#include "bulla/module.h"
#include "phys/phase_pair.h"
#include "phys/row.h"

#include <string.h>

static BULLA_KERNEL void edges_front_meet(size_t n, double front, const double *restrict thin_l,
                                          const double *restrict thin_r, const double *restrict liquid_l,
                                          const double *restrict liquid_r, const double *restrict rho_l,
                                          const double *restrict rho_r, double *restrict upper, double *restrict lower)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = thin_l[i], b = thin_r[i], l = rho_l[i], r = rho_r[i], up = upper[i], low = lower[i];
        double before = a < b ? a : b, behind = a < b ? b : a, wet = liquid_l[i] * liquid_r[i];
        double part = 1.0 - 0.5 * (behind - before) / (front - before), line = part > 0.0 ? part : 0.0;
        int meets = (before < front) & (behind >= front) & (wet > 0.0);
        double left = l + (r - l) * line, right = r + (l - r) * line;
        upper[i] = (meets & (b < a)) ? left : up;
        lower[i] = (meets & (a < b)) ? right : low;
    }
}

static void edges_front_pair(const struct edges_front *row, const struct model_phase *phase)
{
    const struct model *model = row->model;
    const double *alpha = row->w + model->i_alpha * row->pitch, *liquid = alpha + phase->member[0] * row->pitch;
    size_t q = model->i_m + phase->member[0], n = row->n - row->step;
    double front = phase_pair_front(phase->scene), *upper = row->state + 2 * q * row->pitch, *thin = row->thin;
    const double *rho = row->w + q * row->pitch;
    memset(thin, 0, row->n * sizeof *thin);
    for (unsigned j = 1; j < phase->n; j++) row_add(row->n, alpha + phase->member[j] * row->pitch, thin);
    if (row_most(row->n, thin) < front) return;
    edges_front_meet(n, front, thin, thin + row->step, liquid, liquid + row->step, rho, rho + row->step, upper,
                     upper + row->n + row->step);
}

void edges_front(const struct edges_front *row)
{
    for (unsigned k = 0; k < row->model->n_phase; k++)
        if (row->model->phases[k].scene->onset > 0.0) edges_front_pair(row, &row->model->phases[k]);
}
