/* outside.c - see outside.h. */
#include "phys/outside.h"

#include "phys/presence.h"

enum { OUTSIDE_BATCH = 256 };

/* Cells of a tile; NULL: no fraction, no weight. */
struct outside_batch {
    size_t n;
    const double *rho, *p, *alpha, *weight;
};

bool outside_is_told(const struct model *model, unsigned l)
{
    return BULLA_EOS_HAS(model->eos[l].law, count_outside);
}

/* In how many cells is the material? */
static BULLA_KERNEL double outside_present(size_t n, const double *restrict alpha)
{
    double count = 0.0;
#pragma omp simd reduction(+ : count)
    for (size_t i = 0; i < n; i++) count += alpha[i] >= PRESENCE_FRACTION ? 1.0 : 0.0;
    return count;
}

/* The cells of a batch that count, one after the other. */
static size_t outside_pack(const struct outside_batch *in, double *restrict rho, double *restrict p)
{
    size_t held = 0;
    for (size_t i = 0; i < in->n; i++) {
        rho[held] = in->rho[i];
        p[held] = in->p[i];
        held += (!in->alpha || in->alpha[i] >= PRESENCE_FRACTION) && (!in->weight || in->weight[i] > 0.0);
    }
    return held;
}

/* Most tiles hold all of a material or none: nothing is packed then. */
static size_t outside_some(const struct model_eos *eos, const struct outside_batch *in)
{
    double rho[OUTSIDE_BATCH], p[OUTSIDE_BATCH];
    size_t held = in->alpha ? (size_t)outside_present(in->n, in->alpha) : in->n;
    if (held == 0) return 0;
    if (held == in->n && !in->weight) return eos->law->count_outside(eos->self, held, in->rho, in->p);
    held = outside_pack(in, rho, p);
    return held > 0 ? eos->law->count_outside(eos->self, held, rho, p) : 0;
}

size_t outside_count(const struct model *model, unsigned l, size_t n, size_t stride, const double *w,
                     const double *weight)
{
    const double *rho = w + (model->i_m + l) * stride, *p = w + model->i_E * stride;
    const double *alpha = model->n_alpha ? w + (model->i_alpha + l) * stride : NULL;
    size_t found = 0;
    if (!outside_is_told(model, l)) return 0;
    for (size_t i = 0; i < n; i += OUTSIDE_BATCH) {
        const struct outside_batch in = {n - i < OUTSIDE_BATCH ? n - i : OUTSIDE_BATCH, rho + i, p + i,
                                         alpha ? alpha + i : NULL, weight ? weight + i : NULL};
        found += outside_some(&model->eos[l], &in);
    }
    return found;
}
