/* shape_volume.c - see shape_volume.h.
 *
 * Closed forms where they exist: boxes, planes, polygons, discs and bodies of revolution. A ball
 * in three dimensions is an integral of disc areas, cut where the circle passes a corner, so
 * that the integrand is smooth between the cuts. Areas are built from differences along the cell
 * (chord and circular segment), never from differences of large areas: the relative error stays
 * near round-off for bubbles of a thousand cells. */
#include "case/shape_volume.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

static double shape_volume_least(double a, double b)
{
    return a < b ? a : b;
}

static double shape_volume_most(double a, double b)
{
    return a > b ? a : b;
}

double shape_volume_along(double a, double b, int beta)
{
    if (beta == 0) return b - a;
    if (beta == 1) return 0.5 * (b - a) * (b + a);
    return (b - a) * (b * b + a * b + a * a) / 3.0;
}

/* Share of axis `d` of a cell that lies in [from, to]. */
static double shape_volume_share(const struct shape_cell *cell, int d, double from, double to)
{
    double lower = cell->lower[d], upper = cell->upper[d];
    double a = shape_volume_most(lower, from), b = shape_volume_least(upper, to);
    if (b <= a) return 0.0;
    int beta = d == 0 ? cell->beta : 0;
    return shape_volume_along(a, b, beta) / shape_volume_along(lower, upper, beta);
}

double shape_volume_box(const struct shape_cell *cell, const double from[3], const double to[3])
{
    double fraction = 1.0;
    for (int d = 0; d < cell->dim; d++)
        if (from[d] < to[d]) fraction *= shape_volume_share(cell, d, from[d], to[d]);
    return fraction;
}

/* Planes */

/* Area of the unit square under a x + b y = level, 0 <= a <= b, b > 0. */
static double shape_volume_square(double a, double b, double level)
{
    if (level <= 0.0) return 0.0;
    if (level < a) return 0.5 * (level / a) * (level / b);
    if (level <= b) return (level - 0.5 * a) / b;
    double rest = a + b - level;
    return rest > 0.0 ? 1.0 - 0.5 * (rest / a) * (rest / b) : 1.0;
}

/* Volume of the unit cube under m . x = level, 0 <= m[0] <= m[1] <= m[2] (Scardovelli & Zaleski 2000): areas
 * summed along the flattest axis by Gauss' rule, which is exact for the parabolas between the corners. */
static double shape_volume_cube(const double m[3], double level)
{
    if (m[0] <= 0.0) return shape_volume_square(m[1], m[2], level);
    double corner[4] = {m[1] + m[2], m[2], m[1], 0.0}, volume = 0.0, from = 0.0;
    for (int k = 0; k < 5; k++) {
        double to = k < 4 ? shape_volume_least((level - corner[k]) / m[0], 1.0) : 1.0;
        if (to <= from) continue;
        double middle = 0.5 * (from + to), half = 0.5 * (to - from), away = half * 0.57735026918962576451;
        volume += half * (shape_volume_square(m[1], m[2], level - m[0] * (middle - away)) +
                          shape_volume_square(m[1], m[2], level - m[0] * (middle + away)));
        from = to;
    }
    return volume;
}

static void shape_volume_order(double *a, double *b)
{
    if (*a <= *b) return;
    double keep = *a;
    *a = *b;
    *b = keep;
}

static double shape_volume_plane_cartesian(const struct shape_cell *cell, const double point[3], const double normal[3])
{
    double m[3] = {0.0}, depth[3] = {0.0};
    for (int d = 0; d < cell->dim; d++) {
        m[d] = fabs(normal[d]) * (cell->upper[d] - cell->lower[d]);
        depth[d] = normal[d] * (0.5 * (cell->lower[d] + cell->upper[d]) - point[d]);
    }
    for (int d = cell->dim; d < 3; d++) depth[d] = -normal[d] * point[d];
    for (int k = 0; k < 3; k++) { /* sorted sums: the same bits for exchanged axes */
        shape_volume_order(m + k % 2, m + k % 2 + 1);
        shape_volume_order(depth + k % 2, depth + k % 2 + 1);
    }
    double width = m[0] + m[1] + m[2], middle = depth[0] + depth[1] + depth[2];
    if (width <= 0.0) return middle >= 0.0 ? 1.0 : 0.0;
    if (middle >= 0.5 * width) return 1.0;
    if (middle > 0.0) return 1.0 - shape_volume_cube(m, 0.5 * width - middle);
    return shape_volume_cube(m, middle + 0.5 * width);
}

