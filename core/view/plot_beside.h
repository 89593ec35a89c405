/* plot_beside.h - pictures of several runs beside each other on one scale, and films of one run or of several.
 *
 * In a film the run that goes on longest is the clock: each of its times is a frame, in which every other run shows the
 * snapshot nearest to that time, its last one when it has ended; each panel says its own time. */
#ifndef PLOT_BESIDE_H
#define PLOT_BESIDE_H

#include "view/plot_draw.h"
#include "view/plot_picture.h"

#include <stddef.h>

enum { PLOT_BESIDE_RUNS = 8 };

/* Gathers `extremes` of the picture from n snapshot files, and from those of calls before. */
int plot_beside_gather(char *const *paths, size_t n, struct plot_picture *picture);

/* Writes the picture or the film that the options of `picture` ask for; prints its name. A list of fields is refused
 * where each is a plane. */
int plot_beside_write(const char *const *directories, unsigned n, const struct plot_picture *picture);

#endif
