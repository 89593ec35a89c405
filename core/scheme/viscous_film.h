/* viscous_film.h - what viscosity does along the surface between two materials.
 *
 * In a mixed cell a viscous liquid is a film: layers in series across the surface, in parallel along it. What acts
 * across has the harmonic mean mu_h (viscous_mix.h). Along it more does, as in a membrane of Boussinesq and Scriven
 * (L. E. Scriven, Chem. Eng. Sci. 12 (1960) 98-108):
 *     tau = 2 w (mu_a - mu_h) (D_t + delta P),   P = I - n n,   D_t = P D P,   delta = div u - n D n,
 * mu_a = sum alpha_l mu_l, w 1 at a surface (viscous_strain.h). It is what remains of the liquid's own strain D - div u
 * n n, gas taking all of div u, once its part across the surface is with the pressure: no traction acts on a film, so
 * that all materials of a mixed cell have the pressure of the gas.
 *
 * It is made at the corners of cells and acts through the faces that end there, with the weights that its strain is
 * taken with, so that at each corner it takes tau : D >= 0 off the motion. Of the pairs of cells across an axis that
 * meet at a corner those count that hold more of what is viscous: an almost empty cell beside a full one does not get
 * what it could not bear. Two cells of one material alone do not count: they have no film, and tiles of one material
 * need not know. Figures, and what else was tried: docs/decisions/viscous-films.md. */
#ifndef VISCOUS_FILM_H
#define VISCOUS_FILM_H

#include "scheme/viscous_hold.h"
#include "scheme/viscous_mix.h"

/* The films of one tile. A corner is found by the cell of the patch below it along all axes; the cells around it by one
 * bit per axis, the pairs across an axis by one bit for each other axis. */
struct viscous_film {
    unsigned pairs, corners;        /* cells around a corner: 2^(dim - 1) pairs, 2^dim */
    size_t line, lines;             /* of the patch: cells in a line, number of lines */
    size_t beside[3][HOLD_PAIRS];   /* from the cell below a corner to the lower one of a pair across an axis */
    size_t around[HOLD_CORNERS];    /* and to each cell */
    size_t count;                   /* corners that have a mixed cell beside them: all others have no stress */
    unsigned *at;                   /* [count] those */
    bool *held;                     /* [lines] has a line some? */
    unsigned char *mixed, *touched; /* marks of cells and corners */
    double *stress[STRAIN_TENSOR];  /* over the patch [Pa] */
    double *weight[3][HOLD_PAIRS];  /* of a pair */
    double *hoop[HOLD_CORNERS];     /* theta theta times the weight of a cell, in curved geometry */
    double *room;                   /* of all these */
    double even[STRAIN_POINTS];     /* the weight of each pair where all are alike */
};

/* For tiles of a mesh. */
void viscous_film_open(const struct mesh *mesh, const struct model *model, struct viscous_film *ret);
void viscous_film_close(struct viscous_film *film);

/* The films of the tile that the slopes look at. strain: work space. */
void viscous_film_make(struct viscous_film *film, const struct viscous_slopes *slopes, const struct viscous_mix *mix,
                       struct viscous_strain *strain);

/* Adds component (i, block->axis) at the faces of a block to tau[n]. */
void viscous_film_faces(const struct viscous_film *film, const struct viscous_block *block, unsigned i, double *tau);

/* Adds component theta theta in the cells of a block to tau[n]. */
void viscous_film_cells(const struct viscous_film *film, const struct viscous_block *block, double *tau);

#endif
