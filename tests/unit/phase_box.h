/* phase_box.h - scenes of phase change in memory: pairs as materials of a case, cells at random, and their entropy. */
#ifndef PHASE_BOX_H
#define PHASE_BOX_H

#include "flow.h"

#include "phys/phase.h"
#include "phys/traction.h"

#define PHASE_BOX_PAIR(law, preset) \
    "  water: {eos: {type: " law ", preset: " preset "}}\n  steam: {eos: {type: ideal-gas, preset: " preset "}}\n"
#define PHASE_BOX_NASG PHASE_BOX_PAIR("nasg", "water-2016")
#define PHASE_BOX_SG PHASE_BOX_PAIR("stiffened-gas", "water-2004")
#define PHASE_BOX_SG_2017 PHASE_BOX_PAIR("stiffened-gas", "water-2017")
#define PHASE_BOX_DODECANE PHASE_BOX_PAIR("stiffened-gas", "dodecane-2004")
#define PHASE_BOX_IAPWS                                \
    "  water: {eos: {type: iapws95, preset: water}}\n" \
    "  steam: {eos: {type: iapws95-vapour, preset: water-vapour}}\n"
#define PHASE_BOX_AIR "  air: {eos: {type: ideal-gas, preset: air}}\n"
#define PHASE_BOX_CUBIC_AIR "  air: {eos: {type: rkpr, preset: air}}\n"
#define PHASE_BOX_STONE "  stone: {eos: {type: stiffened-gas, preset: begostone}}\n"

#define PHASE_BOX_GEL                                                                                      \
    "  gel: {eos: {type: stiffened-gas, gamma: 4.4, p-inf: 616576970}, constitutive: {type: neo-hookean, " \
    "shear-modulus: "                                                                                      \
    "1 MPa, reference-density: 1060}}\n"

/* A periodic box of `cells` cells of these materials and this pair. */
static inline void phase_box_open(struct flow *flow, const char *materials, const char *phase, int cells,
                                  const char *scheme)
{
    flow_start(flow, mem_print("bulla: 1\ndomain: {lower: [0], upper: [1], cells: [%d], boundaries: {x-: periodic, x+: "
                               "periodic}}\nmesh: {tile: %d}\nmaterials:\n%sphase-change:\n  - %s\ninitial:\n"
                               "  - {everywhere: true, material: water, temperature: 300, pressure: 1 bar}\n"
                               "scheme: {%s}\nrun: {until: 1}\n",
                               cells, cells, materials, phase, scheme));
}

static uint64_t phase_box_seed;

static inline double phase_box_between(double low, double high)
{
    return low * pow(high / low, flow_random(&phase_box_seed));
}

/* A solid is stretched along the axis, and presses or pulls fluids of pressure p through a common traction. */
static inline void phase_box_stretch(const struct model *model, double p, double *w)
{
    double mean;
    for (unsigned s = 0; s < model->n_solid; s++) {
        double *V = w + model->solids[s].stretch, along = phase_box_between(0.5, 2.0);
        V[0] = along;
        V[1] = V[2] = 1.0 / sqrt(along);
    }
    traction_mean(model, 1, 1, w, &mean);
    w[model->i_E] = p + mean;
}

/* All materials at one pressure, or traction, with temperatures of their own; some cells hold traces, or one material
 * alone. A vapour that would be denser than any is left out. */
static inline void phase_box_scatter(const struct model *model, const double x[3], double *w)
{
    double p = phase_box_between(1e3, 1e7), sum = 0.0;
    (void)x;
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct model_eos *eos = &model->eos[l];
        double T = phase_box_between(300.0, l ? 900.0 : 500.0), draw = flow_random(&phase_box_seed);
        double *alpha = &w[model->i_alpha + l], *rho = &w[model->i_m + l];
        *alpha = l && draw < 0.2 ? 0.0 : l && draw < 0.3 ? 1e-8 : phase_box_between(1e-5, 1.0);
        eos->law->density(eos->self, 1, &p, &T, rho);
        if (!isfinite(*rho)) *alpha = 0.0, *rho = 1.0;
        sum += *alpha;
    }
    for (unsigned l = 0; l < model->n_material; l++) w[model->i_alpha + l] /= sum;
    w[model->i_u] = 50.0;
    w[model->i_E] = p;
    if (model->split) phase_box_stretch(model, p, w);
}

/* Entropy of the fluids of a cell, with that of mixing vapour and air; components at `stride`. What the deviator of a
 * solid takes of the work is its heat (squeeze_solid()). */
static inline double phase_box_entropy(const struct model *model, size_t stride, const double *u, const double *w)
{
    const struct model_phase *phase = &model->phases[0];
    double sum = 0.0, moles = 0.0, part[SCENE_MATERIALS] = {0};
    struct traction_pressures parts; /* large: filled as far as it is used */
    traction_part(model, 1, stride, w, &parts);
    for (unsigned l = 0; l < model->n_material; l++) {
        double rho = w[(model->i_m + l) * stride], s, m = u[(model->i_m + l) * stride];
        const double *p = traction_pressure(model, 1, l, w + model->i_E * stride, &parts);
        if (!(w[(model->i_alpha + l) * stride] > 0.0) || model_is_solid(model, l)) continue;
        model->eos[l].law->entropy(model->eos[l].self, 1, &rho, p, &s);
        sum += m * s;
    }
    for (unsigned k = EQUILIBRIUM_VAPOUR; k < phase->n; k++) {
        const struct model_eos *eos = &model->eos[phase->member[k]];
        part[k] = u[(model->i_m + phase->member[k]) * stride] * eos->law->gas_constant(eos->self);
        moles += part[k];
    }
    for (unsigned k = EQUILIBRIUM_VAPOUR; k < phase->n; k++)
        if (part[k] > 0.0 && phase->scene->mixing) sum -= part[k] * log(part[k] / moles);
    return sum;
}

#endif
