/* raster.c - see raster.h: levels between the values of an array. */
#include "case/raster.h"

#include "base/mem.h"
#include "base/status.h"

#include <math.h>
#include <string.h>

static double raster_step(const struct raster *raster, int d)
{
    return (raster->upper[d] - raster->lower[d]) / (double)raster->n[d];
}

static size_t raster_stride(const struct raster *raster, int d)
{
    return d == 0 ? raster->n[1] * raster->n[2] : d == 1 ? raster->n[2] : 1;
}

void raster_done(struct raster *raster)
{
    mem_free(raster->value);
    mem_free(raster->away);
    *raster = (struct raster){0};
}

/* Placing */

/* The steepest slope there can be: the largest difference of neighbours along each axis. */
static double raster_slope(const struct raster *raster)
{
    size_t count = raster->n[0] * raster->n[1] * raster->n[2];
    double square = 0.0;
    for (int d = 0; d < raster->dim; d++) {
        size_t stride = raster_stride(raster, d);
        double most = 0.0;
        for (size_t k = 0; k + stride < count; k++) {
            if (k / stride % raster->n[d] + 1 == raster->n[d]) continue;
            double rise = fabs((double)raster->value[k + stride] - (double)raster->value[k]);
            most = rise > most ? rise : most;
        }
        most /= raster_step(raster, d);
        square += most * most;
    }
    return sqrt(square);
}

/* 0 at all corners of the parts that the surface runs through, infinity elsewhere; how many parts those are. */
static size_t raster_mark(const struct raster *raster, float *away)
{
    size_t found = 0, low[3], count = raster->n[0] * raster->n[1] * raster->n[2];
    for (size_t k = 0; k < count; k++) away[k] = INFINITY;
    for (low[0] = 0; low[0] + 1 < raster->n[0] || low[0] == 0; low[0]++)
        for (low[1] = 0; low[1] + 1 < raster->n[1] || low[1] == 0; low[1]++)
            for (low[2] = 0; low[2] + 1 < raster->n[2] || low[2] == 0; low[2]++) {
                size_t corner[8], inside = 0, n = 0;
                for (unsigned c = 0; c < 8; c++) {
                    size_t at = 0;
                    bool there = true;
                    for (int d = 0; d < 3; d++) {
                        there = there && low[d] + (c >> d & 1) < raster->n[d];
                        at += (low[d] + (c >> d & 1)) * raster_stride(raster, d);
                    }
                    if (!there) continue;
                    inside += raster->value[at] < 0.0f;
                    corner[n++] = at;
                }
                if (inside == 0 || inside == n) continue;
                found++;
                for (size_t c = 0; c < n; c++) away[corner[c]] = 0.0f;
            }
    return found;
}

/* One line of squared distances: the lower envelope of a parabola over each value. `room`: 3 n. */
static void raster_envelope(float *line, size_t n, size_t stride, double step, double *room)
{
    double *value = room, *place = room + n, *from = room + 2 * n; /* parabola q holds from from[q] on */
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        double f = (double)line[i * stride], x = step * (double)i, meet = -INFINITY;
        if (isinf(f)) continue;
        while (count) {
            double p = place[count - 1];
            meet = (f + x * x - value[count - 1] - p * p) / (2.0 * (x - p));
            if (meet > from[count - 1]) break;
            count--;
        }
        from[count] = count ? meet : -INFINITY;
        value[count] = f;
        place[count++] = x;
    }
    for (size_t i = 0, q = 0; count && i < n; i++) {
        double x = step * (double)i;
        while (q + 1 < count && from[q + 1] < x) q++;
        line[i * stride] = (float)(value[q] + (x - place[q]) * (x - place[q]));
    }
}

/* Squared distances along one axis after the other. */
static void raster_transform(const struct raster *raster, float *away)
{
    size_t count = raster->n[0] * raster->n[1] * raster->n[2];
    for (int d = 0; d < raster->dim; d++) {
        size_t stride = raster_stride(raster, d), n = raster->n[d];
        double *room = mem_new(3 * n, sizeof *room);
        for (size_t k = 0; k < count; k++)
            if (k / stride % n == 0) raster_envelope(away + k, n, stride, raster_step(raster, d), room);
        mem_free(room);
    }
}

int raster_place(struct raster *raster, const double lower[3], const double upper[3], double threshold, double sign)
{
    size_t count = raster->n[0] * raster->n[1] * raster->n[2];
    double part = 0.0; /* the diagonal of a part, squared */
    for (int d = 0; d < 3; d++) {
        raster->lower[d] = lower[d];
        raster->upper[d] = upper[d];
        if (d < raster->dim) part += raster_step(raster, d) * raster_step(raster, d);
    }
    for (size_t k = 0; k < count; k++) raster->value[k] = (float)(sign * ((double)raster->value[k] - threshold));
    raster->steepest = raster_slope(raster);
    raster->away = mem_new(count, sizeof *raster->away);
    if (raster_mark(raster, raster->away) == 0)
        return status_fail(STATUS_CASE, "%s of its values are inside", raster->value[0] < 0.0f ? "all" : "none");
    raster_transform(raster, raster->away);
    for (size_t k = 0; k < count; k++)
        raster->away[k] = (float)(sqrt((double)raster->away[k]) * (1.0 - 1e-6) - 1.5 * sqrt(part));
    return STATUS_OK;
}

/* Levels */

/* Along one axis: the lower of two values, its weight, and the nearer of them. */
static void raster_find(const struct raster *raster, int d, double x, size_t *ret_low, double *ret_share)
{
    double s = (x - raster->lower[d]) / raster_step(raster, d) - 0.5, last = (double)raster->n[d] - 1.0;
    s = s < 0.0 ? 0.0 : s > last ? last : s;
    *ret_low = (size_t)s;
    if (*ret_low + 1 == raster->n[d] && *ret_low > 0) (*ret_low)--;
    *ret_share = s - (double)*ret_low;
}

/* How far outside of the box; negative inside. */
static double raster_outside(const struct raster *raster, const double x[3])
{
    double most = -INFINITY;
    for (int d = 0; d < raster->dim; d++) {
        double below = raster->lower[d] - x[d], above = x[d] - raster->upper[d], out = below > above ? below : above;
        most = out > most ? out : most;
    }
    return most;
}

double raster_level(const struct raster *raster, const double x[3])
{
    size_t base = 0, nearest = 0;
    double share[3] = {0.0}, value = 0.0;
    for (int d = 0; d < raster->dim; d++) {
        size_t low, stride = raster_stride(raster, d);
        raster_find(raster, d, x[d], &low, share + d);
        base += low * stride;
        nearest += (low + (share[d] > 0.5)) * stride;
    }
    for (unsigned c = 0; c < 1u << raster->dim; c++) {
        double weight = 1.0;
        size_t at = base;
        for (int d = 0; d < raster->dim; d++) {
            weight *= c >> d & 1 ? share[d] : 1.0 - share[d];
            at += raster->n[d] > 1 && (c >> d & 1) ? raster_stride(raster, d) : 0;
        }
        value += weight * (double)raster->value[at];
    }
    double level = value / raster->steepest, away = (double)raster->away[nearest];
    if (fabs(level) < away) level = level < 0.0 ? -away : away;
    double out = raster_outside(raster, x);
    return level > out ? level : out;
}
