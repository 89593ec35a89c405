/* traction_rate.c - see traction_rate.h.
 *
 * Along the material dB/dt = L B + B L^T - (2/3) tr L B, masses per volume fall by tr L, and the moduli follow the
 * invariants. With b = n.Bn, c = n.B^2 n the traction is G1 (b - I1/3) - G2 (c - tr B^2/3); its change is written once,
 * and asked for the strain of the cell and for one along n. */
#include "phys/traction_rate.h"

#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/elastic_slopes.h"
#include "phys/row.h"

#include <string.h>

enum { TRACTION_RATE_BATCH = 256 };

/* One stretch in a batch. */
struct traction_rate_rows {
    const double *V[6], *normal[3], *gradient[9], *div;
    double one[TRACTION_RATE_BATCH]; /* the normal of a line */
    double rho[TRACTION_RATE_BATCH]; /* density of its solid, as far as it bears */
    double I1[TRACTION_RATE_BATCH], I2[TRACTION_RATE_BATCH];
    double e_1[TRACTION_RATE_BATCH], e_2[TRACTION_RATE_BATCH];
    double e_11[TRACTION_RATE_BATCH], e_12[TRACTION_RATE_BATCH], e_22[TRACTION_RATE_BATCH];
};

static const double traction_rate_zero[TRACTION_RATE_BATCH];

/* What a stretch is across n. */
struct traction_rate_state {
    double b, c, trace, normal; /* n.Bn, n.B^2 n, tr B^2, s'_nn */
};

/* What a strain L does: a = L^T n. */
struct traction_rate_strain {
    double div, aBn, BnLBn, aBBn, LB, LBB; /* tr L, a.Bn, Bn.L Bn, a.B^2 n, L:B, L:B^2 */
};

static ELASTIC_BODY double traction_rate_change(struct elastic_slopes g, struct traction_rate_state s,
                                                struct traction_rate_strain L)
{
    double third = (2.0 / 3.0) * L.div;
    double b = 2.0 * L.aBn - third * s.b, c = 2.0 * (L.BnLBn + L.aBBn) - 2.0 * third * s.c;
    double I1 = 2.0 * L.LB - third * g.I1, trace = 4.0 * L.LBB - 2.0 * third * s.trace, I2 = g.I1 * I1 - 0.5 * trace;
    return g.G1 * (b - I1 / 3.0) - g.G2 * (c - trace / 3.0) +
           elastic_slopes_stiffen(g, I1, I2, s.b - g.I1 / 3.0, s.c - s.trace / 3.0) - L.div * s.normal;
}

/* stiff and pull of one stretch, added. slack: 1/(2 tau) of a branch, which relaxes by Dp = dev B/(2 tau): L - Dp moves
 * it. */
static BULLA_KERNEL void traction_rate_add(size_t n, double slack, double share, double to_y, double to_z,
                                           const struct traction_rate_rows *rows, double *restrict stiff,
                                           double *restrict pull)
{
    const double *const *V = rows->V, *const *G = rows->gradient;
    for (size_t i = 0; i < n; i++) { /* no vectors: few tiles hold a solid and a fluid */
        double x = rows->normal[0][i], y = rows->normal[1][i], z = rows->normal[2][i], square = x * x + y * y + z * z;
        double per = square > 0.0 ? 1.0 / square : 0.0;
        struct elastic_tensor v = {V[0][i], V[1][i], V[2][i], V[3][i], V[4][i], V[5][i]};
        struct elastic_tensor B = elastic_tensor_square(v), C = elastic_tensor_square(B);
        double div = rows->div[i], hoop = share * ((div - G[0][i]) - G[4][i]);
        double mean = rows->I1[i] / 3.0;
        double Lxx = G[0][i] + slack * (B.xx - mean), Lxy = G[1][i] + slack * B.xy, Lxz = G[2][i] + slack * B.xz;
        double Lyx = G[3][i] + slack * B.xy, Lyy = G[4][i] + to_y * hoop + slack * (B.yy - mean);
        double Lyz = G[5][i] + slack * B.yz, Lzx = G[6][i] + slack * B.xz, Lzy = G[7][i] + slack * B.yz;
        double Lzz = G[8][i] + to_z * hoop + slack * (B.zz - mean);
        double m = 2.0 * rows->rho[i], I1 = rows->I1[i], e_2 = rows->e_2[i];
        struct elastic_slopes g = {
            m * (rows->e_1[i] + I1 * e_2), m * e_2, m * rows->e_11[i], m * rows->e_12[i], m * rows->e_22[i], I1};
        double gx = B.xx * x + B.xy * y + B.xz * z, gy = B.xy * x + B.yy * y + B.yz * z,
               gz = B.xz * x + B.yz * y + B.zz * z;
        double hx = C.xx * x + C.xy * y + C.xz * z, hy = C.xy * x + C.yy * y + C.yz * z,
               hz = C.xz * x + C.yz * y + C.zz * z;
        double ax = x * Lxx + y * Lyx + z * Lzx, ay = x * Lxy + y * Lyy + z * Lzy, az = x * Lxz + y * Lyz + z * Lzz;
        struct traction_rate_state s = {.b = per * (x * gx + y * gy + z * gz),
                                        .c = per * (x * hx + y * hy + z * hz),
                                        .trace = elastic_tensor_trace(C)};
        s.normal = g.G1 * (s.b - I1 / 3.0) - g.G2 * (s.c - s.trace / 3.0);
        struct traction_rate_strain along = {1.0, s.b, s.b * s.b, s.c, s.b, s.c};
        struct traction_rate_strain given = {
            .div = div,
            .aBn = per * (ax * gx + ay * gy + az * gz),
            .BnLBn = per * (gx * (Lxx * gx + Lxy * gy + Lxz * gz) + gy * (Lyx * gx + Lyy * gy + Lyz * gz) +
                            gz * (Lzx * gx + Lzy * gy + Lzz * gz)),
            .aBBn = per * (ax * hx + ay * hy + az * hz),
            .LB = Lxx * B.xx + Lyy * B.yy + Lzz * B.zz + (Lxy + Lyx) * B.xy + (Lxz + Lzx) * B.xz + (Lyz + Lzy) * B.yz,
            .LBB = Lxx * C.xx + Lyy * C.yy + Lzz * C.zz + (Lxy + Lyx) * C.xy + (Lxz + Lzx) * C.xz + (Lyz + Lzy) * C.yz};
        double own = square * traction_rate_change(g, s, along);
        stiff[i] += own;
        pull[i] += own * div - square * traction_rate_change(g, s, given);
    }
}

