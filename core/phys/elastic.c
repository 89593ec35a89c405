/* elastic.c - see elastic.h: what a stretch means (energy, stress, speeds). How it moves is in elastic_advance.c.
 *
 * With B = V V and I1, I2 its invariants, every isotropic law comes down to two moduli per point,
 *     G1 = 2 m (e_1 + I1 e_2),   G2 = 2 m e_2,   s' = G1 dev B - G2 dev B^2,
 * and their derivatives for wave speeds. Laws of I1 alone with constant slope (neo-Hookean) take the short path,
 * G2 = 0 and constant G1. So does every Maxwell branch. What the stretches of solids and branches find adds up. */
#include "phys/elastic.h"

#include "mesh/axis.h"
#include "phys/elastic_slopes.h"
#include "phys/elastic_tensor.h"
#include "phys/row.h"

#include <math.h>
#include <string.h>

enum { ELASTIC_BATCH = 512 };

/* Arrays of one batch: invariants and moduli. */
struct elastic_batch {
    double I1[ELASTIC_BATCH], I2[ELASTIC_BATCH], energy[ELASTIC_BATCH], G1[ELASTIC_BATCH], G2[ELASTIC_BATCH];
    double H11[ELASTIC_BATCH], H12[ELASTIC_BATCH], H22[ELASTIC_BATCH]; /* 2 m e_11 ... */
};

/* A plain solid's energy and G1. */
static BULLA_KERNEL void elastic_fill_plain(size_t n, const double *restrict m, const double *restrict e,
                                            const double *restrict e_1, double *restrict energy, double *restrict G1)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double mass = m[i];
        energy[i] = mass * e[i];
        G1[i] = 2.0 * mass * e_1[i];
    }
}

/* A solid's energy and moduli. */
static BULLA_KERNEL void elastic_fill(size_t n, const double *restrict m, const double *restrict I1,
                                      const double *restrict e, const double *restrict e_1, const double *restrict e_2,
                                      double *restrict energy, double *restrict G1, double *restrict G2)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double mass = m[i], first = e_1[i], second = e_2[i];
        energy[i] = mass * e[i];
        G1[i] = 2.0 * mass * (first + I1[i] * second);
        G2[i] = 2.0 * mass * second;
    }
}

static BULLA_KERNEL void elastic_fill_second(size_t n, const double *restrict m, double *restrict H11,
                                             double *restrict H12, double *restrict H22)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double twice = 2.0 * m[i], h11 = H11[i], h12 = H12[i], h22 = H22[i];
        H11[i] = twice * h11;
        H12[i] = twice * h12;
        H22[i] = twice * h22;
    }
}

static bool elastic_plain_law(const struct bulla_constitutive *law)
{
    return !law->second && law->first_only;
}

bool elastic_is_plain(const struct model *model, unsigned k)
{
    return k >= model->n_solid || elastic_plain_law(model->solids[k].law);
}

/* Are all solids of the scene? A path has the speeds that any other one has. */
static bool elastic_are_plain(const struct model *model)
{
    bool plain = true;
    for (unsigned l = 0; l < model->scene->n_material; l++) {
        const struct bulla_module *module = model->scene->material[l].constitutive.module;
        plain = plain && (!module || elastic_plain_law(module->table));
    }
    return plain;
}

/* The spring of a branch: what it adds to the energy, and its modulus. */
static BULLA_KERNEL void elastic_spring(size_t n, double k, const double *restrict m, const double *restrict I1,
                                        double *restrict energy, double *restrict G1)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double stiff = m[i] * k;
        energy[i] = stiff * (I1[i] - 3.0);
        G1[i] = 2.0 * stiff;
    }
}

