/* cavity.c - see cavity.h. Few cells open in a step, so they are taken one by one. */
#include "phys/cavity.h"

#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/mix.h"

#include <math.h>

enum { CAVITY_ROUNDS = 60 };

/* Less than this of a solid in a cell opens nothing: its surface is there already. */
#define CAVITY_FELT 1e-3

/* A void takes at most this part of the solid's volume at once. */
#define CAVITY_MOST 0.5

/* One cell, component q at q * stride. */
struct cavity {
    const struct model *model;
    const struct model_solid *solid;
    size_t stride;
    double *u;
    double rest;                 /* energy that solid and new gas have to hold [J/m3] */
    double alpha, m, gas_energy; /* of the solid; rho e of the gas in a new void */
};

static double cavity_energy(const struct model_eos *eos, double rho, double p)
{
    double e, c2;
    eos->law->state(eos->self, 1, &rho, &p, &e, &c2);
    return e;
}

/* What is left of the internal energy when all but the solid are at p_v. */
static double cavity_rest(const struct cavity *cavity)
{
    const struct model *model = cavity->model;
    size_t stride = cavity->stride;
    double kinetic = 0.0, rho = 0.0, elastic, left[SCENE_MATERIALS], sum = 0.0;
    const double *u = cavity->u, *m[SCENE_MATERIALS];
    for (unsigned l = 0; l < model->n_material; l++) rho += u[(model->i_m + l) * stride];
    for (unsigned q = model->i_u; q < model->i_E; q++) kinetic += 0.5 * u[q * stride] * u[q * stride] / rho;
    for (unsigned s = 0; s < model->n_solid; s++) m[s] = u + (model->i_m + model->solids[s].material) * stride;
    bearing_of_conserved(model, 1, stride, u, 1, left, m);
    elastic_energy(model, 1, stride, u + model->i_V * stride, m, &elastic);
    for (unsigned l = 0; l < model->n_material; l++) {
        double alpha = u[(model->i_alpha + l) * stride], mass = u[(model->i_m + l) * stride];
        if (l == cavity->solid->material || !(alpha > MIX_ABSENT) || !(mass > 0.0)) continue;
        sum += alpha * cavity_energy(&model->eos[l], mass / alpha, cavity->solid->damage.p);
    }
    return u[model->i_E * stride] - kinetic - elastic - sum;
}

/* Energy that is missing when the solid has shrunk to the fraction a. */
static double cavity_miss(const struct cavity *cavity, double a)
{
    const struct model_damage *damage = &cavity->solid->damage;
    double opened = cavity->alpha - a, rho = (cavity->m - opened * damage->rho) / a;
    double held = a * cavity_energy(&cavity->model->eos[cavity->solid->material], rho, damage->p);
    return held + opened * cavity->gas_energy - cavity->rest;
}

/* The fraction that is left, by bisection and secants (Illinois); the whole one if there is none. */
static double cavity_shrink(const struct cavity *cavity)
{
    double a = CAVITY_MOST * cavity->alpha, b = cavity->alpha, at = b;
    double f = cavity_miss(cavity, a), g = cavity_miss(cavity, b);
    if (!(f < 0.0) || !(g > 0.0)) return cavity->alpha;
    for (int round = 0, side = 0; round < CAVITY_ROUNDS; round++) {
        double next = (a * g - b * f) / (g - f), value = cavity_miss(cavity, next);
        if (!(next > a && next < b) || next == at) break;
        at = next;
        bool above = value > 0.0;
        if (above) b = at, g = value, f *= side > 0 ? 0.5 : 1.0;
        else a = at, f = value, g *= side < 0 ? 0.5 : 1.0;
        side = above ? 1 : -1;
        if (value == 0.0) break;
    }
    return at;
}

/* What was the solid's becomes that of a void: volume, and the little mass in it with what it remembered. */
static void cavity_give(const struct cavity *cavity, double a)
{
    const struct model *model = cavity->model;
    const struct model_damage *damage = &cavity->solid->damage;
    size_t stride = cavity->stride, l = cavity->solid->material;
    double opened = cavity->alpha - a, mass = opened * damage->rho, kept = (cavity->m - mass) / cavity->m;
    cavity->u[(model->i_alpha + l) * stride] = a;
    cavity->u[(model->i_alpha + damage->gas) * stride] += opened;
    cavity->u[(model->i_m + l) * stride] -= mass;
    cavity->u[(model->i_m + damage->gas) * stride] += mass;
    for (unsigned k = 0; k < model->n_memory; k++)
        if (&model->solids[model->memories[k].solid] == cavity->solid)
            cavity->u[model->memories[k].field * stride] *= kept;
    cavity->u[damage->field * stride] = cavity->u[(model->i_m + l) * stride];
}

/* Is solid s of a cell broken, and in tension? */
static bool cavity_wants(const struct model *model, const struct model_solid *solid, size_t stride, const double *w,
                         const double *u)
{
    double m = u[(model->i_m + solid->material) * stride];
    if (!(w[model->i_E * stride] < 0.0) || !(u[(model->i_alpha + solid->material) * stride] > CAVITY_FELT))
        return false;
    return m > ELASTIC_NOTHING && u[solid->damage.field * stride] >= m;
}

static void cavity_cell(const struct model *model, const struct model_solid *solid, size_t stride, double *u)
{
    struct cavity cavity = {.model = model, .solid = solid, .stride = stride, .u = u};
    cavity.alpha = u[(model->i_alpha + solid->material) * stride];
    cavity.m = u[(model->i_m + solid->material) * stride];
    cavity.gas_energy = cavity_energy(&model->eos[solid->damage.gas], solid->damage.rho, solid->damage.p);
    cavity.rest = cavity_rest(&cavity);
    double a = cavity_shrink(&cavity);
    if (a < cavity.alpha) cavity_give(&cavity, a);
}

void cavity_open(const struct model *model, size_t n, size_t stride, const double *w, double *u)
{
    for (unsigned s = 0; s < model->n_solid; s++) {
        const struct model_solid *solid = &model->solids[s];
        for (size_t i = 0; solid->damage.law && solid->damage.opens && i < n; i++)
            if (cavity_wants(model, solid, stride, w + i, u + i)) cavity_cell(model, solid, stride, u + i);
    }
}
