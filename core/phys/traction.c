/* traction.c - see traction.h. */
#include "phys/traction.h"

#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/elastic_tensor.h"
#include "phys/pick.h"
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

struct traction_vector {
    double x, y, z;
};

static ELASTIC_BODY struct traction_vector traction_times(struct elastic_tensor V, struct traction_vector n)
{
    return (struct traction_vector){V.xx * n.x + V.xy * n.y + V.xz * n.z, V.xy * n.x + V.yy * n.y + V.yz * n.z,
                                    V.xz * n.x + V.yz * n.y + V.zz * n.z};
}

static ELASTIC_BODY double traction_dot(struct traction_vector a, struct traction_vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

#define TRACTION_LOCAL(row, normal)                                                                              \
    const double *restrict xx = row[ELASTIC_XX], *restrict xy = row[ELASTIC_XY], *restrict xz = row[ELASTIC_XZ]; \
    const double *restrict yy = row[ELASTIC_YY], *restrict yz = row[ELASTIC_YZ], *restrict zz = row[ELASTIC_ZZ]; \
    const double *restrict nx = normal[0], *restrict ny = normal[1], *restrict nz = normal[2]
#define TRACTION_V(i) ((struct elastic_tensor){xx[i], yy[i], zz[i], xy[i], xz[i], yz[i]})

/* N.s'N with the normals of the cells: B N = V (V N). */
static BULLA_KERNEL void traction_along(size_t n, const double *restrict rho, const double *const *row,
                                        const double *const *normal, const double *restrict I1,
                                        const double *restrict I2, const double *restrict e_1,
                                        const double *restrict e_2, double *restrict own)
{
    TRACTION_LOCAL(row, normal);
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct elastic_tensor V = TRACTION_V(i);
        struct traction_vector N = {nx[i], ny[i], nz[i]}, half = traction_times(V, N), BN = traction_times(V, half);
        double square = traction_dot(N, N), B = traction_dot(half, half), C = traction_dot(BN, BN);
        double first = I1[i], slope = e_2[i], trace = first * first - 2.0 * I2[i], G1 = e_1[i] + first * slope;
        own[i] = 2.0 * rho[i] * (G1 * (B - square * (first / 3.0)) - slope * (C - square * (trace / 3.0)));
    }
}

/* s'N, the whole vector. */
static BULLA_KERNEL void traction_pull(size_t n, const double *restrict rho, const double *const *row,
                                       const double *const *normal, const double *restrict I1,
                                       const double *restrict I2, const double *restrict e_1,
                                       const double *restrict e_2, double *const *pull)
{
    TRACTION_LOCAL(row, normal);
    double *restrict px = pull[0], *restrict py = pull[1], *restrict pz = pull[2];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct elastic_tensor V = TRACTION_V(i);
        struct traction_vector N = {nx[i], ny[i], nz[i]}, BN = traction_times(V, traction_times(V, N));
        struct traction_vector BBN = traction_times(V, traction_times(V, BN));
        double first = I1[i], slope = e_2[i], G1 = e_1[i] + first * slope, twice = 2.0 * rho[i];
        double mean = G1 * (first / 3.0) - slope * ((first * first - 2.0 * I2[i]) / 3.0);
        px[i] = twice * (G1 * BN.x - slope * BBN.x - mean * N.x);
        py[i] = twice * (G1 * BN.y - slope * BBN.y - mean * N.y);
        pz[i] = twice * (G1 * BN.z - slope * BBN.z - mean * N.z);
    }
}

/* The cells of a batch that have a stress on a normal. Of models with normals the few that have one, packed; of the
 * others all of them, in place. */
struct traction_cells {
    size_t n;
    const unsigned *at; /* their numbers; NULL: in place */
};

/* A row at those cells; `room` is where packed ones go. */
static const double *traction_row(const struct traction_cells *cells, const double *row, double *room)
{
    if (!cells->at) return row;
    pick_take(cells->n, cells->at, row, room);
    return room;
}

enum { TRACTION_PITCH = TRACTION_BATCH + 8 }; /* of packed rows, which shall not lie in the same lines of caches */

/* A stretch at those cells, and what it is looked at with. */
struct traction_view {
    const double *row[6], *normal[3]; /* [normal]: of models that have them */
    double I1[TRACTION_BATCH], I2[TRACTION_BATCH], e_1[TRACTION_BATCH], e_2[TRACTION_BATCH];
    double packed_V[6 * TRACTION_PITCH], packed_normal[3 * TRACTION_PITCH];
};

