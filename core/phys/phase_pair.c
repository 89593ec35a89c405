/* phase_pair.c - see phase_pair.h. */
#include "phys/phase_pair.h"

#include "phys/equilibrium.h"
#include "phys/presence.h"

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

/* How many cells have such a pressure? Most tiles have none. */
static BULLA_KERNEL double phase_pair_high(size_t n, const double *restrict p, double most)
{
    double count = 0.0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) count += p[i] > most ? 1.0 : 0.0;
    return count;
}

size_t phase_pair_past(const struct model *model, unsigned k, size_t n, size_t stride, const double *w,
                       const double *weight)
{
    const struct model_phase *phase = &model->phases[k];
    const double *p = w + model->i_E * stride, *alpha = w + model->i_alpha * stride;
    double end = phase->scene->curve.p_max;
    size_t past = 0;
    if (phase_pair_high(n, p, end) == 0.0) return 0;
    for (size_t i = 0; i < n; i++) {
        double airy = 0.0;
        for (unsigned m = EQUILIBRIUM_VAPOUR; m < phase->n; m++) airy += alpha[phase->member[m] * stride + i];
        past += p[i] > end && alpha[phase->member[EQUILIBRIUM_LIQUID] * stride + i] >= PRESENCE_FRACTION &&
                airy >= PRESENCE_FRACTION && (!weight || weight[i] > 0.0);
    }
    return past;
}
