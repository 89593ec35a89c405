/* colormap.c - colour maps from a handful of CIELAB points.
 *
 * Between the points lightness is interpolated linearly and (a, b) by a Catmull-Rom spline, so
 * the paths have no kinks that could pass for features of the flow. Conversions: CIE 15
 * (L*a*b*, D65 white) and IEC 61966-2-1 (sRGB). */
#include "view/colormap.h"

#include "base/status.h"
#include "base/text.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

enum { COLORMAP_POINTS = 7 };

struct colormap_point {
    double lightness, chroma, hue; /* hue in degrees */
};

struct colormap_path {
    const char *name;
    unsigned count;
    struct colormap_point point[COLORMAP_POINTS];
};

static const struct colormap_path colormap_paths[] = {
    {"lagoon", 5, {{12, 32, 305}, {32, 48, 284}, {52, 36, 225}, {72, 52, 155}, {92, 80, 102}}},
    {"ember", 5, {{8, 22, 295}, {29.5, 58, 325}, {51, 68, 385}, {72.5, 72, 425}, {94, 48, 462}}},
    {"frost", 4, {{18, 38, 282}, {43, 42, 262}, {68, 28, 238}, {96, 4, 215}}},
    {"balance",
     7,
     {{24, 42, 278}, {48, 46, 268}, {72, 26, 255}, {96, 0, 250}, {72, 38, 45}, {48, 62, 35}, {24, 46, 30}}},
    {"grey", 2, {{0, 0, 0}, {100, 0, 0}}},
};

enum { COLORMAP_COUNT = sizeof colormap_paths / sizeof *colormap_paths };

static double colormap_uncompress(double f)
{
    return f > 6.0 / 29.0 ? f * f * f : 3.0 * (6.0 / 29.0) * (6.0 / 29.0) * (f - 4.0 / 29.0);
}

static double colormap_gamma(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

static bool colormap_try_lab(double lightness, double a, double b, double ret_rgb[3])
{
    double fy = (lightness + 16.0) / 116.0;
    double x = 0.95047 * colormap_uncompress(fy + a / 500.0);
    double y = colormap_uncompress(fy);
    double z = 1.08883 * colormap_uncompress(fy - b / 200.0);
    double linear[3] = {3.2406 * x - 1.5372 * y - 0.4986 * z, -0.9689 * x + 1.8758 * y + 0.0415 * z,
                        0.0557 * x - 0.2040 * y + 1.0570 * z};
    bool fits = true;
    for (int c = 0; c < 3; c++) {
        ret_rgb[c] = colormap_gamma(linear[c]);
        fits = fits && ret_rgb[c] > -0.002 && ret_rgb[c] < 1.002;
    }
    return fits;
}

uint32_t colormap_lab(double lightness, double a, double b)
{
    double rgb[3], keep = 1.0;
    if (!colormap_try_lab(lightness, a, b, rgb)) {
        double fits = 0.0;
        for (int step = 0; step < 20; step++) { /* the largest chroma that fits, by bisection */
            double middle = 0.5 * (fits + keep);
            if (colormap_try_lab(lightness, middle * a, middle * b, rgb)) fits = middle;
            else keep = middle;
        }
        colormap_try_lab(lightness, fits * a, fits * b, rgb);
    }
    uint32_t packed = 0xff;
    for (int c = 0; c < 3; c++) {
        double level = rgb[c] < 0.0 ? 0.0 : rgb[c] > 1.0 ? 1.0 : rgb[c];
        packed = packed << 8 | (uint32_t)lround(255.0 * level);
    }
    return packed;
}

double colormap_lightness(uint32_t rgb)
{
    static const double weight[3] = {0.0722, 0.7152, 0.2126};
    double y = 0.0;
    for (int c = 0; c < 3; c++) {
        double level = (double)(rgb >> (8 * c) & 0xff) / 255.0;
        y += weight[c] * (level <= 0.04045 ? level / 12.92 : pow((level + 0.055) / 1.055, 2.4));
    }
    return y > 216.0 / 24389.0 ? 116.0 * cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

static double colormap_spline(const double p[4], double s)
{
    return p[1] +
           0.5 * s *
               (p[2] - p[0] + s * (2 * p[0] - 5 * p[1] + 4 * p[2] - p[3] + s * (3 * (p[1] - p[2]) + p[3] - p[0])));
}

static uint32_t colormap_on_path(const struct colormap_path *path, double value)
{
    unsigned last = path->count - 1;
    double at = value * last;
    unsigned i = at >= last ? last - 1 : (unsigned)at;
    double s = at - i, a[4], b[4];
    for (unsigned k = 0; k < 4; k++) {
        unsigned from = i + k == 0 ? 0 : i + k - 1 > last ? last : i + k - 1;
        const struct colormap_point *point = &path->point[from];
        a[k] = point->chroma * cos(point->hue * M_PI / 180.0);
        b[k] = point->chroma * sin(point->hue * M_PI / 180.0);
    }
    double lightness = (1.0 - s) * path->point[i].lightness + s * path->point[i + 1].lightness;
    return colormap_lab(lightness, colormap_spline(a, s), colormap_spline(b, s));
}

int colormap_find(const char *name, struct colormap *ret_map)
{
    const char *names[COLORMAP_COUNT + 1] = {0};
    for (unsigned i = 0; i < COLORMAP_COUNT; i++) {
        names[i] = colormap_paths[i].name;
        if (strcmp(name, names[i]) != 0) continue;
        ret_map->name = names[i];
        for (unsigned k = 0; k < COLORMAP_STEPS; k++)
            ret_map->rgb[k] = colormap_on_path(&colormap_paths[i], k / (COLORMAP_STEPS - 1.0));
        return STATUS_OK;
    }
    const char *near = text_nearest(name, names);
    return status_fail(STATUS_CASE, "no colour map '%s'%s%s%s; there are: lagoon, ember, frost, balance, grey", name,
                       near ? " (did you mean '" : "", near ? near : "", near ? "'?)" : "");
}

const char *colormap_for_field(const char *field, double least, double most)
{
    if (strcmp(field, "schlieren") == 0) return "grey";
    if (least < 0.0 && most > 0.0 && least > -100.0 * most && most < -100.0 * least) return "balance";
    if (strncmp(field, "temperature", 11) == 0) return "ember";
    if (strncmp(field, "alpha_", 6) == 0) return "frost";
    return "lagoon";
}

uint32_t colormap_at(const struct colormap *map, double value)
{
    if (isnan(value)) return 0;
    double at = value * (COLORMAP_STEPS - 1) + 0.5;
    return map->rgb[at < 0.0 ? 0 : at >= COLORMAP_STEPS ? COLORMAP_STEPS - 1 : (unsigned)at];
}

uint32_t colormap_line(unsigned index)
{
    static const struct colormap_point strong[] = {{42, 52, 272}, {52, 66, 48}, {50, 44, 160},
                                                   {48, 58, 345}, {64, 62, 80}, {36, 36, 320},
                                                   {60, 34, 225}, {30, 0, 0},   {76, 40, 30}};
    const struct colormap_point *point = &strong[index % (sizeof strong / sizeof *strong)];
    double angle = point->hue * M_PI / 180.0;
    return colormap_lab(point->lightness, point->chroma * cos(angle), point->chroma * sin(angle));
}
