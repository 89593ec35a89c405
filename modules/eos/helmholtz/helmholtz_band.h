/* helmholtz_band.h - the coordinates of tables over (rho, p): rows of densities, and in a row
 *     y = sqrt((p/rho - f0) s),
 * which runs from a constant at the cold edge of the domain to 1 at its highest temperature. f0 and s are a cubic in
 * rho per row of cells (a "band"): no division, and lines of constant y follow the edges. Near the cold edge of a
 * liquid p is nearly a parabola in T (a density maximum is not far); in y even that is smooth.
 *
 * Rows are equally spaced in rho, or, where the module defines HELMHOLTZ_SKEW [kg/m3], in ln(rho + HELMHOLTZ_SKEW): a
 * vapour is stable in a ten thousandth of its densities. What tables say is then differentiated along that. */
#ifndef HELMHOLTZ_BAND_H
#define HELMHOLTZ_BAND_H

#include "helmholtz_state.h"
#include "shared/elementary.h"

#include <stddef.h>

#ifndef HELMHOLTZ_SKEW
#define HELMHOLTZ_SKEW 0.0
#endif

#define HELMHOLTZ_COLD 1e-4 /* y^2 of the lower edge */

enum { HELMHOLTZ_BAND = 8 };

/* Rows of densities, and what lies between two of them. */
struct helmholtz_band {
    int n; /* rows of nodes */
    double rho_0, per_rho, step_rho,
        last;      /* first row, 1/spacing, spacing (of helmholtz_along), number of the last cell */
    double blur;   /* rows over which the cold edge is rounded; 0: not at all */
    double *cubic; /* (n - 1) x 8: f0 and s, by powers of the part x of a row */
    double *ends;  /* n x 2: p/rho at both ends of the domain, from which they come */
};

/* A density: the row of cells, and where in it. */
struct helmholtz_row {
    int i;
    double x;
};

/* The coordinate in which rows of densities are equally spaced, and back. */
PATCH_INLINE double helmholtz_along(double rho)
{
    return HELMHOLTZ_SKEW > 0.0 ? elementary_log(rho + HELMHOLTZ_SKEW) : rho;
}

PATCH_INLINE double helmholtz_back(double at)
{
    return HELMHOLTZ_SKEW > 0.0 ? elementary_exp(at) - HELMHOLTZ_SKEW : at;
}

PATCH_INLINE double helmholtz_band_at(const struct helmholtz_band *band, double rho)
{
    return (helmholtz_along(rho) - band->rho_0) * band->per_rho;
}

static inline double helmholtz_band_rho(const struct helmholtz_band *band, int i)
{
    return helmholtz_back(band->rho_0 + i * band->step_rho);
}

/* Rows per density at a density: the slope of helmholtz_band_at; and how fast that falls, relative. */
PATCH_INLINE double helmholtz_band_per(const struct helmholtz_band *band, double per_rho)
{
    return HELMHOLTZ_SKEW > 0.0 ? band->per_rho * per_rho / (1.0 + HELMHOLTZ_SKEW * per_rho) : band->per_rho;
}

PATCH_INLINE double helmholtz_band_fall(double per_rho)
{
    return HELMHOLTZ_SKEW > 0.0 ? per_rho / (1.0 + HELMHOLTZ_SKEW * per_rho) : 0.0;
}

PATCH_INLINE struct helmholtz_row helmholtz_band_row(const struct helmholtz_band *band, double rho)
{
    double at = helmholtz_band_at(band, rho);
    int i = patch_cell(at, band->last);
    return (struct helmholtz_row){i, at - i};
}

/* A pressure there: 1/rho, p/rho, y^2 = (p/rho - f0) s, and y held within the domain. */
struct helmholtz_level {
    double per_rho, f, q, y;
};

PATCH_INLINE struct helmholtz_level helmholtz_band_level(const struct helmholtz_band *band, struct helmholtz_row row,
                                                         double rho, double p)
{
    const double *c = band->cubic, x = row.x;
    int at = HELMHOLTZ_BAND * row.i;
    double f0 = c[at] + x * (c[at + 1] + x * (c[at + 2] + x * c[at + 3]));
    double s = c[at + 4] + x * (c[at + 5] + x * (c[at + 6] + x * c[at + 7]));
    double per_rho = 1.0 / rho, f = p * per_rho, q = (f - f0) * s;
    double held = q < HELMHOLTZ_COLD ? HELMHOLTZ_COLD : q; /* a NaN stays one */
    held = held > 1.0 ? 1.0 : held;
    return (struct helmholtz_level){per_rho, f, q, sqrt(held)};
}

/* f0 and s with their slopes in rho; `per`: rows per density there. */
struct helmholtz_lines {
    double f0, f0_r, s, s_r;
};

