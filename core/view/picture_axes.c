/* picture_axes.c - see picture_axes.h. Ticks point outwards: they hide no data. */
#include "view/picture_axes.h"

#include "view/colormap.h"
#include "view/picture_text.h"

#include <math.h>

static const struct picture_text picture_axes_numbers = {8.5, false}, picture_axes_labels = {9.5, false};

#define AXES_LINE 0.7 /* stroke of frame and ticks */
#define AXES_TICK 3.5
#define AXES_PAD 2.5     /* tick to number */
#define AXES_GAP 5.5     /* numbers to label */
#define AXES_BETWEEN 9.0 /* least gap between numbers side by side */
#define AXES_ROW 26.0    /* least distance of ticks of an upright scale */
#define AXES_POINT 0.8   /* length of a bar's pointed end, in bar widths */

static double picture_axes_widest(cairo_t *cr, const struct picture_scale *scale)
{
    double widest = 0.0;
    for (unsigned i = 0; i < scale->n_tick; i++) {
        double width = picture_text_width(cr, picture_axes_numbers, scale->text[i]);
        if (width > widest) widest = width;
    }
    return widest;
}

void picture_axes_fit(cairo_t *cr, struct picture_scale *scale, double length, bool upright)
{
    unsigned most = (unsigned)(length / (upright ? AXES_ROW : 32.0)) + 1;
    for (most = most < 2 ? 2 : most > 8 ? 8 : most; most >= 2; most--) {
        picture_scale_ticks(scale, most);
        bool fits = true;
        for (unsigned i = 1; i < scale->n_tick; i++) {
            double step =
                length * (picture_scale_at(scale, scale->tick[i]) - picture_scale_at(scale, scale->tick[i - 1]));
            double needs = 0.5 * (picture_text_width(cr, picture_axes_numbers, scale->text[i - 1]) +
                                  picture_text_width(cr, picture_axes_numbers, scale->text[i])) +
                           AXES_BETWEEN;
            fits = fits && step >= (upright ? 1.6 * picture_axes_numbers.size : needs);
        }
        if (fits) return;
    }
}

double picture_axes_room(cairo_t *cr, const struct picture_scale *scale, bool upright)
{
    double room = AXES_TICK + AXES_PAD + AXES_GAP + picture_axes_labels.size;
    return room + (upright ? picture_axes_widest(cr, scale) : PICTURE_TEXT_HEIGHT * picture_axes_numbers.size);
}

static void picture_axes_segment(cairo_t *cr, double x, double y, double dx, double dy)
{
    cairo_move_to(cr, x, y);
    cairo_rel_line_to(cr, dx, dy);
}

/* Ticks and numbers of a scale that runs up at `x`, on its left (side -1) or right (+1). */
static void picture_axes_upright(cairo_t *cr, const struct picture_scale *scale, double x, struct picture_rect run,
                                 double side)
{
    for (unsigned i = 0; i < scale->n_tick; i++) {
        double y = run.y + run.h * (1.0 - picture_scale_at(scale, scale->tick[i]));
        double number[2] = {x + side * (AXES_TICK + AXES_PAD),
                            y + 0.5 * PICTURE_TEXT_HEIGHT * picture_axes_numbers.size};
        picture_axes_segment(cr, x, y, side * AXES_TICK, 0.0);
        cairo_stroke(cr);
        picture_text_draw(cr, picture_axes_numbers, number, side < 0.0 ? 1.0 : 0.0, scale->text[i]);
    }
}

/* Ticks and numbers of a scale that runs along the lower edge of `run`. */
static void picture_axes_level(cairo_t *cr, const struct picture_scale *scale, struct picture_rect run, bool numbers)
{
    for (unsigned i = 0; i < scale->n_tick; i++) {
        double x = run.x + run.w * picture_scale_at(scale, scale->tick[i]), y = run.y + run.h;
        double number[2] = {x, y + AXES_TICK + AXES_PAD + PICTURE_TEXT_HEIGHT * picture_axes_numbers.size};
        picture_axes_segment(cr, x, y, 0.0, AXES_TICK);
        cairo_stroke(cr);
        if (numbers) picture_text_draw(cr, picture_axes_numbers, number, 0.5, scale->text[i]);
    }
}

/* Labels longer than what they stand beside are set smaller. */
static struct picture_text picture_axes_label_font(cairo_t *cr, const char *label, double length)
{
    struct picture_text font = picture_axes_labels;
    double natural = picture_text_width(cr, font, label);
    if (natural > length) font.size *= length / natural > 0.7 ? length / natural : 0.7;
    return font;
}

static void picture_axes_label_below(cairo_t *cr, const struct picture_scale *scale, struct picture_rect run)
{
    double down =
        AXES_TICK + AXES_PAD + AXES_GAP + PICTURE_TEXT_HEIGHT * (picture_axes_numbers.size + picture_axes_labels.size);
    double at[2] = {run.x + 0.5 * run.w, run.y + run.h + down};
    picture_text_draw(cr, picture_axes_label_font(cr, scale->label, run.w), at, 0.5, scale->label);
}

