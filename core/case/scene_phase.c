/* scene_phase.c - liquids and their vapours: which materials exchange mass, how fast and where. */
#include "case/saturation.h"
#include "case/scene_draft.h"

#include "base/mem.h"
#include "base/status.h"
#include "bulla/eos.h"

#include <math.h>
#include <string.h>

static const struct key scene_phase_type[] = {
    {.name = "type", .type = KEYS_CHOICE, .required = true, .doc = "How fast mass is exchanged."},
    {0},
};

static const struct key scene_phase_relaxation_rows[] = {
    {.name = "time",
     .type = KEYS_NUMBER,
     .unit = "s",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc = "Time in which what is missing to equilibrium falls to 1/e."},
    {0},
};

static const struct key scene_phase_hertz_rows[] = {
    {.name = "accommodation",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = KEYS_POSITIVE,
     .max = 1,
     .fallback = "0.4",
     .doc = "Share of the molecules that stay; of water 0.04 to 1 in the literature."},
    {.name = "area",
     .type = KEYS_NUMBER,
     .unit = "1/m",
     .min = KEYS_POSITIVE,
     .max = KEYS_MOST,
     .required = true,
     .doc = "Surface of liquid and vapour per volume of the cell: about 1/h for an interface in cells of the size h, "
            "3 alpha/R in a cloud of bubbles."},
    {0},
};

static const struct key scene_phase_lua_rows[] = {
    {.name = "lua",
     .type = KEYS_TEXT,
     .required = true,
     .doc = "File or block: function(p, T, p_eq, share, alpha) that returns the mass that evaporates per volume of the "
            "cell and "
            "time, kg/m3/s, below 0 where vapour condenses: p and T of the cell, p_eq the vapour's pressure at which "
            "nothing "
            "happens, share * p its pressure (share: its mole fraction among the gases), alpha the volume fraction of "
            "vapour and gases."},
    {0},
};

static const struct keys_section scene_phase_equilibrium = {
    .name = "equilibrium", .doc = "Infinitely fast: one pressure, temperature and Gibbs energy after every stage."};
static const struct keys_section scene_phase_none = {.name = "none",
                                                     .doc = "No mass is exchanged; the family shares its temperature."};
static const struct keys_section scene_phase_relaxation = {.name = "relaxation",
                                                           .doc = "Towards equilibrium in a given time.",
                                                           .keys = scene_phase_relaxation_rows};
static const struct keys_section scene_phase_hertz = {
    .name = "hertz-knudsen",
    .doc = "Kinetic theory: 2 s/(2 - s)/sqrt(2 pi R T) (p_eq - p_v) per surface, implicit in time.",
    .keys = scene_phase_hertz_rows};

static const struct keys_section scene_phase_lua = {
    .name = "lua",
    .doc = "A function of yours, implicit in time and never past equilibrium.",
    .keys = scene_phase_lua_rows};

static const struct keys_section *const scene_phase_rates[] = {&scene_phase_equilibrium, &scene_phase_none,
                                                               &scene_phase_relaxation,  &scene_phase_hertz,
                                                               &scene_phase_lua,         NULL};

static const struct keys_section scene_phase_rate = {.name = "rate",
                                                     .doc = "How fast mass is exchanged.",
                                                     .keys = scene_phase_type,
                                                     .selector = "type",
                                                     .cases = scene_phase_rates};

static const struct key scene_phase_nucleation_rows[] = {
    {.name = "tension",
     .type = KEYS_NUMBER,
     .unit = "Pa",
     .max = KEYS_MOST,
     .doc = "Liquid without vapour cavitates where its pressure is below the saturation pressure by more than this."},
    {.name = "superheat",
     .type = KEYS_NUMBER,
     .unit = "K",
     .max = KEYS_MOST,
     .doc = "Liquid without vapour boils where its temperature is above saturation by more than this."},
    {0},
};

