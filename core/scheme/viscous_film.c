/* viscous_film.c - see viscous_film.h. The corners that have a mixed cell beside them are worked on side by side. Sums
 * begin with what lies opposite, so that mirrors and the exchange of axes keep all bits. */
#include "scheme/viscous_film.h"

#include "base/mem.h"
#include "phys/elastic.h"
#include "phys/pick.h"
#include "phys/row.h"
#include "scheme/patch.h"

#include <string.h>

/* Some corners, packed. */
struct viscous_film_batch {
    struct viscous_film *film;
    const struct viscous_slopes *slopes;
    const struct viscous_mix *mix;
    struct viscous_strain *strain;
    size_t n;
    const unsigned *at;                           /* [n] the cells below them */
    double per[3][STRAIN_POINTS];                 /* 1/(distance of the cells of a pair) */
    double radius[2][STRAIN_POINTS];              /* of the cells below and above, in curved geometry */
    double value[HOLD_CORNERS][STRAIN_POINTS];    /* of the cells around them, of what is looked at */
    double weight[3][HOLD_PAIRS][STRAIN_POINTS];  /* of a pair across an axis */
    double ring[HOLD_CORNERS / 2][STRAIN_POINTS]; /* weights of the cells in curved geometry */
    double packed[STRAIN_POINTS];
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
    const struct box_block block = rim_block(mesh, 1, NULL);
    const size_t stride[3] = {1, block.size[0], block.size[0] * block.size[1]};
    unsigned corners = 1u << mesh->dim, pairs = corners / 2;
    size_t rows = STRAIN_TENSOR + (size_t)mesh->dim * pairs + (mesh->beta ? corners : 0);
    *ret = (struct viscous_film){.pairs = pairs, .corners = corners, .line = block.size[0]};
    if (!model->n_alpha) return;
    ret->lines = block.pitch / block.size[0];
    ret->held = mem_new(ret->lines, sizeof *ret->held);
    ret->mixed = mem_new(2 * block.pitch, sizeof *ret->mixed);
    ret->touched = ret->mixed + block.pitch;
    ret->at = mem_new(block.pitch, sizeof *ret->at);
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
    mem_free(film->mixed);
    mem_free(film->at);
    mem_free(film->room);
}

/* The values around the corners of what lies over the patch. */
static void viscous_film_take(struct viscous_film_batch *batch, const double *from)
{
    for (unsigned c = 0; c < batch->film->corners; c++)
        pick_take(batch->n, batch->at, from + batch->film->around[c], batch->value[c]);
}

/* What two pairs add to a derivative: v (b - a) + w (d - c). */
static BULLA_KERNEL void viscous_film_slope(size_t n, const double *restrict per, const double *restrict v,
                                            const double *restrict a, const double *restrict b,
                                            const double *restrict w, const double *restrict c,
                                            const double *restrict d, double *restrict slope)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = slope[i];
        slope[i] = s + (v[i] * (b[i] - a[i]) + w[i] * (d[i] - c[i])) * per[i];
    }
}

/* d/dx_e of the values; weight: of the pairs, NULL: all alike. */
static void viscous_film_derive(const struct viscous_film_batch *batch, int e, const double (*weight)[STRAIN_POINTS],
                                double *ret)
{
    const double(*value)[STRAIN_POINTS] = batch->value;
    unsigned last = batch->film->pairs - 1, bit = 1u << e;
    memset(ret, 0, batch->n * sizeof *ret);
    for (unsigned p = 0; p <= last / 2; p++) {
        unsigned low = viscous_hold_low(p, e), other = viscous_hold_low(last - p, e);
        const double *v = weight ? weight[p] : batch->film->even, *w = weight ? weight[last - p] : batch->film->even;
        viscous_film_slope(batch->n, batch->per[e], v, value[low], value[low | bit], last ? w : viscous_film_none,
                           value[other], value[other | bit], ret);
    }
}

