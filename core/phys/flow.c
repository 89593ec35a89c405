/* flow.c - see flow.h.
 *
 * Most cells do not yield: a first pass only measures q. Those that do are gathered into rows without gaps, so that the
 * search is one loop over rows for all of them; cells that have arrived wait for the others. 1 - Y/q falls
 * nearly linearly with x, at small strain exactly, so that the first guess is good to the strain and a secant step
 * squares the error. */
#include "phys/flow.h"

#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/elastic_tensor.h"
#include "phys/flow_curve.h"
#include "phys/traction.h"

#include <math.h>
#include <string.h>

enum { FLOW_BATCH = 128, FLOW_ROUNDS = 60 };

/* q may differ from Y by this, relative, when the search ends; and less than FLOW_SLACK too much is not worth one: what
 * was put back stays as it is. */
#define FLOW_ENOUGH 1e-10
#define FLOW_SLACK 1e-9

/* A strength of less than this part of the stress is none: what is molten loses all but that. */
#define FLOW_MOLTEN 1e-6

/* What the strength of one solid asks for, of the cells that yield. */
struct flow_solid {
    const struct model_solid *solid;
    const struct model_eos *eos;
    double m[FLOW_BATCH];                                     /* partial density [kg/m3] */
    double left[FLOW_BATCH];                                  /* the same of one that can break, as far as it bears */
    const double *bears;                                      /* left, or m */
    double alpha[FLOW_BATCH];                                 /* of its volume, as far as it bears */
    double eps[FLOW_BATCH];                                   /* plastic strain when the step began */
    double p[FLOW_BATCH], rho[FLOW_BATCH], per_p[FLOW_BATCH]; /* own pressure, density, d(rho e)/dp */
};

/* The cells of a batch in which one solid yields. */
struct flow {
    const struct model *model;
    double dt;
    size_t n;
    size_t cell[FLOW_BATCH];
    double V[6][FLOW_BATCH];
    double I1[FLOW_BATCH], I2[FLOW_BATCH];
    double a[FLOW_BATCH], b[FLOW_BATCH], c[FLOW_BATCH]; /* 3/2 of dev B:dev B, dev B:dev B^-1, dev B^-1:dev B^-1 */
    double q0[FLOW_BATCH], r0[FLOW_BATCH];
    double x[FLOW_BATCH], g[FLOW_BATCH], x_before[FLOW_BATCH], g_before[FLOW_BATCH];
    double low[FLOW_BATCH], high[FLOW_BATCH];                                  /* the bracket; high 0: none yet */
    double E[FLOW_BATCH], first[FLOW_BATCH], r[FLOW_BATCH], grown[FLOW_BATCH]; /* at x: E, I1, r, d eps */
    double q[FLOW_BATCH], aim[FLOW_BATCH];                                     /* at x: q, and what it should be */
    double rate[FLOW_BATCH], T[FLOW_BATCH], p[FLOW_BATCH], strain[FLOW_BATCH], Y[FLOW_BATCH];
    struct flow_solid own;
};

static const double flow_zero[FLOW_BATCH];

bool flow_reads(const struct model *path)
{
    bool reads = false;
    for (unsigned s = 0; s < path->n_solid; s++)
        reads = reads || path->solids[s].needs & (BULLA_INELASTIC_PRESSURE | BULLA_INELASTIC_TEMPERATURE);
    return reads;
}

/* I1 and r = sqrt(3/2 dev B:dev B). */
#define FLOW_MEASURE(nv)                                                                                \
    static BULLA_KERNEL void flow_measure_##nv(size_t n, struct elastic_rows V, double *restrict first, \
                                               double *restrict r)                                      \
    {                                                                                                   \
        ELASTIC_LOCAL(V);                                                                               \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                              \
        {                                                                                               \
            struct elastic_tensor B = elastic_tensor_square(ELASTIC_AT(i, nv));                         \
            first[i] = elastic_tensor_trace(B);                                                         \
            r[i] = sqrt(1.5 * elastic_tensor_norm2(flow_curve_deviator(B)));                            \
        }                                                                                               \
    }
FLOW_MEASURE(1)
FLOW_MEASURE(2)
FLOW_MEASURE(3)

