/* chart.c - see chart.h. A line with far more points than pixels is drawn through the first, least, most
 * and last value of every pixel column: it looks the same and costs nothing. */
#include "view/chart.h"

#include "view/colormap.h"
#include "view/picture_axes.h"
#include "view/picture_canvas.h"
#include "view/picture_header.h"
#include "view/picture_text.h"

#include <math.h>

static const struct picture_text chart_names = {8.5, false};

#define CHART_MARGIN 9.0
#define CHART_WIDTH 340.0
#define CHART_BETWEEN 13.0 /* between panels */
#define CHART_LEGEND 13.0  /* line above a panel with several series */
#define CHART_SAMPLE 16.0
#define CHART_GAP 5.0      /* from a sample to its name */
#define CHART_APART 12.0   /* from a name to the next sample */
#define CHART_DOT_ROOM 2.2 /* least distance of points that get dots */
#define CHART_COLUMN 0.08  /* points closer than this share a column: a quarter of a pixel */

struct chart_plan {
    struct chart chart; /* with fitted scales */
    struct picture_header header;
    struct picture_rect box[CHART_PANELS];
    double room; /* of numbers and labels on the left: the same for all panels */
    double width, height;
};

void chart_range(const struct chart_series *series, const double x[2], double *lo, double *hi)
{
    for (size_t i = 0; i < series->n; i++) {
        double value = series->y[i];
        if (!isfinite(value) || series->x[i] < x[0] || series->x[i] > x[1]) continue;
        if (value < *lo) *lo = value;
        if (value > *hi) *hi = value;
    }
}

static double chart_panel_height(unsigned n_panel)
{
    return n_panel == 1 ? 220.0 : n_panel == 2 ? 150.0 : n_panel == 3 ? 120.0 : 95.0;
}

/* Series [first, return) whose names go into one line of the legend: as many as the box is wide, at least one. */
static unsigned chart_legend_end(cairo_t *cr, const struct chart_panel *panel, unsigned first)
{
    double width = 0.0;
    unsigned end = first;
    while (end < panel->n_series) {
        width += picture_text_width(cr, chart_names, panel->series[end].name) + CHART_SAMPLE + CHART_GAP;
        if (end > first && width + CHART_APART * (end - first) > CHART_WIDTH) break;
        end++;
    }
    return end;
}

static double chart_legend_height(cairo_t *cr, const struct chart_panel *panel)
{
    double height = 0.0;
    for (unsigned i = 0; panel->n_series > 1 && i < panel->n_series; i = chart_legend_end(cr, panel, i))
        height += CHART_LEGEND;
    return height;
}

static void chart_plan(cairo_t *cr, struct chart_plan *plan)
{
    const struct chart *chart = &plan->chart;
    double high = chart_panel_height(chart->n_panel);
    picture_axes_fit(cr, &plan->chart.x, CHART_WIDTH, false);
    for (unsigned p = 0; p < chart->n_panel; p++) {
        picture_axes_fit(cr, &plan->chart.panel[p].y, high, true);
        plan->room = fmax(plan->room, picture_axes_room(cr, &plan->chart.panel[p].y, true));
    }
    double left = CHART_MARGIN + plan->room;
    plan->header = (struct picture_header){.title = chart->title, .note = chart->note, .box_width = CHART_WIDTH};
    plan->width = left + CHART_WIDTH + 14.0 + CHART_MARGIN;
    plan->width += picture_header_plan(cr, &plan->header, CHART_WIDTH + 14.0);
    double y = CHART_MARGIN + plan->header.height;
    for (unsigned p = 0; p < chart->n_panel; p++) {
        y += chart_legend_height(cr, &chart->panel[p]);
        plan->box[p] = (struct picture_rect){left, y, CHART_WIDTH, high};
        y += high + CHART_BETWEEN;
    }
    plan->height = y - CHART_BETWEEN + picture_axes_room(cr, &plan->chart.x, false) + CHART_MARGIN;
}

