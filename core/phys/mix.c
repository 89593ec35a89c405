/* mix.c - the mixture of N materials at one pressure and velocity, see mix.h.
 *
 * Batches of MIX_BATCH points keep the scratch arrays in L1. Loops run over points inside and
 * materials outside; each is a function of its own so that it is built for several instruction
 * sets. Densities of absent materials are the fill value: every law can then be called on every
 * point, and its weight alpha_l = 0 removes it. */
#include "phys/mix.h"

#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/present.h"
#include "phys/row.h"
#include "phys/traction.h"

#include <math.h>
#include <string.h>

enum { MIX_BATCH = MIX_PRESSURE_BATCH };

struct mix_row {
    double value[MIX_BATCH];
};

/* Sums start here: only the points in use are cleared. */
static void mix_zero(size_t n, struct mix_row *row)
{
    memset(row->value, 0, n * sizeof *row->value);
}

/* Below this a volume fraction is noise: it counts as 0 even where energies are added up. */
#define MIX_NOTHING 1e-20

/* alpha_l' = alpha_l above `least`, else 0 (and also 0 where mass is asked for and there is none); the sum of them. */
static BULLA_KERNEL void mix_keep(size_t n, double least, double least_mass, const double *restrict alpha,
                                  const double *restrict m, double *restrict kept, double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], mass = m[i], s = sum[i];
        double keep = a > least ? a : 0.0;
        keep = mass > least_mass ? keep : 0.0;
        kept[i] = keep;
        sum[i] = s + keep;
    }
}

/* Number of points at which what energies see and what fluxes see of a material differs. */
static BULLA_KERNEL double mix_count_traces(size_t n, const double *restrict alpha, const double *restrict m)
{
    double count = 0.0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], mass = m[i];
        double trace = a <= MIX_ABSENT ? 1.0 : 0.0;
        trace = mass > 0.0 ? trace : 1.0;
        count += a > MIX_NOTHING ? trace : 0.0;
    }
    return count;
}

static BULLA_KERNEL void mix_invert(size_t n, double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) sum[i] = 1.0 / sum[i];
}

/* rho_l = m_l / alpha_l, alpha normalised to sum 1; the fill density where there is no material or no mass. */
static BULLA_KERNEL void mix_densities(size_t n, const double *restrict m, const double *restrict per_sum, double fill,
                                       double *restrict alpha, double *restrict rho)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i] * per_sum[i], mass = m[i];
        double divisor = a > 0.0 ? a : 1.0, density = mass / divisor;
        density = a > 0.0 ? density : fill;
        alpha[i] = a;
        rho[i] = mass > 0.0 ? density : fill;
    }
}

/* u = momentum / rho, and twice the kinetic energy. */
static BULLA_KERNEL void mix_velocity(size_t n, const double *restrict momentum, const double *restrict rho,
                                      double *restrict u, double *restrict twice)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double q = momentum[i], v = q / rho[i];
        u[i] = v;
        twice[i] += q * v;
    }
}

/* rho e = rho E - rho |u|^2/2. */
static BULLA_KERNEL void mix_internal(size_t n, const double *restrict energy, const double *restrict twice,
                                      double *restrict rho_e)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) rho_e[i] = energy[i] - 0.5 * twice[i];
}

/* Fractions above `least` with more than `least_mass`, at sum 1, and the densities that follow. */
static void mix_fractions(const struct model *model, size_t n, size_t stride, const double *u, double least,
                          double least_mass, double *w)
{
    struct mix_row sum;
    mix_zero(n, &sum);
    for (unsigned l = 0; l < model->n_alpha; l++)
        mix_keep(n, least, least_mass, u + (model->i_alpha + l) * stride, u + (model->i_m + l) * stride,
                 w + (model->i_alpha + l) * stride, sum.value);
    mix_invert(n, sum.value);
    for (unsigned l = 0; l < model->n_alpha; l++)
        mix_densities(n, u + (model->i_m + l) * stride, sum.value, model->eos[l].rho_fill,
                      w + (model->i_alpha + l) * stride, w + (model->i_m + l) * stride);
}

