/* relax.c - see relax.h. Scalar code: it runs in a handful of cells. */
#include "phys/relax.h"

#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/mix.h"
#include "phys/squeeze.h"
#include "phys/traction.h"

#include <math.h>
#include <string.h>

enum { RELAX_FIELDS = MODEL_FIELDS, RELAX_ROUNDS = 80, RELAX_NEWTON = 30, RELAX_AGAIN = 4 };

/* Nearest to its least pressure that a material may start: this share of the distance from there to the old
 * pressure. */
#define RELAX_NEAR 1e-6

/* A gas that expands has an ever lower least pressure; the search for p* goes down to that of this share of its
 * density. */
#define RELAX_THIN 1e-9

struct relax {
    const struct model *model;
    double u[RELAX_FIELDS], w[RELAX_FIELDS]; /* the cell now */
    bool present[SCENE_MATERIALS];
    double m[SCENE_MATERIALS], v0[SCENE_MATERIALS], e0[SCENE_MATERIALS], v[SCENE_MATERIALS];
    double own[SCENE_MATERIALS]; /* pressure of a material less the common one: s'_nn of its stretch now (traction.h) */
    double p0, floor;            /* common pressure at the start, and the least one that all present materials bear */
    double stiffest;             /* largest rho_l c_l^2 at the start */
};

/* A volume fraction below RELAX_TRACE with less than RELAX_VOID of the cell's mass is an empty trace: it gives way. */
#define RELAX_TRACE 1e-3
#define RELAX_VOID 1e-13

/* Least distance of p* from the floor, relative to the largest rho_l c_l^2: what the closure can resolve. */
#define RELAX_RESOLVED 1e-11

/* Volumes that jump by more than this share of the cell at p* do so in a law that has two at one p and energy, as cold
 * dense gases beyond their end; those above p* are of the branch that the cell came on. */
#define RELAX_LEAP 1e-6

/* What the materials have in common: the traction, or the pressure. */
static double relax_common(const struct model *model, const double *w)
{
    double mean = 0.0;
    if (model->split) traction_mean(model, 1, 1, w, &mean);
    return w[model->i_E] - mean;
}

/* Least pressure of material l at a density, in terms of the common one. */
static double relax_least(const struct relax *relax, unsigned l, double rho)
{
    const struct model_eos *eos = &relax->model->eos[l];
    double least;
    eos->law->p_min(eos->self, 1, &rho, &least);
    return least - relax->own[l];
}

static double relax_temperature(const struct relax *relax, unsigned l, double rho, double common)
{
    const struct model_eos *eos = &relax->model->eos[l];
    double p = common + relax->own[l], T;
    eos->law->temperature(eos->self, 1, &rho, &p, &T);
    return T;
}

/* Temperature of the material that makes up most of the cell's mass, at its start. */
static double relax_ambient(const struct relax *relax)
{
    unsigned heavy = 0;
    for (unsigned l = 1; l < relax->model->n_material; l++)
        if (relax->m[l] > relax->m[heavy]) heavy = l;
    return relax_temperature(relax, heavy, relax->w[relax->model->i_m + heavy], relax->p0);
}

/* Common pressure at which material l starts. The old one; but a trace of gas in a liquid under tension has no state
 * there. It is taken to be as warm as what surrounds it. */
static double relax_start(const struct relax *relax, unsigned l)
{
    double rho = relax->w[relax->model->i_m + l], least = relax_least(relax, l, rho),
           above = RELAX_NEAR * fabs(relax->p0 - least), ambient = relax_ambient(relax);
    if (relax->p0 > least + above) return relax->p0;
    for (int i = 0; i < RELAX_ROUNDS && relax_temperature(relax, l, rho, least + above) < ambient; i++) above *= 1.5;
    return least + above;
}

/* Lags by surface tension and viscosity, at the fractions that the cell arrived with. */
static void relax_lag(struct relax *relax)
{
    const struct model *model = relax->model;
    const double *alpha = relax->u + model->i_alpha;
    for (unsigned k = 0; k < model->n_pair; k++) {
        const struct model_pair *pair = &model->pairs[k];
        double jump = pair->sigma * relax->u[pair->i_kappa];
        relax->own[pair->inside] += alpha[pair->outside] * jump;
        relax->own[pair->outside] -= alpha[pair->inside] * jump;
    }
}

/* What the traction looks at beside densities: stretches, normals, and how far solids are broken. */
static void relax_bear(struct relax *relax)
{
    const struct model *model = relax->model;
    for (unsigned i = model_drawn(model); i < model->n_active; i++)
        relax->w[model->active[i]] = relax->u[model->active[i]];
    for (unsigned k = 0; k < model->n_memory; k++) {
        unsigned q = model->memories[k].field;
        double m = relax->m[model->solids[model->memories[k].solid].material], value = relax->u[q] / m;
        value = value < model->memories[k].most ? value : model->memories[k].most;
        relax->w[q] = m > ELASTIC_NOTHING ? value : 0.0;
    }
}

