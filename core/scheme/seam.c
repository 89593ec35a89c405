/* seam.c - see seam.h. */
#include "scheme/seam.h"

#include "base/mem.h"
#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/elastic_tensor.h"
#include "phys/mix.h"
#include "phys/pick.h"
#include "scheme/strain.h"
#include "scheme/terms.h"

#include <math.h>
#include <string.h>

/* Steps of fractions that small count less: an even mixture has no surface. */
#define SEAM_TRACE 1e-3

/* Tangents that turn with the normal. */
static void seam_aim(struct seam *seam, size_t i, const double n[3])
{
    double flat = hypot(n[0], n[1]);
    double one[3] = {flat > 0.0 ? -n[1] / flat : 0.0, flat > 0.0 ? n[0] / flat : 1.0, 0.0};
    double two[3] = {n[1] * one[2] - n[2] * one[1], n[2] * one[0] - n[0] * one[2], n[0] * one[1] - n[1] * one[0]};
    for (unsigned d = 0; d < 3; d++) {
        seam->frame[0][d][i] = n[d];
        seam->frame[1][d][i] = one[d];
        seam->frame[2][d][i] = two[d];
    }
}

static BULLA_KERNEL void seam_find(size_t n, const double *restrict alpha, const double *restrict m,
                                   unsigned char *restrict there)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++)
        there[i] = (unsigned char)(there[i] + ((alpha[i] > MIX_ABSENT) & (m[i] > ELASTIC_NOTHING)));
}

void seam_count(const struct term_tile *tile, unsigned s, const double *u, size_t from, size_t n, unsigned char *there)
{
    const struct model *model = tile->model;
    unsigned l = model->solids[s].material;
    seam_find(n, u + (model->i_alpha + l) * tile->n_cell + from, u + (model->i_m + l) * tile->n_cell + from, there);
}

void seam_gradient(const struct term_tile *tile, size_t cell, const double *weight, double g[3])
{
    const struct model *model = tile->model;
    const double *slope = tile->rates + terms_first(tile->terms, &strain_term) * tile->n_cell + cell;
    unsigned dim = (unsigned)model->dim;
    for (unsigned d = 0; d < 3; d++) g[d] = 0.0;
    for (unsigned s = 0; s < model->n_solid; s++)
        for (unsigned d = 0; d < dim; d++)
            g[d] += weight[s] * slope[((model->n_velocity + s) * dim + d) * tile->n_cell] * tile->level->h[d];
}

/* Area of the surface per volume [1/m]; g is per cell. */
static double seam_steep(const struct term_tile *tile, const double g[3])
{
    double sum = 0.0;
    for (int d = 0; d < tile->model->dim; d++) sum += g[d] / tile->level->h[d] * (g[d] / tile->level->h[d]);
    return sqrt(sum);
}

double seam_add(struct seam *seam, const struct term_tile *tile, unsigned cell, const double g[3])
{
    double size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]), weight = size / SEAM_TRACE;
    if (!(size > 0.0)) return 0.0;
    const double n[3] = {g[0] / size, g[1] / size, g[2] / size};
    size_t i = seam->n++;
    seam_aim(seam, i, n);
    seam->cell[i] = cell;
    seam->part[i] = weight < 1.0 ? weight * weight : 1.0;
    seam->steep[i] = seam_steep(tile, g);
    return seam->part[i];
}

struct seam_vector {
    double x, y, z;
};

static ELASTIC_BODY struct seam_vector seam_times(struct elastic_tensor V, struct seam_vector r)
{
    return (struct seam_vector){r.x * V.xx + r.y * V.xy + r.z * V.xz, r.x * V.xy + r.y * V.yy + r.z * V.yz,
                                r.x * V.xz + r.y * V.yz + r.z * V.zz};
}

static ELASTIC_BODY double seam_dot(struct seam_vector a, struct seam_vector r)
{
    return a.x * r.x + a.y * r.y + a.z * r.z;
}

