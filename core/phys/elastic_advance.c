/* elastic_advance.c - see elastic.h: how the stretch moves.
 *
 * d V/dt = L V holds for a deformation gradient, so M = (what the step makes of V) is not symmetric. Only B = M M^T
 * matters (model.md 2): M is turned back to V = M R^T, R the rotation in M, which in a plane is
 *     tan(angle) = (M_yx - M_xy)/(M_xx + M_yy)
 * and in space follows from (tr V 1 - V) phi = axial(M - M^T), repeated as rotations of one step are small. The trace
 * of L is taken off first. det V = 1 would take out what it scales M by, but the transport comes in between, with
 * stretches that it has not scaled: the step would be of first order in time. */
#include "phys/elastic.h"

#include "phys/elastic_tensor.h"
#include "phys/flow_relax.h"

#include <math.h>

/* A step may not shear or stretch by more than this at once: |dt L/4| is cut there (the guard's step sizes are
 * below). */
#define MOVE_MOST 0.5

/* A cell that loses solid faster than this in a step keeps its stretch the better: its change is taken per this share
 * of the mass that it had, so that a cell that empties does not blow up what it still has. */
#define MOVE_LEFT 0.5

/* Square of a slope of fractions [1/m2] that counts as none. */
#define MOVE_FLAT 1e-30

/* A general 3 x 3 matrix. */
struct move_matrix {
    double xx, xy, xz, yx, yy, yz, zx, zy, zz;
};

/* Rows of one batch: -d_k u_i at index 3 i + k (those that a scene does not have are zeros), -div u, and the
 * components of V_old, -div(V* F) and V_new. */
struct move_rows {
    const double *gradient[9], *div, *squeeze, *slope[3], *m_old, *m_new, *old[6], *carried[6];
    double *out[6];
};

