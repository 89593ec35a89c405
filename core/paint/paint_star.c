/* paint_star.c - see paint_star.h. A few hundred calls of a law for each cell that a surface cuts, once. */
#include "paint/paint_star.h"

#include "phys/mix.h"

#include <math.h>
#include <string.h>

enum {
    PAINT_STAR_STEPS = 16, /* along an isentrope; midpoint rule */
    PAINT_STAR_TRIES = 60, /* of a Hugoniot, and of the pressure */
};

/* How well both velocities agree, over the sum of the speeds of sound. */
#define PAINT_STAR_CLOSE 1e-9

/* A body, and what it is at another density and pressure. */
struct paint_star_body {
    const struct model *model;
    const double *w;
    double rho, p, energy; /* rho e */
};

struct paint_star_state {
    double energy, stiffness; /* rho e, rho c^2 */
};

/* All densities times `squeeze`, at pressure p. False: some material does not bear it. */
static bool paint_star_at(const struct paint_star_body *body, double squeeze, double p, struct paint_star_state *ret)
{
    const struct model *model = body->model;
    double w[MODEL_FIELDS] = {0}, u[MODEL_FIELDS], rho_c2[SCENE_MATERIALS], c2;
    memcpy(w, body->w, model->n_field * sizeof *w);
    for (unsigned l = 0; l < model->n_material; l++) w[model->i_m + l] *= squeeze;
    for (unsigned q = model->i_u; q < model->i_E; q++) w[q] = 0.0;
    w[model->i_E] = p;
    mix_conserved(model, 1, 1, w, u);
    mix_stiffness(model, 1, 1, w, rho_c2);
    mix_speed2(model, 1, 1, w, rho_c2, &c2);
    *ret = (struct paint_star_state){u[model->i_E], squeeze * body->rho * c2};
    return ret->stiffness > 0.0;
}

static bool paint_star_body_of(const struct model *model, const double *w, struct paint_star_body *ret_body)
{
    struct paint_star_state here;
    *ret_body = (struct paint_star_body){.model = model, .w = w, .p = w[model->i_E]};
    for (unsigned l = 0; l < model->n_material; l++)
        ret_body->rho += (model->n_alpha ? w[model->i_alpha + l] : 1.0) * w[model->i_m + l];
    if (!(ret_body->rho > 0.0) || !paint_star_at(ret_body, 1.0, ret_body->p, &here)) return false;
    ret_body->energy = here.energy;
    return true;
}

/* What a body loses of its velocity, and the impedance it has then. */
struct paint_star_answer {
    double slower, impedance;
};

static bool paint_star_rarefied(const struct paint_star_body *body, double p, struct paint_star_answer *ret)
{
    struct paint_star_state state;
    double dp = (p - body->p) / PAINT_STAR_STEPS, log = 0.0;
    ret->slower = 0.0;
    for (int step = 0; step < PAINT_STAR_STEPS; step++) {
        double before = body->p + step * dp;
        if (!paint_star_at(body, exp(log), before, &state)) return false;
        double half = log + 0.5 * dp / state.stiffness;
        if (!paint_star_at(body, exp(half), before + 0.5 * dp, &state)) return false;
        ret->slower += dp / sqrt(body->rho * exp(half) * state.stiffness);
        log += dp / state.stiffness;
    }
    if (!paint_star_at(body, exp(log), p, &state)) return false;
    ret->impedance = sqrt(body->rho * exp(log) * state.stiffness);
    return true;
}

/* How much more energy per mass the body has at p than its Hugoniot allows. */
static bool paint_star_surplus(const struct paint_star_body *body, double squeeze, double p, double *ret_surplus)
{
    struct paint_star_state state;
    if (!paint_star_at(body, squeeze, p, &state)) return false;
    *ret_surplus = state.energy / (squeeze * body->rho) - body->energy / body->rho -
                   0.5 * (p + body->p) / body->rho * (1.0 - 1.0 / squeeze);
    return true;
}

static bool paint_star_shocked(const struct paint_star_body *body, double p, struct paint_star_answer *ret)
{
    struct paint_star_state state;
    double low = 1.0, high = 1.5, surplus;
    if (!paint_star_surplus(body, high, p, &surplus)) return false;
    for (int k = 0; surplus > 0.0; k++, low = high, high *= 1.5)
        if (k == PAINT_STAR_TRIES || !paint_star_surplus(body, 1.5 * high, p, &surplus)) return false;
    for (int k = 0; k < PAINT_STAR_TRIES; k++) {
        double middle = 0.5 * (low + high);
        if (!paint_star_surplus(body, middle, p, &surplus)) return false;
        if (surplus > 0.0) low = middle;
        else high = middle;
    }
    if (!paint_star_at(body, low, p, &state)) return false;
    ret->slower = sqrt((p - body->p) / body->rho * (1.0 - 1.0 / low));
    ret->impedance = sqrt(body->rho * low * state.stiffness);
    return true;
}

static bool paint_star_answers(const struct paint_star_body *body, double p, struct paint_star_answer *ret)
{
    return p <= body->p ? paint_star_rarefied(body, p, ret) : paint_star_shocked(body, p, ret);
}

/* Newton's method: what is left of the difference of the velocities is taken up by both impedances. */
bool paint_star_find(const struct model *model, const double *w_a, const double *w_b, double u_a, double u_b,
                     double near, struct paint_star *ret_star)
{
    struct paint_star_body a, b;
    struct paint_star_answer left, right;
    double p = near;
    if (!paint_star_body_of(model, w_a, &a) || !paint_star_body_of(model, w_b, &b)) return false;
    for (int k = 0; k < PAINT_STAR_TRIES; k++) {
        if (!paint_star_answers(&a, p, &left) || !paint_star_answers(&b, p, &right)) return false;
        double from_a = u_a - left.slower, from_b = u_b + right.slower, apart = from_a - from_b;
        double step = apart / (1.0 / left.impedance + 1.0 / right.impedance);
        double speeds = left.impedance / a.rho + right.impedance / b.rho;
        *ret_star = (struct paint_star){p, 0.5 * (from_a + from_b)};
        if (fabs(apart) < PAINT_STAR_CLOSE * speeds) return true;
        p += step;
    }
    return false;
}