PATCH_INLINE struct helmholtz_lines helmholtz_band_lines(const struct helmholtz_band *band, struct helmholtz_row row,
                                                         double per)
{
    const double *c = band->cubic, x = row.x;
    int at = HELMHOLTZ_BAND * row.i;
    return (struct helmholtz_lines){
        .f0 = c[at] + x * (c[at + 1] + x * (c[at + 2] + x * c[at + 3])),
        .f0_r = (c[at + 1] + x * (2.0 * c[at + 2] + x * (3.0 * c[at + 3]))) * per,
        .s = c[at + 4] + x * (c[at + 5] + x * (c[at + 6] + x * c[at + 7])),
        .s_r = (c[at + 5] + x * (2.0 * c[at + 6] + x * (3.0 * c[at + 7]))) * per,
    };
}

/* Intervals of y: first y, 1/spacing, number of the last. */
struct helmholtz_steps {
    double y_0, per_y, last;
};

static inline struct helmholtz_steps helmholtz_steps_of(int n)
{
    double y_0 = sqrt(HELMHOLTZ_COLD);
    return (struct helmholtz_steps){y_0, (n - 1) / (1.0 - y_0), n - 2};
}

/* Where a y lies among them. */
struct helmholtz_rung {
    int k;
    double t;
};

PATCH_INLINE double helmholtz_rung_at(const struct helmholtz_steps *steps, double y)
{
    return (y - steps->y_0) * steps->per_y;
}

PATCH_INLINE struct helmholtz_rung helmholtz_rung(const struct helmholtz_steps *steps, double y)
{
    double at = helmholtz_rung_at(steps, y);
    int k = patch_cell(at, steps->last);
    return (struct helmholtz_rung){k, at - k};
}

/* Slope per spacing at point i of n (5 or more) that are `stride` numbers apart, to fourth order. */
static inline double helmholtz_band_slope(const double *f, int i, int n, int stride)
{
    const double *at = f + (ptrdiff_t)i * stride;
    if (i >= 2 && i < n - 2) return (at[-2 * stride] - at[2 * stride]) / 12.0 + (at[stride] - at[-stride]) / 1.5;
    int way = i < 2 ? stride : -stride, end = i < 2 ? i : n - 1 - i;
    const double *from = f + (ptrdiff_t)(i < 2 ? 0 : n - 1) * stride;
    static const double weight[2][5] = {{-25.0, 48.0, -36.0, 16.0, -3.0}, {-3.0, -10.0, 18.0, -6.0, 1.0}};
    double sum = 0.0;
    for (int k = 0; k < 5; k++) sum += weight[end][k] * from[(ptrdiff_t)k * way];
    return (way > 0 ? sum : -sum) / 12.0;
}

/* p/rho at the cold edge of row i, its bends in rho rounded: no interpolation would follow them. */
static inline double helmholtz_band_low(const struct helmholtz_band *band, int i)
{
    int reach = (int)(4.0 * band->blur), room = i < band->n - 1 - i ? i : band->n - 1 - i;
    double sum = 0.0, weights = 0.0;
    reach = reach < room ? reach : room;
    for (int k = -reach; k <= reach; k++) {
        double part = band->blur > 0.0 ? k / band->blur : 0.0, weight = exp(-0.5 * part * part);
        sum += weight * band->ends[2 * (i + k)];
        weights += weight;
    }
    return sum / weights;
}

/* f0 (0) or s (1) at row i. */
static inline double helmholtz_band_node(const struct helmholtz_band *band, int i, int which)
{
    double low = helmholtz_band_low(band, i), span = (band->ends[2 * i + 1] - low) / (1.0 - HELMHOLTZ_COLD);
    return which ? 1.0 / span : low - HELMHOLTZ_COLD * span;
}

/* The cubics of row i, from `ends` of all rows. */
static inline void helmholtz_band_fill(const struct helmholtz_band *band, int i)
{
    for (int which = 0; which < 2; which++) {
        double near[6], *c = band->cubic + HELMHOLTZ_BAND * i + 4 * which;
        int first = i < 2 ? 0 : i - 2, rows = band->n - first < 6 ? band->n - first : 6;
        if (rows < 6) first = band->n - 6;
        for (int k = 0; k < 6; k++) near[k] = helmholtz_band_node(band, first + k, which);
        /* slopes must not depend on where the window lies: those at the ends are one-sided */
        int at = i - first;
        double f = near[at], up = near[at + 1];
        double m = helmholtz_band_slope(near, at, 6, 1), m_up = helmholtz_band_slope(near, at + 1, 6, 1);
        c[0] = f;
        c[1] = m;
        c[2] = 3.0 * (up - f) - 2.0 * m - m_up;
        c[3] = 2.0 * (f - up) + m + m_up;
    }
}

#endif