static const struct keys_section scene_phase_nucleation = {
    .name = "nucleation",
    .doc = "When vapour comes to be where there is none.",
    .keys = scene_phase_nucleation_rows,
    .choose = 2,
    .rules = "{'minProperties': 1, 'maxProperties': 1, 'errorMessage': 'One threshold is needed.'}"};

static const struct key scene_phase_calibrate_rows[] = {
    {.name = "temperature",
     .type = KEYS_NUMBER,
     .unit = "K",
     .min = KEYS_POSITIVE,
     .max = 1e4,
     .required = true,
     .doc = "Where the liquid boils ..."},
    {.name = "pressure",
     .type = KEYS_NUMBER,
     .unit = "Pa",
     .min = KEYS_POSITIVE,
     .max = 1e9,
     .required = true,
     .doc = "... at this pressure ..."},
    {.name = "latent-heat",
     .type = KEYS_NUMBER,
     .unit = "J/kg",
     .min = KEYS_POSITIVE,
     .max = 1e9,
     .required = true,
     .doc = "... with this latent heat."},
    {0},
};

static const struct keys_section scene_phase_calibrate = {
    .name = "calibrate",
    .doc = "Sets the heat bond and the zero of entropy of the vapour.",
    .keys = scene_phase_calibrate_rows};

static const struct key scene_phase_rows[] = {
    {.name = "liquid", .type = KEYS_TEXT, .required = true, .doc = "The liquid."},
    {.name = "vapour", .type = KEYS_TEXT, .required = true, .doc = "Its vapour."},
    {.name = "gases",
     .type = KEYS_TEXT,
     .many = KEYS_LIST,
     .doc = "Gases that share the vapour's volume and the temperature of both."},
    {.name = "mixing",
     .type = KEYS_CHOICE,
     .choices = "ideal|none",
     .fallback = "ideal",
     .doc = "ideal: gases lower the vapour's pressure (Dalton); none: the vapour takes no notice of them."},
    {.name = "rate",
     .type = KEYS_SECTION,
     .section = &scene_phase_rate,
     .fallback = "equilibrium",
     .doc = "How fast mass is exchanged: equilibrium, none, or {type: relaxation, ...}, {type: hertz-knudsen, ...}, "
            "{type: lua, ...}."},
    {.name = "where",
     .type = KEYS_CHOICE,
     .choices = "interface|everywhere",
     .fallback = "interface",
     .doc = "interface: in cells that hold liquid and vapour, or liquid and a gas; everywhere: also in liquid alone, "
            "beyond `nucleation`."},
    {.name = "nucleation",
     .type = KEYS_SECTION,
     .section = &scene_phase_nucleation,
     .doc = "With everywhere: {tension: 1 MPa} or {superheat: 5 K}; not given: no tension is borne."},
    {.name = "onset",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = 0.0,
     .max = 0.999,
     .doc = "Liquid evaporates only where vapour and gases fill this share of a cell or of one beside it; wherever "
            "they are felt, if 0. Not given: 0.99 for pairs without gases whose liquid conducts, with `rate: "
            "equilibrium` at interfaces, so that their surface stays sharp; else 0. Liquid below a tenth of its "
            "saturation pressure evaporates, and vapour condenses, all the same."},
    {.name = "condense-from",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = 0.0,
     .max = 0.99,
     .doc =
         "Vapour condenses only where the liquid fills this share of a cell; wherever it is felt, if 0, in all cells "
         "that the surface is smeared over. Not given: 0.9 for pairs with gases whose liquid conducts, at interfaces "
         "with the rates equilibrium and hertz-knudsen and no `onset`; else 0."},
    {.name = "condense-over",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = 0.0,
     .max = 100.0,
     .doc =
         "With `rate: equilibrium` vapour condenses while sound of the mixture (Wood's speed) crosses this many cells; "
         "at once, if 0. Not given: 8 where `initial` mixes the liquid with its vapour and the pair has neither "
         "`onset` "
         "nor `condense-from`, so that the pressure behind condensing shocks does not swing; else 0."},
    {.name = "nucleus",
     .type = KEYS_NUMBER,
     .unit = "1",
     .min = 1e-5,
     .max = 0.01,
     .doc =
         "Vapour that fills no more of a cell than this does not condense; all does, if not given. Liquid in which a "
         "bubble has vanished then boils when it is stretched, and bears no tension."},
    {.name = "gas-temperature",
     .type = KEYS_CHOICE,
     .choices = "shared|own",
     .fallback = "shared",
     .doc =
         "Of the gases in a cell that also holds liquid. shared: that of liquid and vapour. own: they keep their heat "
         "but for work and conduction, so that a collapse does not cool what the mesh mixes of them into the liquid."},
    {.name = "direction",
     .type = KEYS_CHOICE,
     .choices = "both|evaporation|condensation",
     .fallback = "both",
     .doc = "evaporation: only where liquid wants to become vapour at one pressure and temperature of the family."},
    {.name = "calibrate",
     .type = KEYS_SECTION,
     .section = &scene_phase_calibrate,
     .doc = "Where the pair boils: sets `heat-bond` and `entropy-zero` of the vapour."},
    {0},
};

