/* prolong_levels.h - a second level over a flow, or over a part of it: what prolongation and restriction act on,
 * without the machinery that decides on tiles. Level 0 stays what flow.h made. States that stress them, and maps of
 * the axes. */
#ifndef PROLONG_LEVELS_H
#define PROLONG_LEVELS_H

#include "flow.h"
#include "replicated.h"

#include "levels/prolong.h"
#include "levels/restrict.h"
#include "mesh/link.h"
#include "mesh/morton.h"

struct twolevel {
    struct flow flow;
    struct mesh *mesh;
    const struct model *model;
    struct level *coarse, *fine;
    struct bound *bound;       /* of level 0 */
    struct mesh_change change; /* that made the fine level */
};

static inline int twolevel_compare(const void *a, const void *b)
{
    uint64_t x = ((const struct tile *)a)->key, y = ((const struct tile *)b)->key;
    return (x > y) - (x < y);
}

/* Which tiles the fine level has; NULL: all. */
typedef bool twolevel_chooser(const int at[3]);

/* Those of all ranks; fine tiles belong to the owner of the coarse one. */
static inline struct tile *twolevel_tiles(const struct level *coarse, int dim, twolevel_chooser *chosen,
                                          unsigned *ret_count)
{
    const struct span span = {coarse->n_rank, 0, coarse->first_keys};
    struct nest_set all = {coarse->n_local, mem_new(coarse->n_local, sizeof *all.tiles)};
    if (all.n) memcpy(all.tiles, coarse->tiles + coarse->first, all.n * sizeof *all.tiles);
    replicated_join(&all);
    struct tile *tiles = mem_new((size_t)all.n << dim, sizeof *tiles);
    *ret_count = 0;
    for (unsigned i = 0; i < all.n << dim; i++) {
        const struct tile *below = &all.tiles[i >> dim];
        struct tile tile = {.rank = span_owner(&span, below->key)};
        for (int d = 0; d < dim; d++) tile.at[d] = 2 * below->at[d] + (int)(i >> d & 1);
        tile.key = morton_key(tile.at);
        if (!chosen || chosen(tile.at)) tiles[(*ret_count)++] = tile;
    }
    nest_keys_free_set(&all);
    qsort(tiles, *ret_count, sizeof *tiles, twolevel_compare);
    return tiles;
}

static inline void twolevel_start(struct twolevel *two, char *text, flow_setter *set, twolevel_chooser *chosen)
{
    unsigned count;
    *two = (struct twolevel){0};
    flow_start(&two->flow, text);
    if (set) flow_set(&two->flow, set);
    struct mesh *mesh = two->mesh = two->flow.state->mesh;
    two->model = two->flow.state->model;
    two->coarse = &mesh->levels[0];
    two->fine = &mesh->levels[1];
    for (int d = 0; d < 3; d++) {
        two->fine->h[d] = d < mesh->dim ? two->coarse->h[d] / 2 : 1.0;
        two->fine->extent[d] = d < mesh->dim ? two->coarse->extent[d] * 2 : 1;
    }
    struct tile *tiles = twolevel_tiles(two->coarse, mesh->dim, chosen, &count);
    replicated_replace(mesh, 1, tiles, count, &two->change);
    two->bound = bound_new(two->model, mesh, two->coarse);
}

static inline void twolevel_stop(struct twolevel *two)
{
    mesh_change_free(&two->change);
    bound_free(two->bound);
    flow_stop(&two->flow);
}

/* Fills the fine level; the number of limited coarse cells. */
static inline long long twolevel_bear(struct twolevel *two)
{
    struct prolong *prolong = prolong_new(two->model, two->mesh);
    long long limited = prolong_tiles(prolong, two->mesh, 1, two->bound, two->change.born);
    prolong_free(prolong);
    return limited;
}

/* Primitives of all fine tiles from their conserved fields. */
static inline void twolevel_close(struct twolevel *two)
{
    for (unsigned t = 0; t < two->fine->n_local; t++)
        mix_primitives(two->model, two->mesh->n_cell, two->mesh->n_cell, two->fine->u_old[t], two->fine->w[t]);
}

