/* soft.c - see soft.h. Scalar code: it runs in a handful of cells. */
#include "phys/soft.h"

#include "phys/mix.h"
#include "phys/squeeze.h"

#include <math.h>

enum { SOFT_ROUNDS = 80 };

/* A gas that expands has an ever lower least pressure; p is looked for down to that of this share of its density. */
#define SOFT_THIN 1e-9

/* How well p - floor is found. */
#define SOFT_CLOSE 1e-12

/* What the closure can resolve of a pressure, of the stiffest material's rho c^2. */
#define SOFT_RESOLVED 1e-11

struct soft {
    const struct model *model;
    double u[MODEL_FIELDS], w[MODEL_FIELDS]; /* the cell now */
    bool present[SCENE_MATERIALS];
    unsigned stiffest;
    double m[SCENE_MATERIALS], v0[SCENE_MATERIALS], e0[SCENE_MATERIALS], v[SCENE_MATERIALS];
    double p0, floor; /* pressure at the start, and the least one that all soft materials bear, thinned */
    double inner;     /* energy of all materials [J/m3] */
    double room;      /* volume of those that are present, a share of the cell */
};

static double soft_least(const struct model_eos *eos, double rho)
{
    double least;
    eos->law->p_min(eos->self, 1, &rho, &least);
    return least;
}

static double soft_stiffness(const struct model_eos *eos, double rho, double p)
{
    double rho_e, rho_c2;
    eos->law->state(eos->self, 1, &rho, &p, &rho_e, &rho_c2);
    return rho_c2;
}

/* The cell as it is, its materials and its energy; false with any solid in it. */
static bool soft_take(struct soft *soft, size_t stride, const double *u)
{
    const struct model *model = soft->model;
    double rho = 0.0, twice = 0.0;
    for (unsigned i = 0; i < model->n_active; i++) soft->u[model->active[i]] = u[model->active[i] * stride];
    for (unsigned s = 0; s < model->n_solid; s++)
        if (soft->u[model->i_m + model->solids[s].material] != 0.0) return false;
    soft->room = 1.0;
    for (unsigned l = 0; l < model->n_material; l++) {
        double alpha = soft->u[model->i_alpha + l];
        soft->m[l] = soft->u[model->i_m + l];
        soft->present[l] = alpha > MIX_ABSENT && soft->m[l] > 0.0;
        soft->room -= soft->present[l] ? 0.0 : alpha;
        rho += soft->m[l];
    }
    for (unsigned d = 0; d < model->n_velocity; d++) twice += soft->u[model->i_u + d] * soft->u[model->i_u + d];
    soft->inner = soft->u[model->i_E] - 0.5 * twice / rho;
    return isfinite(soft->inner);
}

/* What shocks have given to what was here [J/kg]. */
static double soft_heat(const struct soft *soft, const double *before)
{
    const struct model *model = soft->model;
    double rho = 0.0, heat = 0.0;
    for (unsigned l = 0; l < model->n_material; l++) rho += soft->m[l];
    for (unsigned d = 0; d < model->n_velocity; d++) {
        double change = soft->u[model->i_u + d] / rho - before[model->i_u + d];
        heat += SOFT_HEAT * 0.5 * change * change;
    }
    return heat;
}

/* Where a material starts: from its own density where most of it was here before, else from that it arrived with. False
 * where that does not bear the pressure. */
static bool soft_start(struct soft *soft, unsigned l, double alpha, double m, double rho)
{
    const struct model_eos *eos = &soft->model->eos[l];
    bool own = alpha > 0.0 && m > 0.5 * soft->m[l] && m < 2.0 * soft->m[l];
    double from = own ? rho : soft->m[l] / soft->u[soft->model->i_alpha + l], slope;
    if (!(soft->p0 > soft_least(eos, from))) return false;
    soft->v0[l] = 1.0 / from;
    soft->e0[l] = squeeze_energy(eos, from, soft->p0, &slope) / from;
    return true;
}

static bool soft_begin(struct soft *soft, size_t stride, const double *u_old)
{
    const struct model *model = soft->model;
    double old[MODEL_FIELDS] = {0}, before[MODEL_FIELDS] = {0}, most = 0.0;
    for (unsigned i = 0; i < model->n_active; i++) old[model->active[i]] = u_old[model->active[i] * stride];
    mix_primitives(model, 1, 1, old, before);
    soft->p0 = before[model->i_E];
    double heat = soft_heat(soft, before);
    for (unsigned l = 0; l < model->n_material; l++) {
        double rho = before[model->i_m + l];
        if (!soft->present[l]) continue;
        if (!soft_start(soft, l, before[model->i_alpha + l], old[model->i_m + l], rho)) return false;
        double stiffness = soft_stiffness(&model->eos[l], 1.0 / soft->v0[l], soft->p0);
        soft->e0[l] += heat;
        if (!(soft->u[model->i_alpha + l] > SOFT_TRACE) || !(stiffness > most)) continue;
        most = stiffness;
        soft->stiffest = l;
    }
    soft->floor = -HUGE_VAL;
    for (unsigned l = 0; l < model->n_material; l++) {
        if (!soft->present[l] || l == soft->stiffest) continue;
        double least = soft_least(&model->eos[l], SOFT_THIN / soft->v0[l]);
        soft->floor = least > soft->floor ? least : soft->floor;
    }
    return most > 0.0 && soft->p0 > soft->floor && isfinite(soft->floor);
}

/* Energy that the cell lacks for a pressure p; falls with p. Where the soft ones alone are larger than the cell, p is
 * too low. */
