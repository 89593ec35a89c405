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

/* In a plane, nv = 2, z is not there. */
static ELASTIC_BODY struct traction_vector traction_times(int nv, struct elastic_tensor V, struct traction_vector n)
{
    if (nv < 3) return (struct traction_vector){V.xx * n.x + V.xy * n.y, V.xy * n.x + V.yy * n.y, 0.0};
    return (struct traction_vector){V.xx * n.x + V.xy * n.y + V.xz * n.z, V.xy * n.x + V.yy * n.y + V.yz * n.z,
                                    V.xz * n.x + V.yz * n.y + V.zz * n.z};
}

static ELASTIC_BODY double traction_square(int nv, struct traction_vector a)
{
    double plane = a.x * a.x + a.y * a.y;
    return nv < 3 ? plane : plane + a.z * a.z;
}

/* Invariants of B and slopes of the energy of a point. */
struct traction_slopes {
    double twice, G1, slope, first, trace; /* 2 rho, e_1 + I1 e_2, e_2, tr B, tr B^2 */
};

/* N.s'N: B N = V (V N). */
static ELASTIC_BODY double traction_on(int nv, struct traction_slopes g, struct traction_vector N,
                                       struct traction_vector half, struct traction_vector BN)
{
    double square = traction_square(nv, N), B = traction_square(nv, half), C = traction_square(nv, BN);
    return g.twice * (g.G1 * (B - square * (g.first / 3.0)) - g.slope * (C - square * (g.trace / 3.0)));
}

/* Rows of the cells that a kernel looks at; of a plane the parts along z point at any row. */
struct traction_rows {
    struct elastic_rows V;
    const double *normal[3], *rho, *I1, *I2, *e_1, *e_2;
};

#define TRACTION_LOCAL(rows)                                                                                           \
    ELASTIC_LOCAL((rows)->V);                                                                                          \
    const double *restrict nx = (rows)->normal[0], *restrict ny = (rows)->normal[1], *restrict nz = (rows)->normal[2]; \
    const double *restrict rho = (rows)->rho, *restrict I1 = (rows)->I1, *restrict I2 = (rows)->I2;                    \
    const double *restrict e_1 = (rows)->e_1, *restrict e_2 = (rows)->e_2
#define TRACTION_N(i, nv) ((struct traction_vector){nx[i], ny[i], (nv) > 2 ? nz[(nv) > 2 ? (i) : 0] : 0.0})
#define TRACTION_SLOPES(i) \
    ((struct traction_slopes){2.0 * rho[i], e_1[i] + I1[i] * e_2[i], e_2[i], I1[i], I1[i] * I1[i] - 2.0 * I2[i]})

/* N.s'N with the normals of the cells. */
#define TRACTION_ALONG(nv)                                                                                         \
    static BULLA_KERNEL void traction_along_##nv(size_t n, const struct traction_rows *rows, double *restrict own) \
    {                                                                                                              \
        TRACTION_LOCAL(rows);                                                                                      \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                                         \
        {                                                                                                          \
            struct elastic_tensor V = ELASTIC_AT(i, nv);                                                           \
            struct traction_vector N = TRACTION_N(i, nv), half = traction_times(nv, V, N);                         \
            own[i] = traction_on(nv, TRACTION_SLOPES(i), N, half, traction_times(nv, V, half));                    \
        }                                                                                                          \
    }
TRACTION_ALONG(2)
TRACTION_ALONG(3)

/* The same, and s'N, the whole vector. */
#define TRACTION_PULL(nv)                                                                                         \
    static BULLA_KERNEL void traction_pull_##nv(size_t n, const struct traction_rows *rows, double *restrict own, \
                                                double *restrict px, double *restrict py, double *restrict pz)    \
    {                                                                                                             \
        TRACTION_LOCAL(rows);                                                                                     \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                                        \
        {                                                                                                         \
            struct elastic_tensor V = ELASTIC_AT(i, nv);                                                          \
            struct traction_slopes g = TRACTION_SLOPES(i);                                                        \
            struct traction_vector N = TRACTION_N(i, nv), half = traction_times(nv, V, N);                        \
            struct traction_vector BN = traction_times(nv, V, half);                                              \
            struct traction_vector BBN = traction_times(nv, V, traction_times(nv, V, BN));                        \
            double mean = g.G1 * (g.first / 3.0) - g.slope * (g.trace / 3.0);                                     \
            own[i] = traction_on(nv, g, N, half, BN);                                                             \
            px[i] = g.twice * (g.G1 * BN.x - g.slope * BBN.x - mean * N.x);                                       \
            py[i] = g.twice * (g.G1 * BN.y - g.slope * BBN.y - mean * N.y);                                       \
            if ((nv) > 2) pz[(nv) > 2 ? i : 0] = g.twice * (g.G1 * BN.z - g.slope * BBN.z - mean * N.z);          \
        }                                                                                                         \
    }
TRACTION_PULL(2)
TRACTION_PULL(3)

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
    double packed_V[6 * TRACTION_PITCH];
};

/* Points `ret` at n rows at those cells, the first of which is `first`; `room` is where packed ones go. */
static void traction_point(const struct traction_cells *cells, unsigned n, size_t stride, const double *first,
                           double *room, const double **ret)
{
    if (cells->at) pick_take_rows(cells->n, cells->at, n, stride, first, TRACTION_PITCH, room);
    for (unsigned c = 0; c < n; c++) ret[c] = cells->at ? room + c * TRACTION_PITCH : first + c * stride;
}