/* The same of stretch k of a solid, and of a branch. */
static void elastic_of_solid(const struct model_solid *solid, bool plain, size_t n, const double *m,
                             struct elastic_batch *batch)
{
    double e[ELASTIC_BATCH], e_1[ELASTIC_BATCH], e_2[ELASTIC_BATCH];
    solid->law->energy(solid->self, n, batch->I1, plain ? batch->I1 : batch->I2, e, e_1, e_2);
    if (plain) elastic_fill_plain(n, m, e, e_1, batch->energy, batch->G1);
    else elastic_fill(n, m, batch->I1, e, e_1, e_2, batch->energy, batch->G1, batch->G2);
}

/* Invariants, energy and moduli of stretch k alone at n <= ELASTIC_BATCH points from `from` of all rows; its block from
 * there. */
static const double *elastic_moduli(const struct model *model, unsigned k, size_t n, size_t stride, const double *V,
                                    size_t from, const double *const *m, struct elastic_batch *batch)
{
    const double *own = V + elastic_block(model, k, stride) + from;
    bool plain = elastic_is_plain(model, k);
    if (plain) elastic_invariants_first(model, n, stride, own, batch->I1);
    else elastic_invariants(model, n, stride, own, batch->I1, batch->I2);
    if (k < model->n_solid) {
        elastic_of_solid(&model->solids[k], plain, n, m[k] + from, batch);
    } else {
        const struct model_branch *branch = &model->branches[k - model->n_solid];
        elastic_spring(n, branch->k, m[branch->solid] + from, batch->I1, batch->energy, batch->G1);
    }
    return own;
}

static void elastic_curvature(const struct model_solid *solid, size_t n, const double *m, struct elastic_batch *batch)
{
    double *rows[] = {batch->H11, batch->H12, batch->H22};
    for (size_t i = 0; i < sizeof rows / sizeof *rows && !solid->law->second; i++) memset(rows[i], 0, n * sizeof *m);
    if (!solid->law->second) return;
    solid->law->second(solid->self, n, batch->I1, batch->I2, batch->H11, batch->H12, batch->H22);
    elastic_fill_second(n, m, batch->H11, batch->H12, batch->H22);
}

static size_t elastic_part(size_t n, size_t from)
{
    return n - from < ELASTIC_BATCH ? n - from : ELASTIC_BATCH;
}

void elastic_energy(const struct model *model, size_t n, size_t stride, const double *V, const double *const *m,
                    double *restrict rho_es)
{
    struct elastic_batch batch;
    for (size_t from = 0; from < n; from += ELASTIC_BATCH)
        for (unsigned k = 0; k < model_stretches(model); k++) {
            size_t part = elastic_part(n, from);
            elastic_moduli(model, k, part, stride, V, from, m, &batch);
            if (k) row_add(part, batch.energy, rho_es + from);
            else memcpy(rho_es + from, batch.energy, part * sizeof *rho_es);
        }
}

/* dev of G1 B - G2 B^2, component by component. */
static ELASTIC_BODY struct elastic_tensor elastic_deviator(struct elastic_tensor V, double G1, double G2)
{
    struct elastic_tensor B = elastic_tensor_square(V), C = elastic_tensor_square(B);
    double mean = (G1 * elastic_tensor_trace(B) - G2 * elastic_tensor_trace(C)) / 3.0;
    return (struct elastic_tensor){(G1 * B.xx - G2 * C.xx) - mean, (G1 * B.yy - G2 * C.yy) - mean,
                                   (G1 * B.zz - G2 * C.zz) - mean, G1 * B.xy - G2 * C.xy,
                                   G1 * B.xz - G2 * C.xz,          G1 * B.yz - G2 * C.yz};
}