const struct keys_section scene_phase_keys = {.name = "phase-change",
                                              .doc = "A liquid and its vapour, which exchange mass.",
                                              .keys = scene_phase_rows};

/* What a material is to the pairs so far. */
static bool scene_phase_taken(const struct scene *scene, unsigned material)
{
    for (unsigned k = 0; k < scene->n_phase; k++) {
        const struct scene_phase *pair = &scene->phases[k];
        if (pair->liquid == material || pair->vapour == material) return true;
        for (unsigned g = 0; g < pair->n_gas; g++)
            if (pair->gas[g] == material) return true;
    }
    return false;
}

/* A material of a family, or -1 after an error. */
static int scene_phase_member(struct draft *draft, const struct keys_value *value)
{
    int index = scene_matter_index(draft, value);
    if (index < 0) return -1;
    const struct scene_material *material = &draft->scene->material[index];
    const struct bulla_eos *law = material->eos.module ? material->eos.module->table : NULL;
    if (scene_matter_is_solid(draft, (unsigned)index)) {
        keys_error(&draft->keys, value, "'%s' is a solid: name a fluid, which boils or condenses", material->name);
        return -1;
    }
    if (scene_phase_taken(draft->scene, (unsigned)index)) {
        keys_error(&draft->keys, value, "'%s' is in another pair: add a material with the same law", material->name);
        return -1;
    }
    if (!law) return -1;
    if (BULLA_EOS_HAS(law, thermal)) return index;
    keys_error(&draft->keys, value, "the law '%s' of '%s' does not give its entropy and enthalpy from p and T",
               material->eos.module->name, material->name);
    diag_help(draft->keys.diag, "laws that do: ideal-gas, stiffened-gas, nasg, mnasg, iapws95 (the liquid), "
                                "iapws95-vapour, and of gases helmholtz-air, rkpr, peng-robinson");
    return -1;
}

double scene_phase_gas(const struct scene *scene, unsigned material)
{
    const struct instance *eos = &scene->material[material].eos;
    const struct bulla_eos *law = eos->module ? eos->module->table : NULL;
    return law && BULLA_EOS_HAS(law, gas_constant) ? law->gas_constant(eos->self) : 0.0;
}

/* A member that must be a gas, or must be none. */
static int scene_phase_dilute(struct draft *draft, const struct keys_value *value, bool gas)
{
    int index = scene_phase_member(draft, value);
    if (index < 0 || (scene_phase_gas(draft->scene, (unsigned)index) > 0.0) == gas) return index;
    const char *name = draft->scene->material[index].name;
    keys_error(&draft->keys, value,
               gas ? "'%s' is a liquid: its law becomes no ideal gas when it is thin"
                   : "'%s' is a gas: the liquid of a pair is held together by something",
               name);
    if (gas)
        diag_help(draft->keys.diag,
                  "laws of gases: iapws95-vapour (beside iapws95), ideal-gas (beside iapws95 with 'calibrate'), "
                  "helmholtz-air, rkpr, peng-robinson");
    else diag_help(draft->keys.diag, "laws of liquids: nasg, stiffened-gas, mnasg, iapws95");
    return -1;
}