static void traction_aim(const struct model *model, const struct traction_cells *cells, size_t stride, const double *w,
                         struct traction_view *ret)
{
    for (unsigned d = 0; d < 3; d++) {
        const double *row = w + (model->i_normal + d) * stride;
        ret->normal[d] = traction_zero;
        if (d < model->n_normal) ret->normal[d] = traction_row(cells, row, ret->packed_normal + d * TRACTION_PITCH);
    }
}

static void traction_look(const struct model *model, const struct traction_cells *cells, unsigned k, size_t stride,
                          const double *w, struct traction_view *ret)
{
    const double *V = w + model_stretch(model, k) * stride;
    for (unsigned c = 0; c < 6; c++) ret->row[c] = traction_zero;
    for (unsigned c = 0; c < model->n_stretch; c++)
        ret->row[c] = traction_row(cells, V + c * stride, ret->packed_V + c * TRACTION_PITCH);
    size_t pitch = cells->at ? TRACTION_PITCH : stride;
    if (!elastic_is_plain(model, k)) {
        elastic_invariants(model, cells->n, pitch, ret->row[0], ret->I1, ret->I2);
        return;
    }
    elastic_invariants_first(model, cells->n, pitch, ret->row[0], ret->I1);
    memcpy(ret->I2, ret->I1, cells->n * sizeof *ret->I2); /* nobody looks at it */
}

/* Where s'_nn goes, and of models with normals s'N if it is asked for (else NULL). */
struct traction_out {
    double *own, *pull[3];
};

/* Both of the slopes e_1, e_2 of a view. */
static void traction_of(const struct model *model, size_t n, const double *rho, const struct traction_view *view,
                        const struct traction_out *out)
{
    const double *const *row = view->row, *I1 = view->I1, *I2 = view->I2, *e_1 = view->e_1, *e_2 = view->e_2;
    if (out->pull[0]) traction_pull(n, rho, row, view->normal, I1, I2, e_1, e_2, out->pull);
    if (model->n_normal) traction_along(n, rho, row, view->normal, I1, I2, e_1, e_2, out->own);
    else
        traction_normal(n, rho, row[ELASTIC_XX], row[ELASTIC_XY], row[ELASTIC_XZ], row[ELASTIC_YY], row[ELASTIC_YZ],
                        row[ELASTIC_ZZ], I1, I2, e_1, e_2, out->own);
}

/* What the Maxwell branches of solid s add: each a neo-Hookean spring on its own stretch. rho: of the solid. */
static void traction_branches(const struct model *model, const struct traction_cells *cells, unsigned s, size_t stride,
                              const double *w, const double *rho, struct traction_view *view,
                              const struct traction_out *out)
{
    double room[4 * TRACTION_BATCH];
    struct traction_out part = {.own = room};
    for (unsigned d = 0; out->pull[0] && d < 3; d++) part.pull[d] = room + (d + 1) * TRACTION_BATCH;
    for (unsigned b = 0; b < model->n_branch; b++) {
        const struct model_branch *branch = &model->branches[b];
        if (branch->solid != s) continue;
        traction_look(model, cells, model->n_solid + b, stride, w, view);
        for (size_t i = 0; i < cells->n; i++) view->e_1[i] = branch->k, view->e_2[i] = 0.0;
        traction_of(model, cells->n, rho, view, &part);
        row_add(cells->n, part.own, out->own);
        for (unsigned d = 0; out->pull[0] && d < 3; d++) row_add(cells->n, part.pull[d], out->pull[d]);
    }
}

/* Density of solid s at those cells, as far as it bears. `room`: three rows. */
static const double *traction_density(const struct model *model, const struct traction_cells *cells, unsigned s,
                                      size_t stride, const double *w, double *room)
{
    const struct model_solid *solid = &model->solids[s];
    const double *rho = traction_row(cells, w + (model->i_m + solid->material) * stride, room);
    if (!solid->damage.law) return rho;
    const double *D = traction_row(cells, w + solid->damage.field * stride, room + TRACTION_BATCH);
    bearing_reduce(cells->n, D, rho, room + 2 * TRACTION_BATCH);
    return room + 2 * TRACTION_BATCH;
}

/* The same of all of solid s at those cells. */
static void traction_solid(const struct model *model, const struct traction_cells *cells, unsigned s, size_t stride,
                           const double *w, struct traction_view *view, const struct traction_out *out)
{
    const struct model_solid *solid = &model->solids[s];
    double e[TRACTION_BATCH], room[3 * TRACTION_BATCH];
    const double *rho = traction_density(model, cells, s, stride, w, room);
    traction_look(model, cells, s, stride, w, view);
    solid->law->energy(solid->self, cells->n, view->I1, view->I2, e, view->e_1, view->e_2);
    traction_of(model, cells->n, rho, view, out);
    traction_branches(model, cells, s, stride, w, rho, view, out);
}

