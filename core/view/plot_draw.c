/* plot_draw.c - see plot_draw.h: planes here, lines in plot_profile.c, space in plot_space.c. */
#include "view/plot_draw.h"

#include "base/mem.h"
#include "base/status.h"
#include "view/picture.h"
#include "view/picture_text.h"
#include "view/plot_interface.h"
#include "view/plot_profile.h"
#include "view/plot_space.h"
#include "view/plot_view.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The part of the axes that is shown: all of the domain unless --xlim or --ylim say otherwise. */
static int plot_draw_window(const struct plot_view *view, const struct plot_option *option, double ret_window[2][2])
{
    for (int k = 0; k < 2 && k < view->n_axis; k++) {
        memcpy(ret_window[k], view->domain[k], sizeof ret_window[k]);
        const struct plot_option_span *limit = &option->limit[k];
        if (!limit->given) continue;
        if (limit->hi <= view->domain[k][0] || limit->lo >= view->domain[k][1])
            return status_fail(STATUS_CASE, "--%clim %g,%g: the domain reaches from %g to %g", 'x' + k, limit->lo,
                               limit->hi, view->domain[k][0], view->domain[k][1]);
        ret_window[k][0] = limit->lo;
        ret_window[k][1] = limit->hi;
    }
    return STATUS_OK;
}

static void plot_draw_note(const struct plot_view *view, const struct plot_picture *picture, char *ret_note,
                           size_t size)
{
    char time[PICTURE_SCALE_LABEL];
    double like = picture->time_like > 0.0 ? picture->time_like : view->snapshot->time;
    picture_scale_quantity(view->snapshot->time, like, "s", time);
    snprintf(ret_note, size, PICTURE_ITALIC "t" PICTURE_UPRIGHT " = %s%s%s", time, *view->note ? ", " : "", view->note);
}

static bool plot_draw_is_inside(const struct plot_picture *picture, unsigned index)
{
    return *picture->option->inside && index + 1 == picture->n_field;
}

/* Leaves NaN where another field of the picture is shown: the other half, in a material or out of it. */
static int plot_draw_mask(const struct plot_view *view, const struct plot_picture *picture, unsigned index,
                          double *values)
{
    const struct plot_option *option = picture->option;
    bool inside = plot_draw_is_inside(picture, index);
    for (size_t c = 0; option->left && !inside && c < view->n; c++) /* the images are the left half */
        if ((c >= view->n_plain) != (index == 0)) values[c] = NAN;
    if (!*option->inside) return STATUS_OK;
    struct plot_field field;
    char *name = mem_print("alpha_%s", option->inside);
    int code = plot_field_find(view->snapshot, name, &field);
    mem_free(name);
    if (code) return status_wrap(code, "--inside %s=%s: ", option->inside, option->inside_field);
    double *alpha = plot_view_values(view, &field);
    for (size_t c = 0; c < view->n; c++)
        if ((alpha[c] >= 0.5) != inside) values[c] = NAN;
    mem_free(alpha);
    return STATUS_OK;
}

/* One field of a plane; its values are new memory also when this fails. */
static int plot_draw_layer(const struct plot_view *view, const struct plot_picture *picture, unsigned index,
                           const double window[2][2], struct picture_layer *layer, double **ret_values)
{
    const struct plot_option *option = picture->option;
    struct plot_field field;
    TRY(plot_field_find(view->snapshot, picture->fields[index], &field));
    double *values = plot_view_values(view, &field), extremes[2] = {INFINITY, -INFINITY};
    layer->values = *ret_values = values;
    layer->cells = view->cells;
    layer->n = view->n;
    TRY(plot_draw_mask(view, picture, index, values));
    if (picture->common) memcpy(extremes, picture->extremes[index], sizeof extremes);
    else plot_view_range(view, values, window, option->log, extremes);
    const char *map = option->map ? option->map : colormap_for_field(picture->fields[index], extremes[0], extremes[1]);
    if (!option->map && plot_draw_is_inside(picture, index) && strcmp(map, "balance") != 0)
        map = "ember"; /* told apart */
    TRY(colormap_find(map, &layer->map));
    TRY(plot_picture_range(&option->range[index], option->log, picture->fields[index], map, extremes));
    picture_scale_init(&layer->scale, &(struct picture_scale_inp){.name = field.label,
                                                                  .unit = field.field->unit,
                                                                  .lo = extremes[0],
                                                                  .hi = extremes[1],
                                                                  .log = option->log});
    return STATUS_OK;
}