/* What turns, as it would at the radius of the corner: then slopes along the radius are r d(u_th/r)/dr. */
static void viscous_film_turn(struct viscous_film_batch *batch)
{
    for (unsigned c = 0; c < batch->film->corners; c++)
        for (size_t i = 0; i < batch->n; i++)
            batch->value[c][i] *= 0.5 * (batch->radius[0][i] + batch->radius[1][i]) / batch->radius[c & 1u][i];
}

/* Velocities by the weights of the pairs, the colour by one for all; even: that one for velocities, too. */
static void viscous_film_gradients(struct viscous_film_batch *batch, bool even)
{
    const struct model *path = batch->slopes->tile->model;
    for (unsigned d = 0; d < path->n_velocity; d++) {
        viscous_film_take(batch, viscous_slopes_velocity(batch->slopes, d));
        if (model_is_turn(path, path->i_u + d)) viscous_film_turn(batch);
        for (int e = 0; e < path->dim; e++)
            viscous_film_derive(batch, e, even ? NULL : batch->weight[e], batch->strain->gradient[d][e]);
    }
    viscous_film_take(batch, batch->slopes->colour);
    for (int e = 0; e < path->dim; e++) viscous_film_derive(batch, e, NULL, batch->strain->colour[e]);
}

/* u_r/r of the cells on one side, by their weights; the second pair only where there are two axes. */
static BULLA_KERNEL void viscous_film_ring(size_t n, const double *restrict radius, const double *restrict v,
                                           const double *restrict a, const double *restrict w, const double *restrict b,
                                           double *restrict hoop)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double h = hoop[i];
        hoop[i] = h + (v[i] * a[i] + w[i] * b[i]) / radius[i];
    }
}

/* The hoop of corners, of at most two axes. */
static void viscous_film_hoop(struct viscous_film_batch *batch, bool even)
{
    double *hoop = batch->strain->hoop, (*ring)[STRAIN_POINTS] = batch->ring;
    bool flat = batch->film->corners == 4;
    viscous_hold_ring(even ? NULL : &batch->hold, batch->n, batch->film->corners, ring);
    viscous_film_take(batch, viscous_slopes_velocity(batch->slopes, 0));
    memset(hoop, 0, batch->n * sizeof *hoop);
    for (unsigned side = 0; side < 2; side++) {
        unsigned other = flat ? side + 2 : side;
        viscous_film_ring(batch->n, batch->radius[side], ring[side], batch->value[side],
                          flat ? ring[other] : viscous_film_none, batch->value[other], hoop);
    }
}

static void viscous_film_strain(struct viscous_film_batch *batch, bool even)
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

static void viscous_film_stress(struct viscous_film_batch *batch, const double *mu)
{
    const struct viscous_film *film = batch->film;
    const struct viscous_strain *strain = batch->strain;
    const struct model *path = strain->path;
    for (unsigned i = 0; i < path->n_velocity; i++)
        for (unsigned j = 0; j <= i && j < (unsigned)path->dim; j++) {
            viscous_mix_film(strain, mu, i, j, batch->packed);
            pick_put(batch->n, batch->at, batch->packed, film->stress[elastic_component(i, j)]);
        }
    for (int e = 0; e < path->dim; e++)
        for (unsigned p = 0; p < film->pairs; p++)
            pick_put(batch->n, batch->at, batch->weight[e][p], film->weight[e][p]);
    if (!path->beta) return;
    viscous_mix_film_hoop(strain, mu, batch->packed);
    for (unsigned c = 0; c < film->corners; c++) {
        viscous_film_times(batch->n, batch->packed, batch->ring[c]);
        pick_put(batch->n, batch->at, batch->ring[c], film->hoop[c]);
    }
}

/* The rate of shear that laws are asked with: of the strain without weights. */
static void viscous_film_rate(struct viscous_film_batch *batch, double *rate)
{
    double square[STRAIN_POINTS];
    viscous_film_strain(batch, true);
    viscous_strain_square(batch->strain, square);
    viscous_strain_rate(batch->strain, square, rate);
}

