/* picture.c - layout in points, then drawing at any resolution.
 *
 * The size of the data box follows from the aspect ratio; numbers are fitted to it, and margins to the
 * numbers. The box is then moved to whole pixels so that cell edges stay sharp. */
#include "view/picture.h"

#include "base/mem.h"
#include "view/picture_axes.h"
#include "view/picture_canvas.h"
#include "view/picture_header.h"
#include "view/picture_text.h"

#include <math.h>

#define PICTURE_MARGIN 9.0
#define PICTURE_BAR 9.5      /* thickness of a colour bar */
#define PICTURE_BAR_GAP 11.0 /* from the box or from what is below it */

struct picture_plan {
    struct picture scaled; /* the picture with fitted scales */
    struct picture_header header;
    struct picture_rect box, bar_box[PICTURE_LAYERS];
    struct picture_bar bar[PICTURE_LAYERS];
    double width, height;
};

/* Size of the data box: true to scale within limits, beyond 1:12 a strip of its own proportions. */
static void picture_box(const struct picture *picture, struct picture_rect *box)
{
    double true_to_scale = (picture->axis[1].hi - picture->axis[1].lo) / (picture->axis[0].hi - picture->axis[0].lo);
    double aspect = picture->aspect > 0.0 ? picture->aspect : true_to_scale;
    if (aspect >= 1.0) {
        box->w = aspect > 1.25 ? 400.0 / aspect : 320.0;
        if (box->w < 80.0) box->w = aspect > 12.0 ? 50.0 : 80.0 - 30.0 * (aspect - 5.0) / 7.0;
        box->h = aspect > 12.0 ? 600.0 : box->w * aspect;
    } else {
        box->w = aspect < 0.5 ? 420.0 : 340.0;
        box->h = aspect < 1.0 / 12.0 ? 35.0 : box->w * aspect;
    }
}

static bool picture_beyond(const struct picture_layer *layer, bool above)
{
    double slack = 1e-6 * (layer->scale.hi - layer->scale.lo);
    for (size_t c = 0; c < layer->n; c++) {
        if (above && layer->values[c] > layer->scale.hi + slack) return true;
        if (!above && layer->values[c] < layer->scale.lo - slack) return true;
    }
    return false;
}

/* Colour bars: right of the box, or below it, one half each when there are two halves. */
static void picture_place_bars(cairo_t *cr, struct picture_plan *plan, double *ret_right, double *ret_below)
{
    unsigned count = plan->scaled.n_layer, below = plan->scaled.inside ? count - 1 : count;
    bool tall = plan->box.h >= 0.45 * plan->box.w && plan->box.h >= 90.0;
    *ret_right = *ret_below = 0.0;
    for (unsigned i = 0; i < count; i++) {
        struct picture_layer *layer = &plan->scaled.layer[i];
        struct picture_bar *bar = &plan->bar[i];
        bool upright = i == below || (count == 1 && tall);
        *bar = (struct picture_bar){&layer->scale, &layer->map, upright, picture_beyond(layer, false),
                                    picture_beyond(layer, true)};
        double between = below > 1 ? 14.0 : 0.0, run = (plan->box.w - between) / below;
        picture_axes_fit(cr, &layer->scale, upright ? plan->box.h : run, upright);
        double room = picture_axes_bar_room(cr, bar);
        if (upright) {
            plan->bar_box[i] = (struct picture_rect){plan->box.w + PICTURE_BAR_GAP, 0.0, PICTURE_BAR, plan->box.h};
            *ret_right = PICTURE_BAR_GAP + PICTURE_BAR + room;
        } else {
            plan->bar_box[i] = (struct picture_rect){(run + between) * i, plan->box.h, run, PICTURE_BAR};
            *ret_below = PICTURE_BAR_GAP + PICTURE_BAR + room;
        }
    }
}

