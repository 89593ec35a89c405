/* outside.c - see outside.h. */
#include "phys/outside.h"

#include "phys/presence.h"

enum { OUTSIDE_BATCH = 256 };

bool outside_is_told(const struct model *model, unsigned l)
{
    return BULLA_EOS_HAS(model->eos[l].law, count_outside);
}

size_t outside_count(const struct model *model, unsigned l, size_t n, size_t stride, const double *w,
                     const double *weight)
{
    const double *all_rho = w + (model->i_m + l) * stride, *all_p = w + model->i_E * stride;
    const double *alpha = model->n_alpha ? w + (model->i_alpha + l) * stride : NULL;
    const struct model_eos *eos = &model->eos[l];
    double rho[OUTSIDE_BATCH], p[OUTSIDE_BATCH];
    size_t found = 0, held = 0;
    if (!outside_is_told(model, l)) return 0;
    for (size_t i = 0; i < n; i++) {
        rho[held] = all_rho[i];
        p[held] = all_p[i];
        held += (!alpha || alpha[i] >= PRESENCE_FRACTION) && (!weight || weight[i] > 0.0);
        if (held < OUTSIDE_BATCH) continue;
        found += eos->law->count_outside(eos->self, held, rho, p);
        held = 0;
    }
    return held > 0 ? found + eos->law->count_outside(eos->self, held, rho, p) : found;
}
