/* voxels.c - see voxels.h. */
#include "view/voxels.h"

#include "base/mem.h"

#include <math.h>
#include <string.h>

enum { VOXELS_HALVINGS = 10 };

static size_t voxels_index(const struct voxels *voxels, const size_t i[3])
{
    return (i[2] * voxels->n[1] + i[1]) * voxels->n[0] + i[0];
}

void voxels_domain(const struct snapshot *snapshot, double ret_domain[2][3])
{
    memcpy(ret_domain, snapshot->domain, sizeof snapshot->domain);
    if (snapshot->dim == 3) return;
    double radius = snapshot->domain[1][0];
    for (int side = 0; side < 2; side++) {
        ret_domain[side][0] = ret_domain[side][1] = side ? radius : -radius;
        ret_domain[side][2] = snapshot->domain[side][1];
    }
}

/* As fine as the finest leaf along each axis, and coarser alike until there is room; one layer along an axis that a
 * plane does not have. */
static void voxels_size(const struct snapshot *snapshot, size_t room, struct voxels *voxels)
{
    double cells = 1.0, length[3];
    for (int k = 0; k < 3; k++) {
        voxels->h[k] = INFINITY;
        for (size_t c = 0; c < snapshot->n_cell; c++)
            voxels->h[k] = fmin(voxels->h[k], snapshot->upper[c][k] - snapshot->lower[c][k]);
        if (k >= snapshot->dim) voxels->h[k] = 1.0;
        length[k] = voxels->domain[1][k] - voxels->domain[0][k];
        cells *= fmax(length[k] / voxels->h[k], 1.0);
    }
    double coarser = fmax(pow(cells / (double)room, 1.0 / snapshot->dim), 1.0);
    for (int k = 0; k < 3; k++) {
        voxels->n[k] = (size_t)fmax(round(length[k] / (voxels->h[k] * (k < snapshot->dim ? coarser : 1.0))), 1.0);
        voxels->h[k] = length[k] / (double)voxels->n[k];
    }
}

/* Cells [ret_from, ret_to) that a leaf shares volume with; none: it lies outside. */
static void voxels_span(const struct voxels *voxels, const double *lower, const double *upper, size_t ret_from[3],
                        size_t ret_to[3])
{
    for (int k = 0; k < 3; k++) {
        double from = (lower[k] - voxels->domain[0][k]) / voxels->h[k],
               to = from + (upper[k] - lower[k]) / voxels->h[k];
        ret_from[k] = (size_t)fmax(floor(from + 1e-6), 0.0);
        ret_to[k] = (size_t)fmax(fmin(ceil(to - 1e-6), (double)voxels->n[k]), 0.0);
    }
}

/* The share of cell i along an axis that lies between lower and upper. */
static double voxels_share(const struct voxels *voxels, int k, size_t i, double lower, double upper)
{
    double left = voxels->domain[0][k] + (double)i * voxels->h[k], right = left + voxels->h[k];
    return fmax(fmin(right, upper) - fmax(left, lower), 0.0) / voxels->h[k];
}

static void voxels_add(const struct voxels *voxels, const double *lower, const double *upper, double value,
                       float *weights)
{
    size_t from[3], to[3], i[3];
    voxels_span(voxels, lower, upper, from, to);
    for (i[2] = from[2]; i[2] < to[2]; i[2]++)
        for (i[1] = from[1]; i[1] < to[1]; i[1]++)
            for (i[0] = from[0]; i[0] < to[0]; i[0]++) {
                double share = 1.0;
                for (int k = 0; k < 3; k++) share *= voxels_share(voxels, k, i[k], lower[k], upper[k]);
                voxels->values[voxels_index(voxels, i)] += (float)(share * value);
                weights[voxels_index(voxels, i)] += (float)share;
            }
}

/* The mean of the leaves in each cell. */
static void voxels_lay(const struct snapshot *snapshot, const double *values, const double domain[2][3], size_t room,
                       struct voxels *voxels)
{
    memcpy(voxels->domain, domain, sizeof voxels->domain);
    voxels_size(snapshot, room, voxels);
    size_t cells = voxels->n[0] * voxels->n[1] * voxels->n[2];
    float *weights = mem_new(cells, sizeof *weights);
    voxels->values = mem_new(cells, sizeof *voxels->values);
    for (size_t c = 0; c < snapshot->n_cell; c++) {
        double upper[3];
        memcpy(upper, snapshot->upper[c], sizeof upper);
        for (int k = snapshot->dim; k < 3; k++) upper[k] = 1.0;
        if (isfinite(values[c])) voxels_add(voxels, snapshot->lower[c], upper, values[c], weights);
    }
    for (size_t i = 0; i < cells; i++) voxels->values[i] = weights[i] > 0.0f ? voxels->values[i] / weights[i] : NAN;
    mem_free(weights);
}

