/* overlap.c - see overlap.h. Cells are found by their place on the lattice of their own width, through a table of
 * slots. */
#include "judge/overlap.h"

#include "base/mem.h"
#include "base/slots.h"
#include "base/status.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* The place of a cell: `level` counts from the finest width of both meshes up. */
struct overlap_key {
    int64_t at[3];
    int level;
};

struct overlap_table {
    const struct snapshot *snapshot;
    double finest[3]; /* widths at level 0 */
    int levels;
    struct slots slots;
};

static double overlap_size(const struct snapshot *snapshot, size_t cell)
{
    double size = 1.0;
    for (int d = 0; d < snapshot->dim; d++) size *= snapshot->upper[cell][d] - snapshot->lower[cell][d];
    return size;
}

static struct overlap_key overlap_key(const struct overlap_table *table, const struct snapshot *snapshot, size_t cell)
{
    struct overlap_key key = {0};
    key.level = (int)lround(log2((snapshot->upper[cell][0] - snapshot->lower[cell][0]) / table->finest[0]));
    for (int d = 0; d < snapshot->dim; d++)
        key.at[d] = llround((snapshot->lower[cell][d] - snapshot->domain[0][d]) / ldexp(table->finest[d], key.level));
    return key;
}

static bool overlap_is_at(const void *data, unsigned cell, const void *wanted)
{
    const struct overlap_table *table = data;
    const struct overlap_key key = overlap_key(table, table->snapshot, cell), *other = wanted;
    return key.level == other->level && !memcmp(key.at, other->at, sizeof key.at);
}

/* The slot of a cell at `key`. */
static unsigned *overlap_slot(const struct overlap_table *table, const struct overlap_key *key)
{
    uint64_t hash = slots_hash(0, (uint64_t)key->level);
    for (int d = 0; d < 3; d++) hash = slots_hash(hash, (uint64_t)key->at[d]);
    return slots_find(&table->slots, hash, overlap_is_at, table, key);
}

static void overlap_fill(struct overlap_table *table)
{
    slots_start(&table->slots, table->snapshot->n_cell);
    for (size_t c = 0; c < table->snapshot->n_cell; c++) {
        struct overlap_key key = overlap_key(table, table->snapshot, c);
        if (key.level >= table->levels) table->levels = key.level + 1;
        *overlap_slot(table, &key) = (unsigned)c + 1;
    }
}

/* The cell of the table's snapshot that holds a cell of the other one, at least `coarser` levels above; false: its
 * cells are finer there. */
static bool overlap_find(const struct overlap_table *table, const struct snapshot *other, size_t cell, int coarser,
                         size_t *ret_cell)
{
    struct overlap_key key = overlap_key(table, other, cell);
    for (int step = 0; key.level < table->levels; step++) {
        unsigned found = step >= coarser ? *overlap_slot(table, &key) : 0;
        if (found) {
            *ret_cell = found - 1;
            return true;
        }
        for (int d = 0; d < 3; d++) key.at[d] /= 2;
        key.level++;
    }
    return false;
}

/* What is summed in the cells of one snapshot. */
struct overlap_sums {
    double *value, *size;
};

/* Sums `fine` over those cells of the table's snapshot that hold its cells. */
static int overlap_add(const struct overlap_table *table, const struct overlap_side *fine, int coarser,
                       struct overlap_sums *sums)
{
    const struct snapshot *coarse = table->snapshot;
    for (size_t c = 0; c < fine->snapshot->n_cell; c++) {
        size_t at;
        if (!overlap_find(table, fine->snapshot, c, coarser, &at)) continue;
        double part = overlap_size(fine->snapshot, c);
        sums->value[at] += part * fine->values[c * fine->stride];
        sums->size[at] += part;
    }
    for (size_t c = 0; c < coarse->n_cell; c++)
        if (sums->size[c] > 0.0 && fabs(sums->size[c] / overlap_size(coarse, c) - 1.0) > 1e-6)
            return status_fail(STATUS_CASE, "the cells of the two snapshots do not lie on one lattice");
    return STATUS_OK;
}

/* The smallest widths of the cells of both. */
static void overlap_widths(const struct snapshot *a, const struct snapshot *b, double ret_finest[3])
{
    const struct snapshot *both[2] = {a, b};
    for (int d = 0; d < a->dim; d++) ret_finest[d] = a->upper[0][d] - a->lower[0][d];
    for (int i = 0; i < 2; i++)
        for (size_t c = 0; c < both[i]->n_cell; c++)
            for (int d = 0; d < a->dim; d++) {
                double width = both[i]->upper[c][d] - both[i]->lower[c][d];
                if (width < ret_finest[d]) ret_finest[d] = width;
            }
}

/* Visits the cells of `coarse` that hold cells of `fine`, at least `coarser` levels finer. */
static int overlap_half(const struct overlap_side *coarse, const struct overlap_side *fine, int coarser,
                        void (*visit)(void *data, double size, double value, double mean), void *data, double *volume)
{
    size_t n = coarse->snapshot->n_cell;
    struct overlap_table table = {.snapshot = coarse->snapshot};
    struct overlap_sums sums = {mem_new(n, sizeof(double)), mem_new(n, sizeof(double))};
    overlap_widths(coarse->snapshot, fine->snapshot, table.finest);
    overlap_fill(&table);
    int code = overlap_add(&table, fine, coarser, &sums);
    for (size_t c = 0; !code && c < n; c++) {
        if (sums.size[c] <= 0.0) continue;
        visit(data, sums.size[c], coarse->values[c * coarse->stride], sums.value[c] / sums.size[c]);
        *volume += sums.size[c];
    }
    mem_free(sums.value);
    mem_free(sums.size);
    slots_done(&table.slots);
    return code;
}

int overlap_visit(const struct overlap_side *a, const struct overlap_side *b,
                  void (*visit)(void *data, double size, double one, double other), void *data)
{
    double volume = 0.0, domain = 1.0;
    for (int d = 0; d < a->snapshot->dim; d++) domain *= a->snapshot->domain[1][d] - a->snapshot->domain[0][d];
    TRY(overlap_half(a, b, 0, visit, data, &volume));
    TRY(overlap_half(b, a, 1, visit, data, &volume));
    if (fabs(volume / domain - 1.0) > 1e-6)
        return status_fail(STATUS_CASE, "the cells of the two snapshots do not lie on one lattice");
    return STATUS_OK;
}