/* What the curve B(x) needs to know of B0. */
#define FLOW_OPEN(nv)                                                                                                  \
    static BULLA_KERNEL void flow_open_##nv(size_t n, struct elastic_rows V, double *restrict I1, double *restrict I2, \
                                            double *restrict a, double *restrict b, double *restrict c)                \
    {                                                                                                                  \
        ELASTIC_LOCAL(V);                                                                                              \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                                             \
        {                                                                                                              \
            struct elastic_tensor B = elastic_tensor_square(ELASTIC_AT(i, nv)), C = elastic_tensor_cofactors(B);       \
            struct elastic_tensor dev_B = flow_curve_deviator(B), dev_C = flow_curve_deviator(C);                      \
            I1[i] = elastic_tensor_trace(B);                                                                           \
            I2[i] = elastic_tensor_trace(C);                                                                           \
            a[i] = 1.5 * elastic_tensor_norm2(dev_B);                                                                  \
            b[i] = 1.5 * flow_curve_product(dev_B, dev_C);                                                             \
            c[i] = 1.5 * elastic_tensor_norm2(dev_C);                                                                  \
        }                                                                                                              \
    }
FLOW_OPEN(1)
FLOW_OPEN(2)
FLOW_OPEN(3)

/* The cube root of d >= 1, to round-off up to 200: Halley's method from a quotient that is good near 1. */
static ELASTIC_BODY double flow_root(double d)
{
    double y = (2.0 * d + 1.0) / (d + 2.0);
    for (int round = 0; round < 5; round++) {
        double cube = y * y * y;
        y = y * (cube + 2.0 * d) / (2.0 * cube + d);
    }
    return y;
}

/* At x: E, I1, r and the plastic strain since x = 0, the trapezium of r dx/(3 E) over s = x/(1 + x), in which the
 * integrand is constant at small strain. */
static BULLA_KERNEL void flow_curve(size_t n, const struct flow *flow, double *restrict E, double *restrict first,
                                    double *restrict r, double *restrict grown)
{
    const double *restrict I1 = flow->I1, *restrict I2 = flow->I2, *restrict x = flow->x, *restrict r0 = flow->r0;
    const double *restrict a = flow->a, *restrict b = flow->b, *restrict c = flow->c;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double t = x[i], one = I1[i], two = I2[i], past = 1.0 + t, from = r0[i];
        double cubic = 1.0 + t * (one + t * (two + t)), root = past * flow_root(cubic / (past * past * past));
        double per = 1.0 / (root * root), size = sqrt(a[i] - t * (2.0 * b[i] - c[i] * t)) * per;
        E[i] = root;
        first[i] = (one + t * (2.0 * two + 3.0 * t)) * per;
        r[i] = size;
        grown[i] = (0.5 / 3.0) * (t / past) * (from + size * (past * past) / root);
    }
}

/* The next x: a secant step if it stays in the bracket, else its middle, or farther out. Done cells stay. */
static BULLA_KERNEL void flow_secant(size_t n, double halve, struct flow *flow)
{
    double *restrict x = flow->x, *restrict g = flow->g, *restrict x_before = flow->x_before;
    double *restrict g_before = flow->g_before, *restrict low = flow->low, *restrict high = flow->high;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double at = x[i], value = g[i], was = x_before[i], had = g_before[i], l = low[i], h = high[i];
        double size = value < 0.0 ? -value : value;
        l = value < 0.0 ? at : l;
        h = value < 0.0 ? h : at;
        double middle = h > 0.0 ? 0.5 * (l + h) : 2.0 * at + 1e-6, next = at - value * (at - was) / (value - had);
        double top = h > 0.0 ? h : 8.0 * at + 1.0;
        next = next > l ? next : middle;
        next = next < top ? next : middle;
        next = halve > 0.0 ? middle : next;
        x[i] = size > FLOW_ENOUGH ? next : at;
        x_before[i] = at;
        g_before[i] = value;
        low[i] = l;
        high[i] = h;
    }
}

#define FLOW_CLOSE(nv)                                                                                    \
    static BULLA_KERNEL void flow_close_##nv(size_t n, struct elastic_rows V, const struct flow *flow,    \
                                             double(*out)[FLOW_BATCH])                                    \
    {                                                                                                     \
        const double *restrict x = flow->x, *restrict E = flow->E, *restrict I2 = flow->I2;               \
        double *restrict xx = out[0], *restrict yy = out[1], *restrict zz = out[2];                       \
        double *restrict xy = out[3], *restrict xz = out[4], *restrict yz = out[5];                       \
        ELASTIC_LOCAL(V);                                                                                 \
        _Pragma("omp simd") for (size_t i = 0; i < n; i++)                                                \
        {                                                                                                 \
            double t = x[i], per = 1.0 / (E[i] * E[i]), add = t * (I2[i] + t);                            \
            struct elastic_tensor from = ELASTIC_AT(i, nv), B = elastic_tensor_square(from);              \
            struct elastic_tensor C = elastic_tensor_cofactors(B);                                        \
            B = (struct elastic_tensor){per * ((B.xx - t * C.xx) + add), per * ((B.yy - t * C.yy) + add), \
                                        per * ((B.zz - t * C.zz) + add), per * (B.xy - t * C.xy),         \
                                        per * (B.xz - t * C.xz),         per * (B.yz - t * C.yz)};        \
            from = (nv) == 1   ? flow_curve_root_line(B)                                                  \
                   : (nv) == 2 ? flow_curve_root_plane(B)                                                 \
                               : flow_curve_root_space(from, B, 1.0 / (1.0 + t));                         \
            xx[i] = from.xx;                                                                              \
            yy[i] = from.yy;                                                                              \
            zz[i] = from.zz;                                                                              \
            if ((nv) > 1) xy[i] = from.xy;                                                                \
            if ((nv) > 2) xz[i] = from.xz;                                                                \
            if ((nv) > 2) yz[i] = from.yz;                                                                \
        }                                                                                                 \
    }
