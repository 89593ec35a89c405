/* viscous_film.c - see viscous_film.h. Lines of corners that follow each other are worked on together, with what lies
 * between two lines, which nobody reads. Sums begin with what lies opposite, so that mirrors and the exchange of axes
 * keep all bits. */
#include "scheme/viscous_film.h"

#include "base/mem.h"
#include "phys/elastic.h"
#include "phys/row.h"
#include "scheme/patch.h"

#include <string.h>

/* Some corners, one behind the other in the patch. */
struct viscous_film_batch {
    struct viscous_film *film;
    const struct viscous_slopes *slopes;
    const struct viscous_mix *mix;
    struct viscous_strain *strain;
    size_t n, at;                    /* how many, and the cell below the first */
    double per[3][STRAIN_POINTS];    /* 1/(distance of the cells of a pair) */
    double radius[2][STRAIN_POINTS]; /* of the cells below and above, in curved geometry */
    struct viscous_hold hold;
};

static const double viscous_film_none[STRAIN_POINTS];

static void viscous_film_number(const struct mesh *mesh, const size_t stride[3], struct viscous_film *film)
{
    for (unsigned c = 0; c < film->corners; c++)
        for (int e = 0; e < mesh->dim; e++) film->around[c] += (c >> e & 1u) * stride[e];
    for (int a = 0; a < mesh->dim; a++)
        for (unsigned p = 0; p < film->pairs; p++) {
            unsigned bit = 0;
            for (int e = 0; e < mesh->dim; e++)
                if (e != a) film->beside[a][p] += (p >> bit++ & 1u) * stride[e];
        }
}

void viscous_film_open(const struct mesh *mesh, const struct model *model, struct viscous_film *ret)
{
    const struct box_block block = patch_block(mesh, 1, NULL);
    const size_t stride[3] = {1, block.size[0], block.size[0] * block.size[1]};
    unsigned corners = 1u << mesh->dim, pairs = corners / 2;
    size_t rows = STRAIN_TENSOR + (size_t)mesh->dim * pairs + (mesh->beta ? corners : 0);
    *ret = (struct viscous_film){.pairs = pairs, .corners = corners, .line = block.size[0]};
    if (!model->n_alpha) return;
    ret->lines = block.pitch / block.size[0];
    ret->held = mem_new(2 * ret->lines, sizeof *ret->held);
    ret->mixed = ret->held + ret->lines;
    ret->room = mem_new(rows * block.pitch, sizeof *ret->room);
    double *room = ret->room;
    for (unsigned c = 0; c < STRAIN_TENSOR; c++, room += block.pitch) ret->stress[c] = room;
    for (unsigned c = 0; mesh->beta && c < corners; c++, room += block.pitch) ret->hoop[c] = room;
    for (int a = 0; a < mesh->dim; a++)
        for (unsigned p = 0; p < pairs; p++, room += block.pitch) ret->weight[a][p] = room;
    for (size_t i = 0; i < STRAIN_POINTS; i++) ret->even[i] = 1.0 / pairs;
    viscous_film_number(mesh, stride, ret);
}

void viscous_film_close(struct viscous_film *film)
{
    mem_free(film->held);
    mem_free(film->room);
}

/* What two pairs add to a derivative. */
static BULLA_KERNEL void viscous_film_slope(size_t n, size_t step, const double *restrict per,
                                            const double *const weight[2], const double *const from[2],
                                            double *restrict slope)
{
    const double *restrict v = weight[0], *restrict w = weight[1], *restrict a = from[0], *restrict b = from[1];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = slope[i];
        slope[i] = s + (v[i] * (a[i + step] - a[i]) + w[i] * (b[i + step] - b[i])) * per[i];
    }
}

/* d/dx_e of what lies over the patch; weight: of the pairs. */
static void viscous_film_derive(const struct viscous_film_batch *batch, const double *from, int e,
                                const double *const *weight, double *ret)
{
    const struct viscous_film *film = batch->film;
    const double *at = from + batch->at;
    unsigned last = film->pairs - 1;
    memset(ret, 0, batch->n * sizeof *ret);
    for (unsigned p = 0; p <= last / 2; p++) {
        const double *const w[2] = {weight[p], last ? weight[last - p] : viscous_film_none};
        const double *const pair[2] = {at + film->beside[e][p], at + film->beside[e][last - p]};
        viscous_film_slope(batch->n, batch->slopes->stride[e], batch->per[e], w, pair, ret);
    }
}

