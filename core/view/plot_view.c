/* plot_view.c - see plot_view.h. A cut that runs along cell faces shows the cells above it. */
#include "view/plot_view.h"

#include "base/mem.h"
#include "base/status.h"
#include "view/picture_scale.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct view_cut {
    bool sliced[3];
    double at[3];
};

static int plot_view_slice(const struct snapshot *snapshot, const struct plot_option *option, int axis,
                           struct view_cut *cut)
{
    double lower = snapshot->domain[0][axis], upper = snapshot->domain[1][axis], at = option->slice[axis];
    if (axis >= snapshot->dim)
        return status_fail(STATUS_CASE, "--slice %c=%g: the run has %d dimension%s", 'x' + axis, at, snapshot->dim,
                           snapshot->dim > 1 ? "s" : "");
    if (!(at >= lower && at <= upper))
        return status_fail(STATUS_CASE, "--slice %c=%g: the domain reaches from %g to %g", 'x' + axis, at, lower,
                           upper);
    cut->sliced[axis] = true;
    cut->at[axis] = at == upper ? nextafter(upper, lower) : at; /* the last cell, not the one behind it */
    return STATUS_OK;
}

static int plot_view_cuts(const struct snapshot *snapshot, const struct plot_option *option, struct view_cut *cut)
{
    int left = snapshot->dim;
    for (int axis = 0; axis < 3; axis++) {
        if (!option->sliced[axis]) continue;
        TRY(plot_view_slice(snapshot, option, axis, cut));
        left--;
    }
    if (left < 1) return status_fail(STATUS_CASE, "--slice: nothing is left to draw when every axis is cut");
    if (left == 3) {
        cut->sliced[2] = true;
        cut->at[2] = 0.5 * (snapshot->domain[0][2] + snapshot->domain[1][2]);
    }
    return STATUS_OK;
}

static bool plot_view_has(const struct snapshot *snapshot, const struct view_cut *cut, size_t cell)
{
    for (int axis = 0; axis < 3; axis++)
        if (cut->sliced[axis] &&
            !(snapshot->lower[cell][axis] <= cut->at[axis] && cut->at[axis] < snapshot->upper[cell][axis]))
            return false;
    return true;
}

static void plot_view_note(const struct snapshot *snapshot, const struct view_cut *cut, struct plot_view *view)
{
    for (int axis = 0; axis < snapshot->dim; axis++) {
        char place[PICTURE_SCALE_LABEL];
        double size = fmax(fabs(snapshot->domain[0][axis]), fabs(snapshot->domain[1][axis]));
        if (!cut->sliced[axis]) continue;
        picture_scale_quantity(cut->at[axis], size, "m", place);
        size_t used = strlen(view->note);
        snprintf(view->note + used, sizeof view->note - used, "%s%s = %.40s", used ? ", " : "",
                 plot_field_axis(snapshot, axis), place);
    }
}

static void plot_view_fill(const struct snapshot *snapshot, const struct view_cut *cut, bool mirror,
                           struct plot_view *view)
{
    size_t room = mirror ? 2 * snapshot->n_cell : snapshot->n_cell;
    view->source = mem_new(room, sizeof *view->source);
    view->cells = mem_new(room, sizeof *view->cells);
    for (size_t c = 0; c < snapshot->n_cell; c++) {
        if (!plot_view_has(snapshot, cut, c)) continue;
        struct raster_cell *cell = &view->cells[view->n];
        for (int k = 0; k < view->n_axis; k++) {
            cell->at[k][0] = snapshot->lower[c][view->axis[k]];
            cell->at[k][1] = snapshot->upper[c][view->axis[k]];
        }
        view->source[view->n++] = c;
    }
    view->n_plain = view->n;
    for (size_t c = 0; mirror && c < view->n_plain; c++) {
        view->cells[view->n] = view->cells[c];
        view->cells[view->n].at[0][0] = -view->cells[c].at[0][1];
        view->cells[view->n].at[0][1] = -view->cells[c].at[0][0];
        view->source[view->n++] = view->source[c];
    }
}

struct view_item {
    struct raster_cell cell;
    size_t source;
};

static int plot_view_compare(const void *left, const void *right)
{
    double a = ((const struct view_item *)left)->cell.at[0][0], b = ((const struct view_item *)right)->cell.at[0][0];
    return a < b ? -1 : a > b;
}

