/* contour_dual.c - vertices are found through a table of slots by lattice positions.
 *
 * The lattice has the spacing of the smallest cell. Each cell first registers at its four
 * corners; then, where a vertex lies in the middle of one of its edges (a neighbour is one level
 * finer), it registers there in both quadrants that it covers. */
#include "view/contour_dual.h"

#include "base/mem.h"
#include "base/slots.h"

#include <math.h>
#include <string.h>

/* Quadrant of the cell, seen from its corner at (side x, side y): the cell lies on the other side. */
static const int contour_dual_quadrant[2][2] = {{2, 1}, {3, 0}};

struct contour_dual_table {
    size_t n, capacity;
    struct slots slots; /* of the vertices */
    struct contour_dual_vertex *vertices;
    double origin[2], step[2];
};

static int64_t contour_dual_key(const struct contour_dual_table *table, int axis, double x)
{
    return llround((x - table->origin[axis]) / table->step[axis]);
}

static bool contour_dual_is_at(const void *vertices, unsigned index, const void *key)
{
    return !memcmp(((const struct contour_dual_vertex *)vertices)[index].key, key, sizeof(int64_t[2]));
}

/* The vertex at `key`; with `add` made if it is not there, else NULL. */
static struct contour_dual_vertex *contour_dual_get(struct contour_dual_table *table, const int64_t key[2], int add)
{
    uint64_t hash = slots_hash(slots_hash(0, (uint64_t)key[0]), (uint64_t)key[1]);
    unsigned *slot = slots_find(&table->slots, hash, contour_dual_is_at, table->vertices, key);
    if (*slot) return &table->vertices[*slot - 1];
    if (!add) return NULL;
    if (table->n == table->capacity) {
        table->capacity = 2 * table->n;
        table->vertices = mem_grow(table->vertices, table->n, table->capacity, sizeof *table->vertices);
    }
    struct contour_dual_vertex *vertex = &table->vertices[table->n++];
    *slot = (unsigned)table->n;
    for (int axis = 0; axis < 2; axis++) {
        vertex->key[axis] = key[axis];
        vertex->at[axis] = table->origin[axis] + table->step[axis] * (double)key[axis];
    }
    for (int q = 0; q < 4; q++) vertex->cell[q] = CONTOUR_DUAL_NONE;
    return vertex;
}

static void contour_dual_corners(struct contour_dual_table *table, long c, const struct raster_cell *cell)
{
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            int64_t key[2] = {contour_dual_key(table, 0, cell->at[0][i]), contour_dual_key(table, 1, cell->at[1][j])};
            contour_dual_get(table, key, 1)->cell[contour_dual_quadrant[i][j]] = c;
        }
}

/* Middles of the two edges of the cell that are normal to `axis`. */
static void contour_dual_edges(struct contour_dual_table *table, long c, const struct raster_cell *cell, int axis)
{
    int along = 1 - axis;
    int64_t lo = contour_dual_key(table, along, cell->at[along][0]),
            hi = contour_dual_key(table, along, cell->at[along][1]);
    if ((hi - lo) % 2) return; /* a smallest cell has no finer neighbour */
    for (int side = 0; side < 2; side++) {
        int64_t key[2];
        key[axis] = contour_dual_key(table, axis, cell->at[axis][side]);
        key[along] = (lo + hi) / 2;
        struct contour_dual_vertex *vertex = contour_dual_get(table, key, 0);
        if (!vertex) continue;
        for (int other = 0; other < 2; other++) {
            int corner[2];
            corner[axis] = side;
            corner[along] = other;
            vertex->cell[contour_dual_quadrant[corner[0]][corner[1]]] = c;
        }
    }
}

static void contour_dual_lattice(struct contour_dual_table *table, size_t n, const struct raster_cell *cells)
{
    for (int axis = 0; axis < 2; axis++) {
        table->origin[axis] = cells[0].at[axis][0];
        table->step[axis] = cells[0].at[axis][1] - cells[0].at[axis][0];
        for (size_t c = 1; c < n; c++) {
            double size = cells[c].at[axis][1] - cells[c].at[axis][0];
            if (size < table->step[axis]) table->step[axis] = size;
        }
    }
}

void contour_dual_build(size_t n, const struct raster_cell *cells, struct contour_dual *ret_dual)
{
    *ret_dual = (struct contour_dual){0};
    if (!n) return;
    struct contour_dual_table table = {.capacity = n + n / 4 + 16};
    slots_start(&table.slots, 4 * n); /* at most four vertices per cell */
    table.vertices = mem_new(table.capacity, sizeof *table.vertices);
    contour_dual_lattice(&table, n, cells);
    for (size_t c = 0; c < n; c++) contour_dual_corners(&table, (long)c, &cells[c]);
    for (size_t c = 0; c < n; c++)
        for (int axis = 0; axis < 2; axis++) contour_dual_edges(&table, (long)c, &cells[c], axis);
    slots_done(&table.slots);
    ret_dual->n = table.n;
    ret_dual->vertices = table.vertices;
}

void contour_dual_done(struct contour_dual *dual)
{
    mem_free(dual->vertices);
    *dual = (struct contour_dual){0};
}
