/* viscous_strain.h - the rate of strain of a batch of points, and the direction in which their fractions change. */
#ifndef VISCOUS_STRAIN_H
#define VISCOUS_STRAIN_H

#include "phys/model.h"

enum { STRAIN_POINTS = 256, STRAIN_TENSOR = 6 };

/* Gradients below this part of the whole range over a cell are those of a mixture and not of an interface: with a
 * thirtieth of that the traces behind a bubble's wall slip (docs/decisions/viscous-films.md). */
#define STRAIN_FLAT 2e-2

/* A batch of points: faces of a frame or cells of a tile. Components of tensors are numbered as in elastic.h. */
struct viscous_strain {
    const struct model *path;
    size_t n;
    double gradient[3][3][STRAIN_POINTS]; /* in: [d][e] d u_d/d x_e, for d < n_velocity, e < dim [1/s] */
    double hoop[STRAIN_POINTS];           /* in: u_r/r in curved geometry [1/s] */
    double colour[3][STRAIN_POINTS];      /* in: gradient of the colour along x_e [1/m]; out: m (below), rows of all */
    double shear[3][STRAIN_POINTS];       /* room for what lies beside the diagonal */
    const double *D[STRAIN_TENSOR];       /* rows, some of them those of the gradient */
    double div[STRAIN_POINTS];
    double sharp[STRAIN_POINTS];    /* w = |m|^2: 1 at an interface, 0 without one */
    double along[3][STRAIN_POINTS]; /* q = D m, of viscous_strain_across */
    double normal[STRAIN_POINTS];   /* m D m, likewise */
    bool interface;                 /* m is not 0 everywhere; else m and w are not made */
};

/* D, div u, and where the colour changes m = g/|g| sqrt(w), w = |g|^8/(|g|^8 + (STRAIN_FLAT/h)^8), g its gradient: a
 * unit vector to 1e-12 at a sharp interface, nothing in a smooth mixture or in traces that a surface has left behind.
 * h: the longest side of a cell. */
void viscous_strain_make(struct viscous_strain *strain, double h);

/* What D is across the interface: q and m D m. Only where there is one. */
void viscous_strain_across(struct viscous_strain *strain);

/* The longest side of a cell. */
static inline double viscous_strain_longest(int dim, const double h[3])
{
    double most = h[0];
    for (int d = 1; d < dim; d++) most = h[d] > most ? h[d] : most;
    return most;
}

/* D:D, with the hoop. */
void viscous_strain_square(const struct viscous_strain *strain, double *square);

/* sqrt(2 D':D') of the deviator, from the above. */
void viscous_strain_rate(const struct viscous_strain *strain, const double *square, double *rate);

/* D_l:D_l of a material whose own dilatation is r div u, and r' div u, what of it shows (r' = 1 + |m|^2 (r - 1)); at an
 * interface, after viscous_strain_across. square: D:D. */
void viscous_strain_own(const struct viscous_strain *strain, const double *square, const double *r, double *ret_square,
                        double *dilatation);

#endif