static void picture_axes_pen(cairo_t *cr)
{
    cairo_set_source_rgb(cr, 0.0, 0.0, 0.0);
    cairo_set_line_width(cr, AXES_LINE);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_MITER);
}

void picture_axes_draw(cairo_t *cr, struct picture_rect box, const struct picture_scale *x,
                       const struct picture_scale *y, struct picture_axes axes)
{
    picture_axes_pen(cr);
    cairo_rectangle(cr, box.x - 0.5 * AXES_LINE, box.y - 0.5 * AXES_LINE, box.w + AXES_LINE, box.h + AXES_LINE);
    cairo_stroke(cr);
    picture_axes_upright(cr, y, box.x, box, -1.0);
    picture_axes_level(cr, x, box, axes.below);
    if (axes.below) picture_axes_label_below(cr, x, box);
    double out = (axes.room > 0.0 ? axes.room : picture_axes_room(cr, y, true)) - picture_axes_labels.size;
    picture_text_draw_up(cr, picture_axes_label_font(cr, y->label, box.h + 12.0),
                         (const double[2]){box.x - out, box.y + 0.5 * box.h}, y->label);
}

/* The body of a bar without its pointed ends. */
static struct picture_rect picture_axes_bar_body(struct picture_rect box, const struct picture_bar *bar)
{
    double point = AXES_POINT * (bar->upright ? box.w : box.h);
    double low = bar->goes_below ? point : 0.0, high = bar->goes_above ? point : 0.0;
    if (bar->upright) return (struct picture_rect){box.x, box.y + high, box.w, box.h - low - high};
    return (struct picture_rect){box.x + low, box.y, box.w - low - high, box.h};
}

static void picture_axes_bar_outline(cairo_t *cr, struct picture_rect box, struct picture_rect body, bool upright)
{
    double right = box.x + box.w, bottom = box.y + box.h, middle_x = box.x + 0.5 * box.w,
           middle_y = box.y + 0.5 * box.h;
    double body_right = body.x + body.w, body_bottom = body.y + body.h;
    cairo_move_to(cr, body.x, body.y);
    if (upright && body.y > box.y) cairo_line_to(cr, middle_x, box.y);
    cairo_line_to(cr, body_right, body.y);
    if (!upright && body_right < right) cairo_line_to(cr, right, middle_y);
    cairo_line_to(cr, body_right, body_bottom);
    if (upright && body_bottom < bottom) cairo_line_to(cr, middle_x, bottom);
    cairo_line_to(cr, body.x, body_bottom);
    if (!upright && body.x > box.x) cairo_line_to(cr, box.x, middle_y);
    cairo_close_path(cr);
}

static cairo_pattern_t *picture_axes_bar_colours(struct picture_rect body, const struct picture_bar *bar)
{
    double bottom = body.y + body.h;
    cairo_pattern_t *colours = bar->upright ? cairo_pattern_create_linear(0.0, bottom, 0.0, body.y)
                                            : cairo_pattern_create_linear(body.x, 0.0, body.x + body.w, 0.0);
    enum { STOPS = 128 };
    for (int k = 0; k <= STOPS; k++) {
        double at = k / (double)STOPS;
        uint32_t rgb = colormap_at(bar->map, at);
        cairo_pattern_add_color_stop_rgb(colours, at, (rgb >> 16 & 0xff) / 255.0, (rgb >> 8 & 0xff) / 255.0,
                                         (rgb & 0xff) / 255.0);
    }
    return colours;
}

double picture_axes_bar_room(cairo_t *cr, const struct picture_bar *bar)
{
    return picture_axes_room(cr, bar->scale, bar->upright);
}

void picture_axes_bar(cairo_t *cr, struct picture_rect box, const struct picture_bar *bar)
{
    struct picture_rect body = picture_axes_bar_body(box, bar);
    cairo_pattern_t *colours = picture_axes_bar_colours(body, bar);
    picture_axes_bar_outline(cr, box, body, bar->upright);
    cairo_set_source(cr, colours);
    cairo_fill_preserve(cr);
    cairo_pattern_destroy(colours);
    picture_axes_pen(cr);
    cairo_stroke(cr);
    if (!bar->upright) {
        picture_axes_level(cr, bar->scale, body, true);
        picture_axes_label_below(cr, bar->scale, box);
        return;
    }
    double x = box.x + box.w;
    picture_axes_upright(cr, bar->scale, x, body, 1.0);
    double out = AXES_TICK + AXES_PAD + picture_axes_widest(cr, bar->scale) + AXES_GAP +
                 PICTURE_TEXT_HEIGHT * picture_axes_labels.size;
    picture_text_draw_up(cr, picture_axes_label_font(cr, bar->scale->label, box.h + 12.0),
                         (const double[2]){x + out, box.y + 0.5 * box.h}, bar->scale->label);
}
