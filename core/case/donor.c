/* donor.c - see donor.h. */
#include "case/donor.h"

#include "base/mem.h"

#include <math.h>
#include <string.h>

/* A box of this run, and what has been gathered of it. */
struct donor_box {
    const struct donor *donor;
    const double *at, *lower, *upper;
    int dim, beta;
    double away[3]; /* unit vector from the origin of a spherical donor, or the axis of rings in space, to the middle of
                       the box */
    double covered;
    double *sum; /* [n_model] */
};

/* Are the cells of the donor rings in space? */
static bool donor_is_rings(const struct donor_box *box)
{
    return box->donor->beta == 1 && box->dim == 3;
}

static size_t donor_bucket_of(const struct donor *donor, const double x[3], int round)
{
    size_t bucket = 0;
    for (int d = donor->dim - 1; d >= 0; d--) {
        double width = (donor->domain[1][d] - donor->domain[0][d]) / donor->buckets[d];
        double place = floor((x[d] - donor->domain[0][d]) / width + 1e-9 * round);
        int last = donor->buckets[d] - 1, i = place > last ? last : place > 0.0 ? (int)place : 0;
        bucket = bucket * (size_t)donor->buckets[d] + (size_t)i;
    }
    return bucket;
}

void donor_sort(struct donor *donor)
{
    size_t count = 1, *next;
    for (int d = 0; d < donor->dim; d++) count *= (size_t)donor->buckets[d];
    donor->first = mem_new(count + 1, sizeof *donor->first);
    donor->order = mem_new(donor->n + 1, sizeof *donor->order);
    next = mem_new(count + 1, sizeof *next);
    for (size_t i = 0; i < donor->n; i++) donor->first[donor_bucket_of(donor, donor->cells[i].lower, 1) + 1]++;
    for (size_t b = 0; b < count; b++) donor->first[b + 1] += donor->first[b];
    memcpy(next, donor->first, count * sizeof *next);
    for (size_t i = 0; i < donor->n; i++) donor->order[next[donor_bucket_of(donor, donor->cells[i].lower, 1)]++] = i;
    mem_free(next);
}

/* Integral of the metric of axis 0, x^beta, from a to b, as a part of that from lower to upper. */
static double donor_part(double a, double b, double lower, double upper, int beta)
{
    double c = upper - lower;
    if (beta == 1) return (b - a) / c * ((a + b) / (lower + upper));
    if (beta == 2) return (b - a) / c * ((a * a + a * b + b * b) / (lower * lower + lower * upper + upper * upper));
    return (b - a) / c;
}

/* The part of the box that lies in a cell of the same geometry. */
static double donor_overlap(const struct donor_box *box, const struct donor_cell *cell)
{
    double part = 1.0;
    for (int d = 0; d < box->dim; d++) {
        double a = cell->lower[d] + box->at[d], b = cell->upper[d] + box->at[d];
        if (a < box->lower[d]) a = box->lower[d];
        if (b > box->upper[d]) b = box->upper[d];
        if (!(b > a)) return 0.0;
        part *= donor_part(a, b, box->lower[d], box->upper[d], d == 0 ? box->beta : 0);
    }
    return part;
}

/* The part of the box that lies in a ball around the origin of the donor. */
static double donor_ball(const struct donor_box *box, double radius)
{
    struct shape ball = {.type = SHAPE_SPHERE, .radius = radius};
    memcpy(ball.a, box->at, sizeof ball.a);
    return radius > 0.0 ? shape_fraction(&ball, box->lower, box->upper, box->dim, box->beta) : 0.0;
}

static void donor_add(struct donor_box *box, size_t cell, double part)
{
    const struct donor *donor = box->donor;
    const double *u = donor->u + cell * donor->n_field;
    bool rings = donor_is_rings(box), turned = rings || (donor->beta == 2 && box->beta != 2);
    box->covered += part;
    for (unsigned q = 0; q < donor->n_field; q++) {
        int what = donor->what[q];
        if (rings && what == donor->momentum + 1) box->sum[donor->momentum + donor->axis] += part * u[q];
        else if (!turned || what != donor->momentum) box->sum[what] += part * u[q];
        else
            for (int d = 0; d < box->dim; d++) box->sum[donor->momentum + d] += part * u[q] * box->away[d];
    }
}

/* The first shell that ends beyond a radius. */
static size_t donor_shell(const struct donor *donor, double radius)
{
    size_t low = 0, high = donor->n;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (donor->cells[middle].upper[0] <= radius) low = middle + 1;
        else high = middle;
    }
    return low;
}

/* Shells between the nearest and the farthest point of the box. */
static void donor_shells(struct donor_box *box)
{
    double near = 0.0, far = 0.0, length = 0.0, inner = 0.0;
    for (int d = 0; d < box->dim; d++) {
        double a = box->lower[d] - box->at[d], b = box->upper[d] - box->at[d], gap = a > 0.0 ? a : b < 0.0 ? -b : 0.0;
        near += gap * gap;
        far += a * a > b * b ? a * a : b * b;
        box->away[d] = 0.5 * (a + b);
        length += box->away[d] * box->away[d];
    }
    for (int d = 0; d < box->dim; d++) box->away[d] = length > 0.0 ? box->away[d] / sqrt(length) : 0.0;
    near = sqrt(near);
    far = sqrt(far);
    for (size_t i = donor_shell(box->donor, near), any = 0; i < box->donor->n; i++) {
        const struct donor_cell *cell = &box->donor->cells[i];
        if (cell->lower[0] >= far) return;
        if (!any++) inner = donor_ball(box, cell->lower[0]);
        double outer = cell->upper[0] >= far ? 1.0 : donor_ball(box, cell->upper[0]);
        if (outer > inner) donor_add(box, i, outer - inner);
        inner = outer;
    }
}