/* Gases of a pair; false after an error. */
static bool scene_phase_gases(struct draft *draft, const struct keys_value *list, struct scene_phase *pair)
{
    bool good = true;
    for (unsigned i = 0; i < list->count; i++) {
        int index = scene_phase_dilute(draft, &list->list[i], true);
        good = good && index >= 0;
        if (index < 0) continue;
        bool again = (unsigned)index == pair->vapour;
        for (unsigned g = 0; g < pair->n_gas; g++) again = again || pair->gas[g] == (unsigned)index;
        if (again) keys_error(&draft->keys, &list->list[i], "'%s' is in this pair already", list->list[i].text);
        else if (pair->n_gas < SCENE_MATERIALS) pair->gas[pair->n_gas++] = (unsigned)index;
    }
    return good;
}

static void scene_phase_pace(struct draft *draft, const struct keys_map *map, struct scene_phase *pair)
{
    static const char *const words[] = {"equilibrium", "none", "relaxation", "hertz-knudsen", "lua"};
    const struct keys_map *rate = keys_at(map, "rate")->map;
    if (!rate || !rate->chosen) return;
    for (unsigned i = 0; i < sizeof words / sizeof *words; i++)
        if (strcmp(rate->chosen->name, words[i]) == 0) pair->rate = (enum scene_phase_rate)i;
    if (pair->rate == SCENE_PHASE_RELAXATION) pair->time = keys_at(rate, "time")->number;
    if (pair->rate == SCENE_PHASE_LUA && keys_at(rate, "lua")->given)
        pair->script = scene_file_lua(draft, keys_at(rate, "lua"));
    if (pair->rate != SCENE_PHASE_HERTZ_KNUDSEN) return;
    pair->accommodation = keys_at(rate, "accommodation")->number;
    pair->area = keys_at(rate, "area")->number;
}

/* Do gases keep their temperature? */
static void scene_phase_apart(struct draft *draft, const struct keys_map *map, struct scene_phase *pair)
{
    const struct keys_value *value = keys_at(map, "gas-temperature");
    pair->apart = value->integer == 1;
    if (pair->apart && !keys_at(map, "gases")->given)
        keys_error(&draft->keys, value, "the pair has no gases: name them with 'gases: [...]', or leave this out");
    if (pair->apart && pair->rate == SCENE_PHASE_LUA)
        keys_error(&draft->keys, value,
                   "a script is asked with all gases at the temperature of the liquid: 'rate: lua' needs 'shared'");
}

static void scene_phase_places(struct draft *draft, const struct keys_map *map, struct scene_phase *pair)
{
    const struct keys_value *nucleation = keys_at(map, "nucleation");
    pair->everywhere = keys_at(map, "where")->integer == 1;
    pair->direction = (enum scene_phase_direction)keys_at(map, "direction")->integer;
    pair->mixing = keys_at(map, "mixing")->integer == 0;
    scene_phase_apart(draft, map, pair);
    if (!nucleation->map) return;
    const struct keys_value *tension = keys_at(nucleation->map, "tension"),
                            *superheat = keys_at(nucleation->map, "superheat");
    if (!pair->everywhere)
        keys_error(&draft->keys, nucleation, "vapour comes to be where there is none only with 'where: everywhere'");
    if (tension->given == superheat->given)
        keys_error(&draft->keys, nucleation, "one threshold is needed: 'tension' or 'superheat'");
    pair->tension = tension->given ? tension->number : 0.0;
    pair->superheat = superheat->given ? superheat->number : 0.0;
}

