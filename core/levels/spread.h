/* spread.h - what becomes of a change of a tile's cells (refluxing) that some of them cannot bear.
 *
 * Such a cell takes only a part of its change, and the cells around it that hold what is wanting take the rest: ring
 * by ring, until all is placed, each by what it has room for. A part is one of all fields, so that a
 * change at uniform p and u, which only exchanges materials, leaves both uniform wherever it goes; volumes weigh, so
 * that sums are conserved. The stretch is nobody's to conserve: a cell's own changes by the part that the cell keeps,
 * those around keep theirs. Leaves of the same tile come first, which is local and equal on any number of ranks; what
 * they cannot take belongs to the finer cells behind the face, which have taken too much. */
#ifndef SPREAD_H
#define SPREAD_H

#include "mesh/metric.h"
#include "phys/model.h"

enum spread_trouble {
    SPREAD_NONE,
    SPREAD_HALF, /* keeps half of what it has room for */
    SPREAD_ALL,  /* keeps nothing */
};

struct spread {
    const struct model *model;
    const struct mesh *mesh;
    const struct tile *tile;
    const struct metric *metric;  /* of the tile; read in curved geometry only */
    const double *u;              /* conserved fields before the change: [n_field][n_cell] */
    const unsigned char *trouble; /* [n_cell] spread_trouble; cells with trouble take nothing from others */
};

/* Moves the parts of delta[n_field][n_cell] that cells with trouble cannot take. What no cell of the tile has room for
 * goes into rest[n_field][n_cell], per volume of the cell with trouble (its other values are left alone); returns true
 * if there is any. */
bool spread_change(const struct spread *spread, double *delta, double *rest);

/* Adds to delta what one cell, or the cells around it if it has no room, is to take: amount[n_field], a change times
 * metric volume (spread_volume). What has no room as a whole is scattered field by field, each mass by what is
 * there. */
void spread_amount(const struct spread *spread, size_t cell, const double *amount, double *delta);

/* Volume of a cell in the units of `amount`: that of the metric, 1 where it is the same everywhere. */
double spread_volume(const struct spread *spread, unsigned q, size_t cell);

#endif