static void picture_plan(cairo_t *cr, struct picture_plan *plan)
{
    const struct picture *picture = &plan->scaled;
    picture_box(picture, &plan->box);
    picture_axes_fit(cr, &plan->scaled.axis[0], plan->box.w, false);
    picture_axes_fit(cr, &plan->scaled.axis[1], plan->box.h, true);
    double right, below, left = PICTURE_MARGIN + picture_axes_room(cr, &plan->scaled.axis[1], true);
    double foot = picture_axes_room(cr, &plan->scaled.axis[0], false);
    picture_place_bars(cr, plan, &right, &below);
    if (right < 12.0) right = 12.0; /* half a number may stick out */
    plan->width = left + plan->box.w + right + PICTURE_MARGIN;

    plan->header = (struct picture_header){.title = picture->title,
                                           .note = picture->note,
                                           .lines_label = picture->lines_label,
                                           .n_lines = picture->n_lines,
                                           .box_width = plan->box.w};
    for (unsigned i = 0; i < picture->n_lines; i++) plan->header.lines[i] = picture->lines[i].name;
    double spare = picture_header_plan(cr, &plan->header, plan->width - left - PICTURE_MARGIN);
    plan->width += spare;
    plan->box.x = left;
    plan->box.y = PICTURE_MARGIN + plan->header.height;
    plan->height = plan->box.y + plan->box.h + foot + below + PICTURE_MARGIN;
    for (unsigned i = 0; i < picture->n_layer; i++) {
        plan->bar_box[i].x += left;
        plan->bar_box[i].y += plan->box.y + (plan->bar[i].upright ? 0.0 : foot + PICTURE_BAR_GAP);
    }
}

/* Moves the box to whole pixels. */
static void picture_snap(struct picture_rect *box, double scale)
{
    double right = round((box->x + box->w) * scale), bottom = round((box->y + box->h) * scale);
    box->x = round(box->x * scale) / scale;
    box->y = round(box->y * scale) / scale;
    box->w = fmax(right / scale - box->x, 1.0 / scale);
    box->h = fmax(bottom / scale - box->y, 1.0 / scale);
}

static void picture_paint_layer(cairo_t *cr, const struct picture_plan *plan, const struct picture_layer *layer,
                                double scale)
{
    const struct picture_scale *axis = plan->scaled.axis;
    struct raster_window window = {{{axis[0].lo, axis[0].hi}, {axis[1].lo, axis[1].hi}},
                                   (int)lround(plan->box.w * scale),
                                   (int)lround(plan->box.h * scale)};
    double *shade = mem_new(layer->n, sizeof *shade);
    for (size_t c = 0; c < layer->n; c++) shade[c] = picture_scale_at(&layer->scale, layer->values[c]);
    for (size_t c = 0; c < layer->n; c++) /* what a log scale cannot show lies below it */
        if (layer->scale.log && !(layer->values[c] > 0.0) && !isnan(layer->values[c])) shade[c] = 0.0;
    cairo_surface_t *image = raster_image(&window, layer->n, layer->cells, shade, &layer->map);
    cairo_save(cr);
    cairo_identity_matrix(cr);
    cairo_set_source_surface(cr, image, round(plan->box.x * scale), round(plan->box.y * scale));
    cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_NEAREST);
    cairo_paint(cr);
    cairo_restore(cr);
    cairo_surface_destroy(image);
    mem_free(shade);
}

static void picture_point(const struct picture_plan *plan, const double at[2], double *ret_x, double *ret_y)
{
    *ret_x = plan->box.x + plan->box.w * picture_scale_at(&plan->scaled.axis[0], at[0]);
    *ret_y = plan->box.y + plan->box.h * (1.0 - picture_scale_at(&plan->scaled.axis[1], at[1]));
}

static void picture_path(cairo_t *cr, const struct picture_plan *plan, const struct contour *contour)
{
    for (size_t i = 0; i < contour->n_line; i++)
        for (size_t k = 0; k < contour->lines[i].n; k++) {
            double x, y;
            picture_point(plan, contour->lines[i].at[k], &x, &y);
            if (k == 0) cairo_move_to(cr, x, y);
            else cairo_line_to(cr, x, y);
        }
}

/* Is the ground under a line dark on the whole, within `part` of the page? Looks at the pixels painted so far. */
static bool picture_dark_ground(cairo_t *cr, const struct picture_plan *plan, const struct contour *contour,
                                struct picture_rect part)
{
    cairo_surface_t *image = cairo_get_target(cr);
    cairo_surface_flush(image);
    const unsigned char *bytes = cairo_image_surface_get_data(image);
    size_t stride = (size_t)cairo_image_surface_get_stride(image);
    double sum = 0.0, count = 0.0;
    for (size_t i = 0; i < contour->n_line; i++)
        for (size_t k = 0; k < contour->lines[i].n; k++) {
            double x, y;
            picture_point(plan, contour->lines[i].at[k], &x, &y);
            if (!(x > part.x && x < part.x + part.w && y > part.y && y < part.y + part.h)) continue;
            cairo_user_to_device(cr, &x, &y);
            const uint32_t *pixels = (const uint32_t *)(const void *)(bytes + (size_t)y * stride);
            sum += colormap_lightness(pixels[(size_t)x]);
            count += 1.0;
        }
    return sum < 45.0 * count;
}

