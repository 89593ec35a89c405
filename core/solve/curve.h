/* curve.h - how interfaces lie in two and three dimensions, their curvatures (of pairs with surface tension) and their
 * slants (scheme/slant.h): a pass over a level before each stage.
 *
 * kappa of a cell looks at three layers of cells around it, s at one, and faces want both of the neighbours, too: so
 * they are made of the fractions before the layers of the frames are sent, and travel with them as fields of the
 * primitives (model.h). In one dimension kappa is known without neighbours (scheme/tension.h), s is 1, and all this
 * does nothing. */
#ifndef CURVE_H
#define CURVE_H

#include "mesh/mesh.h"
#include "phys/model.h"

struct curve;

/* NULL: there is none to make. All below do nothing then. */
struct curve *curve_new(const struct model *model, const struct mesh *mesh);
void curve_free(struct curve *curve);

/* Curvatures and, into its primitives alone, slants of all local tiles of a level into `arrays` ([n_local] blocks of
 * primitives or conserved fields), from the fractions there. Collective. */
void curve_take(struct curve *curve, int l, double *const *arrays);

/* What the next finer level sees of the fractions of this one, after curve_take of its w: slot 0 at the beginning of
 * its step, 1 at its end. Not collective. */
void curve_finer(struct curve *curve, int l, int slot);

/* Sends both slots to the finer level l. Collective. */
void curve_down(struct curve *curve, int l);

#endif
