/* phase_pair.c - see phase_pair.h. */
#include "phys/phase_pair.h"

#include "phys/equilibrium.h"

bool phase_pair_joins(const struct model *model, unsigned l, unsigned m)
{
    for (unsigned k = 0; k < model->n_phase; k++) {
        const struct model_phase *phase = &model->phases[k];
        bool liquid = phase->member[EQUILIBRIUM_LIQUID] == l || phase->member[EQUILIBRIUM_LIQUID] == m;
        for (unsigned i = EQUILIBRIUM_VAPOUR; i < phase->n && liquid && l != m; i++)
            if (phase->member[i] == l || phase->member[i] == m) return true;
    }
    return false;
}

double phase_pair_front(const struct scene_phase *scene)
{
    return scene->onset < 0.5 ? scene->onset : 0.5;
}