/* The vapour with other zeros of energy and entropy. */
static int scene_phase_shift(struct instance *vapour, double dh, double ds)
{
    struct instance shifted = {0};
    int heat = instance_param_find(vapour->module, "heat-bond"),
        order = instance_param_find(vapour->module, "entropy-zero");
    if (heat < 0 || order < 0)
        return status_fail(STATUS_CASE, "the law '%s' has no 'heat-bond' and 'entropy-zero' to set",
                           vapour->module->name);
    vapour->values[heat].number += dh;
    vapour->values[order].number += ds;
    int status = instance_open(vapour->module, vapour->values, &shifted);
    if (status) return status;
    instance_done(vapour);
    *vapour = shifted;
    return STATUS_OK;
}

/* h_v - h_l = L and s_v - s_l = L/T at the given state, so that g_l = g_v there. */
static void scene_phase_set(struct draft *draft, const struct keys_value *value, struct scene_phase *pair)
{
    struct saturation both;
    struct instance *vapour = &draft->scene->material[pair->vapour].eos;
    if (!value->map || !keys_at(value->map, "temperature")->given || !keys_at(value->map, "pressure")->given ||
        !keys_at(value->map, "latent-heat")->given)
        return;
    double T = keys_at(value->map, "temperature")->number, L = keys_at(value->map, "latent-heat")->number;
    if (!saturation_of(&draft->scene->material[pair->liquid].eos, vapour, &both)) return;
    struct saturation_state at = saturation_at(&both, keys_at(value->map, "pressure")->number, T);
    if (scene_phase_shift(vapour, L - (at.h[1] - at.h[0]), L / T - (at.s[1] - at.s[0])))
        keys_error(&draft->keys, value, "%s", status_text());
}

/* Among gases, and in a nucleus, a vapour is asked at the pressure of all, where it would have condensed: ideal gases
 * have a state there, a real one ends at its spinodal. */
static void scene_phase_thick(struct draft *draft, const struct keys_value *value, const struct scene_phase *pair)
{
    const struct scene_material *vapour = &draft->scene->material[pair->vapour];
    const struct bulla_eos *law = vapour->eos.module->table;
    double p = 100.0 * pair->curve.p_min, T = pair->curve.T_min, rho = 0.0, v, h, s, v_T, v_p, c_p;
    bool among = pair->n_gas > 0 && pair->mixing;
    if (!among && !(pair->nucleus > 0.0)) return;
    law->thermal(vapour->eos.self, 1, &p, &T, &rho, &v, &h, &s, &v_T, &v_p, &c_p);
    if (isfinite(v)) return;
    keys_error(&draft->keys, value,
               "'%s' has no state at %.4g K and %.4g Pa, beyond its spinodal, where %s at that pressure bring%s it",
               vapour->name, T, p, among ? "gases" : "its 'nucleus'", among ? "" : "s");
    diag_help(draft->keys.diag, "take an 'ideal-gas' with 'calibrate' for the vapour");
}

/* The curve of a pair: there must be one. */
static void scene_phase_curve(struct draft *draft, const struct keys_value *value, struct scene_phase *pair)
{
    struct saturation both;
    const struct scene_material *liquid = &draft->scene->material[pair->liquid],
                                *vapour = &draft->scene->material[pair->vapour];
    if (!saturation_of(&liquid->eos, &vapour->eos, &both)) return;
    if (saturation_ends(&both, &pair->curve)) {
        scene_phase_thick(draft, value, pair);
        return;
    }
    keys_error(
        &draft->keys, value,
        "'%s' and '%s' have no saturation curve: between 200 and 2000 K their Gibbs energies are nowhere equal above "
        "10 kPa",
        liquid->name, vapour->name);
    diag_help(draft->keys.diag,
              "their energies and entropies have no common zero: take presets of one pair (water-2016, "
              "water-2004, water-2017, dodecane-2004), or give 'calibrate'");
}