static void picture_paint_lines(cairo_t *cr, const struct picture_plan *plan, struct picture_rect part)
{
    cairo_save(cr);
    cairo_rectangle(cr, part.x, part.y, part.w, part.h);
    cairo_clip(cr);
    for (unsigned i = 0; i < plan->scaled.n_lines; i++) {
        const struct contour *contour = plan->scaled.lines[i].contour;
        bool dark = picture_dark_ground(cr, plan, contour, part);
        picture_path(cr, plan, contour);
        picture_header_pen(cr, i, dark, true);
        cairo_stroke_preserve(cr);
        picture_header_pen(cr, i, dark, false);
        cairo_stroke(cr);
    }
    cairo_restore(cr);
}

/* Lines over one field, or over each half of two with their own ink; a rule separates the halves. */
static void picture_paint_all_lines(cairo_t *cr, const struct picture_plan *plan)
{
    struct picture_rect left = plan->box, right = plan->box;
    if (!plan->scaled.halves) {
        picture_paint_lines(cr, plan, plan->box);
        return;
    }
    double middle = plan->box.w * picture_scale_at(&plan->scaled.axis[0], 0.0);
    left.w = middle < 0.0 ? 0.0 : middle > plan->box.w ? plan->box.w : middle;
    right.x += left.w;
    right.w -= left.w;
    picture_paint_lines(cr, plan, left);
    picture_paint_lines(cr, plan, right);
    cairo_move_to(cr, right.x, right.y);
    cairo_rel_line_to(cr, 0.0, right.h);
    cairo_set_source_rgb(cr, 0.0, 0.0, 0.0);
    cairo_set_line_width(cr, 0.5);
    cairo_stroke(cr);
}

/* Lines around small tiles are thinner, so that the picture stays visible under many of them. */
static double picture_tile_width(double width, double height)
{
    double size = width < height ? width : height;
    return size > 12.0 ? 0.4 : size > 3.0 ? size / 30.0 : 0.1;
}

static void picture_paint_tiles(cairo_t *cr, const struct picture_plan *plan)
{
    cairo_save(cr);
    cairo_rectangle(cr, plan->box.x, plan->box.y, plan->box.w, plan->box.h);
    cairo_clip(cr);
    cairo_set_source_rgba(cr, 0.55, 0.55, 0.55, 0.8); /* seen on dark and on light */
    for (size_t i = 0; i < plan->scaled.n_tile; i++) {
        const struct raster_cell *tile = &plan->scaled.tiles[i];
        double x[2], y[2];
        for (int side = 0; side < 2; side++)
            picture_point(plan, (const double[2]){tile->at[0][side], tile->at[1][side]}, &x[side], &y[side]);
        cairo_rectangle(cr, x[0], y[1], x[1] - x[0], y[0] - y[1]);
        cairo_set_line_width(cr, picture_tile_width(x[1] - x[0], y[0] - y[1]));
        cairo_stroke(cr);
    }
    cairo_restore(cr);
}

static void picture_paint(cairo_t *cr, void *data, double scale)
{
    struct picture_plan *plan = data;
    picture_snap(&plan->box, scale);
    for (unsigned i = 0; i < plan->scaled.n_layer; i++) picture_paint_layer(cr, plan, &plan->scaled.layer[i], scale);
    picture_paint_tiles(cr, plan);
    picture_paint_all_lines(cr, plan);
    picture_axes_draw(cr, plan->box, &plan->scaled.axis[0], &plan->scaled.axis[1],
                      (struct picture_axes){.below = true});
    for (unsigned i = 0; i < plan->scaled.n_layer; i++) picture_axes_bar(cr, plan->bar_box[i], &plan->bar[i]);
    picture_header_draw(cr, &plan->header, plan->box.x, PICTURE_MARGIN);
}

static void picture_plan_page(cairo_t *cr, void *data, double ret_size[2])
{
    struct picture_plan *plan = data;
    picture_plan(cr, plan);
    ret_size[0] = plan->width;
    ret_size[1] = plan->height;
}

int picture_draw(const struct picture *picture, int width, cairo_surface_t **ret_image)
{
    struct picture_plan plan = {.scaled = *picture};
    return picture_canvas_draw(&(struct picture_canvas){picture_plan_page, picture_paint, &plan}, width, ret_image);
}