/* The mean of what lies around the corners in the patch. */
static void viscous_film_around(struct viscous_film_batch *batch, unsigned row, double *mean)
{
    unsigned last = batch->film->corners - 1;
    viscous_film_take(batch, batch->slopes->data + row * batch->slopes->pitch);
    memset(mean, 0, batch->n * sizeof *mean);
    for (unsigned c = 0; c <= last / 2; c++) row_add_both(batch->n, batch->value[c], batch->value[last - c], mean);
    for (size_t i = 0; i < batch->n; i++) mean[i] /= batch->film->corners;
}

/* What the cells around the corners have of a density, by volume: where there is none of the material it may be any. */
static BULLA_KERNEL void viscous_film_heap(size_t n, const double *restrict alpha, const double *restrict alpha_b,
                                           const double *restrict rho, const double *restrict rho_b,
                                           double *restrict mass, double *restrict volume)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], b = alpha_b[i], m = mass[i], v = volume[i];
        mass[i] = m + (a * rho[i] + b * rho_b[i]);
        volume[i] = v + (a + b);
    }
}

/* Density of what they have of material l of the scene; of a material that is not there the mean. */
static void viscous_film_density(struct viscous_film_batch *batch, unsigned l, double *rho)
{
    const struct viscous_film *film = batch->film;
    unsigned row = batch->slopes->tile->model->i_around_rho + l, last = film->corners - 1;
    double alpha[2][STRAIN_POINTS], volume[STRAIN_POINTS] = {0}, mass[STRAIN_POINTS] = {0};
    viscous_film_around(batch, row, rho);
    for (unsigned c = 0; c <= last / 2; c++) {
        viscous_hold_fraction(batch->slopes, batch->n, batch->at, film->around[c], l, alpha[0]);
        viscous_hold_fraction(batch->slopes, batch->n, batch->at, film->around[last - c], l, alpha[1]);
        viscous_film_heap(batch->n, alpha[0], alpha[1], batch->value[c], batch->value[last - c], mass, volume);
    }
    for (size_t i = 0; i < batch->n; i++) rho[i] = volume[i] > 0.0 ? mass[i] / volume[i] : rho[i];
}

/* Viscosity of material l at the corners. */
static const double *viscous_film_ask(struct viscous_film_batch *batch, unsigned l, const double *rate,
                                      struct viscous_mix_number *room)
{
    const struct model *path = batch->slopes->tile->model;
    double p[STRAIN_POINTS], rho[STRAIN_POINTS];
    if (coefficient_sees_state(&path->viscosity[l].mu)) {
        viscous_film_density(batch, path->first + l, rho);
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
        viscous_hold_make(batch->slopes, batch->n, batch->at, batch->film->around[c], rows, c, &batch->hold);
    for (int a = 0; a < path->dim; a++)
        viscous_hold_weigh(&batch->hold, batch->n, a, batch->film->pairs, batch->weight[a]);
    viscous_film_strain(batch, false);
    if (!batch->strain->interface) return;
    viscous_strain_across(batch->strain);
    viscous_film_mean(batch, mu);
    viscous_film_stress(batch, mu);
}

/* Distances and radii of the corners of a batch. The last cell of a line has no corner above: what stands there nobody
 * reads. */
static void viscous_film_place(struct viscous_film_batch *batch)
{
    const struct viscous_slopes *slopes = batch->slopes;
    const struct mesh *mesh = slopes->tile->mesh;
    size_t line = batch->film->line, last = line - 2;
    for (int e = 0; e < mesh->dim; e++)
        for (size_t i = 0; i < batch->n; i++) batch->per[e][i] = slopes->across[e][0];
    for (size_t i = 0; mesh->beta && i < batch->n; i++) {
        size_t x = batch->at[i] % line, corner = x < last ? x : last;
        batch->per[0][i] = slopes->across[0][corner];
        for (size_t side = 0; side < 2; side++) batch->radius[side][i] = slopes->centroid[corner + side];
    }
}

/* Marks cells of which a fraction is neither 0 nor 1. */
static BULLA_KERNEL void viscous_film_mark(size_t n, const double *restrict alpha, unsigned char *restrict mixed)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i];
        int mark = (a != 0.0) & (a != 1.0);
        mixed[i] |= mark ? 1 : 0;
    }
}

