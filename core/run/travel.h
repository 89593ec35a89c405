/* travel.h - what a run says of rigid bodies: before, how they go; after, what their way has cost. */
#ifndef TRAVEL_H
#define TRAVEL_H

#include "solve/state.h"

#include <stdbool.h>

/* For `bulla check`, on stdout: how fast each body goes and what passes its walls. */
void travel_print(const struct scene *scene);

/* Cells that bodies pass do not keep all of their mass. What is lost shows where nothing else changes the mass of
 * the domain: `told` says whether that is so. */
struct travel {
    bool told;
    double mass; /* [kg, ...] at the beginning */
};

/* Collective. */
struct travel travel_begin(const struct state *state);

/* A note with the change of the mass since then. Collective. */
void travel_say(const struct travel *travel, const struct state *state);

#endif
