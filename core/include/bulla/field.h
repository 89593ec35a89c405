/* bulla/field.h - functions of a module of kind "field".
 *
 * Named numbers per cell that are made of a state: for snapshots, probes, maps, measures of a history (least, largest,
 * mean, integral), peaks, criteria of refinement, expressions. They change nothing in a run. Every call is a batch of n
 * cells: [any thread; pure; no allocation; n >= 1; arrays do not overlap; unit stride; SI units]. What is written for a
 * cell must not depend on its place in the row or on n: results are the same on any number of ranks and at the edges of
 * tiles.
 *
 * Slopes are central differences over the two neighbours of a cell along an axis, whatever tile, rank or level they are
 * on; behind boundaries as the solver sees it. A row that `needs` does not name is
 * NULL. */
#ifndef BULLA_FIELD_H
#define BULLA_FIELD_H

#include "bulla/module.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a field looks at beside fractions, densities, velocities, pressure, place and time: bits of `needs`. */
enum bulla_field_needs {
    BULLA_FIELD_SOUND = 1,        /* c, Wood's speed of sound of the mixture */
    BULLA_FIELD_TEMPERATURES = 2, /* T of each material; where it is absent, what its law makes of what stands there */
    BULLA_FIELD_ENERGY = 4,       /* rho_E */
    BULLA_FIELD_VELOCITY_SLOPES = 8,
    BULLA_FIELD_PRESSURE_SLOPES = 16,
    BULLA_FIELD_DENSITY_SLOPES = 32, /* of the density of the mixture */
    BULLA_FIELD_ALL = 63
};

/* A batch of cells. */
struct bulla_points {
    uint32_t size;                   /* sizeof(struct bulla_points) of core */
    uint32_t n_material, n_velocity; /* n_velocity: 1 to 3 */
    uint32_t dim;                    /* axes that vary: 1 to 3 */
    uint32_t beta;        /* 0 Cartesian, 1 axisymmetric (x[0] = r, x[1] along the axis), 2 spherical: the divergence
                                        of u has beta u[0]/x[0] more than the slopes */
    size_t n;             /* cells */
    double t;             /* [s] */
    double h[3];          /* sides of a cell [m]; 0 beyond the dimension */
    const double *x[3];   /* centres of the cells [m]; 0 beyond the dimension */
    const double *volume; /* of the cells, all round [m3]; in Cartesian planes m2, on lines m */
    const double *const *alpha; /* [n_material] volume fractions */
    const double *const *rho;   /* [n_material] densities; alpha rho is conserved */
    const double *const *u;     /* [n_velocity] */
    const double *p;
    const double *c;               /* [m/s] */
    const double *const *T;        /* [n_material] K */
    const double *rho_E;           /* total energy per volume, with that of stretches [J/m3] */
    const double *du[3][3];        /* du[i][j] = d u_i/d x_j; 0 for velocities and axes that the scene has not */
    const double *dp[3], *drho[3]; /* along each axis; 0 beyond the dimension */
};

/* What core should know of the values of an output, so that its messages make sense: bits. */
enum bulla_field_is {
    BULLA_FIELD_POSITIVE = 1,  /* everywhere above 0 */
    BULLA_FIELD_VANISHING = 2, /* 0 in fluid at rest */
    BULLA_FIELD_SIGNED = 4,    /* VANISHING, with either sign */
    BULLA_FIELD_FRACTION = 8   /* from 0 to 1 */
};

enum { BULLA_FIELD_OUTPUTS = 8 }; /* of a module, at most */

/* One field. A list of them ends with unit == NULL. */
struct bulla_field_output {
    const char *suffix; /* `fields: {NAME: ...}` of a case makes NAME of "", NAME_q of "q" */
    const char *unit;   /* SI, "1" for pure numbers */
    const char *doc;    /* one sentence */
    uint32_t is;        /* enum bulla_field_is, added up */
};

struct bulla_field {
    uint32_t size;                            /* sizeof(struct bulla_field) */
    uint32_t needs;                           /* enum bulla_field_needs, added up */
    const struct bulla_field_output *outputs; /* one at least */

    /* values: a row of n for each output, in their order. */
    void (*compute)(const void *self, const struct bulla_points *cells, double *const *values);
};

#ifdef __cplusplus
}
#endif
#endif