/* R V R^T of points with the rows of R. */
static BULLA_KERNEL void seam_turn_space(size_t n, const double *const R[3][3], double *const *V)
{
    const double *restrict xx = R[0][0], *restrict xy = R[0][1], *restrict xz = R[0][2];
    const double *restrict yx = R[1][0], *restrict yy = R[1][1], *restrict yz = R[1][2];
    const double *restrict zx = R[2][0], *restrict zy = R[2][1], *restrict zz = R[2][2];
    double *restrict v_xx = V[0], *restrict v_yy = V[1], *restrict v_zz = V[2];
    double *restrict v_xy = V[3], *restrict v_xz = V[4], *restrict v_yz = V[5];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct elastic_tensor full = {v_xx[i], v_yy[i], v_zz[i], v_xy[i], v_xz[i], v_yz[i]};
        struct seam_vector x = {xx[i], xy[i], xz[i]}, y = {yx[i], yy[i], yz[i]}, z = {zx[i], zy[i], zz[i]};
        struct seam_vector a = seam_times(full, x), b = seam_times(full, y);
        v_xx[i] = seam_dot(a, x);
        v_xy[i] = seam_dot(a, y);
        v_xz[i] = seam_dot(a, z);
        v_yy[i] = seam_dot(b, y);
        v_yz[i] = seam_dot(b, z);
        v_zz[i] = seam_dot(seam_times(full, z), z);
    }
}

/* In a plane, where z stands alone. */
static BULLA_KERNEL void seam_turn_plane(size_t n, const double *const R[3][3], double *const *V)
{
    const double *restrict xx = R[0][0], *restrict xy = R[0][1], *restrict yx = R[1][0], *restrict yy = R[1][1];
    const double *restrict zz = R[2][2];
    double *restrict v_xx = V[0], *restrict v_yy = V[1], *restrict v_zz = V[2], *restrict v_xy = V[3];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = v_xx[i], b = v_xy[i], d = v_yy[i], z = zz[i];
        double ax = xx[i] * a + xy[i] * b, ay = xx[i] * b + xy[i] * d;
        double bx = yx[i] * a + yy[i] * b, by = yx[i] * b + yy[i] * d;
        double one = ax * yx[i] + ay * yy[i], other = bx * xx[i] + by * xy[i]; /* x and y exchanged: the same bits */
        v_xx[i] = ax * xx[i] + ay * xy[i];
        v_xy[i] = 0.5 * (one + other);
        v_yy[i] = bx * yx[i] + by * yy[i];
        v_zz[i] = z * v_zz[i] * z;
    }
}

/* A stretch of all points: R V R^T with the rows of the frame as R, or back. */
static void seam_turn(struct seam *seam, double *V, bool back)
{
    const double *R[3][3];
    double *rows[6] = {NULL};
    for (unsigned a = 0; a < 3; a++)
        for (unsigned d = 0; d < 3; d++) R[a][d] = back ? seam->frame[d][a] : seam->frame[a][d];
    for (unsigned c = 0; c < seam->model->n_stretch; c++) rows[c] = V + c * SEAM_BATCH;
    if (seam->model->n_velocity < 3) seam_turn_plane(seam->n, R, rows);
    else seam_turn_space(seam->n, R, rows);
}

/* Partial densities of solid s, as far as it bears. */
static void seam_bear(struct seam *seam, const struct term_tile *tile, unsigned s, const double *u)
{
    const struct model_solid *solid = &seam->model->solids[s];
    double *m = seam->m[s], broken[SEAM_BATCH];
    pick_take(seam->n, seam->cell, u + (seam->model->i_m + solid->material) * tile->n_cell, m);
    if (solid->damage.law) pick_take(seam->n, seam->cell, u + solid->damage.field * tile->n_cell, broken);
    for (size_t i = 0; i < seam->n; i++) {
        double part = solid->damage.law && m[i] > ELASTIC_NOTHING ? bearing_part(broken[i] / m[i]) : 1.0;
        m[i] = m[i] > ELASTIC_NOTHING ? m[i] * part : 0.0;
    }
}

static void seam_take(struct seam *seam, const struct term_tile *tile, const double *u)
{
    const struct model *model = seam->model;
    for (unsigned s = 0; s < model->n_solid; s++) {
        pick_take(seam->n, seam->cell, u + (model->i_alpha + model->solids[s].material) * tile->n_cell, seam->alpha[s]);
        seam_bear(seam, tile, s, u);
    }
    for (unsigned k = 0; k < model_stretches(model); k++) {
        double *V = seam->V[elastic_block(model, k, 1)];
        pick_take_rows(seam->n, seam->cell, model->n_stretch, tile->n_cell, u + model_stretch(model, k) * tile->n_cell,
                       SEAM_BATCH, V);
        seam_turn(seam, V, false);
    }
}

