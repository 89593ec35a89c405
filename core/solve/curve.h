/* curve.h - curvatures of interfaces with surface tension, in two and three dimensions: a pass over a level before each
 * stage.
 *
 * kappa of a cell looks at three layers of cells around it, and faces want it of the neighbours, too: so it is made of
 * the fractions before the layers of the frames are sent, and travels with them as a field of the primitives (model.h,
 * pairs). In one dimension it is known without neighbours (scheme/tension.h), and all this does nothing. */
#ifndef CURVE_H
#define CURVE_H

#include "mesh/mesh.h"
#include "phys/model.h"

struct curve;

/* NULL: there is none to make. All below do nothing then. */
struct curve *curve_new(const struct model *model, const struct mesh *mesh);
void curve_free(struct curve *curve);

/* Curvatures of all local tiles of a level into `arrays` ([n_local] blocks of primitives or conserved fields), from the
 * fractions there. Collective. */
void curve_take(struct curve *curve, int l, double *const *arrays);

/* What the next finer level sees of the fractions of this one, after curve_take of its w: slot 0 at the beginning of
 * its step, 1 at its end. Not collective. */
void curve_finer(struct curve *curve, int l, int slot);

/* Sends both slots to the finer level l. Collective. */
void curve_down(struct curve *curve, int l);

#endif
