/* scene_far.c - states that a law gives, but that nobody means: a density in the wrong unit, a temperature in degrees.
 *
 * A law answers for any density. Where it is stated for (its `range`) is what is known of it, and some way beyond is
 * studied: heavy solids by the laws of liquids, explosives by those of gases, hot and dense. What a wrong unit gives is
 * dense and cold. */
#include "case/scene_draft.h"

#include "bulla/eos.h"

#include <math.h>

static const double scene_far_dense = 10.0, scene_far_gas = 3.0;    /* times the range of densities */
static const double scene_far_cold = 1.0 / 3.0, scene_far_hot = 10; /* times the ends of the range of temperatures */
static const double scene_far_fast = 3e4;                           /* m/s: no sound is as fast */

/* T: of the state; `given`: the temperature that the case gives, or 0. */
static bool scene_far_is(const struct bulla_eos_range *range, double rho, double c, double T, double given)
{
    bool gas = range->rho_min <= 0.0 && range->p_min >= 0.0, cold = T < scene_far_cold * range->T_min;
    double most = (gas ? scene_far_gas : scene_far_dense) * range->rho_max;
    if (rho > most && most > 0.0 && (!gas || cold)) return true;
    if (rho * scene_far_dense < range->rho_min || c > scene_far_fast) return true;
    return given > 0.0 && range->T_max > 0.0 && (cold || given > scene_far_hot * range->T_max);
}

void scene_far(struct draft *draft, unsigned material, double rho, double p, double temperature,
               const struct keys_value *value)
{
    const struct instance *eos = &draft->scene->material[material].eos;
    const struct bulla_eos *law = eos->module->table;
    struct bulla_eos_range range = {0};
    double rho_e, rho_c2, T;
    law->range(eos->self, &range);
    law->state(eos->self, 1, &rho, &p, &rho_e, &rho_c2);
    law->temperature(eos->self, 1, &rho, &p, &T);
    double c = sqrt(rho_c2 / rho);
    if (!scene_far_is(&range, rho, c, T, temperature)) return;
    diag_warn(draft->keys.diag, &value->node->mark,
              "%s: '%s' at %.6g kg/m3 and %.6g Pa has a speed of sound of %.3g m/s and a temperature of %.3g K",
              value->path, draft->scene->material[material].name, rho, p, c, T);
    diag_help(draft->keys.diag,
              "'%s' is stated for %.3g to %.4g kg/m3 and %.4g to %.4g K: is the unit right? Water has 998 kg/m3 (0.998 "
              "g/cm3), air 1.2 kg/m3",
              eos->module->name, range.rho_min, range.rho_max, range.T_min, range.T_max);
}
