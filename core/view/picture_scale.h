/* picture_scale.h - from SI numbers to what a reader sees: prefixes, units, ticks at 1-2-5. */
#ifndef PICTURE_SCALE_H
#define PICTURE_SCALE_H

#include <stdbool.h>
#include <stddef.h>

enum { PICTURE_SCALE_TICKS = 32, PICTURE_SCALE_TEXT = 32, PICTURE_SCALE_LABEL = 160 };

struct picture_scale {
    double lo, hi; /* in SI, lo < hi */
    bool log;
    double factor;                    /* numbers shown are SI / factor */
    char label[PICTURE_SCALE_LABEL];  /* "pressure [MPa]" */
    unsigned n_tick;                  /* set by picture_scale_ticks */
    double tick[PICTURE_SCALE_TICKS]; /* in SI, ascending, within [lo, hi] */
    char text[PICTURE_SCALE_TICKS][PICTURE_SCALE_TEXT];
};

/* What a scale shows: a name (italic marks of picture_text.h are fine), an SI unit ("Pa", "kg/m3", "1", "")
 * and the range. An empty range is widened by a little, so that constant fields have a scale. */
struct picture_scale_inp {
    const char *name, *unit;
    double lo, hi;
    bool log;    /* lo must be > 0 */
    double like; /* choose the prefix for this magnitude; 0: for the larger end of the range */
};

void picture_scale_init(struct picture_scale *scale, const struct picture_scale_inp *inp);

/* Finds at most `most` (>= 2) ticks: steps of 1, 2 or 5 times a power of ten; in log scales decades, or 1-2-5. */
void picture_scale_ticks(struct picture_scale *scale, unsigned most);

/* Position of a value: 0 at lo, 1 at hi. */
double picture_scale_at(const struct picture_scale *scale, double value);

/* The prefixed unit for numbers around `magnitude`: factor to divide by, and its text ("MPa", "10⁶ 1/s", ""). */
void picture_scale_unit(const char *unit, double magnitude, double *ret_factor, char ret_text[PICTURE_SCALE_TEXT]);

/* "0.312 µs": `value` with three significant digits in the prefix that suits `like`. */
void picture_scale_quantity(double value, double like, const char *unit, char ret_text[PICTURE_SCALE_LABEL]);

#endif
