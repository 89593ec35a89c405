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

double paint_stretch_share(const struct model *model, const double *state, size_t stride)
{
    double sum = 0.0;
    if (model->n_alpha == 0) return model->n_solid ? 1.0 : 0.0;
    for (unsigned s = 0; s < model->n_solid; s++) sum += state[(model->i_alpha + model->solids[s].material) * stride];
    return sum;
}

void paint_stretch_mix(const struct model *model, const struct paint_stretch_layer *layer, size_t stride, double *cell)
{
    double below = (1.0 - layer->fraction) * paint_stretch_share(model, cell, stride);
    double above = layer->fraction * paint_stretch_share(model, layer->state, layer->stride);
    if (model->n_alpha == 0) below *= layer->covered;
    double share = above > 0.0 ? above / (below + above) : 0.0;
    for (unsigned c = 0; c < model->n_stretch; c++) {
        double *V = cell + (model->i_V + c) * stride, laid = layer->state[(model->i_V + c) * layer->stride];
        double mean = (1.0 - share) * *V + share * laid;
        *V = below + above > 0.0 ? mean : c < 3 ? 1.0 : 0.0;
    }
}

void paint_stretch_finish(const struct model *model, size_t n, size_t stride, double *u)
{
    double *V = u + model->i_V * stride, *share = mem_new(n, sizeof *share);
    for (size_t i = 0; i < n; i++) share[i] = paint_stretch_share(model, u + i, stride);
    elastic_unimodular(model, n, stride, V);
    elastic_fade(model, n, stride, share, V);
    mem_free(share);
}

void paint_stretch_relaxed(const struct model *model, size_t n, size_t stride, double *fields)
{
    for (unsigned b = 0; b < model->n_branch; b++)
        elastic_identity(model, n, stride, fields + model->branches[b].field * stride);
}
