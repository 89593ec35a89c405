/* reflux.h - coarse and fine fluxes made one: what the coarse cell at a coarse-fine face gets after the fine level
 * has caught up (Berger & Colella 1989; model.md 7, amr.md 3.6).
 *
 * Rows of fluxes whose rates are evolved fields (term.h) are refluxed, whatever term they belong to, and with them the
 * half of a force at the face that acts on the coarse cell: where the pressures at the face balance it on each level,
 * they do so after the exchange. Of the fluxes of the stages, with their weights in the step (solve/tableau.h), a level
 * keeps those through its coarse-fine faces: as the finer side, their means over sub-faces; as the coarser side, its
 * own. With delta = (sum over fine steps of dt F_fine) - dt F_coarse and the cell on the lower side of the face,
 *     conserved fields:  d q = -(A/V) delta(F)
 *     fractions:         d alpha = -(A/V) [delta(alpha* u*) - (alpha + K) delta(u*)],
 *     stretch:           d V = -(A/V)/m_s [delta(V* F) - V delta(F)] + what dL = delta(u) n/h stretches V by
 *                        (F, m_s: mass flux and partial density of all solids together)
 *                              (elastic_correct),
 * alpha + K and V those of the coarse cell, weighted likewise (the midpoint's): without the second terms a uniform
 * alpha or V would be asked to drift. Registers hold, beside all fluxes, u* and in scenes with a solid the face's other
 * velocity components, as the coarse cell sees them where the sides slip. `plain`: the first terms alone. */
#ifndef REFLUX_H
#define REFLUX_H

#include "mesh/link.h"
#include "mesh/metric.h"
#include "scheme/terms.h"

/* Of one level; links are those of its neighbours when it was made. */
struct reflux {
    const struct model *model;
    const struct mesh *mesh;
    const struct level *level;
    struct link *down, *up; /* to the coarser and from the finer level, or NULL */
    double *fine;           /* [down->n_face][n_register][face_cells] of the step under way */
    double *coarse; /* [up->n_source][n_register + n_alpha + n_stretched + stretches][face_cells]: fluxes, then alpha +
                       K, V and m_s (both with a solid), of the cell */
    double *plane;  /* scratch: both fine faces of an axis, [2][n_register][n^(d-1)], then one mean */
    double weight;  /* of the stage under way */
    bool fresh;     /* it is the first one that counts */
};

struct reflux *reflux_new(const struct model *model, const struct mesh *mesh, int l);
void reflux_free(struct reflux *reflux);

/* Has this local tile a coarse-fine face, on either side? */
bool reflux_concerns(const struct reflux *reflux, unsigned local);

/* A stage begins: its fluxes count with `weight`; fresh: none before it did. */
void reflux_weigh(struct reflux *reflux, double weight, bool fresh);

/* Takes the fluxes of one piece of a tile (after face_solve); `terms`: of the path it was solved with. */
void reflux_collect(struct reflux *reflux, const struct terms *terms, unsigned local, const struct frame *frame);

/* After all pieces of an axis: means over sub-faces of the tile's own coarse-fine faces. */
void reflux_average(struct reflux *reflux, unsigned local, int axis);

/* Keeps alpha + K and V of the cells behind finer faces; w: the tile's primitives, K: of mix_closure, of the materials
 * of the path `used`, or NULL (K = 0). */
void reflux_keep(struct reflux *reflux, const struct model *used, unsigned local, const double *w, const double *K);

/* The step of this level was accepted: adds dt times its fine fluxes to the registers of the link below. */
void reflux_commit(struct reflux *reflux, double dt);

/* Empties the registers of the link above: a coarse step begins. */
void reflux_clear(struct reflux *reflux);

/* What refluxing adds to the conserved fields of local tile `local` after a step dt of this level and link_up:
 * delta[n_field][n_cell], zeroed here. */
void reflux_delta(const struct reflux *reflux, unsigned local, double dt, double *delta);

/* The part of it that one value `index` of the registers of a source asks for: ret_change[n_field]; metric: of the
 * tile. */
void reflux_source(const struct reflux *reflux, unsigned s, size_t index, const struct metric *metric, double dt,
                   double *ret_change);

/* The cell of the coarse tile that belongs to value `index` of a source's registers. */
size_t reflux_cell(const struct mesh *mesh, const struct link_face *source, size_t index);

#endif
