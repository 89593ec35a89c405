/* surface_fraction.c - the volume of a cell inside a surface, by columns along x: see surface.h. */
#include "case/surface.h"

#include <string.h>

enum { SURFACE_CORNERS = 9 }; /* a triangle cut by five planes has eight */

/* A plane polygon in space. */
struct surface_fraction_patch {
    int n;
    double x[SURFACE_CORNERS][3];
};

/* Keeps what lies on one side of a plane across an axis: above `at` for sign 1, below it for -1 (Sutherland & Hodgman
 * 1974, Commun. ACM 17, 32). */
static void surface_fraction_cut(struct surface_fraction_patch *patch, int axis, double at, double sign)
{
    struct surface_fraction_patch kept = {0};
    for (int k = 0; k < patch->n; k++) {
        const double *a = patch->x[k], *b = patch->x[k + 1 < patch->n ? k + 1 : 0];
        double from = sign * (a[axis] - at), to = sign * (b[axis] - at);
        if (from >= 0.0) memcpy(kept.x[kept.n++], a, sizeof *kept.x);
        if ((from >= 0.0) == (to >= 0.0)) continue;
        for (int d = 0; d < 3; d++) kept.x[kept.n][d] = a[d] + (b[d] - a[d]) * (from / (from - to));
        kept.x[kept.n++][axis] = at;
    }
    *patch = kept;
}

/* The integral of max(x - from, 0) over the patch's shadow on the (y, z) plane; positive if x points out of its
 * front. */
static double surface_fraction_column(const struct surface_fraction_patch *patch, double from)
{
    struct surface_fraction_patch above = *patch;
    surface_fraction_cut(&above, 0, from, 1.0);
    double sum = 0.0;
    for (int k = 1; k + 1 < above.n; k++) {
        const double *a = above.x[0], *b = above.x[k], *c = above.x[k + 1];
        double area = 0.5 * ((b[1] - a[1]) * (c[2] - a[2]) - (c[1] - a[1]) * (b[2] - a[2]));
        sum += area * (((a[0] - from) + (b[0] - from) + (c[0] - from)) / 3.0);
    }
    return sum;
}

static double surface_fraction_columns(const struct surface *surface, const struct surface_node *node,
                                       const struct shape_cell *cell)
{
    if (node->upper[0] <= cell->lower[0]) return 0.0;
    for (int d = 1; d < 3; d++)
        if (node->upper[d] <= cell->lower[d] || node->lower[d] >= cell->upper[d]) return 0.0;
    double sum = 0.0;
    for (size_t i = node->first; i < node->first + node->n; i++) {
        struct surface_fraction_patch patch = {.n = 3};
        for (int k = 0; k < 3; k++) memcpy(patch.x[k], surface->vertex[surface->corner[i][k]], sizeof *patch.x);
        for (int d = 1; d < 3; d++) {
            surface_fraction_cut(&patch, d, cell->lower[d], 1.0);
            surface_fraction_cut(&patch, d, cell->upper[d], -1.0);
        }
        sum += surface_fraction_column(&patch, cell->lower[0]) - surface_fraction_column(&patch, cell->upper[0]);
    }
    if (node->n) return sum;
    return surface_fraction_columns(surface, node + 1, cell) +
           surface_fraction_columns(surface, surface->node + node->right, cell);
}

double surface_fraction(const struct surface *surface, const struct shape_cell *cell)
{
    double whole = 1.0;
    for (int d = 0; d < 3; d++) whole *= cell->upper[d] - cell->lower[d];
    double fraction = surface_fraction_columns(surface, surface->node, cell) / whole;
    return fraction < 0.0 ? 0.0 : fraction > 1.0 ? 1.0 : fraction;
}