#define ELASTIC_STRESS(nv)                                                                                   \
    static BULLA_KERNEL void elastic_stress_##nv(size_t n, struct elastic_rows V, const double *restrict G1, \
                                                 const double *restrict G2, double *const *out)              \
    {                                                                                                        \
        double *restrict xx = out[0], *restrict yy = out[1], *restrict zz = out[2];                          \
        double *restrict xy = out[3], *restrict xz = out[4], *restrict yz = out[5];                          \
        ELASTIC_LOCAL(V);                                                                                    \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                                   \
        {                                                                                                    \
            struct elastic_tensor dev = elastic_deviator(ELASTIC_AT(i, nv), G1[i], G2[i]);                   \
            xx[i] = dev.xx;                                                                                  \
            yy[i] = dev.yy;                                                                                  \
            zz[i] = dev.zz;                                                                                  \
            if ((nv) > 1) xy[i] = dev.xy;                                                                    \
            if ((nv) > 2) xz[i] = dev.xz;                                                                    \
            if ((nv) > 2) yz[i] = dev.yz;                                                                    \
        }                                                                                                    \
    }
ELASTIC_STRESS(1)
ELASTIC_STRESS(2)
ELASTIC_STRESS(3)

/* s' of one stretch, or that added to what there is. */
static void elastic_stress_part(const struct model *model, bool plain, bool add, size_t n, size_t stride,
                                const double *V, const struct elastic_batch *batch, double *s)
{
    static const double none[ELASTIC_BATCH];
    double part[6][ELASTIC_BATCH], *out[6];
    for (unsigned c = 0; c < 6; c++) out[c] = add || c >= model->n_stretch ? part[c] : s + c * stride;
    struct elastic_rows rows = elastic_tensor_rows(V, stride, model->n_stretch);
    ELASTIC_CHOOSE(model->n_velocity, elastic_stress, n, rows, batch->G1, plain ? none : batch->G2, out);
    for (unsigned c = 0; add && c < model->n_stretch; c++) row_add(n, part[c], s + c * stride);
}

void elastic_stress(const struct model *model, size_t n, size_t stride, const double *V, const double *const *m,
                    double *s)
{
    struct elastic_batch batch;
    for (size_t from = 0; from < n; from += ELASTIC_BATCH)
        for (unsigned k = 0; k < model_stretches(model); k++) {
            size_t part = elastic_part(n, from);
            const double *own = elastic_moduli(model, k, part, stride, V, from, m, &batch);
            elastic_stress_part(model, elastic_is_plain(model, k), k > 0, part, stride, own, &batch, s + from);
        }
}

/* zz stands alone in curved geometries: B_zz = V_zz^2, and tr B^2 = I1^2 - 2 I2. Plain laws have no G2. */
static BULLA_KERNEL void elastic_hoop_plain(size_t n, const double *restrict V_zz, const struct elastic_batch *batch,
                                            const double *restrict p, double *restrict ret)
{
    const double *restrict I1 = batch->I1, *restrict G1 = batch->G1;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double v = V_zz[i];
        ret[i] = p[i] - G1[i] * (v * v - I1[i] / 3.0);
    }
}

static BULLA_KERNEL void elastic_hoop_part(size_t n, const double *restrict V_zz, const struct elastic_batch *batch,
                                           const double *restrict p, double *restrict ret)
{
    const double *restrict I1 = batch->I1, *restrict I2 = batch->I2, *restrict G1 = batch->G1, *restrict G2 = batch->G2;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double v = V_zz[i], first = I1[i], B = v * v, C = first * first - 2.0 * I2[i];
        ret[i] = p[i] - (G1[i] * (B - first / 3.0) - G2[i] * (B * B - C / 3.0));
    }
}

void elastic_hoop(const struct model *model, size_t n, size_t stride, const double *V, const double *const *m,
                  const double *p, double *ret)
{
    struct elastic_batch batch;
    double beside[ELASTIC_BATCH];
    for (size_t from = 0; from < n; from += ELASTIC_BATCH) {
        size_t part = elastic_part(n, from);
        memcpy(beside, p + from, part * sizeof *beside);
        for (unsigned k = 0; k < model_stretches(model); k++) {
            const double *zz = elastic_moduli(model, k, part, stride, V, from, m, &batch) + ELASTIC_ZZ * stride;
            if (k) memcpy(beside, ret + from, part * sizeof *beside);
            if (elastic_is_plain(model, k)) elastic_hoop_plain(part, zz, &batch, beside, ret + from);
            else elastic_hoop_part(part, zz, &batch, beside, ret + from);
        }
    }
}

