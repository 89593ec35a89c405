/* contour.c - marching over dual polygons, then joining the pieces.
 *
 * Each polygon gives directed pieces with the high side on their right. A crossing is known by
 * the two nodes (cells, or their images on the outer edge) between which it lies, not by its
 * coordinates: so pieces join exactly. */
#include "view/contour.h"

#include "base/mem.h"
#include "view/contour_dual.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

struct contour_node {
    long id;
    double at[2], value;
};

struct contour_crossing {
    long key[2];
    double at[2];
};

struct contour_piece {
    struct contour_crossing from, to;
};

struct contour_pieces {
    size_t n, capacity;
    struct contour_piece *at;
};

enum { CONTOUR_NODES = 8 };

static struct contour_node contour_centre(const struct raster_cell *cells, const double *values, long c)
{
    const struct raster_cell *cell = &cells[c];
    return (struct contour_node){c,
                                 {0.5 * (cell->at[0][0] + cell->at[0][1]), 0.5 * (cell->at[1][0] + cell->at[1][1])},
                                 values[c]};
}

/* The image of a cell centre on the outer edge that leaves the vertex along ray `ray` (down, right, up, left). */
static struct contour_node contour_image(struct contour_node node, const struct contour_dual_vertex *vertex, int ray,
                                         size_t n)
{
    int axis = ray % 2;
    node.at[axis] = vertex->at[axis];
    node.id = (long)n + 4 * node.id + ray;
    return node;
}

/* The polygon around a vertex, anticlockwise; returns its number of nodes. */
static int contour_polygon(const struct contour_dual_vertex *vertex, size_t n, const struct raster_cell *cells,
                           const double *values, struct contour_node ret_nodes[CONTOUR_NODES])
{
    int count = 0;
    for (int q = 0; q < 4; q++) {
        int before = (q + 3) % 4, after = (q + 1) % 4;
        if (vertex->cell[q] == CONTOUR_DUAL_NONE) continue;
        struct contour_node node = contour_centre(cells, values, vertex->cell[q]);
        if (vertex->cell[before] == CONTOUR_DUAL_NONE) ret_nodes[count++] = contour_image(node, vertex, before, n);
        if (vertex->cell[before] != vertex->cell[q]) ret_nodes[count++] = node;
        if (vertex->cell[after] == CONTOUR_DUAL_NONE) ret_nodes[count++] = contour_image(node, vertex, q, n);
    }
    return count;
}

static struct contour_crossing contour_between(const struct contour_node *a, const struct contour_node *b, double level)
{
    double s = (level - a->value) / (b->value - a->value);
    struct contour_crossing crossing = {{a->id, b->id}, {0}};
    if (a->id > b->id) {
        crossing.key[0] = b->id;
        crossing.key[1] = a->id;
    }
    for (int axis = 0; axis < 2; axis++) crossing.at[axis] = a->at[axis] + s * (b->at[axis] - a->at[axis]);
    return crossing;
}

static void contour_add(struct contour_pieces *pieces, struct contour_crossing from, struct contour_crossing to)
{
    if (pieces->n == pieces->capacity) {
        pieces->capacity = pieces->capacity ? 2 * pieces->capacity : 256;
        pieces->at = mem_grow(pieces->at, pieces->n, pieces->capacity, sizeof *pieces->at);
    }
    pieces->at[pieces->n++] = (struct contour_piece){from, to};
}

/* Every stretch of low nodes between two high ones gives one piece; at a saddle the mean says
 * whether the low or the high corners are cut off. */
static void contour_march(const struct contour_node *nodes, int count, double level, struct contour_pieces *pieces)
{
    struct contour_crossing down[CONTOUR_NODES], up[CONTOUR_NODES];
    int n_down = 0, n_up = 0;
    double mean = 0.0;
    for (int i = 0; i < count; i++) {
        const struct contour_node *a = &nodes[i], *b = &nodes[(i + 1) % count];
        mean += a->value / count;
        if (a->value >= level && b->value < level) down[n_down++] = contour_between(a, b, level);
        if (a->value < level && b->value >= level) up[n_up++] = contour_between(a, b, level);
    }
    if (n_down != n_up || !isfinite(mean)) return;
    bool down_first = nodes[0].value >= level;
    int shift = mean >= level ? !down_first : down_first; /* cut off the low corners : the high ones */
    for (int i = 0; i < n_down; i++) contour_add(pieces, down[i], up[(i + (n_down > 1 ? shift : 0)) % n_up]);
}

