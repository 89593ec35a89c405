/* prolong_cell.h - the fine cells of a new tile under one coarse cell: conservative, bounded, admissible.
 *
 * Central slopes of the conserved fields times one factor phi in [0, 1] for all of them: only then linear
 * relations (sum alpha = 1, rho E at uniform p and u) survive (docs/decisions/prolongation.md). phi is the largest
 * that keeps every field within the range of the coarse cell and its face neighbours; if then a rho_l or p
 * leaves its range, or a child is not admissible, phi is halved twice and then 0. The stretch of the children is made a
 * stretch again, which leaves what is conserved alone. */
#ifndef PROLONG_CELL_H
#define PROLONG_CELL_H

#include "phys/model.h"

enum { PROLONG_CHILDREN = 8, PROLONG_FIELDS = MODEL_FIELDS };

/* Coarse cells and their face neighbours: component q at w + q * pitch. */
struct prolong_cells {
    const struct model *model;
    size_t pitch, stride[3];      /* stride: to the next cell along an axis; 0 beyond dim */
    const double *w, *u, *rho_c2; /* primitives, conserved fields, rho c_f^2 */
    const double *elastic;        /* elastic energy per volume; NULL without a solid */
    double turn;                  /* part of the upper column of children in the volume of what turns (metric.h) */
};

/* Child o = ox + 2 oy + 4 oz; those beyond 2^dim are not set. */
struct prolong_children {
    double u[PROLONG_FIELDS][PROLONG_CHILDREN], w[PROLONG_FIELDS][PROLONG_CHILDREN];
    double strain[PROLONG_CHILDREN]; /* how far the elastic energy is from linear: p takes it up [J/m3] */
};

/* The children of the coarse cell at offset `at`, whose conserved fields are mean[n_field] (their mean).
 * give[axis][side] times the difference of the two neighbours along the axis is what a child gets of it. Returns
 * phi. */
double prolong_cell_children(const struct prolong_cells *source, size_t at, const double *mean, const double give[3][2],
                             struct prolong_children *ret);

#endif