/* Velocities by the weights of the pairs, the colour by one for all; even: that one for velocities, too. */
static void viscous_film_gradients(const struct viscous_film_batch *batch, bool even)
{
    const struct viscous_film *film = batch->film;
    const struct model *path = batch->slopes->tile->model;
    const double *const all[HOLD_PAIRS] = {film->even, film->even, film->even, film->even};
    for (int e = 0; e < path->dim; e++) {
        const double *own[HOLD_PAIRS];
        for (unsigned p = 0; p < film->pairs; p++) own[p] = film->weight[e][p] + batch->at;
        for (unsigned d = 0; d < path->n_velocity; d++)
            viscous_film_derive(batch, viscous_slopes_velocity(batch->slopes, d), e, even ? all : own,
                                batch->strain->gradient[d][e]);
        viscous_film_derive(batch, batch->slopes->colour, e, all, batch->strain->colour[e]);
    }
}

/* u_r/r of the cells on one side, by their weights; the second pair only where there are two axes. */
static BULLA_KERNEL void viscous_film_ring(size_t n, const double *restrict radius, const double *const weight[2],
                                           const double *const u[2], double *restrict hoop)
{
    const double *restrict v = weight[0], *restrict w = weight[1], *restrict a = u[0], *restrict b = u[1];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double h = hoop[i];
        hoop[i] = h + (v[i] * a[i] + w[i] * b[i]) / radius[i];
    }
}

/* The hoop of corners, of at most two axes. */
static void viscous_film_hoop(const struct viscous_film_batch *batch, bool even)
{
    const struct viscous_film *film = batch->film;
    const double *u = viscous_slopes_velocity(batch->slopes, 0) + batch->at;
    double *part[HOLD_CORNERS], *hoop = batch->strain->hoop;
    bool flat = film->corners == 4;
    for (unsigned c = 0; c < film->corners; c++) part[c] = film->hoop[c] + batch->at;
    viscous_hold_ring(even ? NULL : &batch->hold, batch->n, film->corners, part);
    memset(hoop, 0, batch->n * sizeof *hoop);
    for (unsigned side = 0; side < 2; side++) {
        const double *const weight[2] = {part[side], flat ? part[side + 2] : viscous_film_none};
        const double *const of[2] = {u + side, u + film->around[flat ? side + 2 : side]};
        viscous_film_ring(batch->n, batch->radius[side], weight, of, hoop);
    }
}

static void viscous_film_strain(const struct viscous_film_batch *batch, bool even)
{
    const struct term_tile *tile = batch->slopes->tile;
    struct viscous_strain *strain = batch->strain;
    strain->path = tile->model;
    strain->n = batch->n;
    viscous_film_gradients(batch, even);
    if (tile->mesh->beta) viscous_film_hoop(batch, even);
    viscous_strain_make(strain, viscous_strain_longest(tile->mesh->dim, tile->level->h));
}

/* w times the mean of the cells. */
static BULLA_KERNEL void viscous_film_scale(size_t n, double part, const double *restrict sharp, double *restrict mu)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double sum = mu[i];
        mu[i] = part * sharp[i] * sum;
    }
}

/* What the strain of the corners is multiplied by. */
static void viscous_film_mean(const struct viscous_film_batch *batch, double *mu)
{
    static const unsigned order[HOLD_PAIRS] = {0, 3, 1, 2};
    const struct viscous_film *film = batch->film;
    double half[2][STRAIN_POINTS];
    memset(half, 0, sizeof half);
    for (unsigned k = 0; k < HOLD_PAIRS; k++) {
        unsigned c = order[k];
        if (c < film->pairs)
            row_add_both(batch->n, batch->hold.film[c], batch->hold.film[film->corners - 1 - c], half[k / 2]);
    }
    memset(mu, 0, batch->n * sizeof *mu);
    row_add_both(batch->n, half[0], half[1], mu);
    viscous_film_scale(batch->n, 1.0 / film->corners, batch->strain->sharp, mu);
}

static BULLA_KERNEL void viscous_film_times(size_t n, const double *restrict factor, double *restrict x)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double value = x[i];
        x[i] = factor[i] * value;
    }
}

static void viscous_film_stress(const struct viscous_film_batch *batch, const double *mu)
{
    const struct viscous_film *film = batch->film;
    const struct viscous_strain *strain = batch->strain;
    const struct model *path = strain->path;
    double hoop[STRAIN_POINTS];
    for (unsigned i = 0; i < path->n_velocity; i++)
        for (unsigned j = 0; j <= i && j < (unsigned)path->dim; j++)
            viscous_mix_film(strain, mu, i, j, film->stress[elastic_component(i, j)] + batch->at);
    if (!path->beta) return;
    viscous_mix_film_hoop(strain, mu, hoop);
    for (unsigned c = 0; c < film->corners; c++) viscous_film_times(batch->n, hoop, film->hoop[c] + batch->at);
}