/* Index of a cell of a tile along each axis of its level. */
static inline void twolevel_at(const struct mesh *mesh, const struct tile *tile, size_t cell, int ret_at[3])
{
    for (int d = 0; d < 3; cell /= (size_t)mesh->n[d], d++)
        ret_at[d] = tile->at[d] * mesh->n[d] + (int)(cell % (size_t)mesh->n[d]);
}

/* The tile and cell of a level at integer cell coordinates; false outside the domain. */
static inline bool twolevel_find(const struct mesh *mesh, const struct level *level, const int at[3],
                                 unsigned *ret_tile, size_t *ret_cell)
{
    int tile[3];
    size_t cell = 0;
    for (int d = 2; d >= 0; d--) {
        if (at[d] < 0 || at[d] >= level->extent[d] * mesh->n[d]) return false;
        tile[d] = at[d] / mesh->n[d];
        cell = cell * (size_t)mesh->n[d] + (size_t)(at[d] % mesh->n[d]);
    }
    *ret_tile = (unsigned)mesh_find(mesh, level, tile);
    *ret_cell = cell;
    return true;
}

/* Value of component q of the cell at integer coordinates; NAN outside the domain. */
static inline double twolevel_value(const struct mesh *mesh, const struct level *level, double *const *arrays,
                                    unsigned q, const int at[3])
{
    unsigned tile;
    size_t cell;
    return twolevel_find(mesh, level, at, &tile, &cell) ? arrays[tile][q * mesh->n_cell + cell] : NAN;
}

/* Does the cell of a level lie at the edge of the domain? */
static inline bool twolevel_edge(const struct mesh *mesh, const struct level *level, const int at[3])
{
    for (int d = 0; d < mesh->dim; d++)
        if (at[d] == 0 || at[d] == level->extent[d] * mesh->n[d] - 1) return true;
    return false;
}

#define TWOLEVEL_NASG "  brine: {eos: {type: nasg}}\n"
#define TWOLEVEL_MNASG "  oil: {eos: {type: mnasg}}\n"

/* Pairs of laws, all linear in alpha_l and m_l at given p. */
static const char *const TWOLEVEL_PAIR[] = {FLOW_HELIUM FLOW_AIR, FLOW_WATER FLOW_AIR, TWOLEVEL_NASG FLOW_AIR,
                                            TWOLEVEL_MNASG FLOW_AIR, TWOLEVEL_MNASG FLOW_HELIUM};
enum { TWOLEVEL_PAIRS = 5 };

/* Reconstructions that need two and three ghost layers; that of the next cases. */
static const char *const TWOLEVEL_SCHEMES[] = {"muscl", "weno5-z"};
static const char *twolevel_scheme = "muscl";

/* A case of `dim` axes in [0, 2], 32 cells an axis (16 in 3D), tiles of 8, everything of the first material. */
static inline char *twolevel_case(int dim, const char *geometry, const char *materials)
{
    static const char *const lower[] = {"0", "0, 0", "0, 0, 0"}, *const upper[] = {"2", "2, 2", "2, 2, 2"};
    static const char *const cells[] = {"32", "32, 32", "16, 16, 16"};
    static const char *const sides[] = {"", ", y-: outflow, y+: outflow", ", z-: outflow, z+: outflow"};
    char first[SCENE_NAME];
    sscanf(materials, " %63[^:]", first);
    return mem_print("bulla: 1\ntitle: two levels\ndomain: {geometry: %s, lower: [%s], upper: [%s], cells: [%s], "
                     "boundaries: {x-: %s, x+: outflow%s%s}}\nmesh: {tile: 8}\nmaterials:\n%sinitial:\n"
                     "  - {everywhere: true, material: %s, density: 1000, pressure: 1e5}\nscheme: {reconstruction: "
                     "%s}\nrun: {until: 1}\n",
                     geometry, lower[dim - 1], upper[dim - 1], cells[dim - 1],
                     strcmp(geometry, "cartesian") == 0 ? "outflow" : "axis", dim > 1 ? sides[1] : "",
                     dim > 2 ? sides[2] : "", materials, first, twolevel_scheme);
}

