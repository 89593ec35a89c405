/* heights.h - curvature of a surface from the heights of columns of fractions (Hirt & Nichols, J. Comput. Phys. 39
 * (1981) 201-225; Popinet, J. Comput. Phys. 228 (2009) 5838-5866).
 *
 * A column of seven cells along an axis that begins in one material and ends in the other holds as much as a sharp
 * surface at the height H = h sum alpha would leave in it, however its front is smeared or painted. With the heights of
 * the columns beside it, plane:  kappa = -d/dt (H'/sqrt(1 + H'^2)),     around an axis: with the areas of rings, and
 * 1/(r sqrt(1 + r'^2)) for columns along r, whose height is the radius of the same volume, space:  kappa = -(H_tt (1 +
 * H_u^2) + H_uu (1 + H_t^2) - 2 H_tu H_t H_u)/(1 + H_t^2 + H_u^2)^(3/2). Columns along all axes with a part of the
 * normal that is large enough, n_d^2 > 1/5, count with (n_d^2 - 1/5)^2, so that nothing jumps where the surface turns.
 * A column whose ends lack q of being pure counts less from q = 0.05 on, and not at all from 0.5. So do columns of wide
 * fronts, tanh(x/w) with w from 0.7 to 0.95 cells across the surface: under some 30 to 60 degrees columns of them read
 * kappa beside the foot of a cell, one side of the front before it and the other behind, and waves of six cells grow
 * (docs/decisions/tension.md). Where a wall asks for an angle, columns across it do not count within three cells of it,
 * width is no matter there, and those along it have a neighbour behind it whose height makes n keep that angle at the
 * wall (Afkhami & Bussmann, Int. J. Numer. Methods Fluids 57 (2008) 453-472). Of a disc of 8 cells per radius, painted
 * sharp, kappa is off by 2 % (rms), from normals of smoothed fractions 6 %; waves of 2 pi R/3 get 1.00 of their kappa,
 * there 0.9. */
#ifndef HEIGHTS_H
#define HEIGHTS_H

#include "mesh/mesh.h"

/* Layers around a tile: of fractions that it takes, of normals, of the cells that it serves. */
enum { HEIGHTS_LAYERS = 4, HEIGHTS_NORMALS = 2, HEIGHTS_AROUND = 1 };

/* kappa [1/m] of the surface of the material whose fractions a patch has, positive for a drop, and how much it is to be
 * trusted, from 0 to 1, in the cells of a tile and HEIGHTS_AROUND layers of them (x fastest). normal: of cells, from
 * psi (curvature.h). cosine: of the angles at walls, by faces of the tile, 0: none; NULL: none anywhere. What it says
 * behind such walls is of no use. Not in one dimension. */
void heights_take(const struct mesh *mesh, const struct level *level, const struct tile *tile, const double *a,
                  double *const normal[3], const double *cosine, double *ret_kappa, double *ret_trust);

#endif
