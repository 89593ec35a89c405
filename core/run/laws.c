/* laws.c - see laws.h. */
#include "run/laws.h"

#include "base/log.h"
#include "base/text.h"
#include "cli/human.h"
#include "plug/instance.h"

static void laws_say_closures(const struct mix_effort *closures)
{
    char solved[HUMAN_ROOM];
    if (closures->solved == 0) return;
    log_note("mixture pressures: %s iterated, %.3g steps each, at most %lld",
             human_count((double)closures->solved, solved), (double)closures->steps / (double)closures->solved,
             closures->most);
}

/* "0 to 1240 kg/m3, 1 kPa to 1 GPa, 281 to 1273 K" */
static void laws_range(const struct model_eos *eos, struct text *ret_text)
{
    struct bulla_eos_range range;
    char low[HUMAN_ROOM], high[HUMAN_ROOM];
    eos->law->range(eos->self, &range);
    text_add(ret_text, "%.4g to %.4g kg/m3, %s to %s, %.4g to %.4g K", range.rho_min, range.rho_max,
             human_si(range.p_min, "Pa", low), human_si(range.p_max, "Pa", high), range.T_min, range.T_max);
}

static void laws_say_outside(const struct model *model, const struct state_counts *counts, unsigned l)
{
    const struct scene_material *material = &model->scene->material[l];
    struct text range = {0};
    if (counts->outside[l] == 0) return;
    laws_range(&model->eos[l], &range);
    log_warn(
        "material '%s' left its law in %lld cell-steps (%lld cells at most): '%s' is stated for %s; a continuation "
        "stood in for it, with no claim to be accurate",
        material->name, counts->outside[l], counts->outside_most[l], material->eos.module->name, range.at);
    text_done(&range);
}

static void laws_say_past(const struct scene *scene, const struct state_counts *counts, unsigned k)
{
    const struct scene_phase *pair = &scene->phases[k];
    char text[HUMAN_ROOM];
    if (counts->past[k] == 0) return;
    log_note("%s and %s: pressure was past the end of their saturation curve (%s) in %lld cell-steps (%lld cells at "
             "most); there they exchanged no mass",
             scene->material[pair->liquid].name, scene->material[pair->vapour].name,
             human_si(pair->curve.p_max, "Pa", text), counts->past[k], counts->past_most[k]);
}

void laws_say(const struct state *state)
{
    const struct model *model = state->model;
    struct state_counts counts = state_counts_total(state);
    laws_say_closures(&counts.closures);
    for (unsigned l = 0; l < model->n_material; l++) laws_say_outside(model, &counts, l);
    for (unsigned k = 0; k < model->n_phase; k++) laws_say_past(model->scene, &counts, k);
}