/* Integral of x^beta (y clipped to [bottom, top], minus bottom) over the straight line from (x0, y0) to (x1, y1);
 * negative for x1 < x0. Between the clips the integrand is a polynomial that Gauss' rule meets exactly. */
static double shape_volume_strip(const double from[2], const double to[2], double bottom, double top, int beta)
{
    double rise = to[1] - from[1], run = to[0] - from[0], cut[4] = {0.0, 0.0, 0.0, 1.0}, sum = 0.0;
    if (rise != 0.0) {
        cut[1] = shape_volume_least(shape_volume_most((bottom - from[1]) / rise, 0.0), 1.0);
        cut[2] = shape_volume_least(shape_volume_most((top - from[1]) / rise, 0.0), 1.0);
        shape_volume_order(cut + 1, cut + 2);
    }
    for (int k = 0; k < 3; k++) {
        double middle = 0.5 * (cut[k] + cut[k + 1]), half = 0.5 * (cut[k + 1] - cut[k]);
        if (half <= 0.0) continue;
        for (int side = -1; side <= 1; side += 2) {
            double s = middle + side * half * 0.57735026918962576451, x = from[0] + s * run;
            double y = shape_volume_least(shape_volume_most(from[1] + s * rise, bottom), top) - bottom;
            sum += half * y * (beta == 0 ? 1.0 : beta == 1 ? x : x * x);
        }
    }
    return sum * run;
}

/* Two axes, the first weighted. Turned so that the region lies below the line. `beside`: what the plane's third
 * axis adds. */
static double shape_volume_plane_turned(const struct shape_cell *cell, const double point[3], const double normal[3],
                                        double beside)
{
    bool above = normal[1] > 0.0;
    double bottom = above ? -cell->upper[1] : cell->lower[1], top = above ? -cell->lower[1] : cell->upper[1];
    double py = (above ? -point[1] : point[1]) + beside / fabs(normal[1]), slope = normal[0] / fabs(normal[1]);
    double from[2] = {cell->lower[0], py + slope * (cell->lower[0] - point[0])};
    double to[2] = {cell->upper[0], py + slope * (cell->upper[0] - point[0])};
    return shape_volume_strip(from, to, bottom, top, cell->beta) /
           ((top - bottom) * shape_volume_along(from[0], to[0], cell->beta));
}

double shape_volume_plane(const struct shape_cell *cell, const double point[3], const double normal[3])
{
    if (cell->beta == 0) return shape_volume_plane_cartesian(cell, point, normal);
    double beside = 0.0;
    for (int d = cell->dim; d < 3; d++) beside -= normal[d] * point[d];
    if (cell->dim == 2 && normal[1] != 0.0) return shape_volume_plane_turned(cell, point, normal, beside);
    if (normal[0] == 0.0) return beside >= 0.0 ? 1.0 : 0.0;
    double cut = point[0] - beside / normal[0];
    return normal[0] < 0.0 ? shape_volume_share(cell, 0, -DBL_MAX, cut) : shape_volume_share(cell, 0, cut, DBL_MAX);
}