/* Marks corners with a marked cell. */
static BULLA_KERNEL void viscous_film_touch(size_t n, const unsigned char *restrict mixed,
                                            unsigned char *restrict touched)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) touched[i] |= mixed[i];
}

/* The corners with a mixed cell beside them, and the lines that have any. */
static void viscous_film_look(struct viscous_film *film, const struct viscous_slopes *slopes)
{
    size_t n = film->line * film->lines - film->around[film->corners - 1];
    memset(film->mixed, 0, film->line * film->lines);
    memset(film->touched, 0, n);
    for (unsigned l = 0; l < slopes->tile->model->n_around_alpha; l++)
        viscous_film_mark(film->line * film->lines, slopes->data + l * slopes->pitch, film->mixed);
    for (unsigned c = 0; c < film->corners; c++) viscous_film_touch(n, film->mixed + film->around[c], film->touched);
    film->count = pick_marked(n, 0, film->touched, film->at);
    memset(film->held, 0, film->lines * sizeof *film->held);
    for (size_t i = 0; i < film->count; i++) film->held[film->at[i] / film->line] = true;
}

/* Takes off what the last tile had. Weights, too: what they weigh is 0 here, but a step that failed leaves NANs. */
static void viscous_film_clear(struct viscous_film *film)
{
    for (unsigned c = 0; c < STRAIN_TENSOR; c++)
        for (size_t i = 0; i < film->count; i++) film->stress[c][film->at[i]] = 0.0;
    for (unsigned c = 0; c < HOLD_CORNERS && film->hoop[c]; c++)
        for (size_t i = 0; i < film->count; i++) film->hoop[c][film->at[i]] = 0.0;
    for (unsigned a = 0; a < 3 && film->weight[a][0]; a++)
        for (unsigned p = 0; p < film->pairs; p++)
            for (size_t i = 0; i < film->count; i++) film->weight[a][p][film->at[i]] = 0.0;
    film->count = 0;
}

void viscous_film_make(struct viscous_film *film, const struct viscous_slopes *slopes, const struct viscous_mix *mix,
                       struct viscous_strain *strain)
{
    struct viscous_film_batch batch; /* large: filled as far as it is used */
    batch.film = film, batch.slopes = slopes, batch.mix = mix, batch.strain = strain;
    viscous_film_clear(film);
    if (!slopes->tile->model->n_alpha) return;
    viscous_film_look(film, slopes);
    for (size_t from = 0; from < film->count; from += batch.n) {
        batch.n = film->count - from < STRAIN_POINTS ? film->count - from : STRAIN_POINTS;
        batch.at = film->at + from;
        viscous_film_place(&batch);
        viscous_film_of(&batch);
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
    if (!film->count) return;
    const double *stress = film->stress[elastic_component(i, (unsigned)block->axis)];
    for (size_t r = 0; r < block->rows; r++)
        viscous_film_row(film, block->axis, stress, block->patch + r * block->patch_row, block->n, tau + r * block->n);
}

void viscous_film_cells(const struct viscous_film *film, const struct viscous_block *block, double *tau)
{
    if (!film->count) return;
    for (size_t r = 0; r < block->rows; r++)
        for (unsigned side = 0; side < 2; side++) {
            unsigned other = film->corners == 4 ? side + 2 : side;
            const double *a = film->hoop[side] - film->around[side], *b = film->hoop[other] - film->around[other];
            size_t at = block->patch + r * block->patch_row;
            if (film->corners == 4) row_add_both(block->n, a + at, b + at, tau + r * block->n);
            else row_add(block->n, a + at, tau + r * block->n);
        }
}
