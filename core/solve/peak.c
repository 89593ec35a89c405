/* peak.c - see peak.h. What passes between levels goes tile by tile, an octant of the coarser tile each; who sends what
 * to whom follows from the lists that all ranks have. */
#include "solve/peak.h"

#include "base/comm.h"
#include "base/mem.h"
#include "derive/derive.h"
#include "mesh/post.h"
#include "mesh/tally.h"

#include <math.h>
#include <string.h>

/* A largest value (sign 1) or a least one (sign -1), and when it was. NaN: nothing yet, or nothing now. */
static BULLA_KERNEL void peak_follow(size_t n, double sign, double t, const double *restrict now,
                                     double *restrict value, double *restrict when)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = now[i], b = value[i], w = when[i];
        int keep = (sign * b >= sign * a) | (a != a);
        value[i] = keep ? b : a;
        when[i] = keep ? w : t;
    }
}

/* The field of a tile: of a vector the magnitude, NaN where it says nothing. */
static void peak_values(const struct state *state, int l, unsigned local, double t, const struct derive *field,
                        double *values)
{
    size_t n = state->mesh->n_cell;
    derive_tile(state->model, state->mesh, l, local, t, field, values);
    for (size_t i = 0; field->components == 3 && i < n; i++) {
        double x = values[i], y = values[n + i], z = values[2 * n + i];
        values[i] = sqrt(x * x + y * y + z * z);
    }
    for (size_t i = 0; derive_material(field) >= 0 && i < n; i++)
        if (values[i] == 0.0) values[i] = NAN;
}

/* One of the two ends of a field; `spare`: a row for times that nobody keeps. */
static void peak_end(size_t n, int sign, int row, int when, double t, const double *now, double *kept, double *spare)
{
    if (row < 0) return;
    peak_follow(n, sign, t, now, kept + (size_t)row * n, when < 0 ? spare : kept + (size_t)when * n);
}

static void peak_take_field(const struct state *state, int l, double t, const struct scene_peak *peak,
                            const struct derive *field)
{
    const struct level *level = &state->mesh->levels[l];
    size_t n = state->mesh->n_cell;
    double *now = mem_new(4 * n, sizeof *now), *spare = now + 3 * n;
    for (unsigned local = 0; local < level->n_local; local++) {
        if (tally_is_covered(state->mesh, &level->tiles[level->first + local])) continue;
        peak_values(state, l, local, t, field, now);
        peak_end(n, 1, peak->most, peak->when_most, t, now, level->kept[local], spare);
        peak_end(n, -1, peak->least, peak->when_least, t, now, level->kept[local], spare);
    }
    mem_free(now);
}

void peak_take(const struct state *state, int l, double t)
{
    const struct scene_output *output = &state->scene->output;
    struct derive_moment moment = derive_moment(state->model, state->mesh, t);
    moment.base = l; /* coarser levels may be in the middle of their steps */
    if (t < output->peaks_from || t > output->peaks_until) return;
    for (unsigned i = 0; i < output->n_peak; i++) {
        struct derive field;
        if (derive_find(state->model, output->peaks[i].field, &field)) continue; /* the case was checked */
        derive_prepare(&moment, &field);
        peak_take_field(state, l, t, &output->peaks[i], &field);
    }
}

/* Between levels */

/* What passes between level l and the coarser one: `up` or down, and what becomes of an octant on its way. */
struct peak_pass {
    const struct mesh *mesh;
    const struct scene_output *output;
    int l;
    bool up;
    size_t half[3], n_octant; /* cells of an octant */
};

/* A fine tile and the tile of the coarser level that it lies in; indices in the lists of the levels. */
struct peak_pair {
    unsigned fine, coarse;
    int octant, from, to; /* ranks */
};

static struct peak_pass peak_pass(const struct mesh *mesh, const struct scene_output *output, int l, bool up)
{
    struct peak_pass pass = {.mesh = mesh, .output = output, .l = l, .up = up, .n_octant = 1};
    for (int d = 0; d < 3; d++) {
        pass.half[d] = d < mesh->dim ? (size_t)mesh->n[d] / 2 : 1;
        pass.n_octant *= pass.half[d];
    }
    return pass;
}

