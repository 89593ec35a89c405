/* scene_phase_surface.c - in which cells of a smeared surface a liquid and its vapour change phase: what the case file
 * says, and what a pair has where it says nothing (docs/decisions/phase-change.md, "What a pair has by itself"). */
#include "case/scene_draft.h"

/* Of a cell: vapour at which liquid evaporates, and liquid at which vapour among gases condenses. */
static const double scene_phase_surface_dry = 0.99, scene_phase_surface_wet = 0.9;

/* Cells that sound crosses while vapour condenses where mixtures are painted: of both more than a trace. */
static const double scene_phase_surface_cells = 8.0, scene_phase_surface_trace = 1e-3;

/* Does the liquid conduct, and the pair act at surfaces? */
static bool scene_phase_surface_conducts(const struct scene *scene, const struct scene_phase *pair)
{
    return !pair->everywhere && scene->material[pair->liquid].conductivity.module;
}

bool scene_phase_surface_fed(const struct scene *scene, const struct scene_phase *pair)
{
    return pair->rate == SCENE_PHASE_EQUILIBRIUM && scene_phase_surface_conducts(scene, pair);
}

static double scene_phase_surface_onset(const struct scene *scene, const struct scene_phase *pair)
{
    bool evaporates = pair->direction != SCENE_PHASE_CONDENSATION;
    return evaporates && !pair->n_gas && scene_phase_surface_fed(scene, pair) ? scene_phase_surface_dry : 0.0;
}

static double scene_phase_surface_condense(const struct scene *scene, const struct scene_phase *pair)
{
    bool condenses = pair->direction != SCENE_PHASE_EVAPORATION;
    bool among = pair->n_gas && pair->mixing && !(pair->onset > 0.0);
    bool kinetic = pair->rate == SCENE_PHASE_HERTZ_KNUDSEN && scene_phase_surface_conducts(scene, pair);
    return condenses && among && (kinetic || scene_phase_surface_fed(scene, pair)) ? scene_phase_surface_wet : 0.0;
}

void scene_phase_surface(struct draft *draft, const struct keys_map *map, struct scene_phase *pair)
{
    const struct keys_value *onset = keys_at(map, "onset"), *wet = keys_at(map, "condense-from"),
                            *nucleus = keys_at(map, "nucleus"),
                            *over = keys_at(map, "condense-over"), *const condensing[] = {wet, nucleus, over};
    pair->onset = onset->given ? onset->number : scene_phase_surface_onset(draft->scene, pair);
    pair->wet = wet->given ? wet->number : scene_phase_surface_condense(draft->scene, pair);
    pair->over = over->given ? over->number : 0.0;
    pair->nucleus = nucleus->given ? nucleus->number : 0.0;
    if (pair->everywhere && pair->onset > 0.0)
        keys_error(&draft->keys, onset,
                   "with 'where: everywhere' liquid evaporates from nothing: 'onset' is for surfaces");
    for (int i = 0; i < 3; i++)
        if (pair->direction == SCENE_PHASE_EVAPORATION && condensing[i]->given && condensing[i]->number > 0.0)
            keys_error(&draft->keys, condensing[i], "with 'direction: evaporation' nothing condenses");
    if (pair->over > 0.0 && pair->rate != SCENE_PHASE_EQUILIBRIUM)
        keys_error(&draft->keys, over, "condensation has a rate already; 'condense-over' is for 'rate: equilibrium'");
}

bool scene_phase_surface_boils(const struct scene *scene)
{
    for (unsigned k = 0; k < scene->n_phase; k++)
        if (scene_phase_surface_fed(scene, &scene->phases[k]) || scene->phases[k].rate == SCENE_PHASE_NONE)
            return false;
    return scene->n_phase > 0 && scene->n_material == 2 * scene->n_phase;
}

bool scene_phase_surface_mixed(const struct scene_phase *pair, const struct scene_layer *layer)
{
    const double *part = layer->has_material ? layer->fractions : NULL, least = scene_phase_surface_trace;
    return part && part[pair->liquid] > least && part[pair->vapour] > least;
}

void scene_phase_surface_late(struct draft *draft)
{
    const struct keys_value *section = keys_at(draft->root, "phase-change");
    struct scene *scene = draft->scene;
    if (scene->n_phase != section->count) return; /* errors */
    for (unsigned k = 0; k < scene->n_phase; k++) {
        struct scene_phase *pair = &scene->phases[k];
        bool condenses = pair->direction != SCENE_PHASE_EVAPORATION && pair->rate == SCENE_PHASE_EQUILIBRIUM;
        if (!condenses || keys_at(section->list[k].map, "condense-over")->given) continue;
        if (pair->onset > 0.0 || pair->wet > 0.0) continue;
        for (unsigned i = 0; i < scene->n_layer; i++)
            if (scene_phase_surface_mixed(pair, &scene->layers[i])) pair->over = scene_phase_surface_cells;
    }
}
