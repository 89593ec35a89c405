/* paint_values.h - what a layer says about one point, and the primitives that follow from it. */
#ifndef PAINT_VALUES_H
#define PAINT_VALUES_H

#include "phys/model.h"

struct script_table;

/* A layer of the scene, ready to be asked. */
struct paint_values {
    const struct model *model;
    const struct scene_layer *layer;
    unsigned number;                  /* of the layer, from 1, for messages */
    const struct script_table *names; /* fields of a Lua table; NULL for a layer in YAML */
    bool varying;                     /* values depend on the place */
    bool whole;                       /* needs no state below it */
};

/* Looks at layer `index` of the scene. */
void paint_values_of(const struct model *model, unsigned index, struct paint_values *ret_values);

/* Primitives of the layer at x, w[n_field] (order of model.h; rho_fill where a material is absent). `before`: the
 * primitives of the cell below, or NULL; what the layer does not say is taken from there. STATUS_CASE. */
int paint_values_at(const struct paint_values *values, const double x[3], const double *before, double *w);

#endif
