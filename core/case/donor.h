/* donor.h - the cells of another run as a source of initial states: conserved averages over boxes of this one.
 *
 * A box gets sum_i w_i u_i, w_i the part of its volume that lies in cell i of the donor: overlaps of boxes in the
 * metric of the geometry where both have the same one, and differences of the exact volumes of balls in the box where
 * the donor is spherical and this run is not, or of discs where the donor is axisymmetric and this run has three axes.
 * So masses, energy and volumes of materials are those of the donor to round-off, wherever its domain lies whole in
 * this one; uniform pressure stays uniform with laws that are linear in it, as in the averages of levels. The momentum
 * of a shell points away from the centre, that of a ring away from the axis, at the middle of the box. */
#ifndef DONOR_H
#define DONOR_H

#include "case/shape.h"

#include <stdbool.h>
#include <stddef.h>

struct donor_cell {
    double lower[3], upper[3]; /* in the donor's coordinates */
};

struct donor {
    int dim, beta; /* geometry of the donor */
    int axis;      /* of this run, along which the axis of an axisymmetric donor lies in space */
    double domain[2][3];
    int buckets[3]; /* cells of its level 0: a leaf lies in one */
    size_t n;       /* leaves */
    unsigned n_field;
    struct donor_cell *cells; /* [n]; in one dimension by rising coordinate */
    double *u;                /* [n][n_field] conserved fields, momentum along the donor's axes */
    size_t *first, *order;    /* bucket b holds the leaves order[first[b]] .. order[first[b + 1] - 1] */
    int *what;    /* [n_field] index of the field in this run's model: set by who fills it; a momentum counts as
                                 that of axis 0, 1, 2 from `momentum` on */
    int momentum; /* first momentum of this run's model */
};

/* Sorts the leaves into buckets; to be called once cells and u are there. */
void donor_sort(struct donor *donor);

/* The part of a box of this run (dim axes, geometry beta) that lies in the donor whose origin is at `at`, and the mean
 * of the conserved fields there, ret_mean[n_model] in the order of this run's model; fields that the donor has not are
 * 0. */
double donor_average(const struct donor *donor, const double at[3], const double lower[3], const double upper[3],
                     int dim, int beta, unsigned n_model, double *ret_mean);

void donor_free(struct donor *donor); /* NULL is fine */

#endif