static int contour_compare(const void *left, const void *right)
{
    const struct contour_crossing *a = &((const struct contour_piece *)left)->from;
    const struct contour_crossing *b = &((const struct contour_piece *)right)->from;
    if (a->key[0] != b->key[0]) return a->key[0] < b->key[0] ? -1 : 1;
    return a->key[1] < b->key[1] ? -1 : a->key[1] > b->key[1];
}

/* The piece that starts where piece `i` ends; pieces->n if none does. */
static size_t contour_next(const struct contour_pieces *pieces, size_t i)
{
    struct contour_piece wanted = {.from = pieces->at[i].to};
    const struct contour_piece *found = bsearch(&wanted, pieces->at, pieces->n, sizeof wanted, contour_compare);
    return found ? (size_t)(found - pieces->at) : pieces->n;
}

static void contour_follow(const struct contour_pieces *pieces, size_t start, bool *used, struct contour_line *line)
{
    size_t capacity = 64;
    *line = (struct contour_line){.at = mem_new(capacity, sizeof *line->at)};
    for (size_t i = start; i < pieces->n && !used[i]; i = contour_next(pieces, i)) {
        used[i] = true;
        if (line->n + 2 > capacity) {
            line->at = mem_grow(line->at, capacity, 2 * capacity, sizeof *line->at);
            capacity *= 2;
        }
        const double *from = pieces->at[i].from.at, *to = pieces->at[i].to.at;
        for (int axis = 0; axis < 2; axis++) {
            line->at[line->n][axis] = from[axis];
            line->at[line->n + 1][axis] = to[axis];
        }
        line->n++;
        line->length += hypot(to[0] - from[0], to[1] - from[1]);
    }
    line->n++; /* the end of the last piece */
}

static void contour_join(struct contour_pieces *pieces, struct contour *contour)
{
    if (!pieces->n) return;
    qsort(pieces->at, pieces->n, sizeof *pieces->at, contour_compare);
    bool *used = mem_new(pieces->n, sizeof *used), *inner = mem_new(pieces->n, sizeof *inner);
    for (size_t i = 0; i < pieces->n; i++) {
        size_t next = contour_next(pieces, i);
        if (next < pieces->n) inner[next] = true;
    }
    contour->lines = mem_new(pieces->n, sizeof *contour->lines);
    for (int closed = 0; closed < 2; closed++) /* open lines from their start, then rings from anywhere */
        for (size_t i = 0; i < pieces->n; i++)
            if (!used[i] && (closed || !inner[i])) contour_follow(pieces, i, used, &contour->lines[contour->n_line++]);
    mem_free(used);
    mem_free(inner);
}

void contour_find(size_t n, const struct raster_cell *cells, const double *values, double level,
                  struct contour *ret_contour)
{
    struct contour_dual dual;
    struct contour_pieces pieces = {0};
    contour_dual_build(n, cells, &dual);
    for (size_t v = 0; v < dual.n; v++) {
        struct contour_node nodes[CONTOUR_NODES];
        int count = contour_polygon(&dual.vertices[v], n, cells, values, nodes);
        contour_march(nodes, count, level, &pieces);
    }
    contour_dual_done(&dual);
    *ret_contour = (struct contour){0};
    contour_join(&pieces, ret_contour);
    mem_free(pieces.at);
}

double contour_length(const struct contour *contour)
{
    double length = 0.0;
    for (size_t i = 0; i < contour->n_line; i++) length += contour->lines[i].length;
    return length;
}

void contour_done(struct contour *contour)
{
    for (size_t i = 0; i < contour->n_line; i++) mem_free(contour->lines[i].at);
    mem_free(contour->lines);
    *contour = (struct contour){0};
}