/* The part of the box that lies in a cylinder around the axis of rings. */
static double donor_disc(const struct donor_box *box, double radius)
{
    struct shape disc = {.type = SHAPE_SPHERE, .radius = radius};
    double lower[3] = {0.0}, upper[3] = {0.0};
    for (int k = 0; k < 2; k++) {
        int d = (box->donor->axis + 1 + k) % 3;
        lower[k] = box->lower[d] - box->at[d];
        upper[k] = box->upper[d] - box->at[d];
    }
    return radius > 0.0 ? shape_fraction(&disc, lower, upper, 2, 0) : 0.0;
}

/* The part of the box that lies in a ring. */
static double donor_ring(const struct donor_box *box, const struct donor_cell *cell)
{
    int axis = box->donor->axis;
    double lower = box->lower[axis], upper = box->upper[axis];
    double a = cell->lower[1] + box->at[axis], b = cell->upper[1] + box->at[axis];
    if (a < lower) a = lower;
    if (b > upper) b = upper;
    return b > a ? (b - a) / (upper - lower) * (donor_disc(box, cell->upper[0]) - donor_disc(box, cell->lower[0]))
                 : 0.0;
}

/* Where the box is in the donor's coordinates; of rings in space the distances from the axis between which it lies, and
 * its span along it. */
static void donor_span(struct donor_box *box, double ret_lower[3], double ret_upper[3])
{
    double near = 0.0, far = 0.0, length = 0.0;
    for (int d = 0; d < box->dim; d++) {
        ret_lower[d] = box->lower[d] - box->at[d];
        ret_upper[d] = box->upper[d] - box->at[d];
    }
    if (!donor_is_rings(box)) return;
    int axis = box->donor->axis;
    for (int k = 1; k < 3; k++) {
        int d = (axis + k) % 3;
        double a = ret_lower[d], b = ret_upper[d], gap = a > 0.0 ? a : b < 0.0 ? -b : 0.0;
        near = hypot(near, gap);
        far = hypot(far, a * a > b * b ? a : b);
        box->away[d] = 0.5 * (a + b);
        length = hypot(length, box->away[d]);
    }
    for (int d = 0; d < 3; d++) box->away[d] = length > 0.0 && d != axis ? box->away[d] / length : 0.0;
    ret_lower[1] = ret_lower[axis];
    ret_upper[1] = ret_upper[axis];
    ret_lower[0] = near;
    ret_upper[0] = far;
}

/* Buckets that the box reaches into. */
static void donor_boxes(struct donor_box *box)
{
    const struct donor *donor = box->donor;
    int low[3] = {0}, high[3] = {0}, i[3];
    double lower[3], upper[3];
    donor_span(box, lower, upper);
    for (int d = 0; d < donor->dim; d++) {
        double width = (donor->domain[1][d] - donor->domain[0][d]) / donor->buckets[d];
        double a = floor((lower[d] - donor->domain[0][d]) / width - 1e-9);
        double b = floor((upper[d] - donor->domain[0][d]) / width + 1e-9);
        if (b < 0.0 || a >= donor->buckets[d]) return;
        low[d] = a > 0.0 ? (int)a : 0;
        high[d] = b < donor->buckets[d] - 1 ? (int)b : donor->buckets[d] - 1;
    }
    for (i[2] = low[2]; i[2] <= high[2]; i[2]++)
        for (i[1] = low[1]; i[1] <= high[1]; i[1]++)
            for (i[0] = low[0]; i[0] <= high[0]; i[0]++) {
                size_t bucket = 0;
                for (int d = donor->dim - 1; d >= 0; d--) bucket = bucket * (size_t)donor->buckets[d] + (size_t)i[d];
                for (size_t k = donor->first[bucket]; k < donor->first[bucket + 1]; k++) {
                    const struct donor_cell *cell = &donor->cells[donor->order[k]];
                    double part = donor_is_rings(box) ? donor_ring(box, cell) : donor_overlap(box, cell);
                    if (part > 0.0) donor_add(box, donor->order[k], part);
                }
            }
}

double donor_average(const struct donor *donor, const double at[3], const double lower[3], const double upper[3],
                     int dim, int beta, unsigned n_model, double *ret_mean)
{
    struct donor_box box = {donor, at, lower, upper, dim, beta, {0}, 0.0, ret_mean};
    memset(ret_mean, 0, n_model * sizeof *ret_mean);
    if (donor->beta == 2 && beta != 2) donor_shells(&box);
    else donor_boxes(&box);
    if (!(box.covered > 1e-12)) return 0.0;
    for (unsigned q = 0; q < n_model; q++) ret_mean[q] /= box.covered;
    return box.covered > 1.0 - 1e-12 ? 1.0 : box.covered;
}

void donor_free(struct donor *donor)
{
    if (!donor) return;
    mem_free(donor->cells);
    mem_free(donor->u);
    mem_free(donor->first);
    mem_free(donor->order);
    mem_free(donor->what);
    mem_free(donor);
}
