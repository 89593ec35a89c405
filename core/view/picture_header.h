/* picture_header.h - the lines above a picture: title, time, legend of its lines. */
#ifndef PICTURE_HEADER_H
#define PICTURE_HEADER_H

#include "view/picture_text.h"

#include <cairo.h>

enum { PICTURE_HEADER_LINES = 16 };

struct picture_header {
    const char *title, *note; /* the note is the second line */
    const char *lines_label;  /* what the legend says before the names */
    unsigned n_lines;
    const char *lines[PICTURE_HEADER_LINES];
    double box_width; /* of the data box that the header stands above */
    double height;    /* of all lines and the gap below; set by picture_header_plan */
    double title_size;
    int n_title;
    char title_lines[PICTURE_TEXT_LINES][PICTURE_TEXT_LINE];
    bool legend_beside; /* the legend shares the line of the note */
};

/* Breaks the title to `width`, or shrinks it a little if that saves a line; returns by how much the picture must be
 * wider. */
double picture_header_plan(cairo_t *cr, struct picture_header *header, double width);

/* Draws with the upper left corner at (x, y). */
void picture_header_draw(cairo_t *cr, const struct picture_header *header, double x, double y);

/* The pen of line number `index`, dashed in its own way: black, or white on dark ground. `halo`: the wider,
 * faint band of the other colour that goes beneath. */
void picture_header_pen(cairo_t *cr, unsigned index, bool dark_ground, bool halo);

#endif
