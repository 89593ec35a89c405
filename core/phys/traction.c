/* traction.c - see traction.h. */
#include "phys/traction.h"

#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/row.h"

#include <string.h>

/* s'_xx = 2 rho [(e_1 + I1 e_2) dev B - e_2 dev B^2]_xx with a diagonal or plane V; tr B^2 = I1^2 - 2 I2. */
static BULLA_KERNEL void traction_normal(size_t n, const double *restrict rho, const double *restrict xx,
                                         const double *restrict xy, const double *restrict xz,
                                         const double *restrict yy, const double *restrict yz,
                                         const double *restrict zz, const double *restrict I1,
                                         const double *restrict I2, const double *restrict e_1,
                                         const double *restrict e_2, double *restrict own)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = xx[i], b = xy[i], c = xz[i], d = yy[i], e = yz[i], f = zz[i], first = I1[i], slope = e_2[i];
        double B = a * a + b * b + c * c, Bxy = a * b + b * d + c * e, Bxz = a * c + b * e + c * f;
        double C = B * B + Bxy * Bxy + Bxz * Bxz, trace = first * first - 2.0 * I2[i];
        double G1 = e_1[i] + first * slope;
        own[i] = 2.0 * rho[i] * (G1 * (B - first / 3.0) - slope * (C - trace / 3.0));
    }
}

static const double traction_zero[TRACTION_BATCH];

/* N.s'N with the normals of the cells: B N = V (V N). */
static BULLA_KERNEL void traction_along(size_t n, const double *restrict rho, const double *const *row,
                                        const double *const *normal, const double *restrict I1,
                                        const double *restrict I2, const double *restrict e_1,
                                        const double *restrict e_2, double *restrict own)
{
    const double *restrict xx = row[ELASTIC_XX], *restrict xy = row[ELASTIC_XY], *restrict xz = row[ELASTIC_XZ];
    const double *restrict yy = row[ELASTIC_YY], *restrict yz = row[ELASTIC_YZ], *restrict zz = row[ELASTIC_ZZ];
    const double *restrict nx = normal[0], *restrict ny = normal[1], *restrict nz = normal[2];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = nx[i], y = ny[i], z = nz[i], square = x * x + y * y + z * z;
        double a = xx[i], b = xy[i], c = xz[i], d = yy[i], e = yz[i], f = zz[i], first = I1[i], slope = e_2[i];
        double u = a * x + b * y + c * z, v = b * x + d * y + e * z, w = c * x + e * y + f * z;
        double Bx = a * u + b * v + c * w, By = b * u + d * v + e * w, Bz = c * u + e * v + f * w;
        double B = u * u + v * v + w * w, C = Bx * Bx + By * By + Bz * Bz, trace = first * first - 2.0 * I2[i];
        double G1 = e_1[i] + first * slope;
        own[i] = 2.0 * rho[i] * (G1 * (B - square * (first / 3.0)) - slope * (C - square * (trace / 3.0)));
    }
}

/* A stretch in a batch, and what it is looked at with. */
struct traction_view {
    const double *row[6], *normal[3]; /* [normal]: of models that have them */
    double I1[TRACTION_BATCH], I2[TRACTION_BATCH], e_1[TRACTION_BATCH], e_2[TRACTION_BATCH];
};

static void traction_look(const struct model *model, unsigned k, size_t n, size_t stride, const double *w,
                          struct traction_view *ret)
{
    const double *V = w + model_stretch(model, k) * stride;
    for (unsigned c = 0; c < 6; c++) ret->row[c] = c < model->n_stretch ? V + c * stride : traction_zero;
    for (unsigned d = 0; d < 3; d++)
        ret->normal[d] = d < model->n_normal ? w + (model->i_normal + d) * stride : traction_zero;
    if (!elastic_is_plain(model, k)) {
        elastic_invariants(model, n, stride, V, ret->I1, ret->I2);
        return;
    }
    elastic_invariants_first(model, n, stride, V, ret->I1);
    memcpy(ret->I2, ret->I1, n * sizeof *ret->I2); /* nobody looks at it */
}

/* s'_nn of the slopes e_1, e_2 of a view. */
static void traction_of(const struct model *model, size_t n, const double *rho, const struct traction_view *view,
                        double *own)
{
    const double *const *row = view->row;
    if (model->n_normal) traction_along(n, rho, row, view->normal, view->I1, view->I2, view->e_1, view->e_2, own);
    else
        traction_normal(n, rho, row[ELASTIC_XX], row[ELASTIC_XY], row[ELASTIC_XZ], row[ELASTIC_YY], row[ELASTIC_YZ],
                        row[ELASTIC_ZZ], view->I1, view->I2, view->e_1, view->e_2, own);
}

/* What the Maxwell branches of the solids add: each a neo-Hookean spring on its own stretch. rho: of the solids. */
static void traction_branches(const struct model *model, size_t n, size_t stride, const double *w,
                              const double *const *rho, size_t pitch, double *own)
{
    struct traction_view view;
    double part[TRACTION_BATCH];
    for (unsigned b = 0; b < model->n_branch; b++) {
        const struct model_branch *branch = &model->branches[b];
        unsigned l = model->solids[branch->solid].material;
        traction_look(model, model->n_solid + b, n, stride, w, &view);
        for (size_t i = 0; i < n; i++) view.e_1[i] = branch->k, view.e_2[i] = 0.0;
        traction_of(model, n, rho[branch->solid], &view, part);
        row_add(n, part, own + l * pitch);
    }
}