double shape_volume_polygon(const struct shape_cell *cell, unsigned n, const double (*vertex)[2])
{
    double left = cell->lower[0], right = cell->upper[0], bottom = cell->lower[1], top = cell->upper[1], sum = 0.0;
    for (unsigned i = 0; i < n; i++) {
        const double *a = vertex[i], *b = vertex[i + 1 < n ? i + 1 : 0];
        double run = b[0] - a[0];
        if (run == 0.0) continue;
        double s = (left - a[0]) / run, t = (right - a[0]) / run;
        shape_volume_order(&s, &t);
        s = shape_volume_most(s, 0.0);
        t = shape_volume_least(t, 1.0);
        if (s >= t) continue;
        double from[2] = {a[0] + s * run, a[1] + s * (b[1] - a[1])}, to[2] = {a[0] + t * run, a[1] + t * (b[1] - a[1])};
        sum += shape_volume_strip(from, to, bottom, top, cell->beta);
    }
    return fabs(sum) / ((top - bottom) * shape_volume_along(left, right, cell->beta));
}

/* Balls, scaled to the radius 1 and taken quadrant by quadrant: 0 <= y0 < y1, 0 <= z0 < z1 */

/* Area between an arc of radius r and its chord. */
static double shape_volume_segment(double r, double chord)
{
    double half = 0.5 * chord / r, angle = 2.0 * asin(half < 1.0 ? half : 1.0), a2 = angle * angle;
    double excess = angle - sin(angle);
    if (angle < 0.5)
        excess = angle * a2 / 6.0 *
                 (1.0 - a2 / 20.0 * (1.0 - a2 / 42.0 * (1.0 - a2 / 72.0 * (1.0 - a2 / 110.0 * (1.0 - a2 / 156.0)))));
    return 0.5 * r * r * excess;
}

/* Area of the part of a quadrant's rectangle inside the circle of squared radius r2, and its moment about y = 0. */
static double shape_volume_quadrant(double r2, const double y[2], const double z[2], double *ret_moment)
{
    *ret_moment = 0.0;
    if (y[0] * y[0] + z[0] * z[0] >= r2) return 0.0;
    double under = r2 - z[1] * z[1], full = under > 0.0 ? shape_volume_least(sqrt(under), y[1]) : 0.0;
    double a = shape_volume_most(y[0], full), b = shape_volume_least(y[1], sqrt(r2 - z[0] * z[0]));
    double area = 0.0;
    if (full > y[0]) { /* the arc passes above */
        area = (full - y[0]) * (z[1] - z[0]);
        *ret_moment = 0.5 * area * (full + y[0]);
    }
    if (b <= a) return area;
    double sa = sqrt(r2 - a * a), sb = sqrt(shape_volume_most(r2 - b * b, 0.0));
    double qa = shape_volume_most(sa - z[0], 0.0), qb = shape_volume_most(sb - z[0], 0.0), drop = qa - qb;
    area += 0.5 * (qa + qb) * (b - a) + shape_volume_segment(sqrt(r2), sqrt((b - a) * (b - a) + drop * drop));
    *ret_moment += drop * (0.5 * z[0] * (qa + qb) + (qa * qa + qa * qb + qb * qb) / 3.0);
    return area;
}

/* The volume of an octant's box inside the ball of squared radius r2. */
static double shape_volume_octant(double r2, const double x[2], const double y[2], const double z[2])
{
    static const double node[3] = {0.23861918608319690863, 0.66120938646626451366, 0.93246951420315202781};
    static const double weight[3] = {0.46791393457269104739, 0.36076157304813860757, 0.17132449237917034504};
    static const int corner[4][2] = {{1, 1}, {1, 0}, {0, 1}, {0, 0}}; /* of the rectangle: the circle passes there */
    double cut[5] = {x[0]}, moment;
    for (int k = 0; k < 4; k++) {
        double yk = y[corner[k][0]], zk = z[corner[k][1]], rest = r2 - yk * yk - zk * zk;
        cut[k + 1] = shape_volume_least(shape_volume_most(rest > 0.0 ? sqrt(rest) : 0.0, x[0]), x[1]);
    }
    shape_volume_order(cut + 2, cut + 3);
    double volume = (cut[1] - cut[0]) * (y[1] - y[0]) * (z[1] - z[0]);
    for (int k = 1; k < 4; k++) {
        double length = cut[k + 1] - cut[k];
        if (length <= 0.0) continue;
        for (int g = 0; g < 6; g++) { /* x' = 0 at both cuts: roots become smooth */
            double u = 0.5 + (g % 2 ? 0.5 : -0.5) * node[g / 2], at = cut[k] + length * u * u * (3.0 - 2.0 * u);
            volume +=
                0.5 * weight[g / 2] * length * 6.0 * u * (1.0 - u) * shape_volume_quadrant(r2 - at * at, y, z, &moment);
        }
    }
    return volume;
}

