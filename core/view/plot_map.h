/* plot_map.h - a space-time map of a run (io/maps.h) as a picture: places across, time upwards; a rectangle at one
 * time. */
#ifndef PLOT_MAP_H
#define PLOT_MAP_H

#include "view/plot_option.h"

/* Draws fields of DIR/maps/NAME.csv; words: NAME and a field, or several by comma, a file each.
 * DIR/plots/map_NAME_FIELD.png, or what the options say. A rectangle at --time, or when the field is largest.
 * STATUS_CASE: no such map or field, and the like. */
int plot_map_write(const char *directory, const char *const *words, unsigned n, const struct plot_option *option);

#endif
