/* derive_view.h - one call's view of a tile, for the files that compute derived fields. */
#ifndef DERIVE_VIEW_H
#define DERIVE_VIEW_H

#include "derive/derive.h"

struct derive_view {
    const struct model *model;
    const struct mesh *mesh;
    const struct level *level;
    int level_index;
    unsigned local;
    double t;
    const struct derive *field;
    const double *w; /* primitives [n_field][n] */
    size_t n;
};

static inline const double *derive_view_w(const struct derive_view *tile, unsigned q)
{
    return tile->w + q * tile->n;
}

static inline double derive_view_alpha(const struct derive_view *tile, unsigned l, size_t i)
{
    return tile->model->n_alpha ? derive_view_w(tile, tile->model->i_alpha + l)[i] : 1.0;
}

#endif
