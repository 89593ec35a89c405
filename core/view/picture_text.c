/* picture_text.c - see picture_text.h. Metrics are not hinted: a picture at twice the width has
 * the same layout. */
#include "view/picture_text.h"

#include <stdio.h>
#include <string.h>

static void picture_text_font(cairo_t *cr, struct picture_text font, bool italic)
{
    cairo_font_options_t *options = cairo_font_options_create();
    cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(cr, options);
    cairo_font_options_destroy(options);
    cairo_select_font_face(cr, "DejaVu Sans", italic ? CAIRO_FONT_SLANT_OBLIQUE : CAIRO_FONT_SLANT_NORMAL,
                           font.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, font.size);
}

/* Walks the pieces between marks from (x, y); draws them if `draw`. Returns the width. */
static double picture_text_walk(cairo_t *cr, struct picture_text font, const double at[2], const char *text, bool draw)
{
    double width = 0.0;
    bool italic = false;
    while (*text) {
        size_t length = strcspn(text, PICTURE_ITALIC PICTURE_UPRIGHT);
        char piece[PICTURE_TEXT_LINE];
        snprintf(piece, sizeof piece, "%.*s", (int)length, text);
        cairo_text_extents_t extents;
        picture_text_font(cr, font, italic);
        cairo_text_extents(cr, piece, &extents);
        if (draw) {
            cairo_move_to(cr, at[0] + width, at[1]);
            cairo_show_text(cr, piece);
        }
        width += extents.x_advance;
        text += length;
        if (*text) italic = *text++ == PICTURE_ITALIC[0];
    }
    return width;
}

double picture_text_width(cairo_t *cr, struct picture_text font, const char *text)
{
    return picture_text_walk(cr, font, (const double[2]){0.0, 0.0}, text, false);
}

void picture_text_draw(cairo_t *cr, struct picture_text font, const double at[2], double align, const char *text)
{
    double from[2] = {at[0] - align * picture_text_width(cr, font, text), at[1]};
    picture_text_walk(cr, font, from, text, true);
}

void picture_text_draw_up(cairo_t *cr, struct picture_text font, const double at[2], const char *text)
{
    cairo_save(cr);
    cairo_translate(cr, at[0], at[1]);
    cairo_rotate(cr, -1.5707963267948966);
    picture_text_draw(cr, font, (const double[2]){0.0, 0.0}, 0.5, text);
    cairo_restore(cr);
}

/* Shortens a line, by whole UTF-8 characters, until it and "…" fit. */
static void picture_text_cut(cairo_t *cr, struct picture_text font, double width, char line[PICTURE_TEXT_LINE])
{
    size_t length = strlen(line);
    do {
        while (length > 0 && ((unsigned char)line[length - 1] & 0xc0) == 0x80) length--;
        if (length > 0) length--;
        if (length > PICTURE_TEXT_LINE - 4) continue;
        snprintf(line + length, PICTURE_TEXT_LINE - length, "…");
    } while (length > 0 && picture_text_width(cr, font, line) > width);
}

int picture_text_wrap(cairo_t *cr, struct picture_text font, const char *text, double width,
                      char ret_lines[PICTURE_TEXT_LINES][PICTURE_TEXT_LINE])
{
    int count = 0;
    text += strspn(text, " \n\t");
    while (*text && count < PICTURE_TEXT_LINES) {
        char *line = ret_lines[count++];
        size_t taken = 0;
        for (size_t end = 0; text[end] && end < PICTURE_TEXT_LINE - 8;) { /* word by word */
            end += strspn(text + end, " \n\t");
            end += strcspn(text + end, " \n\t");
            char trial[PICTURE_TEXT_LINE];
            snprintf(trial, sizeof trial, "%.*s", (int)end, text);
            if (taken && picture_text_width(cr, font, trial) > width) break;
            taken = end;
        }
        snprintf(line, PICTURE_TEXT_LINE, "%.*s", (int)taken, text);
        text += taken;
        text += strspn(text, " \n\t");
        if ((*text && count == PICTURE_TEXT_LINES) || picture_text_width(cr, font, line) > width)
            picture_text_cut(cr, font, width, line);
    }
    return count;
}
