/* scene_boil.c - doubts about pairs of a liquid and its vapour: cells that the heat which feeds their surface does not
 * see, superheated liquid without `onset`, painted mixtures with keys of surfaces, states beyond the end of the curve.
 */
#include "case/saturation.h"
#include "case/scene_draft.h"

#include "bulla/conductivity.h"
#include "bulla/eos.h"

#include <math.h>

static const double scene_boil_cells = 4.0;  /* per layer of heat at the end of the run */
static const double scene_boil_super = 0.05; /* [K] of superheat that are none */

/* Least side of the finest cells. */
static double scene_boil_cell(const struct scene *scene)
{
    const struct scene_domain *domain = &scene->domain;
    double h = HUGE_VAL;
    for (int axis = 0; axis < domain->dim; axis++) {
        double own = (domain->upper[axis] - domain->lower[axis]) / ldexp(domain->cells[axis], scene->mesh.levels);
        h = own < h ? own : h;
    }
    return h;
}

/* How far heat gets in a material until the end of the run, sqrt(k v t/c_p) at 1 atm and T. */
static double scene_boil_layer(const struct scene *scene, const struct scene_material *material, double T)
{
    const struct bulla_eos *law = material->eos.module->table;
    const struct bulla_conductivity *conductivity = material->conductivity.module->table;
    double p = 101325.0, rate = 0.0, rho = 0.0, v, h, s, v_T, v_p, c_p, k;
    law->thermal(material->eos.self, 1, &p, &T, &rho, &v, &h, &s, &v_T, &v_p, &c_p);
    conductivity->k.value(material->conductivity.self, 1, &rate, &T, &p, &rho, &k);
    return sqrt(k * v * scene->run.until / c_p);
}

static void scene_boil_heat(struct draft *draft, const struct keys_value *value, const struct scene_phase *pair)
{
    const struct scene *scene = draft->scene;
    const struct scene_material *liquid = &scene->material[pair->liquid];
    if (!scene_phase_surface_fed(scene, pair)) return;
    double T = pair->curve.T_max < 373.0 ? pair->curve.T_max : 373.0, layer = scene_boil_layer(scene, liquid, T);
    double h = scene_boil_cell(scene);
    if (!(h * scene_boil_cells > layer)) return;
    diag_warn(
        draft->keys.diag, &value->node->mark,
        "%s: heat gets %.3g m far in '%s' until the end, %.2g of the finest cells of %.3g m: what evaporates there "
        "depends on the cells",
        value->path, layer, liquid->name, layer / h, h);
    diag_help(draft->keys.diag, "%g cells per layer are needed, or a finite rate", scene_boil_cells);
}

bool scene_boil_state(const struct scene *scene, const struct scene_layer *layer, unsigned l, double *ret_p,
                      double *ret_T)
{
    const struct instance *eos = &scene->material[l].eos;
    const struct bulla_eos *law = eos->module->table;
    const struct scene_value *density = layer->density ? &layer->density[l] : NULL;
    if (!layer->has_material || !layer->fractions || !(layer->fractions[l] > 0.0)) return false;
    if (!layer->pressure.given || layer->pressure.script) return false;
    *ret_p = layer->pressure.number;
    if (layer->temperature.given) {
        *ret_T = layer->temperature.number;
        return !layer->temperature.script;
    }
    if (!density || !density->given || density->script) return false;
    law->temperature(eos->self, 1, &density->number, ret_p, ret_T);
    return true;
}

static void scene_boil_onset(struct draft *draft, const struct keys_value *value, const struct scene_phase *pair,
                             unsigned index)
{
    const struct scene *scene = draft->scene;
    struct saturation both;
    double p, T;
    if (!scene_phase_surface_fed(scene, pair) || pair->onset > 0.0) return;
    if (!scene_boil_state(scene, &scene->layers[index], pair->liquid, &p, &T)) return;
    if (!saturation_of(&scene->material[pair->liquid].eos, &scene->material[pair->vapour].eos, &both)) return;
    double over = T - saturation_temperature(&both, p);
    if (!(over > scene_boil_super)) return;
    diag_warn(draft->keys.diag, &value->node->mark,
              "%s: '%s' of initial[%u] is superheated by %.3g K and boils wherever the mesh brings a trace of vapour",
              value->path, scene->material[pair->liquid].name, index, over);
    diag_help(draft->keys.diag, "'onset: 0.99' lets it evaporate at its surface only");
}

/* A mixture that is painted is no smeared surface: what pairs have by themselves is not for it. */
static void scene_boil_mixed(struct draft *draft, const struct keys_value *value, const struct scene_phase *pair,
                             unsigned index)
{
    const struct scene *scene = draft->scene;
    const struct scene_layer *layer = &scene->layers[index];
    bool onset = pair->onset > 0.0 && !keys_at(value->map, "onset")->given;
    bool wet = pair->wet > 0.0 && !keys_at(value->map, "condense-from")->given;
    if (!(onset || wet) || !scene_phase_surface_mixed(pair, layer)) return;
    diag_warn(draft->keys.diag, &value->node->mark,
              "%s: '%s' and '%s' of initial[%u] are mixed, and %s only at surfaces, where %s fills %.2g of a cell",
              value->path, scene->material[pair->liquid].name, scene->material[pair->vapour].name, index,
              onset ? "evaporate" : "condense", onset ? "vapour" : "liquid", onset ? pair->onset : pair->wet);
    diag_help(draft->keys.diag, "'%s: 0' for bubbly mixtures", onset ? "onset" : "condense-from");
}

static void scene_boil_range(struct draft *draft, const struct keys_value *value, const struct scene_phase *pair,
                             unsigned index)
{
    const struct scene *scene = draft->scene;
    const unsigned both[2] = {pair->liquid, pair->vapour};
    double p, T;
    for (int k = 0; k < 2; k++) {
        if (!scene_boil_state(scene, &scene->layers[index], both[k], &p, &T)) continue;
        bool cold = T < pair->curve.T_min;
        bool past = p > pair->curve.p_max;
        if (!cold && !past && T <= pair->curve.T_max) continue;
        diag_warn(draft->keys.diag, &value->node->mark,
                  "%s: '%s' of initial[%u], at %.4g K and %.4g Pa, is beyond the %s of the curve at %.4g K and %.4g Pa",
                  value->path, scene->material[both[k]].name, index, T, p, cold ? "beginning" : "end",
                  cold ? pair->curve.T_min : pair->curve.T_max, cold ? pair->curve.p_min : pair->curve.p_max);
        diag_help(draft->keys.diag, cold   ? "below it the laws have no saturation: what they exchange there is a guess"
                                    : past ? "above that pressure only temperatures are shared, no mass is exchanged"
                                           : "so hot its liquid boils at any pressure up to that of the end");
    }
}

void scene_boil(struct draft *draft)
{
    const struct keys_value *section = keys_at(draft->root, "phase-change");
    const struct scene *scene = draft->scene;
    if (scene->n_phase != section->count) return; /* errors */
    for (unsigned k = 0; k < scene->n_phase; k++) {
        scene_boil_heat(draft, &section->list[k], &scene->phases[k]);
        for (unsigned i = 0; i < scene->n_layer; i++) {
            scene_boil_onset(draft, &section->list[k], &scene->phases[k], i);
            scene_boil_mixed(draft, &section->list[k], &scene->phases[k], i);
            scene_boil_range(draft, &section->list[k], &scene->phases[k], i);
        }
    }
}
