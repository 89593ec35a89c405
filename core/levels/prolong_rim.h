/* prolong_rim.h - pieces beside fine tiles that lie on the coarser level: edges and corners beside strips (prolong.h).
 *
 * The same rules: c +- s/4 per axis with minmod slopes s of the coarse cell, so that a piece across a face has the
 * bits of the strip there, and a corner is bounded by its coarse cell and that cell's face neighbours. The
 * octants around a fine tile exist on the coarser level, so a slope always has both neighbours; only behind a
 * given boundary, where all layers are alike, there is no slope across it. */
#ifndef PROLONG_RIM_H
#define PROLONG_RIM_H

#include "phys/model.h"
#include "scheme/patch.h"

/* Writes slot 0 (beginning of the coarse step) or 1 (end) of the rim of level l + 1 from a source of level l whose
 * exchange is finished. `model`: the fields are its primitives: fractions add up to 1, stretches stay stretches; NULL:
 * any fields. Not collective; rim_down sends the pieces. */
void prolong_rim(const struct patch_source *coarse, struct rim *fine, int slot, const struct model *model);

#endif