FLOW_CLOSE(1)
FLOW_CLOSE(2)
FLOW_CLOSE(3)

/* sum += alpha Y */
static BULLA_KERNEL void flow_bear(size_t n, const double *restrict alpha, const double *restrict Y,
                                   double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = sum[i];
        sum[i] = s + alpha[i] * Y[i];
    }
}

/* A of a solid at I1; m: its partial densities. */
static void flow_moduli(const struct model_solid *solid, size_t n, const double *first, const double *m, double *A)
{
    double e[FLOW_BATCH], e_1[FLOW_BATCH], e_2[FLOW_BATCH];
    solid->law->energy(solid->self, n, first, first, e, e_1, e_2);
    for (size_t i = 0; i < n; i++) A[i] = 2.0 * m[i] * e_1[i];
}

/* The strength of one solid at its strain, rate, pressure, density; rows of n. T: room for n. */
static void flow_ask(const struct model_solid *solid, const struct model_eos *eos, size_t n, const double *const at[4],
                     double *T, double *Y)
{
    unsigned needs = solid->needs;
    bool thermal = needs & BULLA_INELASTIC_TEMPERATURE,
         pressed = needs & (BULLA_INELASTIC_PRESSURE | BULLA_INELASTIC_TEMPERATURE);
    if (thermal) eos->law->temperature(eos->self, n, at[3], at[2], T);
    solid->strength->strength(solid->strength_self, n, needs & BULLA_INELASTIC_STRAIN ? at[0] : flow_zero,
                              needs & BULLA_INELASTIC_RATE ? at[1] : flow_zero, pressed ? at[2] : flow_zero,
                              thermal ? T : flow_zero, pressed ? at[3] : flow_zero, Y);
}

/* The strength of the solid when it has flowed by `grown` in this step, and kept the heat of that. */
static void flow_bearing(struct flow *flow)
{
    struct flow_solid *own = &flow->own;
    const struct model_solid *solid = own->solid;
    const double *const at[4] = {flow->strain, flow->rate, flow->p, own->rho};
    size_t n = flow->n;
    for (size_t i = 0; solid->needs & BULLA_INELASTIC_STRAIN && i < n; i++)
        flow->strain[i] = own->eps[i] + flow->grown[i];
    for (size_t i = 0; solid->needs & BULLA_INELASTIC_RATE && i < n; i++) flow->rate[i] = flow->grown[i] / flow->dt;
    for (size_t i = 0; solid->needs & (BULLA_INELASTIC_PRESSURE | BULLA_INELASTIC_TEMPERATURE) && i < n; i++)
        flow->p[i] = own->p[i] + 0.5 * (flow->q0[i] + flow->q[i]) * flow->grown[i] / own->per_p[i];
    flow_ask(solid, own->eos, n, at, flow->T, flow->Y);
}

/* aim: what q should be after `grown`. */
static void flow_aim(struct flow *flow)
{
    flow_bearing(flow);
    for (size_t i = 0; i < flow->n; i++) {
        double least = FLOW_MOLTEN * flow->q0[i], aim = flow->own.alpha[i] * flow->Y[i];
        flow->aim[i] = aim > least ? aim : least;
    }
}

/* g = aim/q - 1 at x; returns the largest |g|. */
static double flow_miss(struct flow *flow)
{
    double A[FLOW_BATCH], most = 0.0;
    size_t n = flow->n;
    flow_curve(n, flow, flow->E, flow->first, flow->r, flow->grown);
    flow_moduli(flow->own.solid, n, flow->first, flow->own.bears, A);
    for (size_t i = 0; i < n; i++) flow->q[i] = A[i] * flow->r[i];
    flow_aim(flow);
    for (size_t i = 0; i < n; i++) {
        flow->g[i] = flow->aim[i] / flow->q[i] - 1.0;
        double size = fabs(flow->g[i]);
        most = size > most ? size : most;
    }
    return most;
}