static void scene_phase_pair(struct draft *draft, const struct keys_value *value)
{
    const struct keys_map *map = value->map;
    struct scene *scene = draft->scene;
    struct scene_phase pair = {0};
    if (!map) return;
    int liquid = scene_phase_dilute(draft, keys_at(map, "liquid"), false);
    int vapour = scene_phase_dilute(draft, keys_at(map, "vapour"), true);
    pair.liquid = (unsigned)liquid;
    pair.vapour = (unsigned)vapour;
    bool gases = scene_phase_gases(draft, keys_at(map, "gases"), &pair);
    scene_phase_pace(draft, map, &pair);
    scene_phase_places(draft, map, &pair);
    if (liquid < 0 || vapour < 0 || !gases) return;
    scene_phase_surface(draft, map, &pair);
    scene_phase_set(draft, keys_at(map, "calibrate"), &pair);
    scene_phase_curve(draft, value, &pair);
    scene->phases[scene->n_phase++] = pair;
}

/* Surface tension: one pressure for the vapour, one for the liquid, and one curvature between them. */
static void scene_phase_curved(struct draft *draft, const struct keys_value *section)
{
    const struct scene *scene = draft->scene;
    if (scene->n_material <= 2) return;
    keys_error(&draft->keys, section,
               "phase change and surface tension go together for a liquid and its vapour alone, without a third "
               "material");
    diag_help(draft->keys.diag, "leave '%s' out, or the surface tension", scene->material[2].name);
}

/* What does not go together with it. */
static void scene_phase_company(struct draft *draft, const struct keys_value *section)
{
    const struct scene *scene = draft->scene;
    const struct keys_value *closure = keys_at(keys_at(draft->root, "scheme")->map, "closure");
    if (scene->scheme.closure == SCENE_ALLAIRE)
        keys_error(&draft->keys, closure,
                   "phase change needs the closure kapila: with allaire, mixtures are not in mechanical equilibrium");
    if (scene->scheme.closure == SCENE_ALLAIRE) diag_help(draft->keys.diag, "'closure: kapila', the default");
    if (scene->n_tension) scene_phase_curved(draft, section);
}

/* Infinite rates at resolved surfaces measure the mesh. */
static void scene_phase_warn(struct draft *draft, const struct keys_value *section)
{
    bool instant = false;
    for (unsigned k = 0; k < draft->scene->n_phase; k++)
        instant =
            instant || (draft->scene->phases[k].rate == SCENE_PHASE_EQUILIBRIUM && !draft->scene->phases[k].everywhere);
    if (!instant || scene_matter_conducts(draft)) return;
    diag_warn(
        draft->keys.diag, &section->node->mark,
        "%s: 'rate: equilibrium' without conduction: what evaporates at a resolved surface depends on the cell size",
        section->path);
    diag_help(draft->keys.diag,
              "give the materials a 'conductivity', or a finite rate; for bubbly mixtures it is right");
}

void scene_phase(struct draft *draft)
{
    const struct keys_value *section = keys_at(draft->root, "phase-change");
    if (!section->node) return;
    if (section->count > SCENE_PHASES)
        keys_error(&draft->keys, section, "%u pairs are more than %d", section->count, SCENE_PHASES);
    for (unsigned i = 0; i < section->count && i < SCENE_PHASES; i++) scene_phase_pair(draft, &section->list[i]);
    scene_phase_company(draft, section);
    if (keys_at(keys_at(draft->root, "scheme")->map, "mixture-speed")->integer == 0)
        draft->scene->scheme.wood = scene_phase_surface_boils(draft->scene);
    if (!diag_errors(draft->keys.diag)) scene_phase_warn(draft, section);
}

const struct scene_phase *scene_phase_of(const struct scene *scene, unsigned material)
{
    for (unsigned k = 0; k < scene->n_phase; k++)
        if (scene->phases[k].vapour == material) return &scene->phases[k];
    return NULL;
}
