/* phase_bear.h - what liquid bears that has no vapour beside it: `where: everywhere`, `nucleation:`.
 *
 * It stays liquid until its Gibbs energy at p + tension and T - superheat is above that of its vapour. Most liquid is
 * far from that, which the next point of the saturation curve tells without asking any law. Tiles of liquid alone are
 * asked as a whole, so that they need no other material until it cavitates (scheme/phase_change.c). */
#ifndef PHASE_BEAR_H
#define PHASE_BEAR_H

#include "case/saturation.h"
#include "phys/model.h"

/* D [J/kg], which is below 0 where liquid evaporates into a vapour of its own. p: of the vapour, T: of both. Torn apart
 * (p <= 0): -HUGE_VAL. */
double phase_bear_drive(const struct saturation *pair, double p, double T);

/* Is a pressure past the end of the curve, or has the pair no exchange? Then nothing evaporates. */
bool phase_bear_ends(const struct scene_phase *scene, double p);

/* Does liquid without vapour stay what it is? */
bool phase_bear_stays(const struct scene_phase *scene, const struct saturation *pair, double p, double T);

/* Does all liquid of n cells stay, `path` being that of liquid alone, w its primitives at q * stride? What is no state
 * stays, for the guard. */
bool phase_bear_cells(const struct model *path, const struct scene_phase *scene, size_t n, size_t stride,
                      const double *w);

#endif