void traction_at(const struct model *model, size_t n, const unsigned *at, size_t stride, const double *w, size_t pitch,
                 double *own, double *pull)
{
    struct traction_view view;
    for (size_t from = 0; from < n; from += TRACTION_BATCH) {
        const struct traction_cells cells = {n - from < TRACTION_BATCH ? n - from : TRACTION_BATCH, at + from};
        traction_aim(model, &cells, stride, w, &view);
        for (unsigned s = 0; s < model->n_solid; s++) {
            struct traction_out out = {.own = own + s * pitch + from};
            for (unsigned d = 0; pull && d < 3; d++) out.pull[d] = pull + (3 * s + d) * pitch + from;
            traction_solid(model, &cells, s, stride, w, &view, &out);
        }
    }
}

/* Cells of a batch that have a normal, and what solids have there: row s of the packed `own`. Returns how many. */
static size_t traction_packed(const struct model *model, size_t n, size_t stride, const double *w, unsigned *at,
                              double *own)
{
    n = pick_nonzero(n, model->n_normal, stride, w + model->i_normal * stride, at);
    traction_at(model, n, at, stride, w, TRACTION_BATCH, own, NULL);
    return n;
}

static void traction_batch(const struct model *model, size_t n, size_t stride, const double *w, size_t pitch,
                           double *own)
{
    struct traction_view view;
    unsigned at[TRACTION_BATCH];
    double packed[SCENE_MATERIALS * TRACTION_BATCH];
    const struct traction_cells all = {n, NULL};
    for (unsigned l = 0; l < model->n_material; l++) memset(own + l * pitch, 0, n * sizeof *own);
    size_t count = model->n_normal ? traction_packed(model, n, stride, w, at, packed) : 0;
    for (unsigned s = 0; s < model->n_solid; s++) {
        const struct traction_out ret = {.own = own + model->solids[s].material * pitch};
        if (model->n_normal) pick_put(count, at, packed + s * TRACTION_BATCH, ret.own);
        else traction_solid(model, &all, s, stride, w, &view, &ret);
    }
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
    for (unsigned s = 0; model->n_alpha && s < model->n_solid; s++) {
        unsigned l = model->solids[s].material;
        row_add_product(n, w + (model->i_alpha + l) * stride, own + l * pitch, mean);
    }
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

/* The lags of solids and of what lies beside them, where cells have a normal: the others have none. */
static void traction_tilted(const struct model *model, size_t n, size_t stride, const double *w,
                            struct traction_pressures *ret)
{
    unsigned at[TRACTION_BATCH];
    double own[SCENE_MATERIALS * TRACTION_BATCH], mean[TRACTION_BATCH];
    size_t count = traction_packed(model, n, stride, w, at, own);
    memset(mean, 0, count * sizeof *mean);
    for (unsigned s = 0; s < model->n_solid; s++) {
        const double *alpha = w + (model->i_alpha + model->solids[s].material) * stride;
        for (size_t k = 0; k < count; k++) mean[k] += alpha[at[k]] * own[s * TRACTION_BATCH + k];
    }
    for (unsigned l = 0; l < model->n_material; l++) {
        memset(ret->lag[l], 0, n * sizeof *ret->lag[l]);
        for (size_t k = 0; k < count; k++) ret->lag[l][at[k]] = 0.0 - mean[k];
    }
    for (unsigned s = 0; s < model->n_solid; s++) {
        double *lag = ret->lag[model->solids[s].material];
        for (size_t k = 0; k < count; k++) lag[at[k]] = own[s * TRACTION_BATCH + k] - mean[k];
    }
}

/* The same along the axis. */
static void traction_straight(const struct model *model, size_t n, size_t stride, const double *w,
                              struct traction_pressures *ret)
{
    double mean[TRACTION_BATCH];
    traction_both(model, n, stride, w, TRACTION_BATCH, ret->lag[0], mean);
    for (unsigned l = 0; l < model->n_material; l++) row_take(n, mean, ret->lag[l]);
}

void traction_part(const struct model *model, size_t n, size_t stride, const double *w, struct traction_pressures *ret)
{
    if (!model->lagged) return;
    if (model->n_normal) traction_tilted(model, n, stride, w, ret);
    else if (model->split) traction_straight(model, n, stride, w, ret);
    else
        for (unsigned l = 0; l < model->n_material; l++) memset(ret->lag[l], 0, n * sizeof *ret->lag[l]);
    traction_curves(model, n, stride, w, ret);
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