/* Rows of the partial densities of the solids in a conserved block. */
static void mix_solids(const struct model *model, size_t stride, const double *u, const double **ret_m)
{
    for (unsigned s = 0; s < model->n_solid; s++) ret_m[s] = u + (model->i_m + model->solids[s].material) * stride;
}

static BULLA_KERNEL void mix_subtract(size_t n, const double *restrict a, const double *restrict b,
                                      double *restrict rest)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) rest[i] = a[i] - b[i];
}

/* Normals and curvatures are what they are in both. Slants are made in the primitives alone, afterwards
 * (scheme/slant.h): conserved fields carry none from stage to stage, so that averages, births and checkpoints do not
 * see them. */
static void mix_renewed(const struct model *model, size_t n, size_t stride, const double *from, double *to)
{
    for (unsigned d = model->i_normal; d < model->i_normal + model->n_normal; d++)
        memcpy(to + d * stride, from + d * stride, n * sizeof *to);
    for (unsigned d = model->i_slant; d < model->i_slant + model->n_slant; d++)
        memset(to + d * stride, 0, n * sizeof *to);
    for (unsigned k = 0; k < model->n_pair; k++)
        memcpy(to + model->pairs[k].i_kappa * stride, from + model->pairs[k].i_kappa * stride, n * sizeof *to);
}

/* eps = m eps/m, at most `most`; 0 where there is nothing of the solid. */
static BULLA_KERNEL void mix_strain(size_t n, double most, const double *restrict amount, const double *restrict m,
                                    double *restrict eps)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double mass = m[i], value = amount[i] / mass;
        value = value > most ? most : value;
        eps[i] = mass > ELASTIC_NOTHING ? value : 0.0;
    }
}

/* What the solids remember: plastic strains and damage. */
static void mix_strains(const struct model *model, size_t n, size_t stride, const double *u, double *w)
{
    for (unsigned k = 0; k < model->n_memory; k++) {
        const struct model_memory *memory = &model->memories[k];
        unsigned q = memory->field, l = model->i_m + model->solids[memory->solid].material;
        mix_strain(n, memory->most, u + q * stride, u + l * stride, w + q * stride);
    }
}

/* Stretches are primitives as they are; total energy without the elastic one. */
static void mix_unload(const struct model *model, size_t n, size_t stride, const double *u, double *w,
                       struct mix_row *ret_rest)
{
    struct mix_row elastic, left[SCENE_MATERIALS];
    const double *m[SCENE_MATERIALS];
    mix_solids(model, stride, u, m);
    mix_strains(model, n, stride, u, w);
    bearing_of_conserved(model, n, stride, u, MIX_BATCH, left->value, m);
    for (unsigned i = model_drawn(model); i < model_edged(model); i++)
        memcpy(w + model->active[i] * stride, u + model->active[i] * stride, n * sizeof *w);
    elastic_energy(model, n, stride, u + model->i_V * stride, m, elastic.value);
    mix_subtract(n, u + model->i_E * stride, elastic.value, ret_rest->value);
}

/* What the closure has left of the volume of a trace may be far less than what there is of its mass: compressed to 1e10
 * kg/m3, it would outweigh all the rest. Traces denser than their law states count with the greatest density that it
 * does, in the volume that their mass then takes. */
static BULLA_KERNEL void mix_settle(size_t n, double most, const double *restrict m, double *restrict alpha,
                                    double *restrict rho)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], density = rho[i], room = m[i] / most;
        double dense = density > most ? 1.0 : 0.0;
        dense = a <= MIX_ABSENT ? dense : 0.0;
        dense = a > 0.0 ? dense : 0.0;
        alpha[i] = dense > 0.0 ? room : a;
        rho[i] = dense > 0.0 ? most : density;
    }
}

/* The pressure is closed with all there is of every material, since the conserved energy holds it: a trace
 * of 1e-12 of water weighs 1e-3 J/m3. Only then traces are dropped from what fluxes will see. */
