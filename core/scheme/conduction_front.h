/* conduction_front.h - the surface between a liquid and its vapour, as heat sees it, for pairs with an `onset`.
 *
 * On a mesh the surface is smeared over some cells. Were each of them a surface at saturation, liquid in front of it
 * would boil, and were heat to stop at the first of them, it would evaporate there: the velocity would rise inside the
 * smear and leave a part of the liquid behind in the vapour. So the surface is where vapour and gases, `thin`, fill
 * phase_pair_front of a cell (beside other materials: of what they and the liquid fill). Before it all is liquid. The
 * last such cell touches the surface at the distance d of its centre, by linear interpolation of thin between it and
 * the next (Gibou et al., J. Comput. Phys. 176 (2002) 205-227, 2.2): q = k_l (T_l - T_next)/d,   d = h (front -
 * thin_l)/(thin_next - thin_l). Behind it, up to cells of `onset`, heat goes on as fast as the step allows: the cells
 * share it by the heat that they hold, those of `onset` and more, and those beside such, evaporate (scheme/shore.h).
 * What a face lets through depends on the cells beside it alone, not on where a tile ends.
 *
 * That is a surface that liquid gives heat to. Where of two cells with liquid the wetter one is the colder, vapour
 * condenses in all cells that hold some, and the surface warms its liquid: faces there are those of any mixture
 * (conduction_channel.h). The first cell before the surface would else take so much heat from it that a bubble in
 * slightly subcooled water vanishes where it should swing. */
#ifndef CONDUCTION_FRONT_H
#define CONDUCTION_FRONT_H

#include "phys/model.h"

struct conduction_front;

/* For pieces of paths of this model; NULL where no pair has an `onset`. Owned by the caller. */
struct conduction_front *conduction_front_new(const struct model *model);

void conduction_front_free(struct conduction_front *front);

/* Looks for surfaces in n cells. part: fractions, [n_material] with pitch FACE_ROOM; those of liquid take in the vapour
 * and the gases of cells before a surface. False: all is liquid, or none is; then the calls below may be left out. */
bool conduction_front_look(struct conduction_front *front, const struct model *path, size_t n, double *part);

/* What the cells hold: part as it is now, capacities of own volumes c [J/(m3 K)] and temperatures T [K], pitched alike.
 */
void conduction_front_weigh(struct conduction_front *front, const struct model *path, size_t n, const double *part,
                            const double *c, const double *T);

/* Conductivities of n faces, each between cell i and i + step, times the distance of the centres over d. k: those of
 * the materials, [n_material] with pitch FACE_ROOM [W/(m K)]; most: twice the greatest diffusivity of the step [m2/s].
 */
void conduction_front_meet(struct conduction_front *front, const struct model *path, size_t n, size_t step, double most,
                           const double *k, const double *c);

/* After conduction_front_meet: faces through which the surface warms its liquid have neither those conductivities nor
 * liquid that has taken in what is in its cells. T: as above. ret_part: fractions of the materials on the left and on
 * the right of the faces, [n_material] with pitch FACE_ROOM; they point into `front` if any face is such a one. */
void conduction_front_turn(struct conduction_front *front, const struct model *path, size_t n, size_t step,
                           const double *T, const double *ret_part[2]);

/* They take the place of k_lm where l and m are of a pair, at its surface and behind. */
void conduction_front_take(const struct conduction_front *front, const struct model *path, unsigned l, unsigned m,
                           size_t n, double *k_lm);

#endif
