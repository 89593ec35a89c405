/* plot_view.h - the part of a snapshot that a picture shows: a plane or a line of its cells.
 *
 * Each slice removes an axis; what remains is drawn, first axis to the right, second one up. */
#ifndef PLOT_VIEW_H
#define PLOT_VIEW_H

#include "view/plot_field.h"
#include "view/plot_option.h"
#include "view/raster.h"

struct plot_view {
    const struct snapshot *snapshot;
    int n_axis;                /* 1: a line, 2: a plane */
    int axis[2];               /* of the snapshot */
    double domain[2][2];       /* [shown axis][lower, upper] of all cells, mirror image included */
    size_t n, n_plain;         /* cells; those before n_plain are no mirror images */
    size_t *source;            /* [n] index in the snapshot */
    struct raster_cell *cells; /* [n]; a line has only at[0], ascending */
    char note[128];            /* where it is cut: "z = 0.10 mm"; "" if nowhere */
};

/* Fails with STATUS_CASE if a slice is outside of the domain or its axis is not there. */
int plot_view_make(const struct snapshot *snapshot, const struct plot_option *option, struct plot_view *ret_view);
void plot_view_done(struct plot_view *view);

/* Values of a field in the cells of the view: new memory for the caller to free with mem_free. */
double *plot_view_values(const struct plot_view *view, const struct plot_field *field);

/* Outlines of the mesh tiles that the view cuts; new memory for the caller to free with mem_free. */
struct raster_cell *plot_view_tiles(const struct plot_view *view, size_t *ret_n);

/* Widens `extremes` by the finite values in cells that touch the window [shown axis][2]; with `log` by those
 * above 0 only. */
void plot_view_range(const struct plot_view *view, const double *values, const double window[2][2], bool log,
                     double extremes[2]);

#endif
