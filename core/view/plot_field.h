/* plot_field.h - a field of a snapshot by the name that a user gives, and how pictures call it. */
#ifndef PLOT_FIELD_H
#define PLOT_FIELD_H

#include "io/read.h"

#include <stdbool.h>

enum { PLOT_FIELD_MAGNITUDE = -1, PLOT_FIELD_LABEL = 160 };

struct plot_field {
    const struct snapshot_field *field; /* of the snapshot */
    int component;                      /* 0..2, or PLOT_FIELD_MAGNITUDE of a vector; 0 of a scalar */
    const struct snapshot_field *body;  /* where it is above 1/2 there is no fluid; NULL: nowhere */
    bool blank;                         /* 0 says that the material is absent: temperature_M, density_M */
    char label[PLOT_FIELD_LABEL];       /* "density of air", "axial velocity" */
};

/* Finds "pressure", "velocity" (its magnitude; of runs in 1D its only component, with its sign), "velocity_y". An
 * unknown name is STATUS_CASE with the fields that are there and a suggestion. */
int plot_field_find(const struct snapshot *snapshot, const char *name, struct plot_field *ret_field);

/* NaN where the field says nothing: such cells stay blank and have no part in the range. */
double plot_field_value(const struct plot_field *field, size_t cell);

/* The symbol of a coordinate axis with its italic marks: x, y, z; axisymmetric r, z; spherical r. */
const char *plot_field_axis(const struct snapshot *snapshot, int axis);

#endif
