/* check_phase.c - see check_phase.h. */
#include "run/check_phase.h"

#include "bulla/eos.h"
#include "cli/human.h"

#include <math.h>
#include <stdio.h>

#define CHECK_PHASE_ATM 101325.0
#define CHECK_PHASE_MOST 1e12
#define CHECK_PHASE_STEP 1.002

/* Temperature of one material of a layer; NaN: it is no number. */
static double check_phase_temperature(const struct scene *scene, const struct scene_layer *layer, unsigned l)
{
    const struct instance *eos = &scene->material[l].eos;
    const struct bulla_eos *law = eos->module->table;
    double T = NAN;
    if (layer->temperature.given) return layer->temperature.script ? (double)NAN : layer->temperature.number;
    if (!layer->density || !layer->density[l].given || layer->density[l].script) return (double)NAN;
    law->temperature(eos->self, 1, &layer->density[l].number, &layer->pressure.number, &T);
    return T;
}

/* Pressure of the vapour in a layer that holds some: its mole fraction of the layer's. */
static double check_phase_partial(const struct scene *scene, const struct scene_phase *pair,
                                  const struct scene_layer *layer)
{
    double vapour = layer->fractions[pair->vapour], all = vapour;
    (void)scene;
    for (unsigned g = 0; g < pair->n_gas && pair->mixing; g++) all += layer->fractions[pair->gas[g]];
    return layer->pressure.number * vapour / all; /* at one p and T volumes are mole fractions */
}

static void check_phase_layer(const struct scene *scene, const struct scene_phase *pair, const struct saturation *both,
                              unsigned index)
{
    const struct scene_layer *layer = &scene->layers[index];
    char text[HUMAN_ROOM], own[HUMAN_ROOM];
    if (!layer->has_material || !layer->fractions || !layer->pressure.given || layer->pressure.script) return;
    bool liquid = layer->fractions[pair->liquid] > 0.0, vapour = layer->fractions[pair->vapour] > 0.0;
    if (!liquid && !vapour) return;
    double T = check_phase_temperature(scene, layer, liquid ? pair->liquid : pair->vapour);
    double psat = saturation_pressure(both, T);
    if (isnan(psat)) return;
    printf("  %-12s initial[%u]: %.6g K, saturation pressure %s", "", index, T, human_si(psat, "Pa", text));
    if (saturation_is_water(both, scene->material[pair->liquid].name) && T > 273.0 && T < 647.0)
        printf(" (%+.2g %% of IAPWS-95)", 100.0 * (psat / saturation_water(T) - 1.0));
    double p = vapour ? check_phase_partial(scene, pair, layer) : layer->pressure.number;
    if (vapour && p > 1.001 * psat) printf("; its vapour at %s condenses at once", human_si(p, "Pa", own));
    if (vapour && liquid && p < 0.999 * psat) printf("; its vapour at %s takes up more", human_si(p, "Pa", own));
    if (!vapour && p < psat) printf("; the liquid at %s is superheated", human_si(p, "Pa", own));
    putchar('\n');
}

/* Above the pressure where the vapour would be as dense as the liquid g_v - g_l falls again with p: where it is 0 once
 * more. NaN: not below 1 TPa; past its spinodal a real vapour has no state, and that is no root. */
static double check_phase_second(const struct saturation *both, double T)
{
    double low = 1e3, high = CHECK_PHASE_MOST;
    struct saturation_state at = saturation_at(both, low, T);
    while (low < high && !(at.v[1] <= at.v[0] && at.drive <= 0.0)) at = saturation_at(both, low *= CHECK_PHASE_STEP, T);
    return low < high ? low : (double)NAN;
}

static void check_phase_root(const struct saturation *both, double T)
{
    double p = check_phase_second(both, T);
    char text[HUMAN_ROOM];
    if (isnan(p)) return;
    printf("  %-12s above the end temperatures are shared, no mass is exchanged; at %.4g K the liquid would evaporate "
           "again "
           "from %s on\n",
           "", T, human_si(p, "Pa", text));
}

static void check_phase_pair(const struct scene *scene, const struct scene_phase *pair, const char *head)
{
    struct saturation both;
    char text[HUMAN_ROOM], more[HUMAN_ROOM];
    const struct saturation_range *curve = &pair->curve;
    if (!saturation_of(&scene->material[pair->liquid].eos, &scene->material[pair->vapour].eos, &both)) return;
    printf("  %-12s %s to %s: ", head, scene->material[pair->liquid].name, scene->material[pair->vapour].name);
    double T = saturation_temperature(&both, CHECK_PHASE_ATM);
    if (!isnan(T)) {
        struct saturation_state at = saturation_at(&both, CHECK_PHASE_ATM, T);
        printf("boils at %.2f K at 1 atm, latent heat %s; ", T, human_si(at.h[1] - at.h[0], "J/kg", text));
    }
    printf("curve from %.4g K, %s to %.4g K, %s\n", curve->T_min, human_si(curve->p_min, "Pa", text), curve->T_max,
           human_si(curve->p_max, "Pa", more));
    if (!isnan(T)) check_phase_root(&both, T);
    for (unsigned i = 0; i < scene->n_layer; i++) check_phase_layer(scene, pair, &both, i);
}

void check_phase_print(const struct scene *scene)
{
    for (unsigned k = 0; k < scene->n_phase; k++) check_phase_pair(scene, &scene->phases[k], k ? "" : "phase");
}