static void traction_rate_look(const struct model *model, unsigned k, size_t n, size_t stride, const double *w,
                               const struct traction_strain *strain, size_t from, struct traction_rate_rows *ret)
{
    const double *V = w + model_stretch(model, k) * stride + from;
    unsigned dim = (unsigned)model->dim;
    for (unsigned c = 0; c < 6; c++) ret->V[c] = c < model->n_stretch ? V + c * stride : traction_rate_zero;
    for (unsigned d = 0; d < 3; d++)
        ret->normal[d] = d < model->n_normal ? w + (model->i_normal + d) * stride + from : traction_rate_zero;
    if (!model->n_normal) ret->normal[0] = ret->one;
    for (unsigned i = 0; i < 3; i++)
        for (unsigned d = 0; d < 3; d++)
            ret->gradient[3 * i + d] = i < model->n_velocity && d < dim
                                           ? strain->gradient + (i * dim + d) * stride + from
                                           : traction_rate_zero;
    ret->div = strain->div + from;
    elastic_invariants(model, n, stride, V, ret->I1, ret->I2);
}

/* The law of a solid at its invariants. */
static void traction_rate_ask(const struct model_solid *solid, size_t n, struct traction_rate_rows *rows)
{
    double e[TRACTION_RATE_BATCH];
    double *second[] = {rows->e_11, rows->e_12, rows->e_22};
    solid->law->energy(solid->self, n, rows->I1, rows->I2, e, rows->e_1, rows->e_2);
    for (size_t r = 0; r < 3; r++) memset(second[r], 0, n * sizeof *rows->e_11);
    if (solid->law->second) solid->law->second(solid->self, n, rows->I1, rows->I2, rows->e_11, rows->e_12, rows->e_22);
}

/* The spring of a branch: e = k (I1 - 3). */
static void traction_rate_spring(double k, size_t n, struct traction_rate_rows *rows)
{
    double *none[] = {rows->e_2, rows->e_11, rows->e_12, rows->e_22};
    for (size_t i = 0; i < n; i++) rows->e_1[i] = k;
    for (size_t r = 0; r < 4; r++) memset(none[r], 0, n * sizeof *rows->e_1);
}

static void traction_rate_batch(const struct model *model, size_t n, size_t stride, const double *w,
                                const struct traction_strain *strain, size_t from, size_t pitch, double *stiff,
                                double *pull)
{
    struct traction_rate_rows rows; /* large: filled as far as it is used */
    double left[SCENE_MATERIALS * TRACTION_RATE_BATCH], share = model->beta ? 1.0 / model->beta : 0.0;
    const double *rho[SCENE_MATERIALS];
    for (size_t i = 0; i < n; i++) rows.one[i] = 1.0;
    for (unsigned s = 0; s < model->n_solid; s++) rho[s] = w + (model->i_m + model->solids[s].material) * stride + from;
    bearing_of(model, n, stride, w + from, TRACTION_RATE_BATCH, left, rho);
    for (unsigned k = 0; k < model_stretches(model); k++) {
        unsigned s = model_bearer(model, k), l = model->solids[s].material;
        traction_rate_look(model, k, n, stride, w, strain, from, &rows);
        if (k < model->n_solid) traction_rate_ask(&model->solids[k], n, &rows);
        else traction_rate_spring(model->branches[k - model->n_solid].k, n, &rows);
        memcpy(rows.rho, rho[s], n * sizeof *rows.rho);
        double slack = k < model->n_solid ? 0.0 : 0.5 / model->branches[k - model->n_solid].time;
        traction_rate_add(n, slack, share, model->beta == 2, model->beta > 0, &rows, stiff + l * pitch,
                          pull + l * pitch);
    }
}

void traction_rate(const struct model *model, size_t n, size_t stride, const double *w,
                   const struct traction_strain *strain, size_t pitch, double *stiff, double *pull)
{
    for (unsigned l = 0; l < model->n_material; l++) {
        memset(stiff + l * pitch, 0, n * sizeof *stiff);
        memset(pull + l * pitch, 0, n * sizeof *pull);
    }
    for (size_t from = 0; from < n; from += TRACTION_RATE_BATCH) {
        size_t part = n - from < TRACTION_RATE_BATCH ? n - from : TRACTION_RATE_BATCH;
        traction_rate_batch(model, part, stride, w, strain, from, pitch, stiff + from, pull + from);
    }
}
