/* paint_contact.c - see paint_contact.h. */
#include "paint/paint_contact.h"

#include "paint/paint_star.h"
#include "phys/mix.h"

#include <math.h>
#include <string.h>

/* Pressures that differ by less than this share of the softer body's rho c^2 are left to the mean: a profile that both
 * bodies follow differs by so much between the middle of a cell and that of a part of it. */
#define PAINT_CONTACT_JUMP 0.1

/* Where the pressure of a body is looked for from [Pa]. */
#define PAINT_CONTACT_START 1e5

struct paint_contact_body {
    double w[MODEL_FIELDS];
    double p, velocity, impedance, stiffness;
};

static bool paint_contact_is_fluid(const struct model *model, const double *u)
{
    double solid = 0.0;
    for (unsigned s = 0; s < model->n_solid; s++) solid += fabs(u[model->i_m + model->solids[s].material]);
    return solid == 0.0;
}

static void paint_contact_look(const struct model *model, const double *u, const double n[3],
                               struct paint_contact_body *ret_body)
{
    double rho_c2[SCENE_MATERIALS], c2, rho = 0.0;
    struct paint_contact_body *body = ret_body;
    memset(body, 0, sizeof *body);
    body->w[model->i_E] = PAINT_CONTACT_START;
    mix_primitives(model, 1, 1, u, body->w);
    mix_stiffness(model, 1, 1, body->w, rho_c2);
    mix_speed2(model, 1, 1, body->w, rho_c2, &c2);
    for (unsigned l = 0; l < model->n_material; l++) rho += u[model->i_m + l];
    for (unsigned d = 0; d < model->n_velocity; d++) body->velocity += n[d] * body->w[model->i_u + d];
    body->p = body->w[model->i_E];
    body->impedance = rho * sqrt(c2);
    body->stiffness = rho * c2;
}

/* Do the bodies mostly consist of different materials? A jump within one is a wave: its mean is a state of that
 * material. */
static bool paint_contact_differs(const struct model *model, const double *a, const double *b)
{
    double difference = 0.0;
    for (unsigned l = 0; l < model->n_alpha; l++) difference += fabs(a[model->i_alpha + l] - b[model->i_alpha + l]);
    return difference > 1.0;
}

/* Do all fluids of the cell bear its pressure? */
static bool paint_contact_is_borne(const struct model *model, const double *w)
{
    bool borne = true;
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct model_eos *eos = &model->eos[l];
        double least;
        if (!(w[model->i_alpha + l] > MIX_ABSENT)) continue;
        eos->law->p_min(eos->self, 1, &w[model->i_m + l], &least);
        borne = borne && w[model->i_E] > least;
    }
    return borne;
}

bool paint_contact(const struct model *model, const double *u_a, const double *u_b, const double n[3], double *u)
{
    struct paint_contact_body a, b;
    double w[MODEL_FIELDS] = {0}, met[MODEL_FIELDS], along = 0.0;
    if (!paint_contact_is_fluid(model, u_a) || !paint_contact_is_fluid(model, u_b)) return false;
    if (!paint_contact_differs(model, u_a, u_b)) return false;
    paint_contact_look(model, u_a, n, &a);
    paint_contact_look(model, u_b, n, &b);
    double sum = a.impedance + b.impedance, wave = a.p - b.p, slip = a.velocity - b.velocity;
    double softer = a.stiffness < b.stiffness ? a.stiffness : b.stiffness;
    if (!(fabs(wave) > PAINT_CONTACT_JUMP * softer)) return false;
    w[model->i_E] = PAINT_CONTACT_START;
    mix_primitives(model, 1, 1, u, w);
    for (unsigned d = 0; d < model->n_velocity; d++) along += n[d] * w[model->i_u + d];
    struct paint_star star;
    double acoustic = (b.impedance * a.p + a.impedance * b.p + a.impedance * b.impedance * slip) / sum;
    if (!paint_star_find(model, a.w, b.w, a.velocity, b.velocity, acoustic, &star)) return false;
    w[model->i_E] = star.p;
    if (!paint_contact_is_borne(model, w)) return false;
    for (unsigned d = 0; d < model->n_velocity; d++) w[model->i_u + d] += n[d] * (star.u - along);
    mix_conserved(model, 1, 1, w, met);
    for (unsigned d = 0; d < model->n_velocity; d++) u[model->i_u + d] = met[model->i_u + d];
    u[model->i_E] = met[model->i_E];
    return true;
}