static const char *const TWOLEVEL_GEOMETRY[] = {"cartesian", "axisymmetric", "spherical"};

/* Range of a component over a coarse cell and its face neighbours (behind the domain's outflow: itself). */
static inline void twolevel_range(const struct twolevel *two, double *const *arrays, unsigned q, const int coarse[3],
                                  double *ret_low, double *ret_high)
{
    *ret_low = *ret_high = twolevel_value(two->mesh, two->coarse, arrays, q, coarse);
    for (int face = 0; face < 2 * two->mesh->dim; face++) {
        int at[3] = {coarse[0], coarse[1], coarse[2]};
        at[face / 2] += face % 2 ? 1 : -1;
        double value = twolevel_value(two->mesh, two->coarse, arrays, q, at);
        if (isnan(value)) continue;
        *ret_low = fmin(*ret_low, value);
        *ret_high = fmax(*ret_high, value);
    }
}

static uint64_t twolevel_seed;

/* Jumps of every size at every cell; absent and pure materials too. */
static inline void twolevel_rough(const struct model *model, const double x[3], double *w)
{
    (void)x;
    double sum = 0.0;
    for (unsigned l = 0; l < model->n_alpha; l++) {
        double kind = flow_random(&twolevel_seed);
        sum += w[l] = kind < 0.4 ? 0.0 : kind < 0.6 ? 1e-7 * flow_random(&twolevel_seed) : flow_random(&twolevel_seed);
    }
    for (unsigned l = 0; l < model->n_alpha; l++) w[l] = sum > 0.0 ? w[l] / sum : l == 0;
    for (unsigned l = 0; l < model->n_material; l++)
        w[model->i_m + l] = (l ? 1.0 : 1000.0) * (0.5 + flow_random(&twolevel_seed));
    for (int d = 0; d < model->dim; d++) w[model->i_u + (unsigned)d] = 2000.0 * (flow_random(&twolevel_seed) - 0.5);
    w[model->i_E] = flow_random(&twolevel_seed) < 0.5 ? 1e5 : 1e9 * flow_random(&twolevel_seed);
}

/* A field that is linear in space, per component. */
static inline double twolevel_slope(unsigned q, const double x[3])
{
    return 1.0 + 0.1 * (double)q + (0.03 * x[0] - 0.05 * x[1]) + 0.02 * x[2];
}

static inline void twolevel_linear(const struct model *model, const double x[3], double *w)
{
    for (unsigned q = model->n_alpha; q < model->n_field; q++) w[q] = twolevel_slope(q, x);
    if (!model->n_alpha) return;
    w[0] = 0.3 * twolevel_slope(0, x);
    w[1] = 1.0 - w[0];
}

/* An interface that is smooth in places and sharp in others, densities that vary, all at one p and u. */
static inline void twolevel_equilibrium(const struct model *model, const double x[3], double *w)
{
    double r = hypot(hypot(x[0] - 0.9, x[1] - 0.4), x[2] - 0.3), bump = sin(3.0 * x[0]) * cos(2.0 * x[1] + x[2]);
    w[0] = r < 0.3 ? 0.0 : x[0] > 1.7 ? 1.0 : 0.5 + 0.4 * bump;
    w[1] = 1.0 - w[0];
    w[2] = 900.0 * (1.0 + 0.1 * bump);
    w[3] = 1.2 * (1.0 + 0.1 * sin(5.0 * x[0] + x[1]));
    for (int d = 0; d < model->dim; d++) w[model->i_u + (unsigned)d] = 10.0 - 7.0 * d;
    w[model->i_E] = 1e5;
}

/* Water hit by a shock of 1 GPa, with air of a thousandth of its density behind a front of one, two or no mixed
 * cells. */