/* Start states: the material's own where most of it was here before, else the density it arrived with. */
static bool relax_begin(struct relax *relax, size_t stride, const double *u_old)
{
    const struct model *model = relax->model;
    double old[RELAX_FIELDS] = {0}, before[RELAX_FIELDS] = {0};
    for (unsigned i = 0; i < model->n_active; i++) old[model->active[i]] = u_old[model->active[i] * stride];
    mix_primitives(model, 1, 1, old, before);
    double rho_all = 0.0;
    for (unsigned l = 0; l < model->n_material; l++) rho_all += relax->u[model->i_m + l];
    relax->p0 = relax_common(model, before);
    relax->floor = -HUGE_VAL;
    for (unsigned l = 0; l < model->n_material; l++) {
        double m = relax->u[model->i_m + l], alpha = relax->u[model->i_alpha + l];
        relax->m[l] = m;
        relax->present[l] = alpha > MIX_ABSENT && m > (alpha < RELAX_TRACE ? RELAX_VOID * rho_all : 0.0);
        if (!relax->present[l]) continue;
        bool own = before[model->i_alpha + l] > 0.0 && old[model->i_m + l] > 0.5 * m && old[model->i_m + l] < 2.0 * m;
        relax->w[model->i_m + l] = own ? before[model->i_m + l] : m / alpha;
    }
    relax_bear(relax);
    if (model->split) traction_own(model, 1, 1, relax->w, 1, relax->own);
    relax_lag(relax);
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct model_eos *eos = &model->eos[l];
        double rho = relax->w[model->i_m + l], slope, rho_e, rho_c2;
        if (!relax->present[l]) continue;
        double thin = relax_least(relax, l, RELAX_THIN * rho), start = relax_start(relax, l) + relax->own[l];
        if (thin > relax->floor) relax->floor = thin;
        relax->v0[l] = 1.0 / rho;
        relax->e0[l] = squeeze_energy(eos, rho, start, &slope) / rho;
        eos->law->state(eos->self, 1, &rho, &start, &rho_e, &rho_c2);
        if (rho_c2 > relax->stiffest) relax->stiffest = rho_c2;
    }
    return isfinite(relax->floor);
}

/* v_l at a common pressure. */
static double relax_volume(const struct relax *relax, unsigned l, double common)
{
    return squeeze_volume(&relax->model->eos[l], relax->v0[l], relax->e0[l], common + relax->own[l]);
}

/* Volume of all masses at p, less the cell's; falls with p. */
static double relax_excess(struct relax *relax, double p)
{
    double sum = -1.0;
    for (unsigned l = 0; l < relax->model->n_material; l++) {
        if (!relax->present[l]) continue;
        relax->v[l] = relax_volume(relax, l, p);
        sum += relax->m[l] * relax->v[l];
    }
    return sum;
}

/* p*, by doubling and halving of p - floor, then bisection of its logarithm; NaN if there is none. */
static double relax_pressure(struct relax *relax)
{
    double floor = relax->floor, least = RELAX_NEAR * fabs(relax->p0 - floor), above = relax->p0 - floor;
    double low = above > least ? above : least, high = low;
    bool rising = relax_excess(relax, floor + low) > 0.0;
    for (int i = 0; i < RELAX_ROUNDS; i++) {
        double next = rising ? 2.0 * high : 0.5 * low;
        bool crossed = (relax_excess(relax, floor + next) > 0.0) != rising;
        if (rising) low = high, high = next;
        else high = low, low = next;
        if (crossed) break;
        if (i == RELAX_ROUNDS - 1) return NAN;
    }
    double excess = 0.0;
    for (int i = 0; i < RELAX_ROUNDS && high > low * (1.0 + 1e-13); i++) {
        double middle = sqrt(low * high);
        excess = relax_excess(relax, floor + middle);
        if (excess > 0.0) low = middle;
        else high = middle;
    }
    if (excess > RELAX_LEAP) relax_excess(relax, floor + high);
    return floor + high;
}

/* Sum 1, to round-off; none above 1. */
static void relax_normalise(struct relax *relax)
{
    double sum = 0.0;
    double *alpha = relax->u + relax->model->i_alpha;
    for (unsigned l = 0; l < relax->model->n_alpha; l++) sum += alpha[l];
    for (unsigned l = 0; l < relax->model->n_alpha; l++) alpha[l] /= sum;
}

/* Common pressure that the conserved energy gives with the present fractions. */
static double relax_close(struct relax *relax)
{
    mix_primitives(relax->model, 1, 1, relax->u, relax->w);
    return relax_common(relax->model, relax->w);
}

/* The present material of least or most `gain`. */
static unsigned relax_extreme(const struct relax *relax, const double *gain, bool least)
{
    unsigned found = 0;
    while (!relax->present[found]) found++;
    for (unsigned l = found + 1; l < relax->model->n_material; l++)
        if (relax->present[l] && (least ? gain[l] < gain[found] : gain[l] > gain[found])) found = l;
    return found;
}