/* Nothing at n corners. */
static void viscous_film_clear(const struct viscous_film *film, size_t at, size_t n)
{
    for (unsigned c = 0; c < STRAIN_TENSOR; c++) memset(film->stress[c] + at, 0, n * sizeof **film->stress);
    for (unsigned c = 0; c < HOLD_CORNERS && film->hoop[c]; c++) memset(film->hoop[c] + at, 0, n * sizeof **film->hoop);
}

/* The rate of shear that laws are asked with: of the strain without weights. */
static void viscous_film_rate(const struct viscous_film_batch *batch, double *rate)
{
    double square[STRAIN_POINTS];
    viscous_film_strain(batch, true);
    viscous_strain_square(batch->strain, square);
    viscous_strain_rate(batch->strain, square, rate);
}

/* The mean of what lies around the corners in the patch. */
static void viscous_film_around(const struct viscous_film_batch *batch, unsigned row, double *mean)
{
    const double *at = batch->slopes->data + row * batch->slopes->pitch + batch->at;
    unsigned last = batch->film->corners - 1;
    memset(mean, 0, batch->n * sizeof *mean);
    for (unsigned c = 0; c <= last / 2; c++)
        row_add_both(batch->n, at + batch->film->around[c], at + batch->film->around[last - c], mean);
    for (size_t i = 0; i < batch->n; i++) mean[i] /= batch->film->corners;
}

/* Viscosity of material l at the corners. */
static const double *viscous_film_ask(const struct viscous_film_batch *batch, unsigned l, const double *rate,
                                      struct viscous_mix_number *room)
{
    const struct model *path = batch->slopes->tile->model;
    double p[STRAIN_POINTS], rho[STRAIN_POINTS];
    if (coefficient_sees_state(&path->viscosity[l].mu)) {
        viscous_film_around(batch, path->i_around_rho + path->first + l, rho);
        viscous_film_around(batch, path->i_around_p, p);
    }
    const struct coefficient_points points = {batch->n, rate, p, rho};
    return viscous_mix_ask(batch->mix, path, l, &points, room).mu;
}

static void viscous_film_of(struct viscous_film_batch *batch)
{
    const struct model *path = batch->slopes->tile->model;
    struct viscous_mix_number room[SCENE_MATERIALS];
    const double *rows[SCENE_MATERIALS];
    double rate[STRAIN_POINTS], mu[STRAIN_POINTS];
    if (viscous_mix_sees_rate(path)) viscous_film_rate(batch, rate);
    for (unsigned l = 0; l < path->n_material; l++) rows[l] = viscous_film_ask(batch, l, rate, &room[l]);
    for (unsigned c = 0; c < batch->film->corners; c++)
        viscous_hold_make(batch->slopes, batch->n, batch->at + batch->film->around[c], rows, c, &batch->hold);
    for (int a = 0; a < path->dim; a++) {
        double *weight[HOLD_PAIRS];
        for (unsigned p = 0; p < batch->film->pairs; p++) weight[p] = batch->film->weight[a][p] + batch->at;
        viscous_hold_weigh(&batch->hold, batch->n, a, batch->film->pairs, weight);
    }
    viscous_film_strain(batch, false);
    if (!batch->strain->interface) {
        viscous_film_clear(batch->film, batch->at, batch->n);
        return;
    }
    viscous_strain_across(batch->strain);
    viscous_film_mean(batch, mu);
    viscous_film_stress(batch, mu);
}

/* Distances and radii of the corners of a batch, whose first is corner x of its line. Between two lines stands what the
 * last corner has. */
static void viscous_film_place(struct viscous_film_batch *batch, size_t x)
{
    const struct viscous_slopes *slopes = batch->slopes;
    const struct mesh *mesh = slopes->tile->mesh;
    size_t line = batch->film->line, last = line - 2;
    for (int e = 0; e < mesh->dim; e++)
        for (size_t i = 0; i < batch->n; i++) batch->per[e][i] = slopes->across[e][0];
    for (size_t i = 0, at = x; mesh->beta && i < batch->n; i++, at = at + 1 < line ? at + 1 : 0) {
        size_t corner = at < last ? at : last;
        batch->per[0][i] = slopes->across[0][corner];
        for (size_t side = 0; side < 2; side++) batch->radius[side][i] = slopes->centroid[corner + side];
    }
}

/* The corners above some lines of cells that follow each other. */
static void viscous_film_lines(struct viscous_film_batch *batch, size_t from, size_t lines)
{
    size_t line = batch->film->line, all = lines * line - 1; /* no corner behind the last one */
    for (size_t x = 0; x < all; x += batch->n) {
        batch->n = all - x < STRAIN_POINTS ? all - x : STRAIN_POINTS;
        batch->at = from * line + x;
        viscous_film_place(batch, x % line);
        viscous_film_of(batch);
    }
}

