/* amr.h - what the tests of refinement share: leaves of all levels of a run in memory (flow.h), totals and deviations
 * over them, states given to all levels by hand, and the comparison of whole hierarchies. On one rank. */
#ifndef AMR_H
#define AMR_H

#include "flow.h"

#include "solve/regrid.h"
#include "solve/sync.h"
#include "solve/wake.h"

/* A cell that no finer tile covers. */
struct amr_leaf {
    int l;
    unsigned tile;
    size_t cell;
    double volume, x[3]; /* whole volume; centre */
};

struct amr_leaves {
    size_t n;
    struct amr_leaf *all; /* level by level, in Morton order */
};

/* Centre of a cell of a tile; 0 on unused axes. */
static inline void amr_centre(const struct mesh *mesh, const struct level *level, const struct tile *tile, size_t c,
                              double ret_x[3])
{
    for (int d = 0; d < 3; d++) {
        size_t n = (size_t)mesh->n[d];
        ret_x[d] = d < mesh->dim
                       ? mesh->lower[d] + ((double)tile->at[d] * (double)n + (double)(c % n) + 0.5) * level->h[d]
                       : 0.0;
        c /= n;
    }
}

/* Release with mem_free(leaves.all). */
static inline struct amr_leaves amr_leaves(const struct flow *flow)
{
    const struct mesh *mesh = flow->state->mesh;
    struct amr_leaves leaves = {0};
    size_t room = 0;
    double *leaf = mem_new(mesh->n_cell, sizeof *leaf), *volume = mem_new(mesh->n_cell, sizeof *volume);
    for (int l = 0; l < mesh->n_level; l++) room += mesh->levels[l].n_tile * mesh->n_cell;
    leaves.all = mem_new(room, sizeof *leaves.all);
    for (int l = 0; l < mesh->n_level; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++) {
            const struct tile *tile = &mesh->levels[l].tiles[t];
            mesh_leaves(mesh, tile, leaf);
            metric_volumes(mesh, &mesh->levels[l], tile, volume);
            for (size_t c = 0; c < mesh->n_cell; c++) {
                struct amr_leaf *next = &leaves.all[leaves.n];
                *next = (struct amr_leaf){.l = l, .tile = t, .cell = c, .volume = volume[c]};
                amr_centre(mesh, &mesh->levels[l], tile, c, next->x);
                leaves.n += leaf[c] != 0.0;
            }
        }
    mem_free(leaf);
    mem_free(volume);
    return leaves;
}

static inline double amr_conserved(const struct flow *flow, const struct amr_leaf *leaf, unsigned q)
{
    const struct mesh *mesh = flow->state->mesh;
    return mesh->levels[leaf->l].u_old[leaf->tile][q * mesh->n_cell + leaf->cell];
}

static inline double amr_primitive(const struct flow *flow, const struct amr_leaf *leaf, unsigned q)
{
    const struct mesh *mesh = flow->state->mesh;
    return mesh->levels[leaf->l].w[leaf->tile][q * mesh->n_cell + leaf->cell];
}

/* The lever of a field: the middle of the volume for what turns around the axis (mesh/metric.h). */
static inline double amr_lever(const struct flow *flow, const struct amr_leaf *leaf, unsigned q)
{
    double h = flow->state->mesh->levels[leaf->l].h[0];
    if (q != flow->state->mesh->turns) return 1.0;
    return metric_centroid(1, leaf->x[0] - 0.5 * h, leaf->x[0] + 0.5 * h);
}

/* Integral over the leaves of a conserved field, with its lever, and of its magnitude. */
static inline long double amr_total(const struct flow *flow, unsigned q, double *ret_size)
{
    struct amr_leaves leaves = amr_leaves(flow);
    long double sum = 0.0L, size = 0.0L;
    for (size_t i = 0; i < leaves.n; i++) {
        long double part = (long double)amr_conserved(flow, &leaves.all[i], q) * leaves.all[i].volume;
        part *= amr_lever(flow, &leaves.all[i], q);
        sum += part;
        size += fabsl(part);
    }
    *ret_size = (double)size;
    mem_free(leaves.all);
    return sum;
}

/* Largest distance of a primitive of any leaf from `value`; NaN counts as infinite. */
static inline double amr_deviation(const struct flow *flow, unsigned q, double value)
{
    struct amr_leaves leaves = amr_leaves(flow);
    double worst = 0.0;
    for (size_t i = 0; i < leaves.n; i++) {
        double off = fabs(amr_primitive(flow, &leaves.all[i], q) - value);
        worst = off <= worst ? worst : off >= 0.0 ? off : HUGE_VAL;
    }
    mem_free(leaves.all);
    return worst;
}

