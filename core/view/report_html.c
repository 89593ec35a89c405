/* report_html.c - see report_html.h. The page needs no network, no script and no other file; it
 * fits the screen of a phone: only tables and the case file scroll sidewards, within their own boxes. */
#include "view/report_html.h"

#include "base/status.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

static const char report_html_style[] =
    ":root{color-scheme:light}"
    "body{font:16px/1.5 'DejaVu Sans',system-ui,sans-serif;color:#1a1a1a;background:#fff;max-width:1080px;"
    "margin:2.5rem auto;padding:0 1.5rem;overflow-wrap:anywhere}"
    "h1{font-size:1.7rem;line-height:1.25;margin:0 0 .3rem}"
    "h2{font-size:1.15rem;margin:2.6rem 0 .8rem;padding-bottom:.3rem;border-bottom:1px solid #ccc}"
    ".about{max-width:46rem;white-space:pre-line}.cite{color:#666;font-size:.85rem}"
    "table{border-collapse:collapse;font-size:.9rem}td,th{text-align:left;padding:.25rem 1.4rem .25rem 0;"
    "border-bottom:1px solid #e6e6e6;font-variant-numeric:tabular-nums;vertical-align:top}th{font-weight:600}"
    ".facts{columns:2;column-gap:3rem}.facts div{display:flex;justify-content:space-between;gap:1rem;"
    "border-bottom:1px solid #e6e6e6;padding:.2rem 0;font-size:.9rem;break-inside:avoid}"
    ".facts span{color:#555;min-width:0}.facts b{font-weight:400;text-align:right;flex:none;max-width:60%}"
    "small{display:block;color:#666;font-size:.8em;line-height:1.35}.note,figcaption{color:#555;font-size:.85rem}"
    ".wide{overflow-x:auto;min-width:0}"
    ".numbers td,.numbers th{padding-right:1rem;white-space:nowrap}"
    ".pass{color:#17692f}.fail{color:#a3151b;font-weight:600}"
    ".figures{display:grid;grid-template-columns:minmax(0,1fr) minmax(0,1fr);gap:1.2rem;align-items:start}"
    ".steps{position:relative;max-width:800px}.steps input{position:absolute;opacity:0}.step{display:none}"
    "input:checked+.step{display:block}input:focus-visible+.step .turn{outline:2px solid #1a5fb4}"
    ".turn{display:flex;justify-content:space-between;align-items:center;gap:.5rem;margin:.4rem 0}"
    ".turn b{font-weight:400}"
    ".turn label,.turn span{border:1px solid #999;border-radius:4px;padding:.45rem .8rem}.turn label{cursor:pointer}"
    ".turn span{color:#aaa;border-color:#ddd}"
    "@media(max-width:820px){body{margin:1rem auto;padding:0 .9rem}.figures{grid-template-columns:minmax(0,1fr)}"
    ".facts{columns:1}}@media print{.step{display:block}.turn label,.turn span{display:none}}"
    "figure{margin:0}img{width:100%;height:auto;display:block}"
    "pre{font:.8rem/1.45 'DejaVu Sans Mono',monospace;background:#f6f6f6;padding:1rem;overflow-x:auto}"
    "summary{cursor:pointer}";

void report_html_begin(struct text *page, const char *title)
{
    text_add(page, "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                   "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>");
    report_html_text(page, title);
    text_add(page, "</title>\n<style>%s</style>\n</head>\n<body>\n", report_html_style);
}

void report_html_end(struct text *page)
{
    text_add(page, "</body>\n</html>\n");
}

void report_html_text(struct text *page, const char *words)
{
    while (*words) {
        size_t plain = strcspn(words, "<>&\"");
        text_add_n(page, words, plain);
        words += plain;
        if (*words == '<') text_add(page, "&lt;");
        if (*words == '>') text_add(page, "&gt;");
        if (*words == '&') text_add(page, "&amp;");
        if (*words == '"') text_add(page, "&quot;");
        words += *words != '\0';
    }
}

static cairo_status_t report_html_collect(void *closure, const unsigned char *bytes, unsigned length)
{
    text_add_n(closure, (const char *)bytes, length);
    return CAIRO_STATUS_SUCCESS;
}

static void report_html_base64(struct text *page, const unsigned char *bytes, size_t length)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < length; i += 3) {
        uint32_t three = (uint32_t)bytes[i] << 16;
        if (i + 1 < length) three |= (uint32_t)bytes[i + 1] << 8;
        if (i + 2 < length) three |= bytes[i + 2];
        char four[4] = {digits[three >> 18], digits[three >> 12 & 63], i + 1 < length ? digits[three >> 6 & 63] : '=',
                        i + 2 < length ? digits[three & 63] : '='};
        text_add_n(page, four, sizeof four);
    }
}

int report_html_figure(struct text *page, cairo_surface_t *image, const char *what, const char *caption)
{
    struct text png = {0};
    cairo_status_t status = cairo_surface_write_to_png_stream(image, report_html_collect, &png);
    if (status == CAIRO_STATUS_SUCCESS) {
        text_add(page, "<figure><img alt=\"");
        report_html_text(page, what);
        text_add(page, "\" src=\"data:image/png;base64,");
        report_html_base64(page, (const unsigned char *)png.at, png.length);
        text_add(page, "\"><figcaption>");
        report_html_text(page, caption);
        text_add(page, "</figcaption></figure>\n");
    }
    text_done(&png);
    if (status == CAIRO_STATUS_SUCCESS) return STATUS_OK;
    return status_fail(STATUS_RUN, "cannot encode a picture: %s", cairo_status_to_string(status));
}

const char *report_html_unit(const char *unit, char ret_words[PICTURE_SCALE_TEXT])
{
    double factor;
    picture_scale_unit(unit, 1.0, &factor, ret_words);
    if (!*unit) snprintf(ret_words, PICTURE_SCALE_TEXT, "unit not known");
    else if (strcmp(unit, "1") == 0) snprintf(ret_words, PICTURE_SCALE_TEXT, "pure number");
    return ret_words;
}
