/* rigid_part.c - see rigid_part.h.
 *
 * Volumes are those of shape.h. A face in 2D is a line, in 3D some lines side by side: where the least level of all
 * bodies changes its sign along a line is found by regula falsi (Illinois; Dowell & Jarratt 1971, BIT 11, 168). */
#include "mesh/rigid_part.h"

#include <math.h>
#include <string.h>

enum { RIGID_PART_SPANS = 6, RIGID_PART_LINES = 8, RIGID_PART_STEPS = 40 };

/* Surfaces this near to a face lie in it, in cells. */
#define RIGID_PART_TOUCH 1e-9

/* Parts of faces are whole multiples of this, so that mirrored ones have the same bits. */
#define RIGID_PART_GRAIN 0x1p-40

double rigid_part_body(const struct rigid_part *part, unsigned body, const struct rigid_part_box *cell, int beta)
{
    const struct pose *pose = &part->poses[body];
    struct shape *inside = part->scene->rigids[body].shape;
    struct shape turned = {.type = SHAPE_TURNED, .n = 1, .parts = &inside};
    double lower[3], upper[3];
    int dim = part->scene->domain.dim;
    for (int d = 0; d < 3; d++) {
        lower[d] = cell->lower[d] - pose->shift[d];
        upper[d] = cell->upper[d] - pose->shift[d];
    }
    memcpy(turned.a, pose->pivot, sizeof turned.a);
    memcpy(turned.turn, pose->turn, sizeof turned.turn);
    return shape_fraction(pose->turned ? &turned : inside, lower, upper, dim, beta);
}

bool rigid_part_reaches(const struct rigid_part *part, const struct rigid_part_box *box)
{
    int dim = part->scene->domain.dim;
    for (unsigned k = 0; k < part->scene->n_rigid; k++) {
        double middle[3] = {0.0}, back[3], square = 0.0;
        for (int d = 0; d < dim; d++) {
            middle[d] = 0.5 * (box->lower[d] + box->upper[d]);
            square += 0.25 * (box->upper[d] - box->lower[d]) * (box->upper[d] - box->lower[d]);
        }
        pose_back(&part->poses[k], middle, back);
        if (shape_level(part->scene->rigids[k].shape, back) <= sqrt(square)) return true;
    }
    return false;
}

/* Least level of all bodies: not positive in one. */
static double rigid_part_level(const struct rigid_part *part, const double x[3])
{
    double least = INFINITY, back[3];
    for (unsigned k = 0; k < part->scene->n_rigid; k++) {
        pose_back(&part->poses[k], x, back);
        double level = shape_level(part->scene->rigids[k].shape, back);
        least = level < least ? level : least;
    }
    return least;
}

/* A line through space, s from 0 to 1, whose parts have the weight x^beta. */
struct rigid_part_line {
    const struct rigid_part *part;
    double from[3], way[3], touch;
    int beta;
};

static double rigid_part_at(const struct rigid_part_line *line, double s)
{
    double x[3];
    for (int d = 0; d < 3; d++) x[d] = line->from[d] + s * line->way[d];
    return rigid_part_level(line->part, x) - line->touch;
}

/* Where the level vanishes between a and b, at which it has the values p and q of different signs. */
static double rigid_part_root(const struct rigid_part_line *line, double a, double p, double b, double q)
{
    double s = a;
    for (int step = 0; step < RIGID_PART_STEPS && b - a > 1e-14; step++) {
        s = (a * q - b * p) / (q - p);
        double r = rigid_part_at(line, s);
        if (r == 0.0) break;
        if ((r < 0.0) == (p < 0.0)) {
            a = s;
            p = r;
            q *= 0.5;
        } else {
            b = s;
            q = r;
            p *= 0.5;
        }
    }
    return s;
}

/* Integral of the weight from s = a to b, over that of the whole line. */
static double rigid_part_share(const struct rigid_part_line *line, double a, double b)
{
    double x = line->from[0], w = line->way[0];
    if (line->beta == 0 || w == 0.0) return b - a;
    double from = x + a * w, to = x + b * w, end = x + w;
    return line->beta == 1 ? (to * to - from * from) / (end * end - x * x)
                           : (to * to * to - from * from * from) / (end * end * end - x * x * x);
}

/* Part of the line that is open. */
static double rigid_part_along(const struct rigid_part_line *line)
{
    double open = 0.0, before = rigid_part_at(line, 0.0);
    for (int i = 0; i < RIGID_PART_SPANS; i++) {
        double a = (double)i / RIGID_PART_SPANS, b = (double)(i + 1) / RIGID_PART_SPANS;
        double behind = rigid_part_at(line, b);
        if (before > 0.0 && behind > 0.0) open += rigid_part_share(line, a, b);
        else if (before > 0.0) open += rigid_part_share(line, a, rigid_part_root(line, a, before, b, behind));
        else if (behind > 0.0) open += rigid_part_share(line, rigid_part_root(line, a, before, b, behind), b);
        before = behind;
    }
    return open;
}

double rigid_part_open(const struct rigid_part *part, int axis, const struct rigid_part_box *face, double h, int beta)
{
    struct rigid_part_line line = {.part = part, .touch = RIGID_PART_TOUCH * h, .beta = beta};
    int dim = part->scene->domain.dim, along = axis == 0 ? 1 : 0, across = 3 - axis - along;
    int lines = dim == 3 ? RIGID_PART_LINES : 1;
    double open = 0.0;
    memcpy(line.from, face->lower, sizeof line.from);
    if (dim == 1) return rigid_part_at(&line, 0.0) > 0.0 ? 1.0 : 0.0;
    line.way[along] = face->upper[along] - face->lower[along];
    for (int i = 0; i < lines; i++) {
        double s = (i + 0.5) / lines;
        if (dim == 3) line.from[across] = (1.0 - s) * face->lower[across] + s * face->upper[across];
        open += rigid_part_along(&line);
    }
    return rint(open / lines / RIGID_PART_GRAIN) * RIGID_PART_GRAIN;
}