/* Largest eigenvalue of [a b; b d] with b^2 given; exactly a where b = 0 and d <= a. */
static ELASTIC_BODY double elastic_fastest(double a, double d, double b2)
{
    double half = 0.5 * (a - d), spread = fabs(half) + sqrt(half * half + b2), more = b2 / spread;
    return (a > d ? a : d) + (spread > 0.0 ? more : 0.0);
}

struct elastic_face {
    double normal, shear_1, shear_2, stiff, rigid;
};

/* Neo-Hookean kind: rho A_nn = rho c_f^2 + G [2/9 B_nn + 5/9 (B_t1t1 + B_t2t2)], A_tt = G B_nn, A_nt = -2/3 G B_nt.
 * Tensors in the frame of the face: x normal, y and z tangential. */
static ELASTIC_BODY struct elastic_face elastic_plain(struct elastic_tensor V, double G, double fluid)
{
    struct elastic_tensor B = elastic_tensor_square(V);
    double along = B.yy + B.zz, a = fluid + G * ((2.0 / 9.0) * B.xx + (5.0 / 9.0) * along), d = G * B.xx;
    double b2 = (4.0 / 9.0) * (G * G) * (B.xy * B.xy + B.xz * B.xz);
    return (struct elastic_face){.normal = G * ((2.0 / 3.0) * B.xx - along / 3.0),
                                 .shear_1 = G * B.xy,
                                 .shear_2 = G * B.xz,
                                 .stiff = elastic_fastest(a, d, b2) - fluid,
                                 .rigid = d};
}

/* Any law. A strain a (x) n changes B by a b' + b a' - (2/3)(a.n) B with b = B n, C = B^2 by the product rule, the
 * invariants with them, densities by -(a.n); what the traction on n changes by along a' is rho A_aa'. Tensors in
 * the frame of the face. A bound of the tangential block (its larger diagonal entry plus the other one) stands for
 * d. */
static ELASTIC_BODY struct elastic_face elastic_general(struct elastic_tensor V, struct elastic_slopes g, double fluid)
{
    struct elastic_tensor B = elastic_tensor_square(V), C = elastic_tensor_square(B);
    double trace = elastic_tensor_trace(C), dev_B = B.xx - g.I1 / 3.0, dev_C = C.xx - trace / 3.0;
    double normal = g.G1 * dev_B - g.G2 * dev_C;
    double n1 = 2.0 * B.xx - (2.0 / 3.0) * g.I1, n2 = g.I1 * n1 - (2.0 * C.xx - (2.0 / 3.0) * trace);  /* a = n */
    double p1 = 2.0 * B.xy, p2 = g.I1 * p1 - 2.0 * C.xy, q1 = 2.0 * B.xz, q2 = g.I1 * q1 - 2.0 * C.xz; /* t1, t2 */
    double dC = (2.0 / 3.0) * C.xx + 2.0 * B.xx * B.xx, dtrace = 4.0 * C.xx - (4.0 / 3.0) * trace;
    double nn = g.G1 * ((4.0 / 3.0) * B.xx - n1 / 3.0) - g.G2 * (dC - dtrace / 3.0) +
                elastic_slopes_stiffen(g, n1, n2, dev_B, dev_C) - normal;
    double np = -g.G1 * (p1 / 3.0) - g.G2 * (2.0 * B.xx * B.xy - (4.0 / 3.0) * C.xy) +
                elastic_slopes_stiffen(g, p1, p2, dev_B, dev_C);
    double nq = -g.G1 * (q1 / 3.0) - g.G2 * (2.0 * B.xx * B.xz - (4.0 / 3.0) * C.xz) +
                elastic_slopes_stiffen(g, q1, q2, dev_B, dev_C);
    double pp = g.G1 * B.xx - g.G2 * (C.xx + B.xx * B.yy + B.xy * B.xy) + elastic_slopes_stiffen(g, p1, p2, B.xy, C.xy);
    double qq = g.G1 * B.xx - g.G2 * (C.xx + B.xx * B.zz + B.xz * B.xz) + elastic_slopes_stiffen(g, q1, q2, B.xz, C.xz);
    double pq = -g.G2 * (B.xx * B.yz + B.xy * B.xz) + elastic_slopes_stiffen(g, q1, q2, B.xy, C.xy);
    double d = (pp > qq ? pp : qq), a = fluid + nn, bound = d + fabs(pq);
    return (struct elastic_face){.normal = normal,
                                 .shear_1 = g.G1 * B.xy - g.G2 * C.xy,
                                 .shear_2 = g.G1 * B.xz - g.G2 * C.xz,
                                 .stiff = elastic_fastest(a, bound, np * np + nq * nq) - fluid,
                                 .rigid = d > 0.0 ? d : 0.0};
}

