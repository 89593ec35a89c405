/* surface.c - see surface.h: a tree of boxes around the triangles, distances by it, and what they enclose.
 *
 * A node's triangles are parted at the middle of their centres' box along its longest axis. */
#include "case/surface.h"

#include "base/mem.h"

#include <math.h>
#include <string.h>

enum { SURFACE_LEAF = 4 };

/* The tree */

static double surface_centre(const struct surface *surface, size_t i, int axis)
{
    const size_t *corner = surface->corner[i];
    return (surface->vertex[corner[0]][axis] + surface->vertex[corner[1]][axis] + surface->vertex[corner[2]][axis]) /
           3.0;
}

static void surface_widen(struct surface_node *box, const double x[3])
{
    for (int d = 0; d < 3; d++) {
        box->lower[d] = x[d] < box->lower[d] ? x[d] : box->lower[d];
        box->upper[d] = x[d] > box->upper[d] ? x[d] : box->upper[d];
    }
}

static const struct surface_node SURFACE_EMPTY = {
    {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0, 0, 0};

/* Sorts triangles so that the first `answer` have their centres below the middle. */
static size_t surface_part(struct surface *surface, size_t first, size_t n)
{
    struct surface_node box = SURFACE_EMPTY;
    for (size_t i = first; i < first + n; i++)
        surface_widen(&box, (double[3]){surface_centre(surface, i, 0), surface_centre(surface, i, 1),
                                        surface_centre(surface, i, 2)});
    int axis = 0;
    for (int d = 1; d < 3; d++)
        if (box.upper[d] - box.lower[d] > box.upper[axis] - box.lower[axis]) axis = d;
    double middle = 0.5 * (box.lower[axis] + box.upper[axis]);
    size_t below = first;
    for (size_t i = first; i < first + n; i++) {
        if (!(surface_centre(surface, i, axis) < middle)) continue;
        size_t swap[3];
        memcpy(swap, surface->corner[i], sizeof swap);
        memcpy(surface->corner[i], surface->corner[below], sizeof swap);
        memcpy(surface->corner[below++], swap, sizeof swap);
    }
    below -= first;
    return below > 0 && below < n ? below : n / 2; /* all in one place: any half */
}

static void surface_grow(struct surface *surface, size_t first, size_t n)
{
    size_t at = surface->n_node++;
    struct surface_node *node = surface->node + at;
    *node = SURFACE_EMPTY;
    for (size_t i = first; i < first + n; i++)
        for (int k = 0; k < 3; k++) surface_widen(node, surface->vertex[surface->corner[i][k]]);
    if (n <= SURFACE_LEAF) {
        node->first = first;
        node->n = n;
        return;
    }
    size_t below = surface_part(surface, first, n);
    surface_grow(surface, first, below);
    node->right = surface->n_node;
    surface_grow(surface, first + below, n - below);
}

void surface_place(struct surface *surface, const double turn[3][3], double scale, const double offset[3])
{
    for (size_t i = 0; i < surface->n_vertex; i++) {
        double x[3];
        memcpy(x, surface->vertex[i], sizeof x);
        for (int d = 0; d < 3; d++)
            surface->vertex[i][d] = scale * (turn[d][0] * x[0] + turn[d][1] * x[1] + turn[d][2] * x[2]) + offset[d];
    }
    mem_free(surface->node);
    surface->n_node = 0;
    surface->node = mem_new(2 * surface->n, sizeof *surface->node);
    surface_grow(surface, 0, surface->n);
}

void surface_done(struct surface *surface)
{
    mem_free(surface->vertex);
    mem_free(surface->corner);
    mem_free(surface->node);
    *surface = (struct surface){0};
}

/* Distance */

static double surface_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Squared distance to a segment from a, `along` it. */
static double surface_to_edge(const double from[3], const double along[3])
{
    double square = surface_dot(along, along), s = square > 0.0 ? surface_dot(from, along) / square : 0.0, away[3];
    s = s < 0.0 ? 0.0 : s > 1.0 ? 1.0 : s;
    for (int d = 0; d < 3; d++) away[d] = from[d] - s * along[d];
    return surface_dot(away, away);
}

/* Squared distance to a triangle: to its plane where the foot lies in it, else to the nearest edge. */
static double surface_to_triangle(const struct surface *surface, size_t i, const double x[3])
{
    double from[3][3], along[3][3], least = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double *a = surface->vertex[surface->corner[i][k]], *b = surface->vertex[surface->corner[i][(k + 1) % 3]];
        for (int d = 0; d < 3; d++) {
            from[k][d] = x[d] - a[d];
            along[k][d] = b[d] - a[d];
        }
    }
    const double *u = along[0], *v = along[1];
    const double normal[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    double square = surface_dot(normal, normal);
    bool above = square > 0.0;
    for (int k = 0; k < 3; k++) {
        const double *e = along[k], *f = from[k];
        double side = normal[0] * (e[1] * f[2] - e[2] * f[1]) + normal[1] * (e[2] * f[0] - e[0] * f[2]) +
                      normal[2] * (e[0] * f[1] - e[1] * f[0]);
        above = above && side >= 0.0;
        double edge = surface_to_edge(f, e);
        least = edge < least ? edge : least;
    }
    double off = surface_dot(normal, from[0]);
    return above ? off * off / square : least;
}

static double surface_to_box(const struct surface_node *node, const double x[3])
{
    double square = 0.0;
    for (int d = 0; d < 3; d++) {
        double below = node->lower[d] - x[d], over = x[d] - node->upper[d], out = below > over ? below : over;
        if (out > 0.0) square += out * out;
    }
    return square;
}

/* The lesser of `least` and the squared distance to what a node holds. */
static double surface_nearest(const struct surface *surface, const struct surface_node *node, const double x[3],
                              double least)
{
    for (size_t i = node->first; i < node->first + node->n; i++) {
        double away = surface_to_triangle(surface, i, x);
        least = away < least ? away : least;
    }
    if (node->n) return least;
    const struct surface_node *near = node + 1, *far = surface->node + node->right;
    double to_near = surface_to_box(near, x), to_far = surface_to_box(far, x);
    if (to_far < to_near) {
        const struct surface_node *other = near;
        near = far;
        far = other;
        double swap = to_near;
        to_near = to_far;
        to_far = swap;
    }
    if (to_near < least) least = surface_nearest(surface, near, x, least);
    if (to_far < least) least = surface_nearest(surface, far, x, least);
    return least;
}

/* Inside or not */

/* How often the shadow of a triangle on the (y, z) plane runs around that of the point: 1, 0, -1. Each edge is computed
 * from its lower vertex number, and ends count on one side only, so that the triangles around a point share out the
 * plane. */
static int surface_turns(const struct surface *surface, const size_t corner[3], const double x[3])
{
    int turns = 0;
    for (int k = 0; k < 3; k++) {
        size_t from = corner[k], to = corner[(k + 1) % 3];
        const double *a = surface->vertex[from < to ? from : to], *b = surface->vertex[from < to ? to : from];
        if ((a[1] > x[1]) == (b[1] > x[1])) continue;
        if (!(a[2] + (x[1] - a[1]) * (b[2] - a[2]) / (b[1] - a[1]) > x[2])) continue;
        turns += surface->vertex[from][1] > x[1] ? 1 : -1;
    }
    return turns;
}

/* Does the ray from the point along +x meet the plane of a triangle? */
static bool surface_ahead(const struct surface *surface, const size_t corner[3], const double x[3])
{
    const double *a = surface->vertex[corner[0]], *b = surface->vertex[corner[1]], *c = surface->vertex[corner[2]];
    double u[3], v[3];
    for (int d = 0; d < 3; d++) {
        u[d] = b[d] - a[d];
        v[d] = c[d] - a[d];
    }
    double nx = u[1] * v[2] - u[2] * v[1], ny = u[2] * v[0] - u[0] * v[2], nz = u[0] * v[1] - u[1] * v[0];
    double off = nx * (a[0] - x[0]) + ny * (a[1] - x[1]) + nz * (a[2] - x[2]);
    return nx > 0.0 ? off > 0.0 : off < 0.0;
}

static int surface_winding(const struct surface *surface, const struct surface_node *node, const double x[3])
{
    if (x[1] < node->lower[1] || x[1] > node->upper[1] || x[2] < node->lower[2] || x[2] > node->upper[2] ||
        x[0] > node->upper[0])
        return 0;
    int sum = 0;
    for (size_t i = node->first; i < node->first + node->n; i++) {
        int turns = surface_turns(surface, surface->corner[i], x);
        if (turns && surface_ahead(surface, surface->corner[i], x)) sum += turns;
    }
    if (node->n) return sum;
    return surface_winding(surface, node + 1, x) + surface_winding(surface, surface->node + node->right, x);
}

double surface_level(const struct surface *surface, const double x[3])
{
    double away = sqrt(surface_nearest(surface, surface->node, x, INFINITY));
    return surface_winding(surface, surface->node, x) > 0 ? -away : away;
}

/* As a whole */

/* Tetrahedra from a point near by, so that round-off is that of the body and not of its place. */
double surface_volume(const struct surface *surface)
{
    const double *at = surface->vertex[0];
    double sum = 0.0;
    for (size_t i = 0; i < surface->n; i++) {
        double x[3][3];
        for (int k = 0; k < 3; k++)
            for (int d = 0; d < 3; d++) x[k][d] = surface->vertex[surface->corner[i][k]][d] - at[d];
        sum += x[0][0] * (x[1][1] * x[2][2] - x[1][2] * x[2][1]) + x[0][1] * (x[1][2] * x[2][0] - x[1][0] * x[2][2]) +
               x[0][2] * (x[1][0] * x[2][1] - x[1][1] * x[2][0]);
    }
    return sum / 6.0;
}

void surface_bounds(const struct surface *surface, double ret_lower[3], double ret_upper[3])
{
    for (int d = 0; d < 3; d++) {
        ret_lower[d] = INFINITY;
        ret_upper[d] = -INFINITY;
        for (size_t i = 0; i < surface->n_vertex; i++) {
            double x = surface->vertex[i][d];
            ret_lower[d] = x < ret_lower[d] ? x : ret_lower[d];
            ret_upper[d] = x > ret_upper[d] ? x : ret_upper[d];
        }
    }
}
