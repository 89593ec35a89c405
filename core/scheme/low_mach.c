/* low_mach.c - see low_mach.h. */
#include "scheme/low_mach.h"

#include "bulla/module.h"

#include <math.h>
#include <string.h>

/* From the second difference of pressure over rho c^2 to its part of z: bends of more than 1/200 of rho c^2, 13 MPa in
 * water, see the whole jump; with less the tubes R08 and R09 overshoot by more than 2 %
 * (docs/decisions/low-mach.md). */
#define LOW_MACH_BEND 200.0

/* Less than this of a liquid, or of all else, makes no surface. */
#define LOW_MACH_TRACE 1e-6

/* From the differences to both neighbours. */
static inline double low_mach_turn(double below, double above)
{
    return fabs(above - below);
}

/* The same in the same order: paths with normals and without see the same of cells that have none. */
static inline double low_mach_bend(double before, double here, double after)
{
    return low_mach_turn(here - before, after - here);
}

/* M of one side, squared. */
static inline double low_mach_square(double rho, double rho_c2, double u)
{
    return u * u * rho / rho_c2;
}

/* What both sides of a face add up to; stiff: rho c^2 of the stiffer one. */
static inline double low_mach_sum(double least, double fast_l, double fast_r, double bend_l, double bend_r,
                                  double stiff)
{
    double fast = fast_l > fast_r ? fast_l : fast_r, bend = bend_l > bend_r ? bend_l : bend_r;
    return least + sqrt(fast) + LOW_MACH_BEND * bend / stiff;
}

static BULLA_KERNEL void low_mach_part(size_t n, size_t step, double least, const double *restrict rho,
                                       const double *restrict rho_c2, const double *restrict u, size_t right,
                                       const double *restrict p, double *restrict part)
{
    const double *before = p - step, *next = p + step, *after = next + step;
    const double *rho_r = rho + right, *rho_c2_r = rho_c2 + right, *u_r = u + right;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = rho_c2[i], b = rho_c2_r[i];
        double fast_l = low_mach_square(rho[i], a, u[i]), fast_r = low_mach_square(rho_r[i], b, u_r[i]);
        double bend_l = low_mach_bend(before[i], p[i], next[i]), bend_r = low_mach_bend(p[i], next[i], after[i]);
        part[i] = low_mach_sum(least, fast_l, fast_r, bend_l, bend_r, a > b ? a : b);
    }
}

static BULLA_KERNEL void low_mach_lean(size_t n, size_t step, double least, const double *restrict rho,
                                       const double *restrict rho_c2, const double *restrict u, size_t right,
                                       const double *restrict below, const double *restrict above,
                                       double *restrict part)
{
    const double *below_r = below + step, *above_r = above + step;
    const double *rho_r = rho + right, *rho_c2_r = rho_c2 + right, *u_r = u + right;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = rho_c2[i], b = rho_c2_r[i];
        double fast_l = low_mach_square(rho[i], a, u[i]), fast_r = low_mach_square(rho_r[i], b, u_r[i]);
        double bend_l = low_mach_turn(below[i], above[i]), bend_r = low_mach_turn(below_r[i], above_r[i]);
        part[i] = low_mach_sum(least, fast_l, fast_r, bend_l, bend_r, a > b ? a : b);
    }
}

/* Each side goes towards the velocity of a contact: the less the more impedance it has. Differences first: equal
 * velocities keep their bits. */
static BULLA_KERNEL void low_mach_blend(size_t n, const double *restrict part, const double *restrict rho,
                                        const double *restrict rho_c2, size_t right, double *restrict u_l,
                                        double *restrict u_r)
{
    const double *rho_r = rho + right, *rho_c2_r = rho_c2 + right;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double z = part[i], left = u_l[i], go = u_r[i], a = sqrt(rho[i] * rho_c2[i]), b = sqrt(rho_r[i] * rho_c2_r[i]);
        double step = (1.0 - z) * (go - left) / (a + b), lower = left + b * step, upper = go - a * step;
        u_l[i] = z < 1.0 ? lower : left;
        u_r[i] = z < 1.0 ? upper : go;
    }
}

/* 1 - (1 - z) times the lighter density over the heavier one. */
static BULLA_KERNEL void low_mach_light(size_t n, const double *restrict rho_l, const double *restrict rho_r,
                                        double *restrict part)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = rho_l[i], b = rho_r[i], z = part[i], light = a < b ? a : b, heavy = a < b ? b : a;
        part[i] = 1.0 - (1.0 - z) * (light / heavy);
    }
}

/* Another `least` at the faces of marked cells. */
static BULLA_KERNEL void low_mach_ease(size_t n, size_t step, double less, const double *restrict front,
                                       double *restrict part)
{
    const double *next = front + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double z = part[i], eased = z - less;
        part[i] = front[i] + next[i] > 0.0 ? eased : z;
    }
}

static BULLA_KERNEL void low_mach_share(size_t n, const double *restrict liquid, double *restrict front)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = liquid[i], before = front[i];
        front[i] = a > LOW_MACH_TRACE && a < 1.0 - LOW_MACH_TRACE ? 1.0 : before;
    }
}

void low_mach_surface(size_t n, const double *liquid, double *front)
{
    low_mach_share(n, liquid, front);
}

const double *low_mach_kept(const struct frame *frame, const bool open[2], const double *mask, double *room)
{
    const size_t first = frame_reach(frame);
    if (!open[0] && !open[1]) return mask ? mask + first : NULL;
    if (mask) memcpy(room, mask, frame->count * sizeof *room);
    else memset(room, 0, frame->count * sizeof *room);
    for (size_t o = 0; o < frame->outer; o++)
        for (int side = 0; side < 2; side++) {
            double *line = room + frame_at(frame, o, side ? (int)frame->n - 1 : 0);
            for (size_t i = 0; open[side] && i < frame->inner; i++) line[i] = 1.0;
        }
    return room + first;
}

void low_mach_weigh(const struct low_mach *faces, const double *u)
{
    const size_t n = faces->n;
    if (faces->lean[0])
        low_mach_lean(n, faces->step, faces->least, faces->rho, faces->rho_c2, u, faces->right,
                      faces->lean[0] + faces->reach, faces->lean[1] + faces->reach, faces->part);
    else
        low_mach_part(n, faces->step, faces->least, faces->rho, faces->rho_c2, u, faces->right, faces->p + faces->reach,
                      faces->part);
    if (faces->front) low_mach_ease(n, faces->step, faces->least - LOW_MACH_FRONT, faces->front, faces->part);
    for (size_t i = 0; faces->mask && i < n; i++)
        if (faces->mask[i] + faces->mask[i + faces->step] != 0.0) faces->part[i] = 1.0;
}

void low_mach_lighten(const struct low_mach *faces)
{
    low_mach_light(faces->n, faces->rho, faces->rho + faces->right, faces->part);
}

void low_mach_draw(const struct low_mach *faces, double *u)
{
    low_mach_blend(faces->n, faces->part, faces->rho, faces->rho_c2, faces->right, u, u + faces->right);
}
