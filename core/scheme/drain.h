/* drain.h - what a surface that evaporates leaves behind flows back to it.
 *
 * Evaporation makes volume in the last cell of a liquid (shore.h), so the liquid in the cells behind it hardly moves,
 * while the surface goes on: some of it stays behind in the vapour for good. One part in a hundred of the volume is
 * sixteen times the mass of the vapour there, and it has brought its heat to the surface before. So liquid and vapour
 * change places across faces, as in schemes that compress interfaces (Weller, OpenCFD technical report TR/HGW/04, 2008;
 * here bounded by what both cells hold): per area and time the volume
 *
 *     q = w a_D g_W (a_W - a_D)/(a_W + a_D),   w = min(DRAIN_SPEED max(du, 0), DRAIN_MOST h/dt)
 *
 * of liquid goes from the drier cell D to the wetter W, and as much of vapour and gases back. a: fraction of the
 * liquid; g: of vapour and gases; du: by how much the normal velocity rises over four cells, the speed at which such a
 * surface leaves its vapour; none where they meet. Both take along their mass, energy and momentum; at one pressure no
 * pressure changes. Pairs with an `onset` in scenes with conduction, and those whose vapour diffuses through gases:
 * else drops of the liquid follow the gas. Not where vapour only condenses, nor at faces of troubled cells. */
#ifndef DRAIN_H
#define DRAIN_H

#include "scheme/term.h"

/* How often the surface's own speed (docs/decisions/phase-change.md). */
#define DRAIN_SPEED 5.0

/* Part of a cell that may pass a face in a step. */
#define DRAIN_MOST 0.125

/* Adds to the fluxes; owns no row. */
extern const struct term drain_term;

#endif
