/* terms.c - see terms.h. The list below is the page that shows the equations. */
#include "scheme/terms.h"

#include "base/mem.h"
#include "base/status.h"
#include "scheme/calm.h"
#include "scheme/cling.h"
#include "scheme/closure.h"
#include "scheme/conduction.h"
#include "scheme/convection.h"
#include "scheme/cut.h"
#include "scheme/drag.h"
#include "scheme/drain.h"
#include "scheme/exchange.h"
#include "scheme/face_stress.h"
#include "scheme/fick.h"
#include "scheme/fraction.h"
#include "scheme/hardening.h"
#include "scheme/hoop.h"
#include "scheme/lag.h"
#include "scheme/normal.h"
#include "scheme/response.h"
#include "scheme/settling.h"
#include "scheme/shelter.h"
#include "scheme/slant.h"
#include "scheme/slip.h"
#include "scheme/source.h"
#include "scheme/strain.h"
#include "scheme/tension.h"
#include "scheme/viscoelastic.h"
#include "scheme/viscous.h"
#include "scheme/weld.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

const struct term *const terms_all[] = {
    &convection_term,   /* conserved fields through the faces */
    &cut_term,          /* rigid bodies: what they leave of cells */
    &hardening_term,    /* plastic strains travel with their solids */
    &hoop_term,         /* what stands against p / r and the hoop stress in curved geometry */
    &conduction_term,   /* heat from cell to cell and from material to material */
    &fick_term,         /* gases through each other */
    &face_stress_term,  /* one traction for the materials of a cell */
    &drain_term,        /* liquid that a surface has left behind goes back to it */
    &source_term,       /* forces, heat, mass, Lua */
    &drag_term,         /* resistance of porous media */
    &viscous_term,      /* stress and heat of what is viscous */
    &cling_term,        /* where solids meet a jump of velocity is drawn upon at once */
    &calm_term,         /* shear beside strong shocks */
    &fraction_term,     /* volume fractions move with the flow */
    &exchange_term,     /* volume that brings materials back to one pressure */
    &response_term,     /* what solids resist and pull with, where the traction is common */
    &closure_term,      /* K div u, and what was exchanged */
    &fraction_sum,      /* fractions sum to 1 */
    &lag_term,          /* pressures that materials have in an interface travel with them */
    &tension_term,      /* surface tension: its force, and what a surface that moves has stored */
    &slant_term,        /* how steep the edges of fractions are along an axis */
    &normal_term,       /* how the surfaces of solids lie */
    &shelter_term,      /* how far solids come to the faces of their cells */
    &strain_term,       /* the stretch of solids */
    &viscoelastic_term, /* the stretches of their Maxwell branches, which relax */
    &weld_term,         /* where they meet solids share their shear traction */
    &slip_term,         /* beside a fluid they bear none */
    &settling_term,     /* the heat of solids is their own */
    &cut_flux_term,     /* rigid bodies: what they leave of fluxes */
    NULL,
};
_Static_assert(sizeof terms_all / sizeof *terms_all - 1 <= TERMS_MOST, "terms.h has room for fewer");

static bool terms_has(const struct term *term, const struct model *path)
{
    return !term->wanted || term->wanted(path);
}

struct terms *terms_new(const struct model *path, struct face_work *faces)
{
    struct terms *terms = mem_new(1, sizeof *terms);
    terms->model = path;
    terms->faces = faces;
    terms->n_rates = path->n_field;
    for (unsigned i = 0; terms_all[i]; i++) {
        const struct term *term = terms_all[i];
        if (!terms_has(term, path)) continue;
        assert(terms->n < TERMS_MOST);
        terms->at[terms->n] = term;
        terms->number[terms->n] = i;
        terms->first[terms->n++] = terms->n_rates;
        terms->n_rates += term->rows ? term->rows(path) : 0;
        terms->moves = terms->moves || term->moves;
    }
    for (int axis = 0; axis < path->dim; axis++) {
        terms->flux[axis] = mem_new(TERMS_FLUXES, sizeof **terms->flux);
        for (unsigned i = 0; i < terms->n; i++)
            if (terms->at[i]->list) terms->at[i]->list(terms, axis, terms->first[i], faces);
    }
    return terms;
}

void terms_free(struct terms *terms)
{
    if (!terms) return;
    for (int axis = 0; axis < 3; axis++) mem_free(terms->flux[axis]);
    mem_free(terms);
}

void terms_flux(struct terms *terms, int axis, struct term_flux flux, const char *name, const char *suffix)
{
    assert(terms->n_flux[axis] < TERMS_FLUXES);
    snprintf(flux.name, sizeof flux.name, "%s%s%s", name, *suffix ? "_" : "", suffix);
    terms->flux[axis][terms->n_flux[axis]++] = flux;
}

unsigned terms_first(const struct terms *terms, const struct term *term)
{
    unsigned i = 0;
    while (terms->at[i] != term) i++;
    return terms->first[i];
}

void terms_open(const struct term_room *room, void **ret_own)
{
    for (unsigned i = 0; terms_all[i]; i++)
        ret_own[i] = terms_has(terms_all[i], room->model) && terms_all[i]->open ? terms_all[i]->open(room) : NULL;
}

void terms_close(void **own)
{
    for (unsigned i = 0; terms_all[i]; i++)
        if (own[i]) terms_all[i]->close(own[i]);
}

int terms_failure(void *const *own, const char **ret_message, const char **ret_place)
{
    int status = STATUS_OK;
    for (unsigned i = 0; terms_all[i] && !status; i++)
        if (own[i] && terms_all[i]->failure) status = terms_all[i]->failure(own[i], ret_message, ret_place);
    return status;
}

bool terms_acts(const struct term *term, enum term_part part)
{
    return part == TERM_WHOLE || term->diffuses == (part == TERM_DIFFUSION);
}

bool terms_spread(const struct scene *scene)
{
    bool spread = false;
    for (unsigned i = 0; terms_all[i]; i++) spread = spread || (terms_all[i]->spreads && terms_all[i]->spreads(scene));
    return spread;
}

void terms_pace(const struct terms *terms, const struct term_pace *pace, double *rate)
{
    memset(rate, 0, pace->n_cell * sizeof *rate);
    for (unsigned i = 0; i < terms->n; i++)
        if (terms->at[i]->pace && terms_acts(terms->at[i], pace->part)) terms->at[i]->pace(pace, rate);
}

void terms_say(const struct model *model, struct text *text)
{
    for (unsigned i = 0; terms_all[i]; i++) {
        const struct term *term = terms_all[i];
        if (!terms_has(term, model)) continue;
        text_add(text, "  %-10s  %s", term->name, term->equation);
        if (term->say) term->say(model->scene, text);
        text_add(text, "  [%s]\n", term->owner);
    }
}