/* A plane (r, z) turned about its axis, as much of it as `domain` has. */
static void voxels_turn(const struct voxels *plane, const double domain[2][3], size_t room, struct voxels *voxels)
{
    double radius = plane->domain[1][0], volume = 1.0;
    memcpy(voxels->domain, domain, sizeof voxels->domain);
    for (int k = 0; k < 3; k++) volume *= domain[1][k] - domain[0][k];
    double h = fmax(fmin(plane->h[0], plane->h[1]), cbrt(volume / (double)room));
    for (int k = 0; k < 3; k++) {
        double length = domain[1][k] - domain[0][k];
        voxels->n[k] = (size_t)fmax(floor(length / h), 1.0);
        voxels->h[k] = length / (double)voxels->n[k];
    }
    voxels->values = mem_new(voxels->n[0] * voxels->n[1] * voxels->n[2], sizeof *voxels->values);
    size_t i[3];
    for (i[2] = 0; i[2] < voxels->n[2]; i[2]++)
        for (i[1] = 0; i[1] < voxels->n[1]; i[1]++)
            for (i[0] = 0; i[0] < voxels->n[0]; i[0]++) {
                double x[3];
                for (int k = 0; k < 3; k++) x[k] = voxels->domain[0][k] + ((double)i[k] + 0.5) * voxels->h[k];
                double r = hypot(x[0], x[1]), at[3] = {r, x[2], 0.5};
                voxels->values[voxels_index(voxels, i)] =
                    r >= plane->domain[0][0] && r <= radius ? (float)voxels_at(plane, at) : NAN;
            }
}

/* Extremes of a block and the layer of cells around it. NaN counts for nothing. */
static void voxels_block(struct voxels *voxels, const size_t b[3])
{
    size_t from[3], to[3], i[3], block = (b[2] * voxels->n_block[1] + b[1]) * voxels->n_block[0] + b[0];
    float least = INFINITY, most = -INFINITY;
    for (int k = 0; k < 3; k++) {
        from[k] = b[k] ? b[k] * VOXELS_BLOCK - 1 : 0;
        to[k] = (b[k] + 1) * VOXELS_BLOCK + 1;
        to[k] = to[k] < voxels->n[k] ? to[k] : voxels->n[k];
    }
    for (i[2] = from[2]; i[2] < to[2]; i[2]++)
        for (i[1] = from[1]; i[1] < to[1]; i[1]++)
            for (i[0] = from[0]; i[0] < to[0]; i[0]++) {
                float value = voxels->values[voxels_index(voxels, i)];
                if (value < least) least = value;
                if (value > most) most = value;
            }
    voxels->least[block] = least;
    voxels->most[block] = most;
}

static void voxels_blocks(struct voxels *voxels)
{
    size_t b[3], blocks = 1;
    for (int k = 0; k < 3; k++) {
        voxels->n_block[k] = (voxels->n[k] + VOXELS_BLOCK - 1) / VOXELS_BLOCK;
        blocks *= voxels->n_block[k];
    }
    voxels->least = mem_new(blocks, sizeof *voxels->least);
    voxels->most = mem_new(blocks, sizeof *voxels->most);
    for (b[2] = 0; b[2] < voxels->n_block[2]; b[2]++)
        for (b[1] = 0; b[1] < voxels->n_block[1]; b[1]++)
            for (b[0] = 0; b[0] < voxels->n_block[0]; b[0]++) voxels_block(voxels, b);
}

void voxels_fill(const struct snapshot *snapshot, const double *values, const double domain[2][3], size_t room,
                 struct voxels *ret_voxels)
{
    struct voxels laid = {0};
    double plane[2][3];
    *ret_voxels = laid;
    memcpy(plane, snapshot->domain, sizeof plane);
    plane[1][2] = 1.0;
    voxels_lay(snapshot, values, snapshot->dim == 3 ? domain : (const double(*)[3])plane, room, &laid);
    if (snapshot->dim == 3) *ret_voxels = laid;
    else {
        voxels_turn(&laid, domain, room, ret_voxels);
        voxels_done(&laid);
    }
    voxels_blocks(ret_voxels);
}

void voxels_done(struct voxels *voxels)
{
    mem_free(voxels->values);
    mem_free(voxels->least);
    mem_free(voxels->most);
    *voxels = (struct voxels){0};
}

double voxels_at(const struct voxels *voxels, const double x[3])
{
    size_t low[3], high[3];
    double part[3], sum = 0.0;
    for (int k = 0; k < 3; k++) {
        double at = (x[k] - voxels->domain[0][k]) / voxels->h[k] - 0.5, last = (double)voxels->n[k] - 1.0;
        at = at < 0.0 ? 0.0 : at > last ? last : at;
        low[k] = (size_t)at;
        high[k] = low[k] + 1 < voxels->n[k] ? low[k] + 1 : low[k];
        part[k] = at - (double)low[k];
    }
    for (int corner = 0; corner < 8; corner++) {
        size_t i[3];
        double weight = 1.0;
        for (int k = 0; k < 3; k++) {
            bool up = corner >> k & 1;
            i[k] = up ? high[k] : low[k];
            weight *= up ? part[k] : 1.0 - part[k];
        }
        if (weight > 0.0) sum += weight * (double)voxels->values[voxels_index(voxels, i)];
    }
    return sum;
}