static double soft_lack(struct soft *soft, double p)
{
    const struct model *model = soft->model;
    double rest = soft->room, energy = 0.0, slope;
    for (unsigned l = 0; l < model->n_material; l++) {
        if (!soft->present[l] || l == soft->stiffest) continue;
        soft->v[l] = squeeze_volume(&model->eos[l], soft->v0[l], soft->e0[l], p);
        double alpha = soft->m[l] * soft->v[l];
        rest -= alpha;
        energy += alpha * squeeze_energy(&model->eos[l], 1.0 / soft->v[l], p, &slope);
    }
    if (!(rest > 0.0)) return HUGE_VAL;
    soft->v[soft->stiffest] = rest / soft->m[soft->stiffest];
    energy += rest * squeeze_energy(&model->eos[soft->stiffest], soft->m[soft->stiffest] / rest, p, &slope);
    return soft->inner - energy;
}

/* Is p within SOFT_BELOW of the least rho_l c_l^2 of now from the pressure of the fractions? Then it need not be found.
 */
static bool soft_agrees(struct soft *soft, double p_now, double stiffness)
{
    double reach = SOFT_BELOW * stiffness;
    if (!(p_now - reach > soft->floor)) return false;
    return soft_lack(soft, p_now - reach) > 0.0 && soft_lack(soft, p_now + reach) <= 0.0;
}

/* Two values of p - floor, and what the cell lacks at them: more than nothing at `low`, not so at `high`. */
struct soft_bracket {
    double low, high, above, below;
};

/* By doubling or halving. False: there is none. */
static bool soft_bracket_find(struct soft *soft, struct soft_bracket *ret)
{
    double at = soft->p0 - soft->floor, lack = soft_lack(soft, soft->p0);
    *ret = (struct soft_bracket){at, at, lack, lack};
    for (int i = 0; i < SOFT_ROUNDS; i++) {
        if (ret->above > 0.0 && !(ret->below > 0.0)) return true;
        at = ret->above > 0.0 ? 2.0 * ret->high : 0.5 * ret->low;
        lack = soft_lack(soft, soft->floor + at);
        if (ret->above > 0.0) *ret = (struct soft_bracket){ret->high, at, ret->below, lack};
        else *ret = (struct soft_bracket){at, ret->low, lack, ret->above};
    }
    return false;
}

/* Illinois' false position in the logarithm of p - floor; a half where a value is no number. NaN: there is no such p.
 */
static double soft_pressure(struct soft *soft)
{
    struct soft_bracket in;
    if (!soft_bracket_find(soft, &in)) return NAN;
    double last = in.high, found = in.high;
    for (int i = 0; i < SOFT_ROUNDS; i++) {
        double wide = log(in.high / in.low), share = in.above / (in.above - in.below);
        found = in.low * exp(wide * (isfinite(in.above) ? share : 0.5));
        double lack = soft_lack(soft, soft->floor + found);
        if (fabs(found - last) <= SOFT_CLOSE * found) break;
        bool short_of = lack > 0.0, again = short_of == (last == in.low);
        if (short_of) in.low = found, in.above = lack, in.below *= again ? 0.5 : 1.0;
        else in.high = found, in.below = lack, in.above *= again ? 0.5 : 1.0;
        last = found;
    }
    return isfinite(soft_lack(soft, soft->floor + found)) ? soft->floor + found : NAN;
}

/* Is p far from the pressure of the fractions, and do all materials bear it at their new densities? */
static bool soft_differs(const struct soft *soft, double p, double p_now)
{
    const struct model *model = soft->model;
    double least = HUGE_VAL, most = 0.0, had = soft->u[model->i_alpha + soft->stiffest];
    double moved = fabs(soft->m[soft->stiffest] * soft->v[soft->stiffest] - had);
    if (!(moved < SOFT_ROOM * had)) return false;
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct model_eos *eos = &model->eos[l];
        if (!soft->present[l]) continue;
        double rho = 1.0 / soft->v[l], stiffness = soft_stiffness(eos, rho, p);
        if (!(p > soft_least(eos, rho)) || !(stiffness > 0.0)) return false;
        if (soft->u[model->i_alpha + l] > SOFT_TRACE && stiffness < least) least = stiffness;
        most = stiffness > most ? stiffness : most;
    }
    least = least > SOFT_RESOLVED * most ? least : SOFT_RESOLVED * most;
    return p_now - p > SOFT_ABOVE * least || p - p_now > SOFT_BELOW * least;
}

bool soft_cell(const struct model *model, size_t stride, const double *u_old, double least, double *u, double *w)
{
    struct soft soft = {.model = model};
    if (!model->n_alpha || !soft_take(&soft, stride, u) || !soft_begin(&soft, stride, u_old)) return false;
    if (soft_agrees(&soft, w[model->i_E * stride], least)) return false;
    double p = soft_pressure(&soft);
    if (!isfinite(p) || !soft_differs(&soft, p, w[model->i_E * stride])) return false;
    for (unsigned l = 0; l < model->n_material; l++)
        if (soft.present[l]) soft.u[model->i_alpha + l] = soft.m[l] * soft.v[l];
    soft.w[model->i_E] = p; /* where an iteration starts */
    mix_primitives(model, 1, 1, soft.u, soft.w);
    for (unsigned i = 0; i < model->n_active; i++) {
        unsigned q = model->active[i];
        u[q * stride] = soft.u[q];
        w[q * stride] = soft.w[q];
    }
    return true;
}