/* At how many cells a fraction is neither 0 nor 1. */
static BULLA_KERNEL double viscous_film_count(size_t n, const double *restrict alpha)
{
    double found = 0.0;
#pragma omp simd reduction(+ : found)
    for (size_t i = 0; i < n; i++) found += ((alpha[i] != 0.0) & (alpha[i] != 1.0)) ? 1.0 : 0.0;
    return found;
}

static bool viscous_film_mixed(const struct viscous_film *film, const struct viscous_slopes *slopes, size_t number)
{
    for (unsigned l = 0; l < slopes->tile->model->n_around_alpha; l++)
        if (viscous_film_count(film->line, slopes->data + l * slopes->pitch + number * film->line) > 0.0) return true;
    return false;
}

/* Looks which lines of corners have a mixed cell beside them; others that had one have no stress any more. */
static void viscous_film_look(struct viscous_film *film, const struct viscous_slopes *slopes)
{
    for (size_t k = 0; k < film->lines; k++) film->mixed[k] = viscous_film_mixed(film, slopes, k);
    for (size_t k = 0; k + film->beside[0][film->pairs - 1] / film->line < film->lines; k++) {
        bool held = false;
        for (unsigned p = 0; p < film->pairs; p++) held = held || film->mixed[k + film->beside[0][p] / film->line];
        if (film->held[k] && !held) viscous_film_clear(film, k * film->line, film->line);
        film->held[k] = held;
        film->there = film->there || held;
    }
}

void viscous_film_make(struct viscous_film *film, const struct viscous_slopes *slopes, const struct viscous_mix *mix,
                       struct viscous_strain *strain)
{
    struct viscous_film_batch batch; /* large: filled as far as it is used */
    batch.film = film, batch.slopes = slopes, batch.mix = mix, batch.strain = strain;
    film->there = false;
    if (!slopes->tile->model->n_alpha) return;
    viscous_film_look(film, slopes);
    size_t most = STRAIN_POINTS > film->line ? STRAIN_POINTS / film->line : 1;
    for (size_t k = 0, count; film->there && k < film->lines; k += count) {
        for (count = 0; count < most && k + count < film->lines && film->held[k + count];) count++;
        if (count) viscous_film_lines(&batch, k, count);
        else count = 1;
    }
}

/* What two pairs carry through their faces. */
static BULLA_KERNEL void viscous_film_push(size_t n, const double *const weight[2], const double *const stress[2],
                                           double *restrict tau)
{
    const double *restrict v = weight[0], *restrict w = weight[1], *restrict a = stress[0], *restrict b = stress[1];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double t = tau[i];
        tau[i] = t + (v[i] * a[i] + w[i] * b[i]);
    }
}

/* A row of faces above cells of the patch from `at` on. */
static void viscous_film_row(const struct viscous_film *film, int axis, const double *stress, size_t at, size_t n,
                             double *tau)
{
    double *const *weight = film->weight[axis];
    unsigned last = film->pairs - 1;
    for (unsigned p = 0; p <= last / 2; p++) {
        size_t a = at - film->beside[axis][p], b = at - film->beside[axis][last - p];
        if (!film->held[a / film->line] && !film->held[b / film->line]) continue;
        const double *const w[2] = {weight[p] + a, last ? weight[last - p] + b : viscous_film_none};
        const double *const t[2] = {stress + a, stress + b};
        viscous_film_push(n, w, t, tau);
    }
}

void viscous_film_faces(const struct viscous_film *film, const struct viscous_block *block, unsigned i, double *tau)
{
    if (!film->there) return;
    const double *stress = film->stress[elastic_component(i, (unsigned)block->axis)];
    for (size_t r = 0; r < block->rows; r++)
        viscous_film_row(film, block->axis, stress, block->patch + r * block->patch_row, block->n, tau + r * block->n);
}

void viscous_film_cells(const struct viscous_film *film, const struct viscous_block *block, double *tau)
{
    if (!film->there) return;
    for (size_t r = 0; r < block->rows; r++)
        for (unsigned side = 0; side < 2; side++) {
            unsigned other = film->corners == 4 ? side + 2 : side;
            const double *a = film->hoop[side] - film->around[side], *b = film->hoop[other] - film->around[other];
            size_t at = block->patch + r * block->patch_row;
            if (film->corners == 4) row_add_both(block->n, a + at, b + at, tau + r * block->n);
            else row_add(block->n, a + at, tau + r * block->n);
        }
}
