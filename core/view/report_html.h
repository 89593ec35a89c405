/* report_html.h - pieces of a page: escaped text, embedded pictures, the frame around all. */
#ifndef REPORT_HTML_H
#define REPORT_HTML_H

#include "base/text.h"
#include "view/picture_scale.h"

#include <cairo.h>

/* Opening of the page with its style sheet, up to the first section; and its end. */
void report_html_begin(struct text *page, const char *title);
void report_html_end(struct text *page);

/* Text with <, >, &, " escaped. */
void report_html_text(struct text *page, const char *words);

/* <figure> with the picture as base64 PNG; `what` is for those who cannot see it, `caption` goes below. STATUS_RUN if
 * cairo cannot encode it. */
int report_html_figure(struct text *page, cairo_surface_t *image, const char *what, const char *caption);

/* An SI unit as a page shows it, in the buffer, which is returned: "kg/m³"; "pure number" for 1, "unit not known" for
 * "". */
const char *report_html_unit(const char *unit, char ret_words[PICTURE_SCALE_TEXT]);

#endif
