/* plot_interface.h - the interfaces of materials in a view: lines where alpha = 0.5. */
#ifndef PLOT_INTERFACE_H
#define PLOT_INTERFACE_H

#include "view/contour.h"
#include "view/picture.h"
#include "view/plot_view.h"

struct plot_interfaces {
    unsigned n;
    const char *names[PICTURE_LINES]; /* of the snapshot */
    struct contour contours[PICTURE_LINES];
};

/* Finds the lines of the materials that --contour names. By default of all whose alpha is known except the one that
 * fills most of the view: its lines are those of the others. Known are those in the file; where only one is not, it is
 * 1 less the others. A name that is no material, or whose alpha is not known, is STATUS_CASE. */
int plot_interface_find(const struct plot_view *view, const char *contours, struct plot_interfaces *ret_interfaces);

/* The same in a view with one axis: positions, ascending per material, in new memory (mem_free). */
int plot_interface_places(const struct plot_view *view, const char *contours, double **ret_places, size_t *ret_n);

/* The fractions that are not known, "alpha_air, alpha_gel", in new memory: their interfaces are not in pictures. NULL
 * if all are known. */
char *plot_interface_lacking(const struct snapshot *snapshot);

void plot_interface_done(struct plot_interfaces *interfaces);

#endif
