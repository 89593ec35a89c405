/* soften.c - see soften.h. */
#include "solve/soften.h"

#include "phys/soft.h"

#include <float.h>
#include <math.h>

/* Of a pressure that a stage has changed by less, over the least rho_l c_l^2 of now, that of the soft ones is not far:
 * one that a step doubles is changed by 0.18 of it in each of two stages, in air. */
#define SOFTEN_SUSPECT 0.1

/* How many materials fill more than a trace of a cell. */
static BULLA_KERNEL void soften_count(size_t n, const double *restrict alpha, double *restrict count)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], c = count[i];
        count[i] = c + (a > SOFT_TRACE ? 1.0 : 0.0);
    }
}

/* Whole numbers: their sum is the same in any order. */
static BULLA_KERNEL double soften_shared(size_t n, const double *restrict count)
{
    double shared = 0.0;
#pragma omp simd reduction(+ : shared)
    for (size_t i = 0; i < n; i++) shared += count[i] > 1.0 ? 1.0 : 0.0;
    return shared;
}

/* The least rho_l c_l^2 of the materials of a cell that are no traces. */
static double soften_least(const struct model *model, size_t stride, const double *u, const double *rho_c2)
{
    double least = DBL_MAX;
    for (unsigned l = 0; l < model->n_alpha; l++)
        if (u[(model->i_alpha + l) * stride] > SOFT_TRACE && rho_c2[l * stride] < least) least = rho_c2[l * stride];
    return least;
}

/* Does a source give heat, mass or volume? */
static bool soften_fed(const struct scene_sources *sources)
{
    bool fed = sources && sources->script;
    for (unsigned s = SCENE_SOURCE_HEATING; sources && s < SCENE_SOURCE_STRETCH; s++)
        fed = fed || sources->value[s].given;
    return fed;
}

bool soften_applies(const struct model *model)
{
    bool adiabatic = model->n_phase == 0 && !model->conducts && !soften_fed(model->scene->sources);
    bool fluid = model->n_solid < model->n_material;
    return model->n_alpha > 1 && fluid && model->kapila && !model->lagged && adiabatic;
}

size_t soften_find(const struct model *model, size_t n, size_t stride, const double *u, const double *w,
                   const double *rho_c2, const double *p_before, struct soften_suspect ret_suspects[SOFTEN_BATCH])
{
    double count[SOFTEN_BATCH] = {0};
    const double *p = w + model->i_E * stride;
    size_t found = 0;
    for (unsigned l = 0; l < model->n_alpha; l++) soften_count(n, u + (model->i_alpha + l) * stride, count);
    if (soften_shared(n, count) == 0.0) return 0;
    for (size_t i = 0; i < n; i++) {
        if (!(count[i] > 1.0)) continue;
        double least = soften_least(model, stride, u + i, rho_c2 + i);
        if (fabs(p[i] - p_before[i]) > SOFTEN_SUSPECT * least)
            ret_suspects[found++] = (struct soften_suspect){i, least};
    }
    return found;
}