static struct mix_effort mix_primitives_batch(const struct model *model, size_t n, size_t stride, const double *u,
                                              double *w)
{
    struct mix_row rho, twice, rho_e;
    mix_zero(n, &rho);
    mix_zero(n, &twice);
    unsigned i_m = model->i_m;
    double traces = 0.0;
    for (unsigned l = 0; l < model->n_material; l++) row_add(n, u + (i_m + l) * stride, rho.value);
    if (model->n_alpha) mix_fractions(model, n, stride, u, MIX_NOTHING, -HUGE_VAL, w);
    else memcpy(w + i_m * stride, u + i_m * stride, n * sizeof *w);
    for (unsigned l = 0; l < model->n_alpha; l++)
        traces += mix_count_traces(n, u + (model->i_alpha + l) * stride, u + (i_m + l) * stride);
    for (unsigned l = 0; l < model->n_alpha && traces > 0.0; l++)
        mix_settle(n, model->eos[l].rho_most, u + (i_m + l) * stride, w + (model->i_alpha + l) * stride,
                   w + (i_m + l) * stride);
    for (unsigned q = model->i_u; q < model->i_E; q++) {
        mix_velocity(n, u + q * stride, rho.value, w + q * stride, twice.value);
    }
    const double *energy = u + model->i_E * stride;
    struct mix_row rest;
    if (model->n_stretch) {
        mix_unload(model, n, stride, u, w, &rest);
        energy = rest.value;
    }
    mix_internal(n, energy, twice.value, rho_e.value);
    mix_renewed(model, n, stride, u, w);
    struct mix_effort effort = mix_pressure_close(model, n, stride, rho_e.value, w);
    if (traces > 0.0) mix_fractions(model, n, stride, u, MIX_ABSENT, 0.0, w);
    return effort;
}

struct mix_effort mix_primitives(const struct model *model, size_t n, size_t stride, const double *u, double *w)
{
    struct mix_effort effort = {0};
    for (size_t i = 0; i < n; i += MIX_BATCH)
        mix_pressure_sum(&effort,
                         mix_primitives_batch(model, n - i < MIX_BATCH ? n - i : MIX_BATCH, stride, u + i, w + i));
    return effort;
}

/* Copies stretches and adds the elastic energy; u has its partial densities. */
static void mix_load(const struct model *model, size_t n, size_t stride, const double *w, double *u, double *energy)
{
    struct mix_row elastic, left[SCENE_MATERIALS];
    const double *m[SCENE_MATERIALS];
    mix_solids(model, stride, u, m);
    for (unsigned k = 0; k < model->n_memory; k++) {
        size_t at = model->memories[k].field * stride;
        for (size_t i = 0; i < n; i++) u[at + i] = m[model->memories[k].solid][i] * w[at + i];
    }
    bearing_of(model, n, stride, w, MIX_BATCH, left->value, m);
    for (unsigned i = model_drawn(model); i < model_edged(model); i++)
        memcpy(u + model->active[i] * stride, w + model->active[i] * stride, n * sizeof *u);
    elastic_energy(model, n, stride, w + model->i_V * stride, m, elastic.value);
    row_add(n, elastic.value, energy);
}

static void mix_conserved_batch(const struct model *model, size_t n, size_t stride, const double *w, double *u)
{
    struct mix_row rho, energy, e, c2;
    struct traction_pressures parts;
    traction_part(model, n, stride, w, &parts);
    mix_zero(n, &rho);
    mix_zero(n, &energy);
    for (unsigned l = 0; l < model->n_material; l++) {
        const double *density = w + (model->i_m + l) * stride;
        double *m = u + (model->i_m + l) * stride;
        const double *p = traction_pressure(model, n, l, w + model->i_E * stride, &parts);
        model->eos[l].law->state(model->eos[l].self, n, density, p, e.value, c2.value);
        for (size_t i = 0; i < n; i++) {
            double alpha = model->n_alpha ? w[(model->i_alpha + l) * stride + i] : 1.0;
            if (model->n_alpha) u[(model->i_alpha + l) * stride + i] = alpha;
            m[i] = alpha * density[i];
            rho.value[i] += m[i];
            energy.value[i] += alpha * e.value[i];
        }
    }
    for (unsigned q = model->i_u; q < model->i_E; q++) {
        for (size_t i = 0; i < n; i++) {
            double v = w[q * stride + i];
            u[q * stride + i] = rho.value[i] * v;
            energy.value[i] += 0.5 * rho.value[i] * v * v;
        }
    }
    if (model->n_stretch) mix_load(model, n, stride, w, u, energy.value);
    mix_renewed(model, n, stride, w, u);
    memcpy(u + model->i_E * stride, energy.value, n * sizeof *u);
}