/* Shear traction and stiffness of each solid, per its own volume. */
static void seam_pull(struct seam *seam)
{
    static const double zero[SEAM_BATCH];
    const struct model *model = seam->model;
    double normal[SEAM_BATCH], stiff[SEAM_BATCH];
    const double *m[SCENE_MATERIALS];
    for (unsigned s = 0; s < model->n_solid; s++) {
        const struct elastic_side side = {.normal = normal,
                                          .shear = {seam->t[0][s], seam->t[1][s]},
                                          .stiff = stiff,
                                          .rigid = seam->k[s]};
        for (unsigned other = 0; other < model->n_solid; other++) m[other] = other == s ? seam->m[s] : zero;
        elastic_sides(model, 0, seam->n, SEAM_BATCH, seam->V[0], m, zero, &side);
        for (size_t i = 0; i < seam->n; i++) {
            double per = seam->alpha[s][i] > MIX_ABSENT ? 1.0 / seam->alpha[s][i] : 0.0;
            seam->k[s][i] *= per;
            for (unsigned d = 0; d + 1 < model->n_velocity; d++) seam->t[d][s][i] *= per;
        }
    }
}

/* Stretch k of all points sheared by what its solid slides by: (1 + a n^T) in two halves. */
static void seam_shear(struct seam *seam, unsigned k)
{
    const struct model *model = seam->model;
    unsigned dim = (unsigned)model->dim, s = model_bearer(model, k);
    double gradient[9][SEAM_BATCH] = {{0}}, none[6][SEAM_BATCH] = {{0}}, one[SEAM_BATCH], out[6][SEAM_BATCH];
    for (size_t i = 0; i < seam->n; i++) one[i] = 1.0;
    for (unsigned d = 0; d + 1 < model->n_velocity; d++)
        for (size_t i = 0; i < seam->n; i++) gradient[(d + 1) * dim][i] = -seam->a[d][s][i];
    const struct elastic_rates rates = {
        .carried = none[0], .m_old = one, .m_new = one, .div = none[0], .gradient = gradient[0]};
    double *V = seam->V[elastic_block(model, k, 1)];
    elastic_advance(model, seam->n, SEAM_BATCH, 1.0, V, &rates, out[0]);
    elastic_unimodular(model, seam->n, SEAM_BATCH, out[0]);
    for (unsigned c = 0; c < model->n_stretch; c++) memcpy(V + c * SEAM_BATCH, out[c], seam->n * sizeof *V);
}

/* What has slid goes back. */
static void seam_scatter(struct seam *seam, const struct term_tile *tile, double *u)
{
    const struct model *model = seam->model;
    for (unsigned k = 0; k < model_stretches(model); k++) {
        double *V = seam->V[elastic_block(model, k, 1)];
        unsigned s = model_bearer(model, k);
        seam_shear(seam, k);
        seam_turn(seam, V, true);
        for (size_t i = 0; i < seam->n; i++) {
            if (seam->a[0][s][i] == 0.0 && seam->a[1][s][i] == 0.0) continue;
            for (unsigned c = 0; c < model->n_stretch; c++)
                u[(model_stretch(model, k) + c) * tile->n_cell + seam->cell[i]] = V[c * SEAM_BATCH + i];
        }
    }
}

static void seam_batch(const struct seam_work *work, struct seam *seam, const struct term_tile *tile, double *u)
{
    if (!seam->n) return;
    seam_take(seam, tile, u);
    seam_pull(seam);
    work->slide(seam, tile);
    seam_scatter(seam, tile, u);
    seam->n = 0;
}

void *seam_open(const struct term_room *room)
{
    (void)room;
    return mem_new(1, sizeof(struct seam));
}

void seam_apply(const struct seam_work *work, const struct term_tile *tile, double *u)
{
    struct seam *seam = tile->own;
    unsigned at[SEAM_LOOK];
    seam->model = tile->model;
    seam->n = 0;
    for (size_t from = 0; from < tile->n_cell; from += SEAM_LOOK) {
        size_t left = tile->n_cell - from, n = work->pick(tile, u, from, left < SEAM_LOOK ? left : SEAM_LOOK, at);
        for (size_t i = 0; i < n; i++) {
            work->look(seam, tile, u, at[i]);
            if (seam->n == SEAM_BATCH) seam_batch(work, seam, tile, u);
        }
    }
    seam_batch(work, seam, tile, u);
}
