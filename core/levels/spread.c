/* spread.c - see spread.h. */
#include "levels/spread.h"

#include "base/mem.h"
#include "levels/spread_bear.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A cell gives at most this part of what it holds. */
#define SPREAD_PART 0.5

/* How often a load goes around before what is left stays. */
enum { SPREAD_SWEEPS = 4 };

/* A change on its way: per volume of the cell that it comes from. */
struct spread_load {
    double change[MODEL_FIELDS], volume, lever; /* lever: volume of what turns over that */
    double left;                                /* part that has no place yet */
};

/* Cells of a ring, and the part that each has room for. */
struct spread_ring {
    size_t n, *cells;
    double *room, *sorted;
};

double spread_volume(const struct spread *spread, unsigned q, size_t cell)
{
    size_t i = cell % (size_t)spread->mesh->n[0];
    if (q == spread->mesh->turns && q < spread->mesh->n_field) return spread->metric->turn_volume[i];
    return spread->mesh->beta ? spread->metric->volume[i] : 1.0;
}

static double spread_lever(const struct spread *spread, size_t cell)
{
    return spread_volume(spread, spread->mesh->turns, cell) / spread_volume(spread, 0, cell);
}

/* Largest part of factor * change that leaves fractions in [0, 1] and masses, energy and strains positive, at most 1;
 * of the first n fields where the pressure has a say. */
static double spread_room(const struct spread *spread, size_t cell, const double *change, double factor, unsigned n,
                          const double *delta)
{
    const struct model *model = spread->model;
    double room = 1.0;
    for (unsigned q = 0; q < model->n_field; q++) {
        size_t at = q * spread->mesh->n_cell + cell;
        double now = spread->u[at] + delta[at], step = factor * change[q], has = step < 0.0 ? now : 1.0 - now;
        bool fraction = q < model->n_alpha, bounded = q < model->i_u || q == model->i_E || model_is_inner(model, q);
        if (step == 0.0 || !bounded || (step > 0.0 && !fraction)) continue;
        has = has > 0.0 ? has : 0.0;
        if (has < room * fabs(step)) room = has / fabs(step);
    }
    if (!(room > 0.0)) return room;
    return spread_bear(model, spread->mesh->n_cell, spread->u + cell, delta + cell, n, factor, change, room);
}

static bool spread_is_leaf(const struct spread *spread, size_t cell)
{
    return !(spread->tile->covered >> mesh_octant(spread->mesh, cell) & 1u);
}

/* Collects what the cells at distance r (largest of the axes) from `at` have room for. */
static void spread_collect(const struct spread *spread, const int at[3], int r, const struct spread_load *load,
                           const double *delta, struct spread_ring *ring)
{
    const struct mesh *mesh = spread->mesh;
    int from[3], to[3], i[3];
    for (int d = 0; d < 3; d++) {
        from[d] = at[d] - r > 0 ? at[d] - r : 0;
        to[d] = at[d] + r < mesh->n[d] - 1 ? at[d] + r : mesh->n[d] - 1;
    }
    ring->n = 0;
    for (i[2] = from[2]; i[2] <= to[2]; i[2]++)
        for (i[1] = from[1]; i[1] <= to[1]; i[1]++)
            for (i[0] = from[0]; i[0] <= to[0]; i[0]++) {
                bool on = abs(i[0] - at[0]) == r || abs(i[1] - at[1]) == r || abs(i[2] - at[2]) == r;
                size_t cell = (size_t)(i[0] + mesh->n[0] * (i[1] + mesh->n[1] * i[2]));
                if (!on || spread->trouble[cell] != SPREAD_NONE || !spread_is_leaf(spread, cell)) continue;
                double factor = load->volume / spread_volume(spread, 0, cell);
                ring->cells[ring->n] = cell;
                ring->room[ring->n++] =
                    SPREAD_PART * spread_room(spread, cell, load->change, factor, spread->model->i_V, delta);
            }
}

static int spread_compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The sum does not depend on the order of the cells: mirrored tiles stay mirrored. */
static double spread_total(const struct spread_ring *ring)
{
    double sum = 0.0;
    for (size_t i = 0; i < ring->n; i++) ring->sorted[i] = ring->room[i];
    qsort(ring->sorted, ring->n, sizeof *ring->sorted, spread_compare);
    for (size_t i = 0; i < ring->n; i++) sum += ring->sorted[i];
    return sum;
}

/* Of the first n fields. lever: what more of the field that turns. */
static void spread_add(const struct spread *spread, size_t cell, unsigned n, double factor, double lever,
                       const double *change, double *delta)
{
    for (unsigned q = 0; q < n; q++)
        delta[q * spread->mesh->n_cell + cell] += (q == spread->mesh->turns ? factor * lever : factor) * change[q];
}

/* Places what it can of a load in a ring. */
static void spread_place(const struct spread *spread, const struct spread_ring *ring, struct spread_load *load,
                         double *delta)
{
    double total = spread_total(ring), share = total > load->left ? load->left / total : 1.0;
    for (size_t i = 0; i < ring->n; i++) {
        size_t cell = ring->cells[i];
        double factor = share * ring->room[i] * load->volume / spread_volume(spread, 0, cell);
        double lever = load->lever / spread_lever(spread, cell);
        if (factor > 0.0) spread_add(spread, cell, spread->model->i_V, factor, lever, load->change, delta);
    }
    load->left = total > load->left ? 0.0 : load->left - total;
}