/* The part of an interval on one side of 0, measured away from it. False: there is none. */
static bool shape_volume_side(const double interval[2], int side, double ret_part[2])
{
    ret_part[0] = shape_volume_most(side ? interval[0] : -interval[1], 0.0);
    ret_part[1] = side ? interval[1] : -interval[0];
    return ret_part[1] > ret_part[0];
}

/* Brings intervals that differ by mirroring or order only into one form, so that they give the same bits. */
static void shape_volume_arrange(double (*span)[2], int n)
{
    for (int d = 0; d < n; d++) {
        double a = span[d][0], b = span[d][1];
        if (a + b >= 0.0) continue;
        span[d][0] = -b;
        span[d][1] = -a;
    }
    for (int k = 0; k < n * (n - 1) / 2; k++) {
        double *a = span[k % 2], *b = span[k % 2 + 1], a0 = a[0], a1 = a[1];
        if (a0 < b[0] || (a0 == b[0] && a1 <= b[1])) continue;
        a[0] = b[0];
        a[1] = b[1];
        b[0] = a0;
        b[1] = a1;
    }
}

static double shape_volume_ball_3(double r2, double (*span)[2])
{
    shape_volume_arrange(span, 3);
    double volume = 0.0, x[2], y[2], z[2];
    for (int k = 0; k < 8; k++)
        if (shape_volume_side(span[0], k & 1, x) && shape_volume_side(span[1], k >> 1 & 1, y) &&
            shape_volume_side(span[2], k >> 2, z))
            volume += shape_volume_octant(r2, x, y, z);
    return volume / ((span[0][1] - span[0][0]) * (span[1][1] - span[1][0]) * (span[2][1] - span[2][0]));
}

/* `centre`: of the ball on the first axis, for the weight x = centre + distance. */
static double shape_volume_ball_2(double r2, double (*span)[2], double centre, int beta)
{
    if (beta == 0) shape_volume_arrange(span, 2);
    double area = 0.0, moment = 0.0, part, y[2], z[2];
    for (int k = 0; k < 4; k++) {
        if (!shape_volume_side(span[0], k & 1, y) || !shape_volume_side(span[1], k >> 1, z)) continue;
        area += shape_volume_quadrant(r2, y, z, &part);
        moment += k & 1 ? part : -part;
    }
    double height = span[1][1] - span[1][0];
    if (beta == 0) return area / (height * (span[0][1] - span[0][0]));
    return (centre * area + moment) / (height * shape_volume_along(centre + span[0][0], centre + span[0][1], 1));
}

double shape_volume_ball(const struct shape_cell *cell, const double centre[3], const double axes[3])
{
    double span[3][2], r2 = 1.0;
    for (int d = cell->dim; d < 3; d++) /* a cut beside the centre */
        if (axes[d] > 0.0) r2 -= centre[d] * centre[d] / (axes[d] * axes[d]);
    if (r2 <= 0.0) return 0.0;
    for (int d = 0; d < cell->dim; d++) {
        span[d][0] = (cell->lower[d] - centre[d]) / axes[d];
        span[d][1] = (cell->upper[d] - centre[d]) / axes[d];
    }
    if (cell->dim == 3) return shape_volume_ball_3(r2, span);
    if (cell->dim == 2) return shape_volume_ball_2(r2, span, centre[0] / axes[0], cell->beta);
    double half = sqrt(r2) * axes[0];
    return shape_volume_share(cell, 0, centre[0] - half, centre[0] + half);
}
