/* picture_text.h - words on a cairo surface: one font, italic symbols, real widths.
 *
 * Between the marks PICTURE_ITALIC and PICTURE_UPRIGHT text is slanted, as symbols in print:
 * PICTURE_ITALIC "t" PICTURE_UPRIGHT " = 0.3 µs". Sizes are in the units of the surface. */
#ifndef PICTURE_TEXT_H
#define PICTURE_TEXT_H

#include <cairo.h>
#include <stdbool.h>

#define PICTURE_ITALIC "\x0e"
#define PICTURE_UPRIGHT "\x0f"
#define PICTURE_TEXT_HEIGHT 0.73 /* of capitals and digits, in sizes */

enum { PICTURE_TEXT_LINES = 3, PICTURE_TEXT_LINE = 256 };

struct picture_text {
    double size;
    bool bold;
};

double picture_text_width(cairo_t *cr, struct picture_text font, const char *text);

/* Baseline at `y`; `align` of the width lies left of x (0 starts at x, 0.5 centred, 1 ends at x). */
void picture_text_draw(cairo_t *cr, struct picture_text font, const double at[2], double align, const char *text);

/* The same, turned to read upwards; `at` is the middle of the baseline. */
void picture_text_draw_up(cairo_t *cr, struct picture_text font, const double at[2], const char *text);

/* Breaks a text at spaces into lines no wider than `width`; what does not fit ends in "…".
 * Returns the number of lines. */
int picture_text_wrap(cairo_t *cr, struct picture_text font, const char *text, double width,
                      char ret_lines[PICTURE_TEXT_LINES][PICTURE_TEXT_LINE]);

#endif
