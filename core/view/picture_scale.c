/* picture_scale.c - see picture_scale.h.
 *
 * Units take an SI prefix where custom has one (m, s, Pa, J, N, W, Hz and what begins with them, as
 * J/m3); others (kg/m3, K, 1/s, m2) get a power of ten once numbers become unwieldy. */
#include "view/picture_scale.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const picture_scale_superscript[10] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

/* Appends to a fixed buffer; too long texts are cut. */
static void picture_scale_add(char *text, size_t size, const char *more)
{
    size_t length = strlen(text);
    snprintf(text + length, size - length, "%s", more);
}

static void picture_scale_add_power(char *text, size_t size, int power)
{
    char digits[16];
    snprintf(digits, sizeof digits, "%d", power);
    picture_scale_add(text, size, "10");
    for (const char *d = digits; *d; d++)
        picture_scale_add(text, size, *d == '-' ? "⁻" : picture_scale_superscript[*d - '0']);
}

/* "kg/m3" as "kg/m³". */
static void picture_scale_add_unit(char *text, size_t size, const char *unit)
{
    if (strcmp(unit, "1") == 0) return;
    for (const char *u = unit; *u; u++) {
        char one[2] = {*u, 0};
        bool power = u > unit && *u >= '0' && *u <= '9' && u[-1] != '/';
        if (*u == '^') continue;
        picture_scale_add(text, size, power ? picture_scale_superscript[*u - '0'] : one);
    }
}

static bool picture_scale_takes_prefix(const char *unit)
{
    static const char *const bases[] = {"m", "s", "Pa", "J", "N", "W", "Hz"};
    for (size_t i = 0; i < sizeof bases / sizeof *bases; i++) {
        size_t length = strlen(bases[i]);
        if (strncmp(unit, bases[i], length) != 0) continue;
        if (unit[length] == '\0' || unit[length] == '/' || unit[length] == '.') return true;
    }
    return false;
}

void picture_scale_unit(const char *unit, double magnitude, double *ret_factor, char ret_text[PICTURE_SCALE_TEXT])
{
    static const char *const prefixes[] = {"f", "p", "n", "µ", "m", "", "k", "M", "G", "T"};
    bool prefix = picture_scale_takes_prefix(unit);
    double size = fabs(magnitude) * (1.0 + 1e-9);
    int third = size > 0.0 && isfinite(size) ? (int)floor(log10(size) / 3.0) : 0;
    bool speed = strncmp(unit, "m/s", 3) == 0; /* nobody says 1.5 km/s for sound in water */
    if (speed && size >= 0.1 && size < 1e4) third = 0;
    if (!prefix && size >= 1e-2 && size < 1e5) third = 0;
    if (prefix && third < -5) third = -5;
    if (prefix && third > 4) third = 4;
    *ret_factor = pow(10.0, 3 * third);
    ret_text[0] = '\0';
    if (prefix) {
        picture_scale_add(ret_text, PICTURE_SCALE_TEXT, prefixes[third + 5]);
    } else if (third) {
        picture_scale_add_power(ret_text, PICTURE_SCALE_TEXT, 3 * third);
        if (*unit && strcmp(unit, "1") != 0) picture_scale_add(ret_text, PICTURE_SCALE_TEXT, " ");
    }
    picture_scale_add_unit(ret_text, PICTURE_SCALE_TEXT, unit);
}

/* A number with a real minus sign. */
static void picture_scale_number(double value, int decimals, char *ret_text, size_t size)
{
    char digits[PICTURE_SCALE_TEXT];
    snprintf(digits, sizeof digits, "%.*f", decimals, fabs(value));
    bool zero = strspn(digits, "0.") == strlen(digits);
    snprintf(ret_text, size, "%s%.24s", value < 0.0 && !zero ? "−" : "", digits);
}

void picture_scale_quantity(double value, double like, const char *unit, char ret_text[PICTURE_SCALE_LABEL])
{
    double factor;
    char name[PICTURE_SCALE_TEXT];
    picture_scale_unit(unit, like, &factor, name);
    double shown = value / factor;
    int whole = shown != 0.0 ? (int)floor(log10(fabs(shown))) + 1 : 1;
    picture_scale_number(shown,
                         shown == 0.0 || whole >= 3 ? 0
                         : whole < 0                ? 4
                                                    : 3 - whole,
                         ret_text, PICTURE_SCALE_LABEL);
    if (*name) picture_scale_add(ret_text, PICTURE_SCALE_LABEL, " ");
    picture_scale_add(ret_text, PICTURE_SCALE_LABEL, name);
}

