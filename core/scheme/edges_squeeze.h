/* edges_squeeze.h - edges of velocity and pressure where mixtures of a liquid and its vapour are squeezed, for pairs
 * that condense over some cells (phys/phase.h).
 *
 * The vapour of a shock vanishes, and the mixture behind it is ten to a hundred times stiffer than the one before: what
 * slopes make of the front as it passes a cell, some thousandths of its velocity, is some tenths of its pressure
 * there. So beside vapour, where cells move together along the axis, edges of the normal velocity and of pressure lie
 * no further from their cell than the smaller one of the differences to its neighbours has it (minmod; P. L. Roe, Ann.
 * Rev. Fluid Mech. 18 (1986) 337). Expanding mixtures, densities and fractions keep their slopes. */
#ifndef EDGES_SQUEEZE_H
#define EDGES_SQUEEZE_H

#include "phys/model.h"

#include <stddef.h>

/* A row of n cells that have edges, `step` apart along the axis; one more follows on both sides. */
struct edges_squeeze {
    const struct model *model;
    size_t n, step, pitch;
    const double *w; /* primitives of the first, component q at q pitch */
    double *state;   /* their edges: upper ones of component q at 2 q pitch, lower ones n behind */
    int axis;
    bool pressure; /* its edges are there already */
    double *thin;  /* n + 2 step numbers to work with */
};

/* Puts such edges nearer to their cells. */
void edges_squeeze(const struct edges_squeeze *row);

/* Adds 1 to the mask of cells that are squeezed so. `state` is not looked at. */
void edges_squeeze_mark(const struct edges_squeeze *row, double *mask);

#endif
