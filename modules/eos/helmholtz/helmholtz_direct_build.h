/* helmholtz_direct_build.h - makes the table of helmholtz_direct.h, from a table of the potential that was made before
 * it in the same block. Slopes at the nodes are differences of fourth order: what they miss is less than what a cubic
 * does. */
#ifndef HELMHOLTZ_DIRECT_BUILD_H
#define HELMHOLTZ_DIRECT_BUILD_H

#include "helmholtz_build.h"
#include "helmholtz_rows.h"

/* Nodes of the table of the potential that direct tables are made from; states at which a table is measured. */
enum { HELMHOLTZ_SCAFFOLD = 192, HELMHOLTZ_SAMPLES = 1500 };

static size_t helmholtz_direct_count(int n, int cubic)
{
    size_t nodes = (size_t)n * (size_t)n, numbers = cubic ? 4 : 1;
    return nodes * HELMHOLTZ_FIELDS * (1 + numbers) + helmholtz_band_count(n);
}

/* The table whose numbers are in the block. */
static struct helmholtz_direct helmholtz_direct_in(const struct helmholtz_law *law, int n, int cubic, double *block)
{
    size_t nodes = (size_t)n * (size_t)n, numbers = cubic ? 4 : 1;
    struct helmholtz_direct table = {.n = n, .cubic = cubic, .steps = helmholtz_steps_of(n), .state = block};
    table.warm = table.state + 2 * numbers * nodes;
    table.value = table.warm + numbers * nodes;
    table.band = helmholtz_band_in(law, n, law->blur, table.value + HELMHOLTZ_FIELDS * nodes);
    return table;
}

/* e, c^2 and T at the nodes of row i. */
static void helmholtz_direct_values(const struct helmholtz *from, const struct helmholtz_direct *table, int i)
{
    enum { MOST = 128 };
    const struct helmholtz_band *band = &table->band;
    size_t n = (size_t)table->n, nodes = n * n, row = (size_t)i * n;
    double rho[MOST], p[MOST], rho_e[MOST], rho_c2[MOST], T[MOST], side[MOST];
    double density = helmholtz_held(&from->ends, helmholtz_band_rho(band, i));
    double f0 = helmholtz_band_node(band, i, 0), s = helmholtz_band_node(band, i, 1);
    for (size_t first = 0; first < n; first += MOST) {
        size_t m = n - first < MOST ? n - first : MOST;
        for (size_t k = 0; k < m; k++) {
            double y = table->steps.y_0 + (double)(first + k) / table->steps.per_y;
            rho[k] = density;
            p[k] = density * (f0 + y * y / s);
        }
        const double *const in[2] = {rho, p};
        helmholtz_blocks_ask(from, HELMHOLTZ_STATE, m, in, (double *const[2]){rho_e, rho_c2});
        helmholtz_blocks_ask(from, HELMHOLTZ_THERMAL, m, in, (double *const[2]){T, side});
        for (size_t k = 0; k < m; k++) {
            double *at = table->value + row + first + k;
            at[HELMHOLTZ_E * nodes] = rho_e[k] / density;
            at[HELMHOLTZ_C2 * nodes] = rho_c2[k] / density;
            at[HELMHOLTZ_WARM * nodes] = T[k];
        }
    }
}

/* The node (i, k) of one field: its value, and its slopes per spacing in rho, in y, in both. */
static void helmholtz_direct_node(const double *value, int n, int cubic, int i, int k, double *ret_node)
{
    double slope[5];
    int first = i < 2 ? 0 : i > n - 3 ? n - 5 : i - 2;
    ret_node[0] = value[(ptrdiff_t)i * n + k];
    if (!cubic) return;
    for (int r = 0; r < 5; r++) slope[r] = helmholtz_band_slope(value + (ptrdiff_t)(first + r) * n, k, n, 1);
    ret_node[1] = helmholtz_band_slope(value + k, i, n, n);
    ret_node[2] = slope[i - first];
    ret_node[3] = helmholtz_band_slope(slope, i - first, 5, 1);
}

static void helmholtz_direct_nodes(const struct helmholtz_direct *table, int i)
{
    const int n = table->n, cubic = table->cubic, numbers = cubic ? 4 : 1;
    const size_t nodes = (size_t)n * (size_t)n;
    for (int k = 0; k < n; k++) {
        ptrdiff_t at = (ptrdiff_t)(i * n + k) * numbers;
        for (int field = 0; field < HELMHOLTZ_FIELDS; field++) {
            double *node = field == HELMHOLTZ_WARM ? table->warm + at : table->state + 2 * at + field * numbers;
            helmholtz_direct_node(table->value + (size_t)field * nodes, n, cubic, i, k, node);
        }
    }
}

enum {
    HELMHOLTZ_DIRECT_ENDS,
    HELMHOLTZ_DIRECT_CUBICS,
    HELMHOLTZ_DIRECT_VALUES,
    HELMHOLTZ_DIRECT_NODES,
    HELMHOLTZ_DIRECT_PHASES
};

/* One phase of one part, once the table of the potential is there. */
static void helmholtz_direct_build(const struct helmholtz *self, unsigned phase, int part, int parts)
{
    const struct helmholtz_direct *table = &self->direct;
    struct helmholtz from = *self;
    from.way = HELMHOLTZ_BIQUINTIC;
    if (phase == HELMHOLTZ_DIRECT_ENDS) helmholtz_ends_fill(self->law, &self->grid, &table->band, part, parts);
    if (phase == HELMHOLTZ_DIRECT_CUBICS) helmholtz_cubics_fill(&table->band, part, parts);
    for (int i = part; i < table->n; i += parts) {
        if (phase == HELMHOLTZ_DIRECT_VALUES) helmholtz_direct_values(&from, table, i);
        if (phase == HELMHOLTZ_DIRECT_NODES) helmholtz_direct_nodes(table, i);
    }
}

#endif