/* Cells of a line from left to right. */
static void plot_view_sort(struct plot_view *view)
{
    struct view_item *items = mem_new(view->n, sizeof *items);
    for (size_t c = 0; c < view->n; c++) items[c] = (struct view_item){view->cells[c], view->source[c]};
    qsort(items, view->n, sizeof *items, plot_view_compare);
    for (size_t c = 0; c < view->n; c++) {
        view->cells[c] = items[c].cell;
        view->source[c] = items[c].source;
    }
    mem_free(items);
}

int plot_view_make(const struct snapshot *snapshot, const struct plot_option *option, struct plot_view *ret_view)
{
    struct plot_view view = {.snapshot = snapshot};
    struct view_cut cut = {0};
    TRY(plot_view_cuts(snapshot, option, &cut));
    for (int axis = 0; axis < snapshot->dim; axis++)
        if (!cut.sliced[axis]) view.axis[view.n_axis++] = axis;
    bool mirror = option->mirror || option->left;
    if (mirror && (snapshot->beta != 1 || cut.sliced[0] || view.n_axis != 2))
        return status_fail(STATUS_CASE, "--mirror, --left and --right need an axisymmetric run with its axis in view");
    for (int k = 0; k < view.n_axis; k++)
        for (int side = 0; side < 2; side++) view.domain[k][side] = snapshot->domain[side][view.axis[k]];
    if (mirror) view.domain[0][0] = -view.domain[0][1];
    plot_view_fill(snapshot, &cut, mirror, &view);
    plot_view_note(snapshot, &cut, &view);
    if (view.n_axis == 1) plot_view_sort(&view);
    *ret_view = view;
    return STATUS_OK;
}

void plot_view_done(struct plot_view *view)
{
    mem_free(view->source);
    mem_free(view->cells);
    *view = (struct plot_view){0};
}

double *plot_view_values(const struct plot_view *view, const struct plot_field *field)
{
    double *values = mem_new(view->n, sizeof *values);
    for (size_t c = 0; c < view->n; c++) values[c] = plot_field_value(field, view->source[c]);
    return values;
}

/* The tile of each cell. */
static size_t *plot_view_tile_of(const struct snapshot *snapshot)
{
    size_t *tile_of = mem_new(snapshot->n_cell, sizeof *tile_of);
    for (size_t i = 0; i < snapshot->n_tile; i++)
        for (size_t c = 0; c < snapshot->tiles[i].n_cell; c++) tile_of[snapshot->tiles[i].first + c] = i;
    return tile_of;
}

struct raster_cell *plot_view_tiles(const struct plot_view *view, size_t *ret_n)
{
    size_t tiles = view->snapshot->n_tile, n = 0, *tile_of = plot_view_tile_of(view->snapshot);
    struct raster_cell *boxes = mem_new(2 * tiles, sizeof *boxes); /* mirror images apart */
    for (size_t c = 0; c < view->n; c++) {
        const struct raster_cell *cell = &view->cells[c];
        struct raster_cell *box = &boxes[tile_of[view->source[c]] + (c < view->n_plain ? 0 : tiles)];
        bool first = box->at[0][0] >= box->at[0][1];
        for (int axis = 0; axis < 2; axis++) {
            if (first || cell->at[axis][0] < box->at[axis][0]) box->at[axis][0] = cell->at[axis][0];
            if (first || cell->at[axis][1] > box->at[axis][1]) box->at[axis][1] = cell->at[axis][1];
        }
    }
    for (size_t b = 0; b < 2 * tiles; b++)
        if (boxes[b].at[0][0] < boxes[b].at[0][1]) boxes[n++] = boxes[b];
    mem_free(tile_of);
    *ret_n = n;
    return boxes;
}

void plot_view_range(const struct plot_view *view, const double *values, const double window[2][2], bool log,
                     double extremes[2])
{
    for (size_t c = 0; c < view->n; c++) {
        bool inside = true;
        for (int k = 0; k < view->n_axis; k++)
            inside = inside && view->cells[c].at[k][1] > window[k][0] && view->cells[c].at[k][0] < window[k][1];
        if (!inside || !isfinite(values[c]) || (log && values[c] <= 0.0)) continue;
        if (values[c] < extremes[0]) extremes[0] = values[c];
        if (values[c] > extremes[1]) extremes[1] = values[c];
    }
}
