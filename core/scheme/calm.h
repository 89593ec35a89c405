/* calm.h - strong shocks that run along a mesh: faces beside them resist shear (`scheme: {shock-fronts: calm}`).
 *
 * A solver that resolves contacts and shear exactly leaves the rows of cells along which a strong shock runs to
 * themselves: noise between them grows at the front until it is no plane (the carbuncle; Quirk, Int. J. Numer. Methods
 * Fluids 18 (1994) 555-574). A solver that smears them does not. Faces between such rows get what HLL would do to their
 * shear and nothing else, tau = s D min(rho_L, rho_R) (u_tR - u_tL),   D = -S_L S_R/(S_R - S_L), off the flux of
 * momentum, tau times the mean of u_t off that of energy. s grows from 0 to 1 where the pressures of both neighbours of
 * one of the two cells, along an axis that the face lies in, differ by CALM_LEAST to CALM_MOST of the lesser rho c^2 of
 * both sides, and by CALM_LEAST of the lesser of these pressures: the switch of Quirk, without a jump. Contacts are as
 * sharp as without, and so is shear away from shocks. Pressures come with the layer around the tile (tile->around), so
 * tiles do not show. Not at faces of cells that hold a solid, whose shear is what hlld is for. */
#ifndef CALM_H
#define CALM_H

#include "scheme/term.h"

extern const struct term calm_term;

#endif
