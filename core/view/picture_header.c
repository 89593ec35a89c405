/* picture_header.c - see picture_header.h. Lines contrast with their ground and carry a faint halo: they read
 * on every colour map and in print; their dashes tell them apart. */
#include "view/picture_header.h"

static const struct picture_text picture_header_note = {9.5, false};

#define HEADER_TITLE 10.5 /* size, and the least size before a title is broken */
#define HEADER_TITLE_LEAST 9.0
#define HEADER_LINE 13.5 /* distance of lines */
#define HEADER_GAP 5.0   /* below the last line */
#define HEADER_LEAST 170.0
#define HEADER_SAMPLE 20.0
#define HEADER_AFTER 5.0 /* sample to name */
#define HEADER_NEXT 12.0 /* name to the next sample */

void picture_header_pen(cairo_t *cr, unsigned index, bool dark_ground, bool halo)
{
    static const double dashes[4][4] = {{0}, {4.0, 2.2}, {1.2, 1.8}, {6.0, 1.8, 1.2, 1.8}};
    static const int counts[4] = {0, 2, 2, 4};
    double ink = dark_ground == halo ? 0.0 : 1.0;
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_width(cr, halo ? 2.0 : 0.9);
    cairo_set_dash(cr, dashes[index % 4], counts[index % 4], 0.0);
    cairo_set_source_rgba(cr, ink, ink, ink, halo ? 0.5 : 1.0);
}

static double picture_header_legend_width(cairo_t *cr, const struct picture_header *header)
{
    if (!header->n_lines) return 0.0;
    double width = picture_text_width(cr, picture_header_note, header->lines_label) + HEADER_NEXT;
    for (unsigned i = 0; i < header->n_lines; i++)
        width += HEADER_SAMPLE + HEADER_AFTER + picture_text_width(cr, picture_header_note, header->lines[i]) +
                 (i ? HEADER_NEXT : 0.0);
    return width;
}

double picture_header_plan(cairo_t *cr, struct picture_header *header, double width)
{
    double note = picture_text_width(cr, picture_header_note, header->note),
           legend = picture_header_legend_width(cr, header);
    header->legend_beside = legend > 0.0 && note + 2 * HEADER_NEXT + legend <= header->box_width;
    double needs = legend > note ? legend : note;
    if (needs < HEADER_LEAST) needs = HEADER_LEAST;
    double spare = needs > width ? needs - width : 0.0;
    double natural = picture_text_width(cr, (struct picture_text){HEADER_TITLE, true}, header->title);
    double fitting = HEADER_TITLE * (width + spare) / natural * 0.999;
    header->title_size = fitting >= HEADER_TITLE_LEAST && fitting < HEADER_TITLE ? fitting : HEADER_TITLE;
    header->n_title = picture_text_wrap(cr, (struct picture_text){header->title_size, true}, header->title,
                                        width + spare, header->title_lines);
    int lines = header->n_title + (note > 0.0 || header->legend_beside) + (legend > 0.0 && !header->legend_beside);
    header->height = lines ? HEADER_LINE * lines + HEADER_GAP : 0.0;
    return spare;
}

static void picture_header_draw_legend(cairo_t *cr, const struct picture_header *header, double x, double baseline)
{
    picture_text_draw(cr, picture_header_note, (const double[2]){x, baseline}, 0.0, header->lines_label);
    x += picture_text_width(cr, picture_header_note, header->lines_label) + HEADER_NEXT;
    for (unsigned i = 0; i < header->n_lines; i++) {
        double y = baseline - 0.5 * PICTURE_TEXT_HEIGHT * picture_header_note.size;
        cairo_save(cr);
        picture_header_pen(cr, i, false, false);
        cairo_move_to(cr, x, y);
        cairo_rel_line_to(cr, HEADER_SAMPLE, 0.0);
        cairo_stroke(cr);
        cairo_restore(cr);
        x += HEADER_SAMPLE + HEADER_AFTER;
        picture_text_draw(cr, picture_header_note, (const double[2]){x, baseline}, 0.0, header->lines[i]);
        x += picture_text_width(cr, picture_header_note, header->lines[i]) + HEADER_NEXT;
    }
}

void picture_header_draw(cairo_t *cr, const struct picture_header *header, double x, double y)
{
    cairo_set_source_rgb(cr, 0.0, 0.0, 0.0);
    struct picture_text title = {header->title_size, true};
    double baseline = y + PICTURE_TEXT_HEIGHT * HEADER_TITLE;
    for (int i = 0; i < header->n_title; i++, baseline += HEADER_LINE)
        picture_text_draw(cr, title, (const double[2]){x, baseline}, 0.0, header->title_lines[i]);
    if (header->note[0]) {
        picture_text_draw(cr, picture_header_note, (const double[2]){x, baseline}, 0.0, header->note);
        if (!header->legend_beside) baseline += HEADER_LINE;
    }
    if (!header->n_lines) return;
    double legend = picture_header_legend_width(cr, header);
    picture_header_draw_legend(cr, header, header->legend_beside ? x + header->box_width - legend : x, baseline);
}