static void chart_ink(cairo_t *cr, const struct chart_panel *panel, unsigned index)
{
    static const double dashes[2][4] = {{4.0, 2.4, 4.0, 2.4}, {4.0, 2.2, 0.6, 2.2}};
    bool reference = panel->series[index].reference;
    uint32_t rgb = reference ? 0 : colormap_line(index);
    cairo_set_dash(cr, dashes[index % 2], reference ? 4 : 0, 0.0);
    cairo_set_source_rgb(cr, (rgb >> 16 & 0xff) / 255.0, (rgb >> 8 & 0xff) / 255.0, (rgb & 0xff) / 255.0);
    cairo_set_line_width(cr, 1.1);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
}

struct chart_frame {
    struct picture_rect box;
    const struct picture_scale *x, *y;
};

static double chart_x(const struct chart_frame *frame, double value)
{
    return frame->box.x + frame->box.w * picture_scale_at(frame->x, value);
}

/* Kept within a page of the box: cairo's fixed-point numbers end at 2^23. */
static double chart_y(const struct chart_frame *frame, double value)
{
    double at = frame->y->log && !(value > 0.0) ? -1.0 : picture_scale_at(frame->y, value);
    at = at < -2.0 ? -2.0 : at > 3.0 ? 3.0 : at;
    return frame->box.y + frame->box.h * (1.0 - at);
}

static void chart_to(cairo_t *cr, const struct chart_frame *frame, const struct chart_series *series, size_t i)
{
    double x = chart_x(frame, series->x[i]), y = chart_y(frame, series->y[i]);
    if (cairo_has_current_point(cr)) cairo_line_to(cr, x, y);
    else cairo_move_to(cr, x, y);
}

/* Points [i, ...) in the same column, as wide as CHART_COLUMN: their first, least, most and last. Returns the next
 * i. */
static size_t chart_column(cairo_t *cr, const struct chart_frame *frame, const struct chart_series *series, size_t i)
{
    double x = chart_x(frame, series->x[i]);
    size_t least = i, most = i, end = i;
    for (; end < series->n && isfinite(series->y[end]) && fabs(chart_x(frame, series->x[end]) - x) <= CHART_COLUMN;
         end++) {
        if (series->y[end] < series->y[least]) least = end;
        if (series->y[end] > series->y[most]) most = end;
    }
    size_t lower = least < most ? least : most, upper = least < most ? most : least;
    chart_to(cr, frame, series, i);
    if (lower != i) chart_to(cr, frame, series, lower);
    if (upper != lower) chart_to(cr, frame, series, upper);
    if (end - 1 > upper) chart_to(cr, frame, series, end - 1);
    return end;
}

static void chart_dots(cairo_t *cr, const struct chart_frame *frame, const struct chart_series *series)
{
    double least = INFINITY;
    for (size_t i = 1; i < series->n; i++)
        least = fmin(least, fabs(chart_x(frame, series->x[i]) - chart_x(frame, series->x[i - 1])));
    if (least < CHART_DOT_ROOM && series->n > 1) return;
    for (size_t i = 0; i < series->n; i++) {
        if (!isfinite(series->y[i])) continue;
        cairo_arc(cr, chart_x(frame, series->x[i]), chart_y(frame, series->y[i]), fmin(1.4, 0.38 * least), 0.0,
                  2.0 * M_PI);
        cairo_fill(cr);
    }
}

static void chart_line(cairo_t *cr, const struct chart_frame *frame, const struct chart_series *series)
{
    cairo_new_path(cr);
    for (size_t i = 0; i < series->n;) {
        if (isfinite(series->y[i]) && isfinite(series->x[i])) {
            i = chart_column(cr, frame, series, i);
        } else {
            cairo_new_sub_path(cr);
            i++;
        }
    }
    cairo_stroke(cr);
    chart_dots(cr, frame, series);
}

