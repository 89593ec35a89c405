/* surface_check.c - is a surface closed? See surface.h. */
#include "case/surface.h"

#include "base/mem.h"
#include "base/status.h"

#include <stdlib.h>
#include <string.h>

/* An edge with its ends in rising order; way 1: the triangle runs along it so, -1: against it. */
struct surface_check_edge {
    size_t ends[2];
    int way;
};

static int surface_check_edge_order(const void *first, const void *second)
{
    const struct surface_check_edge *a = first, *b = second;
    if (a->ends[0] != b->ends[0]) return a->ends[0] < b->ends[0] ? -1 : 1;
    return a->ends[1] < b->ends[1] ? -1 : a->ends[1] > b->ends[1];
}

static struct surface_check_edge *surface_check_edges(const struct surface *surface)
{
    struct surface_check_edge *edges = mem_new(3 * surface->n, sizeof *edges), *edge = edges;
    for (size_t i = 0; i < surface->n; i++)
        for (int k = 0; k < 3; k++, edge++) {
            size_t from = surface->corner[i][k], to = surface->corner[i][(k + 1) % 3];
            *edge =
                from < to ? (struct surface_check_edge){{from, to}, 1} : (struct surface_check_edge){{to, from}, -1};
        }
    qsort(edges, 3 * surface->n, sizeof *edges, surface_check_edge_order);
    return edges;
}

int surface_check(const struct surface *surface)
{
    struct surface_check_edge *edges = surface_check_edges(surface);
    size_t holes = 0, twisted = 0, where = 0, n = 3 * surface->n;
    for (size_t i = 0, k; i < n; i = k) {
        int ways = 0;
        for (k = i; k < n && surface_check_edge_order(edges + i, edges + k) == 0; k++) ways += edges[k].way;
        if (!ways) continue;
        if (holes + twisted == 0) where = i;
        *((k - i) % 2 ? &holes : &twisted) += 1;
    }
    int code = STATUS_OK;
    if (holes + twisted) {
        const double *a = surface->vertex[edges[where].ends[0]], *b = surface->vertex[edges[where].ends[1]];
        code = status_fail(STATUS_CASE,
                           "the surface is not closed: %zu of its edges belong to one triangle alone, at %zu two "
                           "neighbours are wound against each other; one runs from (%g, %g, %g) to (%g, %g, %g); "
                           "meshlab and admesh mend such files",
                           holes, twisted, a[0], a[1], a[2], b[0], b[1], b[2]);
    }
    mem_free(edges);
    return code;
}
