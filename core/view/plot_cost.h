/* plot_cost.h - error against CPU seconds: the picture of what `bulla verify --cost` has run. */
#ifndef PLOT_COST_H
#define PLOT_COST_H

#include "view/plot_option.h"

/* Draws a CSV file of `bulla verify --cost` (batch/verify_point.h): a line for each scheme, the front dashed, both axes
 * logarithmic; beside the file with .png at its end, or where -o says; prints the path. STATUS_CASE: no such file, or
 * nothing in it that can be drawn. */
int plot_cost_write(const char *path, const struct plot_option *option);

#endif