/* Brings all cells to their strength. */
static void flow_search(struct flow *flow)
{
    for (size_t i = 0; i < flow->n; i++) {
        flow->g_before[i] = flow->aim[i] / flow->q0[i] - 1.0;
        flow->x_before[i] = flow->low[i] = flow->high[i] = 0.0;
        flow->x[i] = flow->q0[i] / flow->aim[i] - 1.0;
    }
    for (int round = 1; round <= FLOW_ROUNDS && flow_miss(flow) > FLOW_ENOUGH; round++)
        flow_secant(flow->n, round % 6 == 0 ? 1.0 : 0.0, flow);
}

/* Row of the cells that yield. */
static void flow_gather(const struct flow *flow, const double *row, double *ret)
{
    for (size_t i = 0; i < flow->n; i++) ret[i] = row[flow->cell[i]];
}

/* amount/m, at least 0; 0 where there is nothing of the solid. */
static double flow_part(double amount, double m)
{
    return m > ELASTIC_NOTHING && amount > 0.0 ? amount / m : 0.0;
}

/* What the strength of a solid looks at, but for its plastic strain. */
static void flow_gather_state(struct flow *flow, size_t n, size_t stride, const double *w, struct flow_solid *own)
{
    const struct model *model = flow->model;
    struct traction_pressures parts;
    double none[FLOW_BATCH];
    unsigned l = own->solid->material;
    if (!(own->solid->needs & (BULLA_INELASTIC_PRESSURE | BULLA_INELASTIC_TEMPERATURE))) return;
    traction_part(model, n, stride, w, &parts);
    flow_gather(flow, traction_pressure(model, n, l, w + model->i_E * stride, &parts), own->p);
    flow_gather(flow, w + (model->i_m + l) * stride, own->rho);
    own->eos->law->derivatives(own->eos->self, flow->n, own->rho, own->p, own->per_p, none);
}

/* What bears of a solid that can break. */
static void flow_weaken(const struct flow *flow, size_t stride, const double *u, struct flow_solid *own)
{
    const struct model_damage *damage = &own->solid->damage;
    own->bears = damage->law ? own->left : own->m;
    for (size_t i = 0; damage->law && i < flow->n; i++) {
        double part = bearing_part(flow_part(u[damage->field * stride + flow->cell[i]], own->m[i]));
        own->left[i] = part * own->m[i];
        own->alpha[i] *= part;
    }
}

static void flow_gather_solid(struct flow *flow, size_t n, size_t stride, const double *w, const double *u)
{
    const struct model *model = flow->model;
    struct flow_solid *own = &flow->own;
    unsigned l = own->solid->material;
    flow_gather(flow, u + (model->i_m + l) * stride, own->m);
    if (model->n_alpha) flow_gather(flow, u + (model->i_alpha + l) * stride, own->alpha);
    for (size_t i = 0; !model->n_alpha && i < flow->n; i++) own->alpha[i] = 1.0;
    flow_weaken(flow, stride, u, own);
    if (own->solid->strain)
        for (size_t i = 0; i < flow->n; i++)
            own->eps[i] = flow_part(u[own->solid->strain * stride + flow->cell[i]], own->m[i]);
    flow_gather_state(flow, n, stride, w, own);
}

/* The stretches of the cells that yield, put back, and what their strain has grown by: also into `grown`, if any. */
static void flow_scatter(struct flow *flow, size_t stride, double *u, double *grown)
{
    const struct model *model = flow->model;
    struct elastic_rows rows = elastic_tensor_rows(flow->V[0], FLOW_BATCH, model->n_stretch);
    double out[6][FLOW_BATCH], *V = u + flow->own.solid->stretch * stride,
                               *amount = u + flow->own.solid->strain * stride;
    ELASTIC_CHOOSE(model->n_velocity, flow_close, flow->n, rows, flow, out);
    elastic_unimodular(model, flow->n, FLOW_BATCH, out[0]);
    for (unsigned c = 0; c < model->n_stretch; c++)
        for (size_t i = 0; i < flow->n; i++) V[c * stride + flow->cell[i]] = out[c][i];
    for (size_t i = 0; grown && i < flow->n; i++) grown[flow->cell[i]] = flow->grown[i];
    for (size_t i = 0; flow->own.solid->strain && i < flow->n; i++)
        amount[flow->cell[i]] += flow->own.m[i] * flow->grown[i];
}