static void plot_draw_axes(const struct plot_view *view, const double window[2][2], struct picture *drawn)
{
    double size = 0.0;
    for (int k = 0; k < 2; k++) size = fmax(size, fmax(fabs(window[k][0]), fabs(window[k][1])));
    for (int k = 0; k < 2; k++)
        picture_scale_init(&drawn->axis[k], &(struct picture_scale_inp){
                                                .name = plot_field_axis(view->snapshot, view->axis[k]),
                                                .unit = "m",
                                                .lo = window[k][0],
                                                .hi = window[k][1],
                                                .like = size,
                                            });
}

static int plot_draw_plane(const struct plot_view *view, const struct plot_picture *picture, const double window[2][2],
                           const char *note, cairo_surface_t **ret_image)
{
    struct picture drawn = {.title = view->snapshot->title,
                            .note = note,
                            .halves = picture->option->left,
                            .inside = *picture->option->inside,
                            .n_layer = picture->n_field};
    struct plot_interfaces interfaces = {0};
    double *values[PICTURE_LAYERS] = {NULL};
    struct raster_cell *tiles = picture->option->tiles ? plot_view_tiles(view, &drawn.n_tile) : NULL;
    drawn.tiles = tiles;
    plot_draw_axes(view, window, &drawn);
    int code = STATUS_OK;
    for (unsigned i = 0; !code && i < drawn.n_layer; i++)
        code = plot_draw_layer(view, picture, i, window, &drawn.layer[i], &values[i]);
    if (!code) code = plot_interface_find(view, picture->option->contours, &interfaces);
    drawn.lines_label = PICTURE_ITALIC "α" PICTURE_UPRIGHT " = 0.5";
    drawn.n_lines = interfaces.n;
    for (unsigned i = 0; i < interfaces.n; i++)
        drawn.lines[i] = (struct picture_lines){&interfaces.contours[i], interfaces.names[i]};
    if (!code) code = picture_draw(&drawn, picture->option->width, ret_image);
    plot_interface_done(&interfaces);
    mem_free(tiles);
    for (unsigned i = 0; i < drawn.n_layer; i++) mem_free(values[i]);
    return code;
}

int plot_draw_extremes(const struct snapshot *snapshot, struct plot_picture *picture)
{
    struct plot_view view;
    double window[2][2];
    if (picture->option->n_iso) return plot_space_extremes(snapshot, picture);
    TRY(plot_view_make(snapshot, picture->option, &view));
    int code = plot_draw_window(&view, picture->option, window);
    for (unsigned i = 0; !code && i < picture->n_field; i++) {
        struct plot_field field;
        code = plot_field_find(snapshot, picture->fields[i], &field);
        if (code) break;
        double *values = plot_view_values(&view, &field);
        if (view.n_axis == 2) code = plot_draw_mask(&view, picture, i, values);
        plot_view_range(&view, values, window, picture->option->log, picture->extremes[i]);
        mem_free(values);
    }
    plot_view_done(&view);
    return code;
}

int plot_draw(const struct snapshot *snapshot, const struct plot_picture *picture, cairo_surface_t **ret_image)
{
    struct plot_view view;
    double window[2][2];
    char note[384];
    if (picture->option->n_iso) return plot_space_draw(snapshot, picture, ret_image);
    TRY(plot_view_make(snapshot, picture->option, &view));
    int code = plot_draw_window(&view, picture->option, window);
    plot_draw_note(&view, picture, note, sizeof note);
    if (!code && view.n_axis == 1) code = plot_profile_draw(&view, picture, window[0], note, ret_image);
    else if (!code) code = plot_draw_plane(&view, picture, window, note, ret_image);
    plot_view_done(&view);
    return code;
}