/* Series [first, end) from the right end of the box to the left. */
static void chart_legend_line(cairo_t *cr, const struct chart_panel *panel, unsigned first, unsigned end, double right,
                              double baseline)
{
    double x = right;
    for (unsigned i = end; i-- > first;) {
        x -= picture_text_width(cr, chart_names, panel->series[i].name);
        cairo_set_source_rgb(cr, 0.0, 0.0, 0.0);
        picture_text_draw(cr, chart_names, (const double[2]){x, baseline}, 0.0, panel->series[i].name);
        x -= CHART_SAMPLE + CHART_GAP;
        chart_ink(cr, panel, i);
        cairo_move_to(cr, x, baseline - 0.5 * PICTURE_TEXT_HEIGHT * chart_names.size);
        cairo_rel_line_to(cr, CHART_SAMPLE, 0.0);
        cairo_stroke(cr);
        x -= CHART_APART;
    }
    cairo_set_dash(cr, NULL, 0, 0.0);
}

static void chart_legend(cairo_t *cr, const struct chart_panel *panel, struct picture_rect box)
{
    double baseline = box.y - chart_legend_height(cr, panel) + CHART_LEGEND - CHART_GAP;
    for (unsigned i = 0, end; panel->n_series > 1 && i < panel->n_series; i = end, baseline += CHART_LEGEND) {
        end = chart_legend_end(cr, panel, i);
        chart_legend_line(cr, panel, i, end, box.x + box.w, baseline);
    }
}

/* The zero line, where zero lies inside the range. */
static void chart_zero(cairo_t *cr, const struct chart_frame *frame)
{
    if (frame->y->log || frame->y->lo >= 0.0 || frame->y->hi <= 0.0) return;
    cairo_set_source_rgb(cr, 0.75, 0.75, 0.75);
    cairo_set_line_width(cr, 0.5);
    cairo_move_to(cr, frame->box.x, chart_y(frame, 0.0));
    cairo_rel_line_to(cr, frame->box.w, 0.0);
    cairo_stroke(cr);
}

static void chart_marks(cairo_t *cr, const struct chart_frame *frame, const struct chart *chart)
{
    cairo_set_source_rgb(cr, 0.55, 0.55, 0.55);
    cairo_set_line_width(cr, 0.6);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
    cairo_set_dash(cr, (const double[2]){1.2, 1.8}, 2, 0.0);
    for (size_t i = 0; i < chart->n_mark; i++) {
        cairo_move_to(cr, chart_x(frame, chart->marks[i]), frame->box.y);
        cairo_rel_line_to(cr, 0.0, frame->box.h);
    }
    cairo_stroke(cr);
    cairo_set_dash(cr, NULL, 0, 0.0);
}

static void chart_paint(cairo_t *cr, void *data, double scale)
{
    (void)scale;
    const struct chart_plan *plan = data;
    for (unsigned p = 0; p < plan->chart.n_panel; p++) {
        const struct chart_panel *panel = &plan->chart.panel[p];
        struct chart_frame frame = {plan->box[p], &plan->chart.x, &panel->y};
        cairo_save(cr);
        cairo_rectangle(cr, frame.box.x, frame.box.y, frame.box.w, frame.box.h);
        cairo_clip(cr);
        chart_zero(cr, &frame);
        chart_marks(cr, &frame, &plan->chart);
        for (unsigned i = 0; i < panel->n_series; i++) {
            chart_ink(cr, panel, i);
            chart_line(cr, &frame, &panel->series[i]);
        }
        cairo_restore(cr);
        chart_legend(cr, panel, frame.box);
        picture_axes_draw(cr, frame.box, frame.x, frame.y,
                          (struct picture_axes){p + 1 == plan->chart.n_panel, plan->room});
    }
    picture_header_draw(cr, &plan->header, plan->box[0].x, CHART_MARGIN);
}

static void chart_plan_page(cairo_t *cr, void *data, double ret_size[2])
{
    struct chart_plan *plan = data;
    chart_plan(cr, plan);
    ret_size[0] = plan->width;
    ret_size[1] = plan->height;
}

int chart_draw(const struct chart *chart, int width, cairo_surface_t **ret_image)
{
    struct chart_plan plan = {.chart = *chart};
    return picture_canvas_draw(&(struct picture_canvas){chart_plan_page, chart_paint, &plan}, width, ret_image);
}