/* Elastic energy of the cell, which volume moved between materials does not change. */
static double relax_elastic(const struct relax *relax)
{
    const struct model *model = relax->model;
    const double *m[SCENE_MATERIALS];
    double energy = 0.0, left[SCENE_MATERIALS];
    for (unsigned s = 0; s < model->n_solid; s++) m[s] = &relax->u[model->i_m + model->solids[s].material];
    bearing_of_conserved(model, 1, 1, relax->u, 1, left, m);
    if (model->n_stretch) elastic_energy(model, 1, 1, relax->u + model->i_V, m, &energy);
    return energy;
}

/* p, or the least pressure that all materials bear at their present fractions if that is higher. */
static double relax_borne(const struct relax *relax, double p)
{
    for (unsigned l = 0; l < relax->model->n_material; l++) {
        if (!relax->present[l]) continue;
        double least =
            relax_least(relax, l, relax->m[l] / relax->u[relax->model->i_alpha + l]) + RELAX_RESOLVED * relax->stiffest;
        p = p > least ? p : least;
    }
    return p;
}

/* Moves volume between materials until the energy held at p* is the conserved one (Newton). Material l gains
 * rho_l e_l - rho_l d(rho_l e_l)/d rho_l = rho_l c_l^2/Gamma_l - p per volume; volume goes to the one that gains least
 * or most, from the one that has most to give, which need not be the other extreme: that may be a trace. */
static void relax_shift(struct relax *relax, double p)
{
    const struct model *model = relax->model;
    double kinetic = 0.0, rho = 0.0, *alpha = relax->u + model->i_alpha;
    for (unsigned l = 0; l < model->n_material; l++) rho += relax->u[model->i_m + l];
    for (unsigned d = 0; d < model->n_velocity; d++) {
        double q = relax->u[model->i_u + d];
        kinetic += 0.5 * q * q / rho;
    }
    double elastic = relax_elastic(relax);
    for (int i = 0; i < RELAX_NEWTON; i++) {
        double gain[SCENE_MATERIALS], slope, excess = kinetic + elastic - relax->u[model->i_E], most = 0.0;
        p = relax_borne(relax, p);
        for (unsigned l = 0; l < model->n_material; l++) {
            if (!relax->present[l]) continue;
            double density = relax->m[l] / alpha[l],
                   rho_e = squeeze_energy(&model->eos[l], density, p + relax->own[l], &slope);
            gain[l] = rho_e - density * slope;
            excess += alpha[l] * rho_e;
        }
        unsigned to = relax_extreme(relax, gain, excess > 0.0), from = to;
        for (unsigned l = 0; l < model->n_material; l++) {
            double room = relax->present[l] ? alpha[l] * fabs(gain[l] - gain[to]) : 0.0;
            if (room > most) most = room, from = l;
        }
        double shift = fabs(excess / (gain[from] - gain[to]));
        if (!isfinite(shift)) return;
        if (shift > 0.5 * alpha[from]) shift = 0.5 * alpha[from];
        alpha[from] -= shift;
        alpha[to] += shift;
        if (shift < 1e-15) return;
    }
}

static bool relax_has_solid(const struct relax *relax)
{
    bool some = false;
    for (unsigned s = 0; s < relax->model->n_solid; s++)
        some = some || relax->present[relax->model->solids[s].material];
    return some;
}

bool relax_cell(const struct model *model, size_t stride, const double *u_old, double *u, double *w)
{
    struct relax relax = {.model = model};
    if (!model->n_alpha) return false;
    for (unsigned i = 0; i < model->n_active; i++) { /* a narrowed path has nothing in the others */
        unsigned q = model->active[i];
        relax.u[q] = u[q * stride];
        if (!isfinite(relax.u[q])) return false;
    }
    if (!relax_begin(&relax, stride, u_old)) return false;
    double p = relax_pressure(&relax);
    if (!isfinite(p)) return false;
    double resolved = relax.floor + RELAX_RESOLVED * relax.stiffest;
    p = p > resolved ? p : resolved;
    for (unsigned l = 0; l < model->n_alpha; l++)
        relax.u[model->i_alpha + l] = relax.present[l] ? relax.m[l] * relax.v[l] : 0.0;
    relax_normalise(&relax);
    double closed = relax_close(&relax);
    if (!(closed - relax.floor > 0.5 * (p - relax.floor)) || closed < relax_borne(&relax, closed)) {
        relax_shift(&relax, p);
        relax_normalise(&relax);
        closed = relax_close(&relax);
    }
    bool bears = model->split && relax_has_solid(&relax); /* the path of a cell without one may have them */
    for (int i = 0; bears && i < RELAX_AGAIN && !(closed - relax.floor > 0.5 * (p - relax.floor)); i++) {
        traction_own(model, 1, 1, relax.w, 1, relax.own); /* a solid of another density bears another stress */
        relax_lag(&relax);
        relax_shift(&relax, p);
        relax_normalise(&relax);
        closed = relax_close(&relax);
    }
    for (unsigned i = 0; i < model->n_active; i++) {
        unsigned q = model->active[i];
        u[q * stride] = relax.u[q];
        w[q * stride] = relax.w[q];
    }
    return true;
}
