/* rate.h - the rate of change of one tile and the step it makes: the one order in which the terms act (term.h).
 *
 * A run gathers frames from neighbours (solve/stage.c), a replay takes them from a dump (solve/blame_replay.c); both
 * come through here. */
#ifndef RATE_H
#define RATE_H

#include "scheme/terms.h"

/* What differs between a run and a replay; `data` is theirs. */
struct rate_watch {
    void *data;
    /* Fills faces->frame, and faces->mask where cells are marked, with a piece. */
    void (*gather)(void *data, const struct frame *frame, struct face_work *faces);
    /* A piece as it was gathered, and its fluxes, before they become rates. */
    void (*seen)(void *data, const struct frame *frame, struct face_work *faces);
    void (*swept)(void *data, int axis); /* all pieces of an axis are done; or NULL */
};

/* A piece of a tile as the terms of tile->part want it before it is reconstructed: gathered, with what they do to
 * frames. */
struct term_piece rate_gather(const struct term_tile *tile, void *const *own, const struct frame *frame,
                              const struct rate_watch *watch);

/* tile->rates from tile->w, of the terms of tile->part; without those that move there are no Riemann problems. own:
 * [TERMS_MOST] memory of the terms (terms_open). masked: some cells are marked; their faces are first order. */
void rate_take(struct term_tile *tile, void *const *own, const struct rate_watch *watch, bool masked);

/* u_new = tile->u + dt rates, of the active fields; the other terms' forms included. u_new and tile->u may not overlap.
 * Returns the number of cells in which a bound acted. */
size_t rate_apply(struct term_tile *tile, void *const *own, double *u_new);

/* u_new = u_old + mix (u_new - u_old) of the active fields: the mean of two states. A stretch is made one again. mix 1:
 * nothing. */
void rate_mix(const struct term_tile *tile, const double *u_old, double mix, double *u_new);

#endif