/* Where a row of faces puts what it finds. */
struct elastic_out {
    double *normal, *shear_1, *shear_2, *stiff, *rigid;
};

#define ELASTIC_ROOM(out)                                                                                 \
    double *restrict normal = (out).normal, *restrict stiff = (out).stiff, *restrict rigid = (out).rigid; \
    double *restrict shear_1 = (out).shear_1, *restrict shear_2 = (out).shear_2

#define ELASTIC_PUT(nv, op)                       \
    do {                                          \
        normal[i] op face.normal;                 \
        stiff[i] op face.stiff;                   \
        rigid[i] op face.rigid;                   \
        if ((nv) > 1) shear_1[i] op face.shear_1; \
        if ((nv) > 2) shear_2[i] op face.shear_2; \
    } while (0)

#define ELASTIC_SIDES(kind, nv, op)                                                                             \
    static BULLA_KERNEL void elastic_plain##kind##_##nv(size_t n, struct elastic_rows V,                        \
                                                        const struct elastic_batch *batch,                      \
                                                        const double *restrict fluid, struct elastic_out out)   \
    {                                                                                                           \
        ELASTIC_ROOM(out);                                                                                      \
        const double *restrict G1 = batch->G1;                                                                  \
        ELASTIC_LOCAL(V);                                                                                       \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                                      \
        {                                                                                                       \
            struct elastic_face face = elastic_plain(ELASTIC_AT(i, nv), G1[i], fluid[i]);                       \
            ELASTIC_PUT(nv, op);                                                                                \
        }                                                                                                       \
    }                                                                                                           \
    static BULLA_KERNEL void elastic_general##kind##_##nv(size_t n, struct elastic_rows V,                      \
                                                          const struct elastic_batch *batch,                    \
                                                          const double *restrict fluid, struct elastic_out out) \
    {                                                                                                           \
        ELASTIC_ROOM(out);                                                                                      \
        const double *restrict G1 = batch->G1, *restrict G2 = batch->G2, *restrict I1 = batch->I1;              \
        const double *restrict H11 = batch->H11, *restrict H12 = batch->H12, *restrict H22 = batch->H22;        \
        ELASTIC_LOCAL(V);                                                                                       \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                                      \
        {                                                                                                       \
            struct elastic_slopes slopes = {G1[i], G2[i], H11[i], H12[i], H22[i], I1[i]};                       \
            struct elastic_face face = elastic_general(ELASTIC_AT(i, nv), slopes, fluid[i]);                    \
            ELASTIC_PUT(nv, op);                                                                                \
        }                                                                                                       \
    }
ELASTIC_SIDES(, 1, =)
ELASTIC_SIDES(, 2, =)
ELASTIC_SIDES(, 3, =)
ELASTIC_SIDES(_add, 1, +=)
ELASTIC_SIDES(_add, 2, +=)
ELASTIC_SIDES(_add, 3, +=)