void mix_conserved(const struct model *model, size_t n, size_t stride, const double *w, double *u)
{
    for (size_t i = 0; i < n; i += MIX_BATCH)
        mix_conserved_batch(model, n - i < MIX_BATCH ? n - i : MIX_BATCH, stride, w + i, u + i);
}

/* A material's part of rho and of rho c_f^2. */
static BULLA_KERNEL void mix_stiffen(size_t n, const double *restrict alpha, const double *restrict rho_l,
                                     const double *restrict rho_c2, double *restrict rho, double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], r = rho[i], s = sum[i];
        rho[i] = r + a * rho_l[i];
        sum[i] = s + a * rho_c2[i];
    }
}

static BULLA_KERNEL void mix_divide(size_t n, const double *restrict a, const double *restrict b,
                                    double *restrict ratio)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) ratio[i] = a[i] / b[i];
}

/* `everywhere`: also where a material is absent, at its fill density. */
static void mix_stiff(const struct model *model, size_t n, size_t stride, const double *w, bool everywhere,
                      double *rho_c2)
{
    struct traction_pressures parts;
    struct mix_row e;
    for (size_t i = 0; i < n; i += MIX_BATCH) {
        size_t some = n - i < MIX_BATCH ? n - i : MIX_BATCH;
        traction_part(model, some, stride, w + i, &parts);
        for (unsigned l = 0; l < model->n_material; l++) {
            const double *alpha = w + (model->i_alpha + l) * stride + i, *rho = w + (model->i_m + l) * stride + i;
            const double *p = traction_pressure(model, some, l, w + model->i_E * stride + i, &parts);
            struct present part = {some, everywhere || !model->n_alpha ? NULL : alpha, rho, p};
            present_state(&model->eos[l], &part, e.value, rho_c2 + l * stride + i);
        }
    }
}

void mix_stiffness(const struct model *model, size_t n, size_t stride, const double *w, double *rho_c2)
{
    mix_stiff(model, n, stride, w, false, rho_c2);
}

void mix_stiffness_everywhere(const struct model *model, size_t n, size_t stride, const double *w, double *rho_c2)
{
    mix_stiff(model, n, stride, w, true, rho_c2);
}

/* Partial densities alpha_l rho_l of the solids from primitives, as far as they bear; one material alone has them at
 * hand. */
static void mix_solid_densities(const struct model *model, size_t n, size_t stride, const double *w,
                                struct mix_row *masses, const double **ret_m)
{
    for (unsigned s = 0; s < model->n_solid; s++) {
        unsigned l = model->solids[s].material;
        const double *rho = w + (model->i_m + l) * stride;
        ret_m[s] = rho;
        if (!model->n_alpha) continue;
        mix_zero(n, &masses[s]);
        row_add_product(n, w + (model->i_alpha + l) * stride, rho, masses[s].value);
        ret_m[s] = masses[s].value;
    }
    bearing_of(model, n, stride, w, MIX_BATCH, masses[SCENE_MATERIALS].value, ret_m);
}

/* What elasticity adds to c^2. */
static void mix_quicken(const struct model *model, size_t n, size_t stride, const double *w, const double *rho,
                        double *c2)
{
    struct mix_row masses[2 * SCENE_MATERIALS];
    const double *m[SCENE_MATERIALS];
    if (!model->n_stretch) return;
    mix_solid_densities(model, n, stride, w, masses, m);
    elastic_speed2(model, n, stride, w + model->i_V * stride, m, rho, c2);
}

void mix_hoop(const struct model *model, size_t n, size_t stride, const double *w, double *ret)
{
    struct mix_row masses[2 * SCENE_MATERIALS];
    const double *m[SCENE_MATERIALS];
    for (size_t i = 0; i < n; i += MIX_BATCH) {
        size_t part = n - i < MIX_BATCH ? n - i : MIX_BATCH;
        mix_solid_densities(model, part, stride, w + i, masses, m);
        elastic_hoop(model, part, stride, w + model->i_V * stride + i, m, w + model->i_E * stride + i, ret + i);
    }
}

