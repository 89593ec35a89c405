/* phase_bear.c - see phase_bear.h. */
#include "phys/phase_bear.h"

#include <math.h>

enum { PHASE_BEAR_BLOCK = 64 };

double phase_bear_drive(const struct saturation *pair, double p, double T)
{
    return p > 0.0 ? saturation_at(pair, p, T).drive : -HUGE_VAL;
}

bool phase_bear_ends(const struct scene_phase *scene, double p)
{
    return scene->rate == SCENE_PHASE_NONE || p > scene->curve.p_max;
}

bool phase_bear_stays(const struct scene_phase *scene, const struct saturation *pair, double p, double T)
{
    double bears = p + scene->tension, cool = T - scene->superheat;
    if (phase_bear_ends(scene, p)) return true;
    if (pair->jump == 0.0 && bears > saturation_ceiling(&scene->curve, cool)) return true;
    return !(phase_bear_drive(pair, bears, cool) < 0.0);
}

bool phase_bear_cells(const struct model *path, const struct scene_phase *scene, size_t n, size_t stride,
                      const double *w)
{
    const struct scene_material *material = path->scene->material;
    const double *rho = w + path->i_m * stride, *p = w + path->i_E * stride;
    const struct model_eos *eos = &path->eos[0];
    double T[PHASE_BEAR_BLOCK];
    struct saturation pair;
    if (!saturation_of(&material[scene->liquid].eos, &material[scene->vapour].eos, &pair)) return true;
    for (size_t at = 0; at < n; at += PHASE_BEAR_BLOCK) {
        size_t part = n - at < PHASE_BEAR_BLOCK ? n - at : PHASE_BEAR_BLOCK;
        eos->law->temperature(eos->self, part, rho + at, p + at, T);
        for (size_t i = 0; i < part; i++) {
            pair.rho[0] = 1.0 / (1.0 / rho[at + i]); /* as in mixtures, to the bit */
            if (isfinite(p[at + i]) && T[i] > 0.0 && !phase_bear_stays(scene, &pair, p[at + i], T[i])) return false;
        }
    }
    return true;
}