/* Normals packed as the cells: row d at normal + d * pitch. */
static void traction_aim(const struct model *model, size_t pitch, const double *normal, struct traction_view *ret)
{
    for (unsigned d = 0; d < 3; d++) ret->normal[d] = d < model->n_normal ? normal + d * pitch : traction_zero;
}

static void traction_look(const struct model *model, const struct traction_cells *cells, unsigned k, size_t stride,
                          const double *w, struct traction_view *ret)
{
    for (unsigned c = 0; c < 6; c++) ret->row[c] = traction_zero;
    traction_point(cells, model->n_stretch, stride, w + model_stretch(model, k) * stride, ret->packed_V, ret->row);
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

static void traction_plain(size_t n, const double *rho, const struct traction_view *view, double *own)
{
    const double *const *row = view->row;
    traction_normal(n, rho, row[ELASTIC_XX], row[ELASTIC_XY], row[ELASTIC_XZ], row[ELASTIC_YY], row[ELASTIC_YZ],
                    row[ELASTIC_ZZ], view->I1, view->I2, view->e_1, view->e_2, own);
}

/* Both of the slopes e_1, e_2 of a view. */
static void traction_of(const struct model *model, size_t n, const double *rho, const struct traction_view *view,
                        const struct traction_out *out)
{
    struct traction_rows rows = {.rho = rho, .I1 = view->I1, .I2 = view->I2, .e_1 = view->e_1, .e_2 = view->e_2};
    memcpy(rows.V.row, view->row, sizeof rows.V.row);
    memcpy(rows.normal, view->normal, sizeof rows.normal);
    double *const *pull = out->pull;
    bool plane = model->n_velocity < 3;
    if (!model->n_normal) traction_plain(n, rho, view, out->own);
    else if (pull[0] && plane) traction_pull_2(n, &rows, out->own, pull[0], pull[1], pull[2]);
    else if (pull[0]) traction_pull_3(n, &rows, out->own, pull[0], pull[1], pull[2]);
    else if (plane) traction_along_2(n, &rows, out->own);
    else traction_along_3(n, &rows, out->own);
}

/* What the Maxwell branches of solid s add: each a neo-Hookean spring on its own stretch. rho: of the solid. */
static void traction_branches(const struct model *model, const struct traction_cells *cells, unsigned s, size_t stride,
                              const double *w, const double *rho, struct traction_view *view,
                              const struct traction_out *out)
{
    double room[4 * TRACTION_BATCH];
    struct traction_out part = {.own = room};
    for (unsigned d = 0; out->pull[0] && d < 3; d++) part.pull[d] = room + (d + 1) * TRACTION_BATCH;
    unsigned parts = out->pull[0] ? model->n_velocity : 0;
    for (unsigned b = 0; b < model->n_branch; b++) {
        const struct model_branch *branch = &model->branches[b];
        if (branch->solid != s) continue;
        traction_look(model, cells, model->n_solid + b, stride, w, view);
        for (size_t i = 0; i < cells->n; i++) view->e_1[i] = branch->k, view->e_2[i] = 0.0;
        traction_of(model, cells->n, rho, view, &part);
        row_add(cells->n, part.own, out->own);
        for (unsigned d = 0; d < parts; d++) row_add(cells->n, part.pull[d], out->pull[d]);
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

void traction_at(const struct model *model, const struct traction_aimed *aimed, size_t stride, const double *w,
                 size_t pitch, double *own, double *pull)
{
    struct traction_view view;
    for (size_t from = 0; from < aimed->n; from += TRACTION_BATCH) {
        size_t n = aimed->n - from < TRACTION_BATCH ? aimed->n - from : TRACTION_BATCH;
        const struct traction_cells cells = {n, aimed->at + from};
        traction_aim(model, aimed->pitch, aimed->normal + from, &view);
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
    double normal[3 * TRACTION_PITCH];
    const double *rows = w + model->i_normal * stride;
    n = pick_nonzero(n, model->n_normal, stride, rows, at);
    pick_take_rows(n, at, model->n_normal, stride, rows, TRACTION_PITCH, normal);
    const struct traction_aimed aimed = {n, at, TRACTION_PITCH, normal};
    traction_at(model, &aimed, stride, w, TRACTION_BATCH, own, NULL);
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
    double own[SCENE_MATERIALS * TRACTION_BATCH], alpha[TRACTION_BATCH], mean[TRACTION_BATCH], rest[TRACTION_BATCH];
    size_t count = traction_packed(model, n, stride, w, at, own);
    memset(mean, 0, count * sizeof *mean);
    for (unsigned s = 0; count && s < model->n_solid; s++) {
        pick_take(count, at, w + (model->i_alpha + model->solids[s].material) * stride, alpha);
        row_add_product(count, alpha, own + s * TRACTION_BATCH, mean);
    }
    for (size_t k = 0; k < count; k++) rest[k] = 0.0 - mean[k];
    for (unsigned l = 0; l < model->n_material; l++) {
        memset(ret->lag[l], 0, n * sizeof *ret->lag[l]);
        if (!model_is_solid(model, l)) pick_put(count, at, rest, ret->lag[l]);
    }
    for (unsigned s = 0; count && s < model->n_solid; s++) {
        row_take(count, mean, own + s * TRACTION_BATCH);
        pick_put(count, at, own + s * TRACTION_BATCH, ret->lag[model->solids[s].material]);
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
