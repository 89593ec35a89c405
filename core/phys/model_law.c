/* model_law.c - see model_law.h. */
#include "phys/model_law.h"

#include <math.h>

#define MODEL_LAW_STRAIGHT 1.5 /* b grows by no more than this times what it did before */

/* A density for points where the material is absent: any well-posed value serves, because its
 * weight is zero there; the first density the case gives keeps tables and Newton at home. */
static double model_law_fill(const struct scene *scene, unsigned l, const struct model_eos *eos)
{
    for (unsigned i = 0; i < scene->n_layer; i++) {
        const struct scene_layer *layer = &scene->layers[i];
        if (!layer->has_material || !layer->fractions || !layer->density) continue;
        const struct scene_value *density = &layer->density[l];
        if (layer->fractions[l] > 0 && density->given && !density->script) return density->number;
    }
    double p = 101325.0, T = 300.0, rho = 0.0;
    eos->law->density(eos->self, 1, &p, &T, &rho);
    return rho > 0 && isfinite(rho) ? rho : 1.0;
}

/* Does a law bear no density, however large? In rho e = a p + b those of an energy per mass and volume have a straight
 * b(rho), or end on a straight line. A cold curve (Tait, Cochran-Chan) is a power of the density: seven times as dense
 * it would hold 1e6 times the pressure. */
static bool model_law_stiffens(const struct model_eos *eos)
{
    double rho[3] = {2.0 * eos->rho_most, 4.0 * eos->rho_most, 6.0 * eos->rho_most}, a[3], b[3];
    if (!eos->law->linear) return true;
    eos->law->linear(eos->self, 3, rho, a, b);
    return fabs(b[2] - b[1]) > MODEL_LAW_STRAIGHT * fabs(b[1] - b[0]);
}

void model_law_open(struct model *model, unsigned l)
{
    const struct instance *instance = &model->scene->material[l].eos;
    struct model_eos *eos = &model->eos[l];
    struct bulla_eos_range range;
    eos->law = instance->module->table;
    eos->self = instance->self;
    eos->rho_fill = model_law_fill(model->scene, l, eos);
    eos->law->range(eos->self, &range);
    eos->rho_most = range.rho_max > eos->rho_fill ? range.rho_max : eos->rho_fill;
    eos->stiffens = model_law_stiffens(eos);
}
