/* scene_fick.c - gases that diffuse through each other: which, and how fast. */
#include "case/scene_draft.h"

#include "bulla/eos.h"

static const struct key scene_fick_rows[] = {
    {.name = "gases",
     .type = KEYS_TEXT,
     .many = KEYS_LIST,
     .required = true,
     .doc = "Two gases or more, as in [steam, air], that lie in each other as molecules do."},
    {.name = "diffusivity",
     .type = KEYS_NUMBER,
     .unit = "m2/s",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc =
         "D of each in the others, at `temperature` and `pressure`; water vapour in air: 25 mm2/s at 25 C and 1 atm."},
    {.name = "law",
     .type = KEYS_CHOICE,
     .choices = "gas|constant",
     .fallback = "gas",
     .doc = "gas: D grows as T^1.75/p, as of dilute gases; constant: D everywhere."},
    {.name = "temperature",
     .type = KEYS_NUMBER,
     .unit = "K",
     .min = KEYS_POSITIVE,
     .max = 1e4,
     .fallback = "298.15 K",
     .doc = "Where D is given."},
    {.name = "pressure",
     .type = KEYS_NUMBER,
     .unit = "Pa",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .fallback = "101325 Pa",
     .doc = "Where D is given."},
    {0},
};

const struct keys_section scene_fick_keys = {.name = "gas-diffusion",
                                             .doc = "Gases that diffuse through each other (Fick's law).",
                                             .keys = scene_fick_rows};

/* A gas of a mixture, or -1 after an error. */
static int scene_fick_member(struct draft *draft, const struct keys_value *value, const struct scene_fick *fick)
{
    int index = scene_matter_index(draft, value);
    bool again = false;
    if (index < 0) return -1;
    for (unsigned g = 0; g < fick->n; g++) again = again || fick->gas[g] == (unsigned)index;
    for (unsigned k = 0; k < draft->scene->n_fick; k++)
        for (unsigned g = 0; g < draft->scene->ficks[k].n; g++)
            again = again || draft->scene->ficks[k].gas[g] == (unsigned)index;
    if (again) keys_error(&draft->keys, value, "'%s' is named already", value->text);
    if (scene_matter_is_solid(draft, (unsigned)index)) {
        keys_error(&draft->keys, value, "'%s' is a solid: gases diffuse through each other", value->text);
        return -1;
    }
    const struct instance *eos = &draft->scene->material[index].eos;
    const struct bulla_eos *law = eos->module ? eos->module->table : NULL;
    if (law && BULLA_EOS_HAS(law, gas_constant) && !(scene_phase_gas(draft->scene, (unsigned)index) > 0.0)) {
        keys_error(&draft->keys, value, "'%s' is a liquid: gases diffuse through each other", value->text);
        return -1;
    }
    return again ? -1 : index;
}

static void scene_fick_mixture(struct draft *draft, const struct keys_value *value)
{
    const struct keys_map *map = value->map;
    struct scene_fick fick = {0};
    if (!map) return;
    const struct keys_value *gases = keys_at(map, "gases");
    for (unsigned i = 0; i < gases->count && fick.n < SCENE_MATERIALS; i++) {
        int index = scene_fick_member(draft, &gases->list[i], &fick);
        if (index >= 0) fick.gas[fick.n++] = (unsigned)index;
    }
    if (gases->given && gases->count < 2) {
        keys_error(&draft->keys, gases, "one gas diffuses through another: two names are needed");
        diag_help(draft->keys.diag, "'gases: [steam, air]'");
    }
    fick.D = keys_at(map, "diffusivity")->number;
    fick.constant = keys_at(map, "law")->integer == 1;
    fick.T = keys_at(map, "temperature")->number;
    fick.p = keys_at(map, "pressure")->number;
    if (fick.n > 1) draft->scene->ficks[draft->scene->n_fick++] = fick;
}

void scene_fick(struct draft *draft)
{
    const struct keys_value *section = keys_at(draft->root, "gas-diffusion");
    const struct keys_value *closure = keys_at(keys_at(draft->root, "scheme")->map, "closure");
    if (!section->node) return;
    if (section->count > SCENE_PHASES)
        keys_error(&draft->keys, section, "%u mixtures are more than %d", section->count, SCENE_PHASES);
    for (unsigned i = 0; i < section->count && i < SCENE_PHASES; i++) scene_fick_mixture(draft, &section->list[i]);
    if (draft->scene->scheme.closure != SCENE_ALLAIRE) return;
    keys_error(&draft->keys, closure, "with gas-diffusion volume must move with mass, which '%s' does not",
               closure->text);
    diag_help(draft->keys.diag, "'closure: kapila'");
}
