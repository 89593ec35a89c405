/* viscous_face.c - see viscous_face.h. */
#include "scheme/viscous_face.h"

#include "phys/coefficient.h"
#include "phys/row.h"
#include "scheme/viscous_mix.h"

#include <math.h>
#include <string.h>

bool viscous_face_wanted(const struct model *path)
{
    bool thick = false;
    for (unsigned l = 0; l < path->n_alpha; l++) thick = thick || path->viscosity[l].thick;
    return thick && !path->elastic;
}

/* 1/(4/3 mu + zeta) */
static inline double viscous_face_fluid(double mu, double zeta)
{
    return viscous_mix_fluid(4.0 / 3.0 * mu + zeta);
}

static BULLA_KERNEL void viscous_face_number(size_t n, const double *restrict alpha, double fluid,
                                             double *restrict thin)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double f = thin[i];
        thin[i] = f + alpha[i] * fluid;
    }
}

static BULLA_KERNEL void viscous_face_rows(size_t n, const double *restrict alpha, const double *restrict mu,
                                           const double *restrict zeta, double *restrict thin)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double f = thin[i];
        thin[i] = f + alpha[i] * viscous_face_fluid(mu[i], zeta[i]);
    }
}

/* Material l, whose law is asked in batches where it is no number. */
static void viscous_face_material(const struct model *path, unsigned l, const struct viscous_face *faces,
                                  const double *p, double *thin)
{
    const double *alpha = faces->alpha + l * faces->pitch;
    const struct model_viscosity *viscosity = &path->viscosity[l];
    if (!viscosity->thick || coefficient_is_number(&viscosity->mu)) {
        double fluid = viscosity->thick ? viscous_face_fluid(viscosity->mu.number, viscosity->zeta) : VISCOUS_MIX_FLUID;
        viscous_face_number(faces->edges, alpha, fluid, thin);
        return;
    }
    for (size_t from = 0; from < faces->edges; from += COEFFICIENT_BATCH) {
        size_t left = faces->edges - from, n = left < COEFFICIENT_BATCH ? left : COEFFICIENT_BATCH;
        double mu[COEFFICIENT_BATCH], zeta[COEFFICIENT_BATCH];
        struct coefficient_points points = {.n = n, .p = p + from, .rho = faces->rho_l + l * faces->pitch + from};
        coefficient_viscosities(viscosity, &path->eos[l], &points, mu, zeta);
        viscous_face_rows(n, alpha + from, mu, zeta, thin + from);
    }
}

/* From sum alpha_l/(4/3 mu_l + zeta_l) to N. */
static BULLA_KERNEL void viscous_face_impedance(size_t n, double per, double *restrict N)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) N[i] = per / N[i];
}

/* 1/(Z + N) of both sides, less where N is little; 0 where it is less. */
static BULLA_KERNEL void viscous_face_part(const struct viscous_face *faces, double *restrict part)
{
    const size_t n = faces->n, right = faces->right;
    const double *restrict rho_l = faces->rho, *restrict rho_c2_l = faces->rho_c2, *restrict N_l = faces->N;
    const double *restrict rho_r = rho_l + right, *restrict rho_c2_r = rho_c2_l + right, *restrict N_r = N_l + right;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double Z = sqrt(rho_l[i] * rho_c2_l[i]) + sqrt(rho_r[i] * rho_c2_r[i]), N = N_l[i] + N_r[i];
        double over = N / (VISCOUS_FACE_THIN * Z) - 1.0, share = over < 1.0 ? over : 1.0;
        part[i] = (share > 0.0 ? share : 0.0) / (Z + N);
    }
}

static BULLA_KERNEL void viscous_face_jump(size_t n, const double *restrict part, const double *restrict N_l,
                                           const double *restrict N_r, double *restrict p_l, double *restrict p_r)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = p_l[i], b = p_r[i], jump = (b - a) * part[i];
        p_l[i] = a + N_l[i] * jump;
        p_r[i] = b - N_r[i] * jump;
    }
}

/* 1 where a cell holds more than one material. */
static BULLA_KERNEL void viscous_face_mixed(size_t n, const double *restrict alpha, bool first, double *restrict mixed)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double before = first ? 1.0 : mixed[i];
        mixed[i] = alpha[i] == 1.0 ? 0.0 : before;
    }
}

/* Are there mixtures in the row and in what lies beside it? */
static bool viscous_face_surfaces(const struct model *path, const struct viscous_face *faces)
{
    const size_t n = faces->n + 3 * faces->step;
    for (unsigned l = 0; l < path->n_alpha; l++)
        viscous_face_mixed(n, faces->cells + l * faces->room - faces->step, l == 0, faces->mixed);
    return row_most(n, faces->mixed) > 0.0;
}

/* Leaves only parts of faces within two cells of a mixture. */
static BULLA_KERNEL void viscous_face_near(size_t n, size_t step, const double *restrict mixed, double *restrict part)
{
    const double *here = mixed + step, *next = here + step, *after = next + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double near = (mixed[i] + here[i]) + (next[i] + after[i]), own = part[i];
        part[i] = near > 0.0 ? own : 0.0;
    }
}

bool viscous_face_draw(const struct model *path, const struct viscous_face *faces, double *p)
{
    const double *mask = faces->mask;
    const size_t n = faces->n, right = faces->right;
    if (!viscous_face_surfaces(path, faces)) return false;
    memset(faces->N, 0, faces->edges * sizeof *faces->N);
    for (unsigned l = 0; l < path->n_material; l++) viscous_face_material(path, l, faces, p, faces->N);
    viscous_face_impedance(faces->edges, VISCOUS_FACE_HOLD * 2.0 * faces->per_h, faces->N);
    viscous_face_part(faces, faces->part);
    viscous_face_near(n, faces->step, faces->mixed, faces->part);
    for (size_t i = 0; mask && i < n; i++)
        if (mask[i] + mask[i + faces->step] != 0.0) faces->part[i] = 0.0;
    if (row_most(n, faces->part) == 0.0) return false;
    viscous_face_jump(n, faces->part, faces->N, faces->N + right, p, p + right);
    return true;
}