bool voxels_clip(const double domain[2][3], const double from[3], const double along[3], double *ret_begin,
                 double *ret_end)
{
    double begin = -INFINITY, end = INFINITY;
    for (int k = 0; k < 3; k++) {
        if (fabs(along[k]) < 1e-12) {
            if (from[k] < domain[0][k] || from[k] > domain[1][k]) return false;
            continue;
        }
        double a = (domain[0][k] - from[k]) / along[k], b = (domain[1][k] - from[k]) / along[k];
        begin = fmax(begin, fmin(a, b));
        end = fmin(end, fmax(a, b));
    }
    *ret_begin = begin;
    *ret_end = end;
    return begin < end;
}

static void voxels_point(const double from[3], const double along[3], double t, double ret_x[3])
{
    for (int k = 0; k < 3; k++) ret_x[k] = from[k] + t * along[k];
}

/* The block of a point: its number, and where the ray leaves it. */
static size_t voxels_block_at(const struct voxels *voxels, const double x[3], const double along[3], double *ret_length)
{
    size_t b[3];
    double length = INFINITY;
    for (int k = 0; k < 3; k++) {
        double side = VOXELS_BLOCK * voxels->h[k], at = floor((x[k] - voxels->domain[0][k]) / side);
        double last = (double)voxels->n_block[k] - 1.0;
        at = at < 0.0 ? 0.0 : at > last ? last : at;
        b[k] = (size_t)at;
        if (fabs(along[k]) < 1e-12) continue;
        double wall = voxels->domain[0][k] + (at + (along[k] > 0.0 ? 1.0 : 0.0)) * side;
        length = fmin(length, (wall - x[k]) / along[k]);
    }
    *ret_length = fmax(length, 0.0);
    return (b[2] * voxels->n_block[1] + b[1]) * voxels->n_block[0] + b[0];
}

/* The crossing between two points of a ray on different sides. */
static double voxels_halve(const struct voxels *voxels, double level, const double from[3], const double along[3],
                           double below, double above)
{
    for (int i = 0; i < VOXELS_HALVINGS; i++) {
        double middle = 0.5 * (below + above), x[3];
        voxels_point(from, along, middle, x);
        if (voxels_at(voxels, x) < level) below = middle;
        else above = middle;
    }
    return 0.5 * (below + above);
}

static void voxels_normal(const struct voxels *voxels, const double x[3], double ret_normal[3])
{
    double length = 0.0;
    for (int k = 0; k < 3; k++) {
        double up[3], down[3];
        memcpy(up, x, sizeof up);
        memcpy(down, x, sizeof down);
        up[k] += voxels->h[k];
        down[k] -= voxels->h[k];
        double slope = (voxels_at(voxels, up) - voxels_at(voxels, down)) / (2.0 * voxels->h[k]);
        ret_normal[k] = isfinite(slope) ? slope : 0.0;
        length += ret_normal[k] * ret_normal[k];
    }
    for (int k = 0; k < 3; k++) ret_normal[k] = length > 0.0 ? ret_normal[k] / sqrt(length) : k == 2;
}

bool voxels_hit(const struct voxels *voxels, double level, const double from[3], const double along[3],
                const double span[2], double *ret_t, double ret_normal[3])
{
    double step = 0.5 * fmin(voxels->h[0], fmin(voxels->h[1], voxels->h[2])), last = span[0], x[3], length;
    int side = 0; /* of the point before: -1 below, 1 above, 0 not known */
    for (double t = span[0]; t < span[1];) {
        voxels_point(from, along, t, x);
        size_t block = voxels_block_at(voxels, x, along, &length);
        bool low = voxels->most[block] < level, high = voxels->least[block] >= level; /* both: it is empty */
        double value = low && high ? NAN : low ? -INFINITY : high ? INFINITY : voxels_at(voxels, x) - level;
        int now = value < 0.0 ? -1 : value >= 0.0 ? 1 : 0;
        if (side * now < 0) {
            *ret_t = voxels_halve(voxels, level, from, along, side < 0 ? last : t, side < 0 ? t : last);
            voxels_point(from, along, *ret_t, x);
            voxels_normal(voxels, x, ret_normal);
            return true;
        }
        side = now;
        last = t;
        t += low || high ? length + 1e-3 * step : step;
    }
    return false;
}

void voxels_range(const struct voxels *voxels, double level, const struct voxels *field, double extremes[2])
{
    static const size_t stride[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    size_t i[3];
    for (i[2] = 0; i[2] < voxels->n[2]; i[2]++)
        for (i[1] = 0; i[1] < voxels->n[1]; i[1]++)
            for (i[0] = 0; i[0] < voxels->n[0]; i[0]++)
                for (int k = 0; k < 3; k++) {
                    size_t next[3] = {i[0] + stride[k][0], i[1] + stride[k][1], i[2] + stride[k][2]};
                    if (next[k] >= voxels->n[k]) continue;
                    size_t a = voxels_index(voxels, i), b = voxels_index(voxels, next);
                    if ((voxels->values[a] < level) == (voxels->values[b] < level)) continue;
                    extremes[0] = fmin(extremes[0], fmin(field->values[a], field->values[b]));
                    extremes[1] = fmax(extremes[1], fmax(field->values[a], field->values[b]));
                }
}