/* The cells of a batch in which the stress of the solid is beyond its strength. */
static void flow_find(struct flow *flow, size_t n, size_t stride, const double *w, const double *u)
{
    const struct model *model = flow->model;
    const struct model_solid *solid = flow->own.solid;
    double first[FLOW_BATCH], r[FLOW_BATCH], A[FLOW_BATCH];
    struct elastic_rows rows = elastic_tensor_rows(u + solid->stretch * stride, stride, model->n_stretch);
    ELASTIC_CHOOSE(model->n_velocity, flow_measure, n, rows, first, r);
    flow->n = n;
    for (size_t i = 0; i < n; i++) flow->cell[i] = i;
    flow_gather_solid(flow, n, stride, w, u);
    flow_moduli(solid, n, first, flow->own.bears, A);
    for (size_t i = 0; i < n; i++) {
        flow->q0[i] = flow->q[i] = A[i] * r[i];
        flow->r0[i] = r[i];
        flow->grown[i] = 0.0;
    }
    flow_aim(flow);
}

/* Drops the cells that do not yield. */
static void flow_select(struct flow *flow)
{
    size_t kept = 0;
    for (size_t i = 0; i < flow->n; i++) {
        if (!(flow->q0[i] > flow->aim[i] * (1.0 + FLOW_SLACK))) continue;
        flow->cell[kept] = flow->cell[i];
        flow->aim[kept] = flow->aim[i];
        flow->r0[kept] = flow->r0[i];
        flow->q0[kept++] = flow->q0[i];
    }
    flow->n = kept;
}

static void flow_batch(struct flow *flow, size_t n, size_t stride, const double *w, double *u, double *grown)
{
    const struct model *model = flow->model;
    flow_find(flow, n, stride, w, u);
    flow_select(flow);
    if (!flow->n) return;
    const double *V = u + flow->own.solid->stretch * stride;
    if (flow->n < n) flow_gather_solid(flow, n, stride, w, u);
    for (unsigned c = 0; c < model->n_stretch; c++) flow_gather(flow, V + c * stride, flow->V[c]);
    struct elastic_rows rows = elastic_tensor_rows(flow->V[0], FLOW_BATCH, model->n_stretch);
    ELASTIC_CHOOSE(model->n_velocity, flow_open, flow->n, rows, flow->I1, flow->I2, flow->a, flow->b, flow->c);
    flow_search(flow);
    flow_scatter(flow, stride, u, grown);
}

void flow_return(const struct model *model, size_t n, size_t stride, double dt, const double *w, double *u,
                 double *grown)
{
    struct flow flow; /* large: filled as far as it is used */
    flow.model = model;
    flow.dt = dt;
    for (unsigned s = 0; s < model->n_solid; s++) {
        double *own = grown ? grown + s * stride : NULL;
        if (!model->solids[s].strength) continue;
        flow.own.solid = &model->solids[s];
        flow.own.eos = &model->eos[model->solids[s].material];
        for (size_t from = 0; from < n; from += FLOW_BATCH)
            flow_batch(&flow, n - from < FLOW_BATCH ? n - from : FLOW_BATCH, stride, w + from, u + from,
                       own ? own + from : NULL);
    }
}

void flow_strength(const struct model *model, size_t n, size_t stride, const double *w, double *ret)
{
    struct traction_pressures parts;
    double T[FLOW_BATCH], Y[FLOW_BATCH], alpha[FLOW_BATCH];
    memset(ret, 0, n * sizeof *ret);
    for (size_t from = 0; from < n; from += FLOW_BATCH) {
        size_t part = n - from < FLOW_BATCH ? n - from : FLOW_BATCH;
        const double *here = w + from;
        traction_part(model, part, stride, here, &parts);
        for (unsigned s = 0; s < model->n_solid; s++) {
            const struct model_solid *solid = &model->solids[s];
            unsigned l = solid->material;
            if (!solid->strength) continue;
            const double *const at[4] = {here + solid->strain * stride, flow_zero,
                                         traction_pressure(model, part, l, here + model->i_E * stride, &parts),
                                         here + (model->i_m + l) * stride};
            flow_ask(solid, &model->eos[l], part, at, T, Y);
            for (size_t i = 0; i < part; i++) alpha[i] = model->n_alpha ? here[(model->i_alpha + l) * stride + i] : 1.0;
            for (size_t i = 0; solid->damage.law && i < part; i++)
                alpha[i] *= bearing_part(here[solid->damage.field * stride + i]);
            flow_bear(part, alpha, Y, ret + from);
        }
    }
}