/* The tensor with its axes renamed: the normal of the face first, then the tangents. */
static struct elastic_rows elastic_turn(const struct model *model, int axis, size_t stride, const double *V)
{
    unsigned a = axis_component(axis, 0), b = axis_component(axis, 1), c = axis_component(axis, 2);
    unsigned order[6] = {a, b, c, elastic_component(a, b), elastic_component(a, c), elastic_component(b, c)};
    struct elastic_rows rows;
    for (unsigned i = 0; i < 6; i++) rows.row[i] = V + (order[i] < model->n_stretch ? order[i] : 0) * stride;
    return rows;
}

/* What stretch k gives a row of faces, or adds to it behind the first one; its energy is in the batch. `stiffness`: of
 * the fluid, from 0. */
static void elastic_sides_of(const struct model *model, unsigned k, int axis, size_t n, size_t stride, const double *V,
                             size_t from, const double *const *m, const double *stiffness,
                             const struct elastic_out *out, struct elastic_batch *batch)
{
    const double *own = elastic_moduli(model, k, n, stride, V, from, m, batch);
    struct elastic_rows rows = elastic_turn(model, axis, stride, own);
    bool plain = elastic_is_plain(model, k);
    if (!plain) elastic_curvature(&model->solids[k], n, m[k] + from, batch);
    if (plain && k) ELASTIC_CHOOSE(model->n_velocity, elastic_plain_add, n, rows, batch, stiffness, *out);
    else if (plain) ELASTIC_CHOOSE(model->n_velocity, elastic_plain, n, rows, batch, stiffness, *out);
    else if (k) ELASTIC_CHOOSE(model->n_velocity, elastic_general_add, n, rows, batch, stiffness, *out);
    else ELASTIC_CHOOSE(model->n_velocity, elastic_general, n, rows, batch, stiffness, *out);
}

/* Stretches add up. The stiffness along the normal does so to first order in what couples it to the tangents, which is
 * squared in it; all else is exact. */
void elastic_sides(const struct model *model, int axis, size_t n, size_t stride, const double *V,
                   const double *const *m, const double *stiffness, const struct elastic_side *ret)
{
    struct elastic_batch batch;
    for (size_t from = 0; from < n; from += ELASTIC_BATCH) {
        size_t part = elastic_part(n, from);
        struct elastic_out out = {.normal = ret->normal + from, .stiff = ret->stiff + from, .rigid = ret->rigid + from};
        if (model->n_velocity > 1) out.shear_1 = ret->shear[0] + from;
        if (model->n_velocity > 2) out.shear_2 = ret->shear[1] + from;
        for (unsigned k = 0; k < model_stretches(model); k++) {
            elastic_sides_of(model, k, axis, part, stride, V, from, m, stiffness + from, &out, &batch);
            if (!ret->energy) continue;
            if (k) row_add(part, batch.energy, ret->energy + from);
            else memcpy(ret->energy + from, batch.energy, part * sizeof *batch.energy);
        }
    }
}

static BULLA_KERNEL void elastic_quicken(size_t n, const double *restrict stiff, double *restrict most)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = stiff[i], m = most[i];
        most[i] = s > m ? s : m;
    }
}

static BULLA_KERNEL void elastic_speed(size_t n, const double *restrict most, const double *restrict rho,
                                       double *restrict c2)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) c2[i] += most[i] / rho[i];
}

/* A bound for all directions of plain laws, exact at B = 1: the larger diagonal entry plus the other one of the
 * acoustic tensor, G [larger of 5/9 I1 - 1/3 least B_nn and largest B_nn, + 2/3 sum |B_nt|]. */