static ELASTIC_BODY struct move_matrix elastic_advance_product(struct move_matrix a, struct move_matrix b)
{
    return (struct move_matrix){a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
                                a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
                                a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
                                a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
                                a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}

static ELASTIC_BODY struct move_matrix elastic_advance_general(struct elastic_tensor t)
{
    return (struct move_matrix){t.xx, t.xy, t.xz, t.xy, t.yy, t.yz, t.xz, t.yz, t.zz};
}

/* 2 (1 - A)^-1 - 1 = (1 - A)^-1 (1 + A), by cofactors, in an order that keeps the bits where x and y are exchanged. */
static ELASTIC_BODY struct move_matrix elastic_advance_cayley(struct move_matrix A)
{
    double a = 1.0 - A.xx, e = 1.0 - A.yy, i = 1.0 - A.zz, b = -A.xy, c = -A.xz, d = -A.yx, f = -A.yz, g = -A.zx,
           h = -A.zy;
    double ei = e * i - f * h, di = d * i - f * g, dh = d * h - e * g;
    double twice = 2.0 / (i * (a * e - b * d) - (a * (f * h) + e * (c * g)) + (b * (f * g) + d * (c * h)));
    return (struct move_matrix){twice * ei - 1.0, -twice * (b * i - c * h),      twice * (b * f - c * e),
                                -twice * di,      twice * (a * i - c * g) - 1.0, -twice * (a * f - c * d),
                                twice * dh,       -twice * (a * h - b * g),      twice * (a * e - b * d) - 1.0};
}

/* V = M R^T in the x-y plane; zz stands alone. Written so that mirrored and exchanged axes give mirrored bits. */
static ELASTIC_BODY struct elastic_tensor elastic_advance_polar_plane(struct move_matrix M)
{
    double t = M.xx + M.yy, s = M.yx - M.xy, per = 1.0 / sqrt(t * t + s * s), c = t * per, w = s * per;
    double xy = M.xx * w + M.xy * c, yx = M.yx * c - M.yy * w;
    return (struct elastic_tensor){M.xx * c - M.xy * w, M.yx * w + M.yy * c, M.zz, 0.5 * (xy + yx), 0.0, 0.0};
}

/* One turn towards a symmetric M: M R^T with R from (tr V 1 - V) phi = axial(M - M^T), V the symmetric part. */
static ELASTIC_BODY struct move_matrix elastic_advance_turn(struct move_matrix M)
{
    double xy = 0.5 * (M.xy + M.yx), xz = 0.5 * (M.xz + M.zx), yz = 0.5 * (M.yz + M.zy);
    double a = M.yy + M.zz, e = M.xx + M.zz, i = M.xx + M.yy, rx = M.zy - M.yz, ry = M.xz - M.zx, rz = M.yx - M.xy;
    double c_xx = e * i - yz * yz, c_xy = xy * i + yz * xz, c_xz = xy * yz + e * xz;
    double c_yy = a * i - xz * xz, c_yz = a * yz + xy * xz, c_zz = a * e - xy * xy;
    double half = 0.5 / (a * c_xx - xy * c_xy - xz * c_xz);
    double x = half * (c_xx * rx + c_xy * ry + c_xz * rz), y = half * (c_xy * rx + c_yy * ry + c_yz * rz);
    double z = half * (c_xz * rx + c_yz * ry + c_zz * rz);
    double square = x * x + y * y + z * z, per = 1.0 / (1.0 + square), diagonal = (1.0 - square) * per;
    per *= 2.0;
    struct move_matrix R = {diagonal + per * (x * x), per * (x * y - z),        per * (x * z + y),
                            per * (x * y + z),        diagonal + per * (y * y), per * (y * z - x),
                            per * (x * z - y),        per * (y * z + x),        diagonal + per * (z * z)};
    struct move_matrix back = {R.xx, R.yx, R.zx, R.xy, R.yy, R.zy, R.xz, R.yz, R.zz};
    return elastic_advance_product(M, back);
}

static ELASTIC_BODY struct elastic_tensor elastic_advance_polar(struct move_matrix M, int nv)
{
    if (nv < 2) return (struct elastic_tensor){M.xx, M.yy, M.zz, 0.0, 0.0, 0.0};
    if (nv < 3) return elastic_advance_polar_plane(M);
    M = elastic_advance_turn(elastic_advance_turn(elastic_advance_turn(M)));
    return (struct elastic_tensor){M.xx, M.yy, M.zz, 0.5 * (M.xy + M.yx), 0.5 * (M.xz + M.zx), 0.5 * (M.yz + M.zy)};
}

static ELASTIC_BODY double elastic_advance_cut(double a)
{
    a = a < MOVE_MOST ? a : MOVE_MOST;
    return a > -MOVE_MOST ? a : -MOVE_MOST;
}

/* How the hoop strain is made: its share of what div u has beyond the gradient, and whether y and z get it. */
struct move_hoop {
    double share, y, z;
};

/* n n^T of a slope times what is squeezed out across it; nothing where there is no slope. */
static ELASTIC_BODY struct elastic_tensor elastic_advance_squeeze(double amount, double x, double y, double z)
{
    double square = x * x + y * y + z * z, per = amount / (square + MOVE_FLAT);
    return (struct elastic_tensor){per * (x * x), per * (y * y), per * (z * z),
                                   per * (x * y), per * (x * z), per * (y * z)};
}

/* dt L/4 with hoop stretching. G: gradient, negative, without entries of its own where the hoop goes; Q: the
 * squeeze. */
static ELASTIC_BODY struct move_matrix elastic_advance_strain(struct move_matrix G, struct elastic_tensor Q, double div,
                                                              double quarter, struct move_hoop to, int nv)
{
    double hoop = to.share * ((div - G.xx) - G.yy), yy = G.yy + to.y * hoop, zz = G.zz + to.z * hoop;
    struct move_matrix A = {elastic_advance_cut(-quarter * (G.xx + Q.xx)),
                            nv > 1 ? elastic_advance_cut(-quarter * (G.xy + Q.xy)) : 0.0,
                            nv > 2 ? elastic_advance_cut(-quarter * (G.xz + Q.xz)) : 0.0,
                            nv > 1 ? elastic_advance_cut(-quarter * (G.yx + Q.xy)) : 0.0,
                            elastic_advance_cut(-quarter * (yy + Q.yy)),
                            nv > 2 ? elastic_advance_cut(-quarter * (G.yz + Q.yz)) : 0.0,
                            nv > 2 ? elastic_advance_cut(-quarter * (G.zx + Q.xz)) : 0.0,
                            nv > 2 ? elastic_advance_cut(-quarter * (G.zy + Q.yz)) : 0.0,
                            elastic_advance_cut(-quarter * (zz + Q.zz))};
    double mean = (1.0 / 3.0) * ((A.xx + A.yy) + A.zz);
    A.xx -= mean;
    A.yy -= mean;
    A.zz -= mean;
    return A;
}

/* What the solid mass in the cell has for a stretch after other mass came and went: a mean by mass, V + [dt come -
 * V (m_new - m_old)]/m with m = m_new, at least MOVE_LEFT m_old. */
static ELASTIC_BODY struct elastic_tensor elastic_advance_blend(struct elastic_tensor V, double keep,
                                                                struct elastic_tensor come)
{
    return (struct elastic_tensor){keep * V.xx + come.xx, keep * V.yy + come.yy, keep * V.zz + come.zz,
                                   keep * V.xy + come.xy, keep * V.xz + come.xz, keep * V.yz + come.yz};
}

/* What a kernel takes of a step: all, what comes before its middle, what comes after; the latter two with half of the
 * transport. */
enum { MOVE_WHOLE, MOVE_BEGIN, MOVE_END };

/* One point: half of the deformation, the transport, the other half. */
static ELASTIC_BODY struct elastic_tensor elastic_advance_point(struct move_matrix A, struct elastic_tensor V,
                                                                double keep, struct elastic_tensor come, int nv,
                                                                int part)
{
    struct move_matrix E = elastic_advance_cayley(A);
    if (part != MOVE_END) V = elastic_advance_polar(elastic_advance_product(E, elastic_advance_general(V)), nv);
    V = elastic_tensor_nearest(elastic_advance_blend(V, keep, come));
    if (part == MOVE_BEGIN) return V;
    return elastic_advance_polar(elastic_advance_product(E, elastic_advance_general(V)), nv);
}

/* Value of an optional row. */
#define MOVE_IF(there, row) ((there) ? (row)[(there) ? i : 0] : 0.0)

#define MOVE_KERNEL(name, nv, part)                                                                                   \
    static BULLA_KERNEL void name##_##nv(size_t n, double dt, struct move_hoop hoop, const struct move_rows *rows)    \
    {                                                                                                                 \
        const double *restrict g0 = rows->gradient[0], *restrict g1 = rows->gradient[1],                              \
                               *restrict g2 = rows->gradient[2];                                                      \
        const double *restrict g3 = rows->gradient[3], *restrict g4 = rows->gradient[4],                              \
                               *restrict g5 = rows->gradient[5];                                                      \
        const double *restrict g6 = rows->gradient[6], *restrict g7 = rows->gradient[7],                              \
                               *restrict g8 = rows->gradient[8];                                                      \
        const double *restrict o0 = rows->old[0], *restrict o1 = rows->old[1], *restrict o2 = rows->old[2];           \
        const double *restrict o3 = rows->old[3], *restrict o4 = rows->old[4], *restrict o5 = rows->old[5];           \
        const double *restrict m_old = rows->m_old, *restrict m_new = rows->m_new;                                    \
        const double *restrict c0 = rows->carried[0], *restrict c1 = rows->carried[1],                                \
                               *restrict c2 = rows->carried[2];                                                       \
        const double *restrict c3 = rows->carried[3], *restrict c4 = rows->carried[4],                                \
                               *restrict c5 = rows->carried[5];                                                       \
        double *restrict r0 = rows->out[0], *restrict r1 = rows->out[1], *restrict r2 = rows->out[2];                 \
        double *restrict r3 = rows->out[3], *restrict r4 = rows->out[4], *restrict r5 = rows->out[5];                 \
        const double *restrict q = rows->squeeze, *restrict n0 = rows->slope[0], *restrict n1 = rows->slope[1],       \
                               *restrict n2 = rows->slope[2];                                                         \
        const double *restrict div = rows->div;                                                                       \
        const double quarter = 0.25 * dt, come_in = (part) == MOVE_WHOLE ? dt : 0.5 * dt;                             \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                                            \
        {                                                                                                             \
            double d = div[i];                                                                                        \
            struct move_matrix G = {g0[i],                                                                            \
                                    MOVE_IF((nv) > 1, g1),                                                            \
                                    MOVE_IF((nv) > 2, g2),                                                            \
                                    MOVE_IF((nv) > 1, g3),                                                            \
                                    MOVE_IF((nv) > 1, g4),                                                            \
                                    MOVE_IF((nv) > 2, g5),                                                            \
                                    MOVE_IF((nv) > 2, g6),                                                            \
                                    MOVE_IF((nv) > 2, g7),                                                            \
                                    MOVE_IF((nv) > 2, g8)};                                                           \
            struct elastic_tensor old = {                                                                             \
                o0[i], o1[i], o2[i], MOVE_IF((nv) > 1, o3), MOVE_IF((nv) > 2, o4), MOVE_IF((nv) > 2, o5)};            \
            double now = m_new[i], before = m_old[i], least = MOVE_LEFT * before;                                     \
            double mass = now > least ? now : least, per = 1.0 / mass;                                                \
            per = mass > ELASTIC_NOTHING ? per : 0.0;                                                                 \
            double keep = 1.0 - (now - before) * per, take = come_in * per;                                           \
            struct elastic_tensor come = {take * c0[i],                                                               \
                                          take * c1[i],                                                               \
                                          take * c2[i],                                                               \
                                          take * MOVE_IF((nv) > 1, c3),                                               \
                                          take * MOVE_IF((nv) > 2, c4),                                               \
                                          take * MOVE_IF((nv) > 2, c5)};                                              \
            struct elastic_tensor Q =                                                                                 \
                elastic_advance_squeeze(q[i], n0[i], MOVE_IF((nv) > 1, n1), MOVE_IF((nv) > 2, n2));                   \
            struct elastic_tensor V =                                                                                 \
                elastic_advance_point(elastic_advance_strain(G, Q, d, quarter, hoop, nv), old, keep, come, nv, part); \
            r0[i] = V.xx, r1[i] = V.yy, r2[i] = V.zz;                                                                 \
            if ((nv) > 1) r3[i] = V.xy;                                                                               \
            if ((nv) > 2) r4[i] = V.xz, r5[i] = V.yz;                                                                 \
        }                                                                                                             \
    }
MOVE_KERNEL(move, 1, MOVE_WHOLE)
MOVE_KERNEL(move, 2, MOVE_WHOLE)
MOVE_KERNEL(move, 3, MOVE_WHOLE)
MOVE_KERNEL(move_begin, 1, MOVE_BEGIN)
MOVE_KERNEL(move_begin, 2, MOVE_BEGIN)
MOVE_KERNEL(move_begin, 3, MOVE_BEGIN)
MOVE_KERNEL(move_end, 1, MOVE_END)
MOVE_KERNEL(move_end, 2, MOVE_END)
MOVE_KERNEL(move_end, 3, MOVE_END)

enum { MOVE_BATCH = 512 };

static const double elastic_advance_zero[MOVE_BATCH];

/* The same with a relaxation in the middle; rows of n <= MOVE_BATCH points. What comes in is of the middle of the step,
 * has relaxed for half of it and has the other half before it: half of it comes in before the relaxation here, half
 * after. */
static void elastic_advance_relaxing(const struct model *model, size_t n, double dt, struct move_hoop hoop,
                                     double relaxes, const struct move_rows *rows)
{
    double mean[6][MOVE_BATCH], mass[MOVE_BATCH];
    struct move_rows begin = *rows, end = *rows;
    for (unsigned c = 0; c < 6; c++) end.old[c] = begin.out[c] = mean[c];
    for (size_t i = 0; i < n; i++) mass[i] = 0.5 * (rows->m_old[i] + rows->m_new[i]);
    begin.m_new = end.m_old = mass;
    ELASTIC_CHOOSE(model->n_velocity, move_begin, n, dt, hoop, &begin);
    flow_relax(model, n, MOVE_BATCH, relaxes, mean[0]);
    ELASTIC_CHOOSE(model->n_velocity, move_end, n, dt, hoop, &end);
}

void elastic_advance(const struct model *model, size_t n, size_t stride, double dt, const double *V_old,
                     const struct elastic_rates *rates, double *V_new)
{
    unsigned count = model->n_stretch, dim = (unsigned)model->dim;
    struct move_hoop hoop = {.share = model->beta ? 1.0 / model->beta : 0.0,
                             .y = model->beta == 2,
                             .z = model->beta > 0};
    for (size_t from = 0; from < n; from += MOVE_BATCH) {
        size_t part = n - from < MOVE_BATCH ? n - from : MOVE_BATCH;
        struct move_rows rows = {.div = rates->div + from, .m_old = rates->m_old + from, .m_new = rates->m_new + from};
        for (unsigned i = 0; i < 3; i++)
            for (unsigned k = 0; k < 3; k++)
                rows.gradient[3 * i + k] = i < model->n_velocity && k < dim
                                               ? rates->gradient + (i * dim + k) * stride + from
                                               : elastic_advance_zero;
        rows.squeeze = rates->squeeze ? rates->squeeze + from : elastic_advance_zero;
        for (unsigned k = 0; k < 3; k++)
            rows.slope[k] = rates->squeeze && k < dim ? rates->slope + k * stride + from : elastic_advance_zero;
        for (unsigned c = 0; c < 6; c++) {
            size_t at = (c < count ? c : 0) * stride + from;
            rows.old[c] = V_old + at;
            rows.carried[c] = rates->carried + at;
            rows.out[c] = V_new + at;
        }
        if (rates->relaxes > 0.0) elastic_advance_relaxing(model, part, dt, hoop, rates->relaxes, &rows);
        else ELASTIC_CHOOSE(model->n_velocity, move, part, dt, hoop, &rows);
    }
}
