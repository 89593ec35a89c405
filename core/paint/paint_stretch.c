/* paint_stretch.c - see paint_stretch.h.
 *
 * The stretch belongs to the solid, so its mean over a cell is weighted by the solid's volume: a cell cut by the
 * surface of a stretched body then holds that body's elastic energy, and its pressure is as said. */
#include "paint/paint_stretch.h"

#include "base/mem.h"
#include "phys/elastic.h"

#include <math.h>

double paint_stretch_det(const double V[6])
{
    double xx = V[ELASTIC_XX], yy = V[ELASTIC_YY], zz = V[ELASTIC_ZZ];
    double xy = V[ELASTIC_XY], xz = V[ELASTIC_XZ], yz = V[ELASTIC_YZ], minor = xx * yy - xy * xy;
    double det = minor * zz - (xx * yz * yz + yy * xz * xz) + 2.0 * xy * (xz * yz); /* x and y in equal parts */
    return xx > 0.0 && minor > 0.0 ? det : -1.0;
}

void paint_stretch_unimodular(const struct model *model, double V[6])
{
    double root = cbrt(paint_stretch_det(V));
    for (unsigned c = 0; c < 6; c++) V[c] /= root;
    elastic_unimodular(model, 1, 1, V); /* round-off as the solver leaves it */
}

double paint_stretch_share(const struct model *model, unsigned s, const double *state, size_t stride)
{
    return model->n_alpha ? state[(model->i_alpha + model->solids[s].material) * stride] : 1.0;
}

void paint_stretch_mix(const struct model *model, const struct paint_stretch_layer *layer, size_t stride, double *cell)
{
    for (unsigned s = 0; s < model->n_solid; s++) {
        double below = (1.0 - layer->fraction) * paint_stretch_share(model, s, cell, stride);
        double above = layer->fraction * paint_stretch_share(model, s, layer->state, layer->stride);
        if (model->n_alpha == 0) below *= layer->covered;
        double share = above > 0.0 ? above / (below + above) : 0.0;
        for (unsigned c = 0; c < model->n_stretch; c++) {
            unsigned q = model->solids[s].stretch + c;
            double *V = cell + q * stride, mean = (1.0 - share) * *V + share * layer->state[q * layer->stride];
            *V = below + above > 0.0 ? mean : c < 3 ? 1.0 : 0.0;
        }
    }
}

void paint_stretch_finish(const struct model *model, size_t n, size_t stride, double *u)
{
    double *share = mem_new(n, sizeof *share);
    for (unsigned s = 0; s < model->n_solid; s++) {
        double *V = u + model->solids[s].stretch * stride;
        for (size_t i = 0; i < n; i++) share[i] = paint_stretch_share(model, s, u + i, stride);
        elastic_unimodular(model, n, stride, V);
        elastic_fade(model, n, stride, share, V);
    }
    mem_free(share);
}

void paint_stretch_relaxed(const struct model *model, size_t n, size_t stride, double *fields)
{
    for (unsigned b = 0; b < model->n_branch; b++)
        elastic_identity(model, n, stride, fields + model->branches[b].field * stride);
}
