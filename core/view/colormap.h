/* colormap.h - numbers in [0, 1] to colours whose lightness says the same thing as the number.
 *
 * Every map is a short path through CIELAB (lightness, chroma, hue at a few equally spaced
 * points). Lightness is linear along the path, so equal steps of the value look equally large,
 * also in grey print and to colour-blind eyes; `balance` is linear on either side of its centre. */
#ifndef COLORMAP_H
#define COLORMAP_H

#include <stdint.h>

enum { COLORMAP_STEPS = 512 };

struct colormap {
    const char *name;
    uint32_t rgb[COLORMAP_STEPS]; /* 0xffRRGGBB, as cairo's ARGB32 stores opaque pixels */
};

/* Fills `ret_map` with the named map; an unknown name is STATUS_CASE with the names there are. */
int colormap_find(const char *name, struct colormap *ret_map);

/* The map that suits a field: grey for schlieren, diverging for signed ranges, else by quantity. */
const char *colormap_for_field(const char *field, double least, double most);

/* The colour of `value`; below 0 and above 1 the ends. NaN is transparent (0). */
uint32_t colormap_at(const struct colormap *map, double value);

/* Colour number `index` for lines: distinct hues of equal strength, in a fixed order. */
uint32_t colormap_line(unsigned index);

/* CIELAB (D65) to 0xffRRGGBB; colours outside of sRGB lose chroma until they fit. */
uint32_t colormap_lab(double lightness, double a, double b);

/* CIELAB lightness (0 black, 100 white) of 0xffRRGGBB. */
double colormap_lightness(uint32_t rgb);

#endif
