/* plot_history.h - columns of history.csv and probes.csv against time, of one run or of several. */
#ifndef PLOT_HISTORY_H
#define PLOT_HISTORY_H

#include "view/plot_option.h"

#include <cairo.h>

/* Draws the named columns ("V", "pmax", "wall.pressure"; none: what history.csv measures) of a run's directory. An
 * unknown column is STATUS_CASE with those that are there. The caller destroys the image. */
int plot_history_draw(const char *directory, const char *const *columns, unsigned n, const struct plot_option *option,
                      cairo_surface_t **ret_image);

/* The same into DIR/plots/history.png, or where -o says; prints the path. Of several runs each column has a panel with
 * a line for every run, by its name (plot_case.h); at least one column must then be named and the picture is
 * plots/compare.png of the first run. More runs than a panel holds, or a run without the column, are STATUS_CASE. */
int plot_history_write(const char *const *directories, unsigned n_directory, const char *const *columns, unsigned n,
                       const struct plot_option *option);

#endif