/* How far fractions are out of [0, 1], or their sum from 1. */
static inline double amr_fraction_fault(const struct flow *flow)
{
    const struct model *model = flow->state->model;
    struct amr_leaves leaves = amr_leaves(flow);
    double worst = 0.0;
    for (size_t i = 0; i < leaves.n; i++) {
        double sum = -1.0;
        for (unsigned k = 0; k < model->n_alpha; k++) {
            double alpha = amr_conserved(flow, &leaves.all[i], model->i_alpha + k);
            if (!(alpha >= 0.0)) worst = fmax(worst, alpha < 0.0 ? -alpha : HUGE_VAL);
            if (!(alpha <= 1.0)) worst = fmax(worst, alpha - 1.0);
            sum += alpha;
        }
        worst = fmax(worst, fabs(sum));
    }
    mem_free(leaves.all);
    return worst;
}

/* A primitive of the finest cell at a point. */
static inline double amr_value(const struct flow *flow, const double x[3], unsigned q)
{
    struct amr_leaf leaf = {0};
    mesh_locate(flow->state->mesh, x, &leaf.l, &leaf.tile, &leaf.cell);
    return amr_primitive(flow, &leaf, q);
}

/* Closes u_old of all levels as after a step: averages, primitives, signals, boundary references. */
static inline void amr_close(struct flow *flow)
{
    struct state *state = flow->state;
    for (int l = 0; l < state->mesh->n_level; l++)
        if (verdict_start(state->stages[l], &state->counts.relaxed)) fail_msg("level %d: %s", l, status_text());
    for (int l = state->mesh->n_level - 1; l > 0; l--) {
        wake_above(state->stages, l - 1);
        if (sync_up(state->stages[l - 1], state->stages[l], &state->counts.spread)) fail_msg("%s", status_text());
    }
    wake_levels(state, 0);
    for (int l = 0; l < state->mesh->n_level; l++) adopt_bounds(state->stages[l]);
    regrid_signals(state);
}

/* Gives every cell of every level the primitives of a function; `ret_h` tells it the cell size. */
static inline void amr_set(struct flow *flow, flow_setter *set, double *ret_h)
{
    const struct model *model = flow->state->model;
    const struct mesh *mesh = flow->state->mesh;
    size_t n = mesh->n_cell;
    for (int l = 0; l < mesh->n_level; l++)
        for (unsigned t = 0; t < mesh->levels[l].n_tile; t++)
            for (size_t c = 0; c < n; c++) {
                const struct level *level = &mesh->levels[l];
                double x[3], w[FLOW_FIELDS], u[FLOW_FIELDS];
                for (unsigned q = 0; q < model->n_field; q++) w[q] = level->w[t][q * n + c];
                amr_centre(mesh, level, &level->tiles[t], c, x);
                if (ret_h) *ret_h = level->h[0];
                set(model, x, w);
                mix_conserved(model, 1, 1, w, u);
                for (unsigned q = 0; q < model->n_field; q++) level->u_old[t][q * n + c] = u[q];
                level->w[t][model->i_E * n + c] = w[model->i_E];
            }
    amr_close(flow);
}

/* Do two runs have the same tiles on all levels, to the counts of unwanted ones? */
static inline bool amr_same_tiles(const struct flow *a, const struct flow *b)
{
    const struct mesh *x = a->state->mesh, *y = b->state->mesh;
    bool same = x->n_level == y->n_level;
    for (int l = 0; same && l < x->n_level; l++) {
        same = x->levels[l].n_tile == y->levels[l].n_tile;
        for (unsigned t = 0; same && t < x->levels[l].n_tile; t++)
            same = x->levels[l].tiles[t].key == y->levels[l].tiles[t].key &&
                   x->levels[l].tiles[t].unwanted == y->levels[l].tiles[t].unwanted;
    }
    return same;
}

/* Are tiles, time and all evolved fields of the leaves of both runs the same, to the bit? */
static inline bool amr_equal(const struct flow *a, const struct flow *b)
{
    if (!amr_same_tiles(a, b) || a->state->t != b->state->t) return false;
    struct amr_leaves leaves = amr_leaves(a);
    bool equal = true;
    for (size_t i = 0; equal && i < leaves.n; i++)
        for (unsigned q = 0; q < a->state->model->n_field; q++)
            equal = equal && amr_conserved(a, &leaves.all[i], q) == amr_conserved(b, &leaves.all[i], q);
    mem_free(leaves.all);
    return equal;
}

/* Tiles per level, for messages. */
static inline void amr_print(const struct flow *flow, const char *what)
{
    char text[128] = "";
    const struct mesh *mesh = flow->state->mesh;
    const struct state_counts *counts = &flow->state->counts;
    for (int l = 0; l < mesh->n_level; l++)
        snprintf(text + strlen(text), sizeof text - strlen(text), " %u", mesh->levels[l].n_tile);
    print_message("%s: tiles%s; %lld regrids, %lld retries, %lld redone, %lld spread\n", what, text, counts->regrids,
                  counts->retries, counts->fallback, counts->spread);
}

#endif