static struct peak_pair peak_pair(const struct peak_pass *pass, unsigned fine)
{
    const struct level *finer = &pass->mesh->levels[pass->l], *level = finer - 1;
    struct peak_pair pair = {.fine = fine, .from = -1, .to = -1};
    int at[3] = {0};
    for (int d = 0; d < pass->mesh->dim; d++) {
        at[d] = finer->tiles[fine].at[d] >> 1;
        pair.octant |= (finer->tiles[fine].at[d] & 1) << d;
    }
    int coarse = mesh_find(pass->mesh, level, at);
    if (coarse < 0) return pair; /* neither tile is of this rank */
    pair.coarse = (unsigned)coarse;
    int above = finer->tiles[fine].rank, below = level->tiles[pair.coarse].rank;
    pair.from = pass->up ? above : below;
    pair.to = pass->up ? below : above;
    return pair;
}

/* The place of cell (i, j, k) of an octant in the coarse tile. */
static size_t peak_place(const struct peak_pass *pass, int octant, const size_t at[3])
{
    size_t place = 0;
    for (int d = pass->mesh->dim - 1; d >= 0; d--)
        place = place * (size_t)pass->mesh->n[d] + at[d] + ((octant >> d & 1) ? pass->half[d] : 0);
    return place;
}

/* The place of one of its children in the fine tile. */
static size_t peak_child(const struct peak_pass *pass, const size_t at[3], int child)
{
    size_t place = 0;
    for (int d = pass->mesh->dim - 1; d >= 0; d--)
        place = place * (size_t)pass->mesh->n[d] + 2 * at[d] + (size_t)(child >> d & 1);
    return place;
}

/* Calls for every cell of an octant; `cell` counts them. */
typedef void peak_visit(const struct peak_pass *pass, const size_t at[3], size_t cell, int octant, double *packed,
                        double *tile);

static void peak_walk(const struct peak_pass *pass, int octant, double *packed, double *tile, peak_visit *visit)
{
    size_t at[3], cell = 0;
    for (at[2] = 0; at[2] < pass->half[2]; at[2]++)
        for (at[1] = 0; at[1] < pass->half[1]; at[1]++)
            for (at[0] = 0; at[0] < pass->half[0]; at[0]++) visit(pass, at, cell++, octant, packed, tile);
}

/* The end of one field in the children of a cell. */
static void peak_join(const struct peak_pass *pass, const size_t at[3], double sign, int row, int when,
                      const double *tile, double *packed)
{
    size_t n = pass->mesh->n_cell;
    double value = NAN, time = NAN;
    if (row < 0) return;
    for (int child = 0; child < 1 << pass->mesh->dim; child++) {
        size_t place = peak_child(pass, at, child);
        double v = tile[(size_t)row * n + place], t = when < 0 ? 0.0 : tile[(size_t)when * n + place];
        if (isnan(v) || sign * value > sign * v || (value == v && time <= t)) continue;
        value = v;
        time = t;
    }
    packed[(size_t)row * pass->n_octant] = value;
    if (when >= 0) packed[(size_t)when * pass->n_octant] = time;
}

static void peak_pack_fine(const struct peak_pass *pass, const size_t at[3], size_t cell, int octant, double *packed,
                           double *tile)
{
    (void)octant;
    for (unsigned i = 0; i < pass->output->n_peak; i++) {
        const struct scene_peak *peak = &pass->output->peaks[i];
        peak_join(pass, at, 1.0, peak->most, peak->when_most, tile, packed + cell);
        peak_join(pass, at, -1.0, peak->least, peak->when_least, tile, packed + cell);
    }
}

static void peak_pack_coarse(const struct peak_pass *pass, const size_t at[3], size_t cell, int octant, double *packed,
                             double *tile)
{
    size_t place = peak_place(pass, octant, at);
    for (size_t row = 0; row < pass->mesh->n_kept; row++)
        packed[row * pass->n_octant + cell] = tile[row * pass->mesh->n_cell + place];
}

static void peak_take_coarse(const struct peak_pass *pass, const size_t at[3], size_t cell, int octant, double *packed,
                             double *tile)
{
    size_t place = peak_place(pass, octant, at);
    for (size_t row = 0; row < pass->mesh->n_kept; row++)
        tile[row * pass->mesh->n_cell + place] = packed[row * pass->n_octant + cell];
}

