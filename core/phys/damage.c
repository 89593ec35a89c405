/* damage.c - see damage.h. Laws are asked of the undamaged material: its stress and energy are those of the solid's
 * whole mass, per its own volume. */
#include "phys/damage.h"

#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/elastic_tensor.h"
#include "phys/traction.h"

#include <math.h>
#include <string.h>

enum damage_row {
    ROW_DAMAGE,
    ROW_TENSION,
    ROW_PRINCIPAL,
    ROW_STRETCH,
    ROW_ENERGY,
    ROW_MISES,
    ROW_STRAIN,
    ROW_RATE,
    ROW_WARM
};

static const double damage_zero[DAMAGE_BATCH];

/* The largest eigenvalue of a symmetric tensor, by the angle of its deviator (Smith, Commun. ACM 4 (1961) 168). */
static ELASTIC_BODY double damage_largest(struct elastic_tensor t)
{
    double mean = elastic_tensor_trace(t) / 3.0;
    struct elastic_tensor s = {t.xx - mean, t.yy - mean, t.zz - mean, t.xy, t.xz, t.yz};
    double r = sqrt(elastic_tensor_norm2(s) / 6.0), c = elastic_tensor_det(s) / (2.0 * r * r * r);
    c = c > 1.0 ? 1.0 : c;
    c = c < -1.0 ? -1.0 : c;
    return r > 1e-100 ? mean + 2.0 * r * cos(acos(c) / 3.0) : mean;
}

/* The tensor of point i of a batch: of a model with fewer components the others are 0. */
static struct elastic_tensor damage_tensor(const struct model *model, const double *block, size_t i)
{
    double c[6] = {0};
    for (unsigned k = 0; k < model->n_stretch; k++) c[k] = block[k * DAMAGE_BATCH + i];
    return (struct elastic_tensor){c[0], c[1], c[2], c[3], c[4], c[5]};
}

/* Stress and energy of the whole solid s alone, per its own volume. V: the stretches, m: rows of masses of which all
 * but this one are 0. */
static void damage_stress(const struct model *model, unsigned needs, size_t n, const double *V, const double *const *m,
                          double (*ret)[DAMAGE_BATCH])
{
    double stress[6][DAMAGE_BATCH];
    if (needs & BULLA_DAMAGE_ENERGY) elastic_energy(model, n, DAMAGE_BATCH, V, m, ret[ROW_ENERGY]);
    if (!(needs & (BULLA_DAMAGE_PRINCIPAL | BULLA_DAMAGE_MISES))) return;
    elastic_stress(model, n, DAMAGE_BATCH, V, m, stress[0]);
    for (size_t i = 0; i < n; i++) {
        struct elastic_tensor dev = damage_tensor(model, stress[0], i);
        if (needs & BULLA_DAMAGE_MISES) ret[ROW_MISES][i] = sqrt(1.5 * elastic_tensor_norm2(dev));
        if (needs & BULLA_DAMAGE_PRINCIPAL) ret[ROW_PRINCIPAL][i] = ret[ROW_TENSION][i] + damage_largest(dev);
    }
}

/* What the elastic law feels. */
static void damage_pull(const struct model *model, unsigned s, size_t n, size_t stride, const double *w,
                        double (*ret)[DAMAGE_BATCH])
{
    unsigned needs = model->solids[s].damage.needs;
    double V[6 * MODEL_STRETCHES][DAMAGE_BATCH];
    const double *m[SCENE_MATERIALS];
    for (unsigned c = 0; c < model->n_stretched; c++) memcpy(V[c], w + (model->i_V + c) * stride, n * sizeof(double));
    for (unsigned k = 0; k < model->n_solid; k++) m[k] = damage_zero;
    m[s] = w + (model->i_m + model->solids[s].material) * stride;
    damage_stress(model, needs, n, V[0], m, ret);
    for (size_t i = 0; needs & BULLA_DAMAGE_STRETCH && i < n; i++)
        ret[ROW_STRETCH][i] = damage_largest(damage_tensor(model, V[elastic_block(model, s, 1)], i));
}

