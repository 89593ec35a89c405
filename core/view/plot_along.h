/* plot_along.h - what a map of a run (io/maps.h) shows at chosen times: fields along a wall, a line, a surface. */
#ifndef PLOT_ALONG_H
#define PLOT_ALONG_H

#include "view/plot_option.h"

/* Draws fields of DIR/maps/NAME.csv against the place; words: NAME and a field, or several by comma, each with a panel.
 * A line for each --time (the map's nearest) and each run; without --time, for the moment at which the first field is
 * highest in that run. Into DIR/plots/profile_NAME_FIELD.png of the first run (+FIELD for each further one), or where
 * -o says; prints the path. STATUS_CASE: no such map or field, more lines or panels than a chart holds. */
int plot_along_write(const char *const *directories, unsigned n_directory, const char *const *words, unsigned n,
                     const struct plot_option *option);

#endif