static void traction_batch(const struct model *model, size_t n, size_t stride, const double *w, size_t pitch,
                           double *own)
{
    struct traction_view view;
    double e[TRACTION_BATCH], left[SCENE_MATERIALS * TRACTION_BATCH];
    const double *rho[SCENE_MATERIALS];
    for (unsigned s = 0; s < model->n_solid; s++) rho[s] = w + (model->i_m + model->solids[s].material) * stride;
    bearing_of(model, n, stride, w, TRACTION_BATCH, left, rho);
    for (unsigned l = 0; l < model->n_material; l++) memset(own + l * pitch, 0, n * sizeof *own);
    for (unsigned s = 0; s < model->n_solid; s++) {
        const struct model_solid *solid = &model->solids[s];
        traction_look(model, s, n, stride, w, &view);
        solid->law->energy(solid->self, n, view.I1, view.I2, e, view.e_1, view.e_2);
        traction_of(model, n, rho[s], &view, own + solid->material * pitch);
    }
    traction_branches(model, n, stride, w, rho, pitch, own);
}

void traction_own(const struct model *model, size_t n, size_t stride, const double *w, size_t pitch, double *own)
{
    for (size_t i = 0; i < n; i += TRACTION_BATCH)
        traction_batch(model, n - i < TRACTION_BATCH ? n - i : TRACTION_BATCH, stride, w + i, pitch, own + i);
}

/* Both for a batch. */
static void traction_both(const struct model *model, size_t n, size_t stride, const double *w, size_t pitch,
                          double *own, double *mean)
{
    traction_batch(model, n, stride, w, pitch, own);
    if (!model->n_alpha) memcpy(mean, own, n * sizeof *mean);
    else memset(mean, 0, n * sizeof *mean);
    for (unsigned l = 0; l < model->n_alpha; l++)
        row_add_product(n, w + (model->i_alpha + l) * stride, own + l * pitch, mean);
}

void traction_mean(const struct model *model, size_t n, size_t stride, const double *w, double *mean)
{
    double own[SCENE_MATERIALS * TRACTION_BATCH];
    for (size_t i = 0; i < n; i += TRACTION_BATCH)
        traction_both(model, n - i < TRACTION_BATCH ? n - i : TRACTION_BATCH, stride, w + i, TRACTION_BATCH, own,
                      mean + i);
}

/* What surface tension adds to the lags of the material inside and of that outside. */
static BULLA_KERNEL void traction_curve(size_t n, double sigma, const double *restrict kappa,
                                        const double *restrict inside, const double *restrict outside,
                                        double *restrict lag_inside, double *restrict lag_outside)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double jump = sigma * kappa[i], a = inside[i], b = outside[i], up = lag_inside[i], down = lag_outside[i];
        lag_inside[i] = up + b * jump;
        lag_outside[i] = down - a * jump;
    }
}

static void traction_curves(const struct model *model, size_t n, size_t stride, const double *w,
                            struct traction_pressures *ret)
{
    for (unsigned k = 0; k < model->n_pair; k++) {
        const struct model_pair *pair = &model->pairs[k];
        traction_curve(n, pair->sigma, w + pair->i_kappa * stride, w + (model->i_alpha + pair->inside) * stride,
                       w + (model->i_alpha + pair->outside) * stride, ret->lag[pair->inside], ret->lag[pair->outside]);
    }
}

/* What viscosity adds to them: the material's own pull, less the mean over the cell. */
static void traction_pulls(const struct model *model, size_t n, size_t stride, const double *w,
                           struct traction_pressures *ret)
{
    double mean[TRACTION_BATCH];
    if (!model->n_pull) return;
    memset(mean, 0, n * sizeof *mean);
    for (unsigned k = 0; k < model->n_pull; k++) {
        const double *pull = w + model->pulls[k].field * stride;
        row_add_product(n, w + (model->i_alpha + model->pulls[k].material) * stride, pull, mean);
        row_add(n, pull, ret->lag[model->pulls[k].material]);
    }
    for (unsigned l = 0; l < model->n_material; l++) row_take(n, mean, ret->lag[l]);
}

void traction_part(const struct model *model, size_t n, size_t stride, const double *w, struct traction_pressures *ret)
{
    double mean[TRACTION_BATCH];
    if (!model->lagged) return;
    if (model->split) traction_both(model, n, stride, w, TRACTION_BATCH, ret->lag[0], mean);
    for (unsigned l = 0; l < model->n_material; l++) {
        if (model->split) row_take(n, mean, ret->lag[l]);
        else memset(ret->lag[l], 0, n * sizeof *ret->lag[l]);
    }
    traction_curves(model, n, stride, w, ret);
    traction_pulls(model, n, stride, w, ret);
}

static BULLA_KERNEL void traction_give(size_t n, const double *restrict p, const double *restrict lag,
                                       double *restrict own)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) own[i] = p[i] + lag[i];
}

const double *traction_pressure(const struct model *model, size_t n, unsigned l, const double *p,
                                struct traction_pressures *parts)
{
    if (!model->lagged) return p;
    traction_give(n, p, parts->lag[l], parts->own);
    return parts->own;
}