void picture_scale_init(struct picture_scale *scale, const struct picture_scale_inp *inp)
{
    *scale = (struct picture_scale){.lo = inp->lo, .hi = inp->hi, .log = inp->log};
    double size = fabs(inp->lo) > fabs(inp->hi) ? fabs(inp->lo) : fabs(inp->hi);
    if (inp->hi - inp->lo <= 1e-5 * size || inp->hi <= inp->lo) { /* constant, to what float32 files can tell */
        double half = size > 0.0 ? 1e-3 * size : 1.0;
        scale->lo = 0.5 * (inp->lo + inp->hi) - half;
        scale->hi = 0.5 * (inp->lo + inp->hi) + half;
    }
    char unit[PICTURE_SCALE_TEXT];
    picture_scale_unit(inp->unit, inp->like > 0.0 ? inp->like : size, &scale->factor, unit);
    if (inp->log && inp->hi >= 1e3 * inp->lo) { /* labelled with powers of ten: no prefix */
        scale->factor = 1.0;
        unit[0] = '\0';
        picture_scale_add_unit(unit, sizeof unit, inp->unit);
    }
    snprintf(scale->label, sizeof scale->label, *unit ? "%s [%s]" : "%s%s", inp->name, unit);
}

static void picture_scale_put(struct picture_scale *scale, double value, const char *text)
{
    if (scale->n_tick == PICTURE_SCALE_TICKS) return;
    scale->tick[scale->n_tick] = value;
    snprintf(scale->text[scale->n_tick++], PICTURE_SCALE_TEXT, "%s", text);
}

static void picture_scale_linear(struct picture_scale *scale, unsigned most)
{
    double lo = scale->lo / scale->factor, hi = scale->hi / scale->factor, fuzz = 1e-9 * (hi - lo);
    int power = (int)floor(log10((hi - lo) / most)) - 1;
    for (int k = 0;; k++) { /* the finest of 1, 2, 5, 10, ... that gives no more than `most` */
        static const double mantissa[3] = {1.0, 2.0, 5.0};
        int decade = power + k / 3;
        double step = mantissa[k % 3] * pow(10.0, decade);
        double first = ceil((lo - fuzz) / step), last = floor((hi + fuzz) / step);
        if (last - first + 1 > most) continue;
        for (double i = first; i <= last; i += 1.0) {
            char text[PICTURE_SCALE_TEXT];
            picture_scale_number(i * step, decade < 0 ? -decade : 0, text, sizeof text);
            picture_scale_put(scale, i * step * scale->factor, text);
        }
        return;
    }
}

static void picture_scale_decades(struct picture_scale *scale, unsigned most)
{
    int first = (int)ceil(log10(scale->lo) - 1e-9), last = (int)floor(log10(scale->hi) + 1e-9);
    int stride = 1;
    while ((last - first) / stride + 1 > (int)most) stride++;
    for (int power = first; power <= last; power++) {
        if (power % stride) continue;
        char text[PICTURE_SCALE_TEXT] = "";
        picture_scale_add_power(text, sizeof text, power);
        picture_scale_put(scale, pow(10.0, power), text);
    }
}

/* 1-2-5 in each decade, or fewer of them: for ranges below three decades. */
static void picture_scale_within_decades(struct picture_scale *scale, unsigned most)
{
    static const double mantissa[3][3] = {{1, 2, 5}, {1, 3, 0}, {1, 0, 0}};
    double lo = scale->lo / scale->factor, hi = scale->hi / scale->factor;
    for (int set = 0; set < 3; set++) {
        scale->n_tick = 0;
        for (int power = (int)floor(log10(lo)); power <= (int)ceil(log10(hi)); power++)
            for (int k = 0; k < 3 && mantissa[set][k] > 0.0; k++) {
                double value = mantissa[set][k] * pow(10.0, power);
                char text[PICTURE_SCALE_TEXT];
                if (value < lo * (1 - 1e-9) || value > hi * (1 + 1e-9)) continue;
                picture_scale_number(value, power < 0 ? -power : 0, text, sizeof text);
                picture_scale_put(scale, value * scale->factor, text);
            }
        if (scale->n_tick <= most) return;
    }
}

void picture_scale_ticks(struct picture_scale *scale, unsigned most)
{
    scale->n_tick = 0;
    if (most > PICTURE_SCALE_TICKS) most = PICTURE_SCALE_TICKS;
    if (scale->log && scale->hi >= 1e3 * scale->lo) picture_scale_decades(scale, most);
    else if (scale->log) picture_scale_within_decades(scale, most);
    if (!scale->log || scale->n_tick < 2) {
        scale->n_tick = 0;
        picture_scale_linear(scale, most);
    }
}

double picture_scale_at(const struct picture_scale *scale, double value)
{
    if (scale->log) return log(value / scale->lo) / log(scale->hi / scale->lo);
    return (value - scale->lo) / (scale->hi - scale->lo);
}