static void peak_take_fine(const struct peak_pass *pass, const size_t at[3], size_t cell, int octant, double *packed,
                           double *tile)
{
    (void)octant;
    for (size_t row = 0; row < pass->mesh->n_kept; row++)
        for (int child = 0; child < 1 << pass->mesh->dim; child++)
            tile[row * pass->mesh->n_cell + peak_child(pass, at, child)] = packed[row * pass->n_octant + cell];
}

static double *peak_fine(const struct peak_pass *pass, const struct peak_pair *pair)
{
    const struct level *level = &pass->mesh->levels[pass->l];
    return level->kept[pair->fine - level->first];
}

static double *peak_coarse(const struct peak_pass *pass, const struct peak_pair *pair)
{
    const struct level *level = &pass->mesh->levels[pass->l - 1];
    return level->kept[pair->coarse - level->first];
}

static void peak_pack(const struct peak_pass *pass, const struct peak_pair *pair, double *packed)
{
    if (pass->up) peak_walk(pass, pair->octant, packed, peak_fine(pass, pair), peak_pack_fine);
    else peak_walk(pass, pair->octant, packed, peak_coarse(pass, pair), peak_pack_coarse);
}

static void peak_unpack(const struct peak_pass *pass, const struct peak_pair *pair, double *packed)
{
    if (pass->up) peak_walk(pass, pair->octant, packed, peak_coarse(pass, pair), peak_take_coarse);
    else peak_walk(pass, pair->octant, packed, peak_fine(pass, pair), peak_take_fine);
}

/* What this rank sends and gets, in the order of the fine tiles. */
struct peak_lists {
    unsigned n_out, n_in;
    struct peak_pair *out, *in;
    struct post_item *out_items, *in_items;
};

/* Makes the lists; what stays on this rank is passed at once. */
static void peak_plan(const struct peak_pass *pass, const bool *which, size_t doubles, struct peak_lists *lists)
{
    unsigned n_known = pass->mesh->levels[pass->l].n_known;
    int rank = comm_rank();
    double *packed = mem_new(doubles, sizeof *packed);
    for (unsigned fine = 0; fine < n_known; fine++) {
        if (which && !which[fine]) continue;
        struct peak_pair pair = peak_pair(pass, fine);
        if (pair.from == rank && pair.to == rank) {
            peak_pack(pass, &pair, packed);
            peak_unpack(pass, &pair, packed);
        } else if (pair.from == rank) {
            lists->out[lists->n_out] = pair;
            lists->out_items[lists->n_out++] = (struct post_item){pair.to, doubles};
        } else if (pair.to == rank) {
            lists->in[lists->n_in] = pair;
            lists->in_items[lists->n_in++] = (struct post_item){pair.from, doubles};
        }
    }
    mem_free(packed);
}

/* Passes the tiles of a level that are marked; `which` NULL: all of them. */
static void peak_send(const struct peak_pass *pass, const bool *which)
{
    unsigned n = pass->mesh->levels[pass->l].n_known + 1;
    struct peak_lists lists = {.out = mem_new(n, sizeof *lists.out),
                               .in = mem_new(n, sizeof *lists.in),
                               .out_items = mem_new(n, sizeof *lists.out_items),
                               .in_items = mem_new(n, sizeof *lists.in_items)};
    peak_plan(pass, which, pass->mesh->n_kept * pass->n_octant, &lists);
    struct post *post = post_new(POST_KEPT + pass->l, lists.n_out, lists.out_items, lists.n_in, lists.in_items);
    for (unsigned i = 0; i < lists.n_out; i++) peak_pack(pass, &lists.out[i], post_out(post, i));
    post_start(post);
    post_finish(post);
    for (unsigned i = 0; i < lists.n_in; i++) peak_unpack(pass, &lists.in[i], post_in(post, i));
    post_free(post);
    mem_free(lists.out);
    mem_free(lists.in);
    mem_free(lists.out_items);
    mem_free(lists.in_items);
}

void peak_up(const struct mesh *mesh, const struct scene_output *output, int base)
{
    for (int l = mesh->n_level - 1; mesh->n_kept && l > base; l--) {
        struct peak_pass pass = peak_pass(mesh, output, l, true);
        peak_send(&pass, NULL);
    }
}

void peak_down(const struct mesh *mesh, int l, const bool *born)
{
    struct peak_pass pass = peak_pass(mesh, NULL, l, false);
    if (mesh->n_kept) peak_send(&pass, born);
}
