/* foresee.h - asks caches for what a sweep over the tiles of a level reads next.
 *
 * Tiles follow each other along a curve, not in memory, so hardware does not foresee them, and a level is soon larger
 * than its caches: while one tile is computed, the next is on its way. Levels that caches hold are left alone, where
 * asking costs more than it brings, and so are tiles that were skipped last. No value changes (docs/decisions/tiles.md
 * has the figures). */
#ifndef FORESEE_H
#define FORESEE_H

#include "solve/stage.h"

/* Active rows of a block of a tile, such as its old state, which is needed when the rates are there. */
void foresee_block(const struct stage *stage, unsigned local, const double *block);

/* Primitives that the gathers of tile `local` read, its own and its neighbours', from where `source` reads those of the
 * tile before: once the first piece of that one, along the last axis, is gathered; nothing beyond the last tile. */
void foresee_gather(const struct stage *stage, const struct frame_source *source, const struct frame *frame,
                    unsigned local);

/* What stage_close reads of tile `local`; nothing beyond the last. */
void foresee_close(const struct stage *stage, unsigned local);

#endif