/* Ring by ring from distance `first` on. */
static void spread_around(const struct spread *spread, size_t cell, int first, struct spread_load *load,
                          struct spread_ring *ring, double *delta)
{
    const struct mesh *mesh = spread->mesh;
    size_t n0 = (size_t)mesh->n[0], n1 = (size_t)mesh->n[1];
    int at[3] = {(int)(cell % n0), (int)(cell / n0 % n1), (int)(cell / n0 / n1)};
    for (int sweep = 0; sweep < SPREAD_SWEEPS; sweep++)
        for (int r = first; load->left > 0.0 && r < mesh->n[0]; r++) {
            spread_collect(spread, at, r, load, delta, ring);
            spread_place(spread, ring, load, delta);
        }
}

/* Gives a cell with trouble `part` of the room it has. */
static void spread_keep(const struct spread *spread, size_t cell, double part, struct spread_load *load, double *delta)
{
    double keep = part * spread_room(spread, cell, load->change, 1.0, spread->model->n_field, delta);
    if (spread->trouble[cell] != SPREAD_HALF) return;
    keep = keep < load->left ? keep : load->left;
    spread_add(spread, cell, spread->model->n_field, keep, 1.0, load->change, delta);
    load->left -= keep;
}

static bool spread_cell(const struct spread *spread, size_t cell, struct spread_ring *ring, double *delta, double *rest)
{
    size_t n_cell = spread->mesh->n_cell;
    struct spread_load load = {.volume = spread_volume(spread, 0, cell),
                               .lever = spread_lever(spread, cell),
                               .left = 1.0};
    double any = 0.0;
    for (unsigned q = 0; q < spread->model->n_field; q++) {
        double *change = &delta[q * n_cell + cell];
        load.change[q] = *change;
        any += fabs(*change);
        *change = 0.0;
    }
    if (any == 0.0) return false;
    spread_keep(spread, cell, SPREAD_PART, &load, delta);
    spread_around(spread, cell, 1, &load, ring, delta);
    spread_keep(spread, cell, 1.0, &load, delta);
    for (unsigned q = 0; q < spread->model->i_V; q++) rest[q * n_cell + cell] = load.left * load.change[q];
    return load.left > 0.0;
}

static struct spread_ring spread_ring_new(size_t n_cell)
{
    return (struct spread_ring){.cells = mem_new(n_cell, sizeof(size_t)),
                                .room = mem_new(n_cell, sizeof(double)),
                                .sorted = mem_new(n_cell, sizeof(double))};
}

static void spread_ring_free(struct spread_ring *ring)
{
    mem_free(ring->cells);
    mem_free(ring->room);
    mem_free(ring->sorted);
}

bool spread_change(const struct spread *spread, double *delta, double *rest)
{
    size_t n_cell = spread->mesh->n_cell;
    struct spread_ring ring = spread_ring_new(n_cell);
    bool any = false;
    for (size_t cell = 0; cell < n_cell; cell++)
        if (spread->trouble[cell] != SPREAD_NONE) any = spread_cell(spread, cell, &ring, delta, rest) || any;
    spread_ring_free(&ring);
    return any;
}

/* Gives an amount of field q to all leaves in proportion to the partial densities from .. from + many: with one, what
 * is there of a material shrinks or grows by one factor. False: there is too little. */
static bool spread_scale(const struct spread *spread, unsigned q, unsigned from, unsigned many, double amount,
                         double *weight, double *delta)
{
    size_t n_cell = spread->mesh->n_cell;
    double total = 0.0;
    for (size_t cell = 0; cell < n_cell; cell++) {
        weight[cell] = 0.0;
        for (unsigned l = from; spread_is_leaf(spread, cell) && l < from + many; l++) {
            double m = spread->u[l * n_cell + cell] + delta[l * n_cell + cell];
            weight[cell] += m > 0.0 ? m : 0.0;
        }
        total += weight[cell] * spread_volume(spread, q, cell);
    }
    if (!(total > 0.0) || (many == 1 && total + amount < 0.0)) return false;
    for (size_t cell = 0; cell < n_cell; cell++) {
        size_t fraction = (from - spread->model->i_m) * n_cell + cell;
        delta[q * n_cell + cell] += amount * weight[cell] / total;
        if (many == 1 && spread->model->n_alpha && weight[cell] > 0.0) /* its density stays */
            delta[fraction] += (spread->u[fraction] + delta[fraction]) * (amount / total);
    }
    return true;
}

/* What has no room as a whole, field by field; fractions go with the masses. */
static void spread_scatter(const struct spread *spread, size_t cell, const struct spread_load *load, double *weight,
                           double *delta)
{
    const struct model *model = spread->model;
    for (unsigned q = model->i_V; q-- > model->i_m;) { /* masses last: they are the weights */
        double amount = load->left * load->change[q];
        bool mass = q < model->i_u;
        if (amount == 0.0) continue;
        if (!spread_scale(spread, q, mass ? q : model->i_m, mass ? 1 : model->n_material, amount, weight, delta))
            delta[q * spread->mesh->n_cell + cell] += amount / spread_volume(spread, q, cell);
    }
}

void spread_amount(const struct spread *spread, size_t cell, const double *amount, double *delta)
{
    struct spread_ring ring = spread_ring_new(spread->mesh->n_cell);
    struct spread_load load = {.volume = 1.0, .lever = 1.0, .left = 1.0};
    memcpy(load.change, amount, spread->model->i_V * sizeof *amount);
    spread_around(spread, cell, 0, &load, &ring, delta);
    if (load.left > 0.0) spread_scatter(spread, cell, &load, ring.room, delta);
    spread_ring_free(&ring);
}