void damage_look(const struct model *model, unsigned s, size_t n, size_t stride, double dt, const double *w,
                 const double *grown, double (*ret)[DAMAGE_BATCH])
{
    const struct model_solid *solid = &model->solids[s];
    const struct model_eos *eos = &model->eos[solid->material];
    struct traction_pressures parts;
    unsigned needs = solid->damage.needs;
    for (int k = 0; k < DAMAGE_ROWS; k++) memset(ret[k], 0, n * sizeof(double));
    memcpy(ret[ROW_DAMAGE], w + solid->damage.field * stride, n * sizeof(double));
    traction_part(model, n, stride, w, &parts);
    const double *p = traction_pressure(model, n, solid->material, w + model->i_E * stride, &parts);
    const double *rho = w + (model->i_m + solid->material) * stride;
    if (needs & (BULLA_DAMAGE_TENSION | BULLA_DAMAGE_PRINCIPAL))
        for (size_t i = 0; i < n; i++) ret[ROW_TENSION][i] = -p[i];
    if (needs & BULLA_DAMAGE_TEMPERATURE) eos->law->temperature(eos->self, n, rho, p, ret[ROW_WARM]);
    if (needs & (BULLA_DAMAGE_STRETCH | BULLA_DAMAGE_ENERGY | BULLA_DAMAGE_PRINCIPAL | BULLA_DAMAGE_MISES))
        damage_pull(model, s, n, stride, w, ret);
    if (needs & BULLA_DAMAGE_STRAIN) memcpy(ret[ROW_STRAIN], w + solid->strain * stride, n * sizeof(double));
    for (size_t i = 0; needs & BULLA_DAMAGE_RATE && grown && dt > 0.0 && i < n; i++) ret[ROW_RATE][i] = grown[i] / dt;
    if (!(needs & BULLA_DAMAGE_TENSION)) memset(ret[ROW_TENSION], 0, n * sizeof(double));
}

/* m D after dt; those who break no further keep their bits. */
static BULLA_KERNEL void damage_step(size_t n, double dt, double fastest, const double *restrict m,
                                     const double *restrict D, const double *restrict aim, const double *restrict rate,
                                     double *restrict amount)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double mass = m[i], was = amount[i], here = D[i], to = aim[i], r = rate[i];
        r = r < fastest ? r : fastest;
        double most = here + dt * r, then = to < most ? to : most;
        double now = then > here ? then * mass : was;
        now = now < (1.0 - DAMAGE_NEARLY) * mass ? now : mass;
        amount[i] = mass > ELASTIC_NOTHING ? now : was;
    }
}

/* Does a batch hold any of it? */
static bool damage_any(size_t n, const double *m)
{
    double most = 0.0;
    for (size_t i = 0; i < n; i++) most = m[i] > most ? m[i] : most;
    return most > ELASTIC_NOTHING;
}

static void damage_batch(const struct model *model, unsigned s, size_t n, size_t stride, double dt, const double *w,
                         const double *grown, double *u)
{
    const struct model_damage *damage = &model->solids[s].damage;
    const double *m = u + (model->i_m + model->solids[s].material) * stride;
    double rows[DAMAGE_ROWS][DAMAGE_BATCH], aim[DAMAGE_BATCH], rate[DAMAGE_BATCH];
    const struct bulla_damage_state state = {sizeof state,        rows[ROW_DAMAGE],  rows[ROW_TENSION],
                                             rows[ROW_PRINCIPAL], rows[ROW_STRETCH], rows[ROW_ENERGY],
                                             rows[ROW_MISES],     rows[ROW_STRAIN],  rows[ROW_RATE],
                                             rows[ROW_WARM]};
    if (!damage_any(n, m)) return;
    damage_look(model, s, n, stride, dt, w, grown, rows);
    damage->law->grow(damage->self, n, &state, aim, rate);
    damage_step(n, dt, damage->time > 0.0 ? 1.0 / damage->time : HUGE_VAL, m, rows[ROW_DAMAGE], aim, rate,
                u + damage->field * stride);
}

/* Does no solid of a cell bear stretch k any more, though one has? */
static bool damage_gone(const struct model *model, unsigned k, size_t stride, const double *u)
{
    bool broken = false, bears = false;
    for (unsigned s = 0; s < model->n_solid; s++) {
        const struct model_solid *solid = &model->solids[s];
        double m = u[(model->i_m + solid->material) * stride];
        if (!model_carries(model, k, s) || !(m > ELASTIC_NOTHING)) continue;
        bool gone = solid->damage.law && u[solid->damage.field * stride] >= m;
        broken = broken || gone;
        bears = bears || !gone;
    }
    return broken && !bears;
}

void damage_grow(const struct model *model, size_t n, size_t stride, double dt, const double *w, const double *grown,
                 double *u)
{
    for (size_t from = 0; from < n; from += DAMAGE_BATCH)
        for (unsigned s = 0; s < model->n_solid; s++)
            if (model->solids[s].damage.law)
                damage_batch(model, s, n - from < DAMAGE_BATCH ? n - from : DAMAGE_BATCH, stride, dt, w + from,
                             grown ? grown + s * stride + from : NULL, u + from);
    for (unsigned k = 0; k < model_stretches(model); k++)
        for (size_t i = 0; i < n; i++)
            if (damage_gone(model, k, stride, u + i))
                elastic_identity(model, 1, stride, u + i + model_stretch(model, k) * stride);
}