static inline void twolevel_shock(const struct model *model, const double x[3], double *w)
{
    double r = hypot(hypot(x[0] - 1.1, x[1] - 0.9), x[2] - 0.8), front = (r - 0.4) / (0.1 * (1.0 + sin(7.0 * x[0])));
    bool hit = x[0] + 0.2 * x[1] < 0.8;
    w[0] = front < 0.0 ? 0.0 : front > 1.0 ? 1.0 : front;
    w[1] = 1.0 - w[0];
    w[2] = hit ? 1300.0 : 1000.0;
    w[3] = hit ? 6.0 : 1.0;
    for (int d = 0; d < model->dim; d++) w[model->i_u + (unsigned)d] = d == 0 && hit ? 500.0 : 20.0 * x[0];
    w[model->i_E] = hit ? 1e9 : 1e5 * (1.0 + 0.01 * x[0]);
}

/* The same rough cells as above, smooth enough in places to keep slopes. */
static inline void twolevel_half_rough(const struct model *model, const double x[3], double *w)
{
    twolevel_rough(model, x, w);
    if (x[0] < 1.0) return;
    twolevel_shock(model, x, w);
}

/* Left half water, right half air, and a wave in the pressure. */
static inline void twolevel_pure(const struct model *model, const double x[3], double *w)
{
    memset(w, 0, model->n_alpha * sizeof *w);
    w[x[0] < 1.0 ? 0 : 1] = 1.0;
    for (unsigned l = 0; l < model->n_material; l++) w[model->i_m + l] = (l ? 1.0 : 1000.0) + 0.1 * x[1];
    for (int d = 0; d < model->dim; d++) w[model->i_u + (unsigned)d] = x[0];
    w[model->i_E] = 1e5 * (1.0 + 0.1 * x[0]);
}

static struct {
    double sign[3];
    int axis[3]; /* axis[d]: axis of the plain state that axis d of this one shows */
} twolevel_map;

static inline void twolevel_mapped(const struct model *model, const double x[3], double *w)
{
    double y[3] = {0}, plain[FLOW_FIELDS];
    for (int d = 0; d < model->dim; d++) y[twolevel_map.axis[d]] = twolevel_map.sign[d] > 0 ? x[d] : 2.0 - x[d];
    memcpy(plain, w, sizeof plain);
    twolevel_shock(model, y, plain);
    plain[model->i_u + 1] = 30.0 * y[0] * y[1];
    if (model->dim > 2) plain[model->i_u + 2] = 10.0 - y[1];
    memcpy(w, plain, model->n_field * sizeof *w);
    for (int d = 0; d < model->dim; d++)
        w[model->i_u + (unsigned)d] = twolevel_map.sign[d] * plain[model->i_u + (unsigned)twolevel_map.axis[d]];
}

/* Cell of the plain state that a cell of a level of the mapped one shows. */
static inline void twolevel_turn(const struct mesh *mesh, const struct level *level, const int at[3], int ret_from[3])
{
    for (int d = 0; d < mesh->dim; d++) {
        int last = level->extent[d] * mesh->n[d] - 1;
        ret_from[twolevel_map.axis[d]] = twolevel_map.sign[d] > 0 ? at[d] : last - at[d];
    }
}

/* Field of the plain state that field q of the mapped one shows, and the sign it has there. */
static inline unsigned twolevel_turned(const struct model *model, unsigned q, double *ret_sign)
{
    *ret_sign = 1.0;
    if (q < model->i_u || q >= model->i_E) return q;
    *ret_sign = twolevel_map.sign[q - model->i_u];
    return model->i_u + (unsigned)twolevel_map.axis[q - model->i_u];
}

/* A plain state and the mapped one. */
static inline void twolevel_start_pair(struct twolevel *plain, struct twolevel *mapped, int dim, const double sign[3],
                                       const int axis[3])
{
    for (int d = 0; d < 3; d++) {
        twolevel_map.sign[d] = 1.0;
        twolevel_map.axis[d] = d;
    }
    twolevel_start(plain, twolevel_case(dim, "cartesian", FLOW_WATER FLOW_AIR), twolevel_mapped, NULL);
    memcpy(twolevel_map.sign, sign, sizeof twolevel_map.sign);
    memcpy(twolevel_map.axis, axis, sizeof twolevel_map.axis);
    twolevel_start(mapped, twolevel_case(dim, "cartesian", FLOW_WATER FLOW_AIR), twolevel_mapped, NULL);
}

#endif