#define ELASTIC_BOUND(nv)                                                                                           \
    static BULLA_KERNEL void elastic_bound_##nv(size_t n, struct elastic_rows V, const struct elastic_batch *batch, \
                                                double *restrict most)                                              \
    {                                                                                                               \
        const double *restrict G1 = batch->G1, *restrict I1 = batch->I1;                                            \
        ELASTIC_LOCAL(V);                                                                                           \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                                          \
        {                                                                                                           \
            struct elastic_tensor B = elastic_tensor_square(ELASTIC_AT(i, nv));                                     \
            double x = B.xx, y = B.yy, z = B.zz, least = x < y ? x : y, largest = x < y ? y : x;                    \
            least = least < z ? least : z;                                                                          \
            largest = largest < z ? z : largest;                                                                    \
            double across = fabs(B.xy) + fabs(B.xz) + fabs(B.yz), along = (5.0 / 9.0) * I1[i] - least / 3.0;        \
            along = along < largest ? largest : along;                                                              \
            most[i] = G1[i] * (along + (2.0 / 3.0) * across);                                                       \
        }                                                                                                           \
    }
ELASTIC_BOUND(1)
ELASTIC_BOUND(2)
ELASTIC_BOUND(3)

/* The largest of the axes, for any law. */
static void elastic_bound_general(const struct model *model, size_t n, size_t stride, const double *V,
                                  const double *const *m, const double *fluid, double *most)
{
    double normal[ELASTIC_BATCH], stiff[ELASTIC_BATCH], rigid[ELASTIC_BATCH], shear[2][ELASTIC_BATCH];
    struct elastic_side side = {.normal = normal, .shear = {shear[0], shear[1]}, .stiff = stiff, .rigid = rigid};
    memset(most, 0, n * sizeof *most);
    for (int axis = 0; axis < model->dim; axis++) {
        elastic_sides(model, axis, n, stride, V, m, fluid, &side);
        elastic_quicken(n, stiff, most);
    }
}

void elastic_speed2(const struct model *model, size_t n, size_t stride, const double *V, const double *const *m,
                    const double *rho, double *c2)
{
    double most[ELASTIC_BATCH], fluid[ELASTIC_BATCH];
    bool plain = elastic_are_plain(model); /* other laws find all stretches at once */
    struct elastic_batch batch;
    for (size_t from = 0; from < n; from += ELASTIC_BATCH) {
        size_t part = elastic_part(n, from);
        for (unsigned k = 0; plain && k < model_stretches(model); k++) {
            const double *own = elastic_moduli(model, k, part, stride, V, from, m, &batch);
            struct elastic_rows rows = elastic_tensor_rows(own, stride, model->n_stretch);
            ELASTIC_CHOOSE(model->n_velocity, elastic_bound, part, rows, &batch, most);
            elastic_speed(part, most, rho + from, c2 + from);
        }
        if (plain) continue;
        const double *masses[SCENE_MATERIALS];
        for (unsigned s = 0; s < model->n_solid; s++) masses[s] = m[s] + from;
        for (size_t i = 0; i < part; i++) fluid[i] = rho[from + i] * c2[from + i];
        elastic_bound_general(model, part, stride, V + from, masses, fluid, most);
        elastic_speed(part, most, rho + from, c2 + from);
    }
}

void elastic_sum(const struct model *model, size_t n, size_t stride, const double *block, double *restrict sum)
{
    memset(sum, 0, n * sizeof *sum);
    for (unsigned s = 0; s < model->n_solid; s++) row_add(n, block + model->solids[s].material * stride, sum);
}

const double *elastic_carrier(const struct model *model, unsigned k, size_t n, size_t stride, const double *block,
                              double *room)
{
    unsigned s = model_bearer(model, k);
    if (model_carries(model, k, s)) return block + model->solids[s].material * stride;
    memset(room, 0, n * sizeof *room);
    return room;
}

void elastic_identity(const struct model *model, size_t n, size_t stride, double *V)
{
    for (unsigned c = 0; c < model->n_stretch; c++)
        for (size_t i = 0; i < n; i++) V[c * stride + i] = c < 3 ? 1.0 : 0.0;
}