static void mix_speed2_batch(const struct model *model, size_t n, size_t stride, const double *w, const double *rho_c2,
                             double *c2)
{
    struct mix_row rho, sum;
    if (!model->n_alpha) {
        mix_divide(n, rho_c2, w + model->i_m * stride, c2);
        mix_quicken(model, n, stride, w, w + model->i_m * stride, c2);
        return;
    }
    mix_zero(n, &rho);
    mix_zero(n, &sum);
    for (unsigned l = 0; l < model->n_material; l++)
        mix_stiffen(n, w + (model->i_alpha + l) * stride, w + (model->i_m + l) * stride, rho_c2 + l * stride, rho.value,
                    sum.value);
    mix_divide(n, sum.value, rho.value, c2);
    mix_quicken(model, n, stride, w, rho.value, c2);
}

void mix_speed2(const struct model *model, size_t n, size_t stride, const double *w, const double *rho_c2, double *c2)
{
    for (size_t i = 0; i < n; i += MIX_BATCH)
        mix_speed2_batch(model, n - i < MIX_BATCH ? n - i : MIX_BATCH, stride, w + i, rho_c2 + i, c2 + i);
}

/* A trace of a material in a state of no stiffness (guard judges the others) takes no part: its
 * volume stays as transport left it. */
static BULLA_KERNEL void mix_compliance(size_t n, const double *restrict alpha, const double *restrict rho_c2,
                                        double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = rho_c2[i], share = alpha[i] / s, old = sum[i];
        sum[i] = old + (s > 0.0 ? share : 0.0);
    }
}

/* A material that is alone has none, exactly: narrowed paths know of no K, and what rounding leaves would be clipped
 * and counted, or be a change of fraction in refluxing that no cell has room for. */
static BULLA_KERNEL void mix_k(size_t n, const double *restrict alpha, const double *restrict rho_c2,
                               const double *restrict sum, double *restrict K)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = rho_c2[i], a = alpha[i], k = a * (1.0 / (sum[i] * s) - 1.0);
        k = a < 1.0 ? k : 0.0;
        K[i] = s > 0.0 ? k : 0.0;
    }
}

void mix_closure(const struct model *model, size_t n, size_t stride, const double *w, const double *rho_c2, double *K)
{
    for (size_t i = 0; i < n; i += MIX_BATCH) {
        size_t count = n - i < MIX_BATCH ? n - i : MIX_BATCH;
        struct mix_row sum;
        mix_zero(count, &sum);
        for (unsigned l = 0; l < model->n_alpha; l++)
            mix_compliance(count, w + (model->i_alpha + l) * stride + i, rho_c2 + l * stride + i, sum.value);
        for (unsigned l = 0; l < model->n_alpha; l++)
            mix_k(count, w + (model->i_alpha + l) * stride + i, rho_c2 + l * stride + i, sum.value, K + l * stride + i);
    }
}

/* A material that is not there has no temperature. */
static BULLA_KERNEL void mix_absent(size_t n, const double *restrict alpha, double *restrict T)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double own = T[i];
        T[i] = alpha[i] <= 0.0 ? 0.0 : own;
    }
}

static void mix_temperatures_batch(const struct model *model, size_t n, size_t stride, const double *w, double *T)
{
    struct traction_pressures parts;
    traction_part(model, n, stride, w, &parts);
    for (unsigned l = 0; l < model->n_material; l++) {
        const double *p = traction_pressure(model, n, l, w + model->i_E * stride, &parts);
        double *own = T + l * stride;
        model->eos[l].law->temperature(model->eos[l].self, n, w + (model->i_m + l) * stride, p, own);
        if (model->n_alpha) mix_absent(n, w + (model->i_alpha + l) * stride, own);
    }
}

void mix_temperatures(const struct model *model, size_t n, size_t stride, const double *w, double *T)
{
    for (size_t i = 0; i < n; i += MIX_BATCH)
        mix_temperatures_batch(model, n - i < MIX_BATCH ? n - i : MIX_BATCH, stride, w + i, T + i);
}
