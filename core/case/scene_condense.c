/* scene_condense.c - doubts about what a pair of a liquid and its vapour starts from: vapour that condenses or liquid
 * that boils at once, traces from which nothing grows, saturation pressures that are not those of water. */
#include "case/saturation.h"
#include "case/scene_draft.h"

#include <math.h>

static const double scene_condense_near = 0.02;  /* pressures over saturation that are none */
static const double scene_condense_off = 0.1;    /* saturation pressures off those of water that are told */
static const double scene_condense_trace = 1e-6; /* of a cell: PHASE_FELT of phys/phase.h */

/* A pair in one initial layer. */
struct scene_condense {
    const struct scene *scene;
    const struct scene_phase *pair;
    const struct scene_layer *layer;
    unsigned index;
    double p, T, psat; /* numbers */
};

static double scene_condense_part(const struct scene_condense *start, unsigned material)
{
    return start->layer->fractions[material];
}

/* Volume fraction of vapour and gases. */
static double scene_condense_thin(const struct scene_condense *start)
{
    double thin = scene_condense_part(start, start->pair->vapour);
    for (unsigned g = 0; g < start->pair->n_gas; g++) thin += scene_condense_part(start, start->pair->gas[g]);
    return thin;
}

/* Of the vapour: volumes at one p and T are mole fractions. */
static double scene_condense_partial(const struct scene_condense *start)
{
    double vapour = scene_condense_part(start, start->pair->vapour);
    return start->pair->mixing ? start->p * vapour / scene_condense_thin(start) : start->p;
}

static void scene_condense_vapour(struct draft *draft, const struct keys_value *value,
                                  const struct scene_condense *start)
{
    const struct scene_material *material = start->scene->material;
    double p = scene_condense_partial(start);
    if (!(p > (1.0 + scene_condense_near) * start->psat) || start->pair->direction == SCENE_PHASE_EVAPORATION) return;
    diag_warn(
        draft->keys.diag, &value->node->mark,
        "%s: '%s' of initial[%u], %.4g Pa at %.5g K, condenses at once where it meets '%s': saturation is %.4g Pa",
        value->path, material[start->pair->vapour].name, start->index, p, start->T, material[start->pair->liquid].name,
        start->psat);
    diag_help(draft->keys.diag, "less vapour (a gas may hold the rest of the pressure), or a higher temperature");
}

/* Liquid among its vapour, or where it may boil without. */
static void scene_condense_liquid(struct draft *draft, const struct keys_value *value,
                                  const struct scene_condense *start)
{
    const struct scene_phase *pair = start->pair;
    const struct scene_material *material = start->scene->material;
    bool among = scene_condense_part(start, pair->vapour) > scene_condense_trace;
    double p = among ? scene_condense_partial(start) : start->p;
    double borne = among ? 0.0 : pair->tension;
    if (!among && (!pair->everywhere || pair->superheat > 0.0 || scene_condense_thin(start) > 0.0)) return;
    if (among && pair->onset > scene_condense_thin(start)) return;
    if (!(p + borne < (1.0 - scene_condense_near) * start->psat) || pair->direction == SCENE_PHASE_CONDENSATION) return;
    diag_warn(draft->keys.diag, &value->node->mark,
              "%s: '%s' of initial[%u], %s%.4g Pa at %.5g K, boils at once: saturation is %.4g Pa", value->path,
              material[pair->liquid].name, start->index, among ? "its vapour at " : "", p, start->T, start->psat);
    diag_help(draft->keys.diag, "a pressure of at least that, or less temperature%s",
              pair->everywhere ? "; 'nucleation' says what it bears" : "");
}

static void scene_condense_traces(struct draft *draft, const struct keys_value *value,
                                  const struct scene_condense *start)
{
    double thin = scene_condense_thin(start);
    if (!(thin > 0.0) || thin > scene_condense_trace || !(scene_condense_part(start, start->pair->liquid) > 0.0))
        return;
    diag_warn(draft->keys.diag, &value->node->mark,
              "%s: %.2g of '%s' in '%s' of initial[%u] is a trace: below %g of a cell nothing grows from it",
              value->path, thin, start->scene->material[start->pair->vapour].name,
              start->scene->material[start->pair->liquid].name, start->index, scene_condense_trace);
    diag_help(draft->keys.diag, "leave it out: liquid alone boils with 'where: everywhere', and each material costs");
}

static void scene_condense_water(struct draft *draft, const struct keys_value *value,
                                 const struct scene_condense *start, const struct saturation *both)
{
    double off = start->psat / saturation_water(start->T) - 1.0;
    const char *name = start->scene->material[start->pair->liquid].name;
    if (!saturation_is_water(both, name) || !(fabs(off) > scene_condense_off)) return;
    diag_warn(draft->keys.diag, &value->node->mark,
              "%s: at %.5g K (initial[%u]) the saturation pressure of '%s' is %.4g Pa, %+.0f %% off that of water",
              value->path, start->T, start->index, name, start->psat, 100.0 * off);
    diag_help(draft->keys.diag, "'calibrate' sets it at one temperature, iapws95 with iapws95-vapour at all");
}

/* All of one layer. */
static void scene_condense_layer(struct draft *draft, const struct keys_value *value, struct scene_condense *start)
{
    const struct scene_phase *pair = start->pair;
    struct saturation both;
    if (scene_boil_state(start->scene, start->layer, pair->liquid, &start->p, &start->T))
        scene_condense_traces(draft, value, start);
    else if (!scene_boil_state(start->scene, start->layer, pair->vapour, &start->p, &start->T)) return;
    if (pair->rate == SCENE_PHASE_NONE) return;
    const struct scene_material *material = start->scene->material;
    if (!saturation_of(&material[pair->liquid].eos, &material[pair->vapour].eos, &both)) return;
    start->psat = saturation_pressure(&both, start->T);
    if (isnan(start->psat)) return;
    if (scene_condense_part(start, pair->vapour) > scene_condense_trace) scene_condense_vapour(draft, value, start);
    if (scene_condense_part(start, pair->liquid) > scene_condense_trace) scene_condense_liquid(draft, value, start);
    scene_condense_water(draft, value, start, &both);
}

void scene_condense(struct draft *draft)
{
    const struct keys_value *section = keys_at(draft->root, "phase-change");
    const struct scene *scene = draft->scene;
    if (scene->n_phase != section->count) return; /* errors */
    for (unsigned k = 0; k < scene->n_phase; k++)
        for (unsigned i = 0; i < scene->n_layer; i++) {
            struct scene_condense start = {.scene = scene,
                                           .pair = &scene->phases[k],
                                           .layer = &scene->layers[i],
                                           .index = i};
            scene_condense_layer(draft, &section->list[k], &start);
        }
}
