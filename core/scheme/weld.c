/* weld.c - see weld.h.
 *
 * Few cells hold two solids: they are gathered into rows. Their stretches are turned into the frame of the interface, n
 * first, where elastic_sides() knows tractions and stiffness of any law, and elastic_advance() shears. */
#include "scheme/weld.h"

#include "base/mem.h"
#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/elastic_tensor.h"
#include "phys/mix.h"
#include "phys/pick.h"
#include "scheme/strain.h"
#include "scheme/terms.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { WELD_BATCH = 64, WELD_LOOK = 512 }; /* cells that are worked on, and looked at, together */

/* Steps of fractions that small count less: an even mixture has no interface. */
#define WELD_TRACE 1e-3

/* Shears below this are round-off, and leave bits as they are. */
#define WELD_NOTHING 1e-14

/* What the waves of a solid count in how fast tractions become one: each alike, and by its part of the impedance.
 * Measured: with less of the first a contact that moves into the stiffer solid sends more, with more of it one of a
 * dense stiff solid; with less of both 100 : 1 is sheared as if the solids lay beside each other. */
#define WELD_EACH 0.2
#define WELD_STIFF 1.1

/* Shear waves of the solids of each cell: impedances, c^2/alpha, that times the impedance, the slowest c^2. */
struct weld_waves {
    double *impedance, *run, *rush, *least;
};

/* The cells of a tile in which solids meet. */
struct weld {
    const struct model *model;
    size_t n;
    unsigned cell[WELD_BATCH];
    double frame[3][3][WELD_BATCH];                                            /* n and two tangents */
    double part[WELD_BATCH];                                                   /* of the way to one traction */
    double steep[WELD_BATCH];                                                  /* |grad| of the fractions [1/m] */
    double alpha[SCENE_MATERIALS][WELD_BATCH], m[SCENE_MATERIALS][WELD_BATCH]; /* by solid; m as far as it bears */
    double V[6 * MODEL_STRETCHES][WELD_BATCH];                                 /* in the frame of the interface */
    double t[2][SCENE_MATERIALS][WELD_BATCH], k[SCENE_MATERIALS][WELD_BATCH];  /* per own volume */
    double a[2][SCENE_MATERIALS][WELD_BATCH];                                  /* what they slide by */
};

static bool weld_wanted(const struct model *path)
{
    return path->n_solid > 1 && path->n_velocity > 1 && path->n_alpha > 0;
}

static void *weld_open(const struct term_room *room)
{
    (void)room;
    return mem_new(1, sizeof(struct weld));
}

/* Direction in which the number of the solid changes, (sum alpha) sum (s - mean) grad alpha_s, times the spacing; of
 * two solids a grad b - b grad a. */
static void weld_colour(const struct term_tile *tile, const double *u, size_t cell, double g[3])
{
    const struct model *model = tile->model;
    const double *slope = tile->rates + terms_first(tile->terms, &strain_term) * tile->n_cell + cell;
    unsigned dim = (unsigned)model->dim;
    double all = 0.0, sum = 0.0;
    for (unsigned s = 0; s < model->n_solid; s++) {
        double alpha = u[(model->i_alpha + model->solids[s].material) * tile->n_cell + cell];
        all += alpha;
        sum += alpha * s;
    }
    for (unsigned d = 0; d < 3; d++) g[d] = 0.0;
    for (unsigned s = 0; s < model->n_solid; s++)
        for (unsigned d = 0; d < dim; d++)
            g[d] += (sum - s * all) * slope[((model->n_velocity + s) * dim + d) * tile->n_cell] * tile->level->h[d];
}

/* Area of the interface per volume [1/m]; g is per cell. */
static double weld_steep(const struct term_tile *tile, const double g[3])
{
    double sum = 0.0;
    for (int d = 0; d < tile->model->dim; d++) sum += g[d] / tile->level->h[d] * (g[d] / tile->level->h[d]);
    return sqrt(sum);
}

/* n, and tangents that turn with it. */
static void weld_aim(struct weld *weld, size_t i, const double g[3], double size)
{
    double n[3] = {g[0] / size, g[1] / size, g[2] / size}, flat = hypot(n[0], n[1]);
    double one[3] = {flat > 0.0 ? -n[1] / flat : 0.0, flat > 0.0 ? n[0] / flat : 1.0, 0.0};
    double two[3] = {n[1] * one[2] - n[2] * one[1], n[2] * one[0] - n[0] * one[2], n[0] * one[1] - n[1] * one[0]};
    for (unsigned d = 0; d < 3; d++) {
        weld->frame[0][d][i] = n[d];
        weld->frame[1][d][i] = one[d];
        weld->frame[2][d][i] = two[d];
    }
}

/* Counts a solid where it is. */
static BULLA_KERNEL void weld_count(size_t n, const double *restrict alpha, const double *restrict m,
                                    unsigned char *restrict there)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++)
        there[i] = (unsigned char)(there[i] + ((alpha[i] > MIX_ABSENT) & (m[i] > ELASTIC_NOTHING)));
}

/* Of n cells from cell `from` on those that hold several solids. Returns how many there are. */
static size_t weld_pick(const struct term_tile *tile, const double *u, size_t from, size_t n, unsigned *at)
{
    const struct model *model = tile->model;
    unsigned char there[WELD_LOOK] = {0};
    for (unsigned s = 0; s < model->n_solid; s++) {
        unsigned l = model->solids[s].material;
        weld_count(n, u + (model->i_alpha + l) * tile->n_cell + from, u + (model->i_m + l) * tile->n_cell + from,
                   there);
    }
    for (size_t i = 0; i < n; i++) there[i] = there[i] > 1;
    return pick_marked(n, (unsigned)from, there, at);
}

/* Has a cell that holds several solids an interface? Then it comes into the batch. */
static void weld_look(struct weld *weld, const struct term_tile *tile, const double *u, unsigned cell)
{
    double g[3];
    weld_colour(tile, u, cell, g);
    double size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]), weight = size / WELD_TRACE;
    if (!(size > 0.0)) return;
    weld_aim(weld, weld->n, g, size);
    weld->part[weld->n] = weight < 1.0 ? weight * weight : 1.0;
    weld->steep[weld->n] = weld_steep(tile, g);
    weld->cell[weld->n++] = cell;
}

struct weld_vector {
    double x, y, z;
};

static ELASTIC_BODY struct weld_vector weld_times(struct elastic_tensor V, struct weld_vector r)
{
    return (struct weld_vector){r.x * V.xx + r.y * V.xy + r.z * V.xz, r.x * V.xy + r.y * V.yy + r.z * V.yz,
                                r.x * V.xz + r.y * V.yz + r.z * V.zz};
}

static ELASTIC_BODY double weld_dot(struct weld_vector a, struct weld_vector r)
{
    return a.x * r.x + a.y * r.y + a.z * r.z;
}

/* R V R^T of points with the rows of R. */
static BULLA_KERNEL void weld_turn_space(size_t n, const double *const R[3][3], double *const *V)
{
    const double *restrict xx = R[0][0], *restrict xy = R[0][1], *restrict xz = R[0][2];
    const double *restrict yx = R[1][0], *restrict yy = R[1][1], *restrict yz = R[1][2];
    const double *restrict zx = R[2][0], *restrict zy = R[2][1], *restrict zz = R[2][2];
    double *restrict v_xx = V[0], *restrict v_yy = V[1], *restrict v_zz = V[2];
    double *restrict v_xy = V[3], *restrict v_xz = V[4], *restrict v_yz = V[5];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct elastic_tensor full = {v_xx[i], v_yy[i], v_zz[i], v_xy[i], v_xz[i], v_yz[i]};
        struct weld_vector x = {xx[i], xy[i], xz[i]}, y = {yx[i], yy[i], yz[i]}, z = {zx[i], zy[i], zz[i]};
        struct weld_vector a = weld_times(full, x), b = weld_times(full, y);
        v_xx[i] = weld_dot(a, x);
        v_xy[i] = weld_dot(a, y);
        v_xz[i] = weld_dot(a, z);
        v_yy[i] = weld_dot(b, y);
        v_yz[i] = weld_dot(b, z);
        v_zz[i] = weld_dot(weld_times(full, z), z);
    }
}

/* In a plane, where z stands alone. */
static BULLA_KERNEL void weld_turn_plane(size_t n, const double *const R[3][3], double *const *V)
{
    const double *restrict xx = R[0][0], *restrict xy = R[0][1], *restrict yx = R[1][0], *restrict yy = R[1][1];
    const double *restrict zz = R[2][2];
    double *restrict v_xx = V[0], *restrict v_yy = V[1], *restrict v_zz = V[2], *restrict v_xy = V[3];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = v_xx[i], b = v_xy[i], d = v_yy[i], z = zz[i];
        double ax = xx[i] * a + xy[i] * b, ay = xx[i] * b + xy[i] * d;
        double bx = yx[i] * a + yy[i] * b, by = yx[i] * b + yy[i] * d;
        v_xx[i] = ax * xx[i] + ay * xy[i];
        v_xy[i] = ax * yx[i] + ay * yy[i];
        v_yy[i] = bx * yx[i] + by * yy[i];
        v_zz[i] = z * v_zz[i] * z;
    }
}

/* A stretch of all points: R V R^T with the rows of the frame as R, or back. */
static void weld_turn(struct weld *weld, double *V, bool back)
{
    const double *R[3][3];
    double *rows[6] = {NULL};
    for (unsigned a = 0; a < 3; a++)
        for (unsigned d = 0; d < 3; d++) R[a][d] = back ? weld->frame[d][a] : weld->frame[a][d];
    for (unsigned c = 0; c < weld->model->n_stretch; c++) rows[c] = V + c * WELD_BATCH;
    if (weld->model->n_velocity < 3) weld_turn_plane(weld->n, R, rows);
    else weld_turn_space(weld->n, R, rows);
}

/* Partial densities of solid s, as far as it bears. */
static void weld_bear(struct weld *weld, const struct term_tile *tile, unsigned s, const double *u)
{
    const struct model_solid *solid = &weld->model->solids[s];
    double *m = weld->m[s], broken[WELD_BATCH];
    pick_take(weld->n, weld->cell, u + (weld->model->i_m + solid->material) * tile->n_cell, m);
    if (solid->damage.law) pick_take(weld->n, weld->cell, u + solid->damage.field * tile->n_cell, broken);
    for (size_t i = 0; i < weld->n; i++) {
        double part = solid->damage.law && m[i] > ELASTIC_NOTHING ? bearing_part(broken[i] / m[i]) : 1.0;
        m[i] = m[i] > ELASTIC_NOTHING ? m[i] * part : 0.0;
    }
}

static void weld_gather(struct weld *weld, const struct term_tile *tile, const double *u)
{
    const struct model *model = weld->model;
    for (unsigned s = 0; s < model->n_solid; s++) {
        pick_take(weld->n, weld->cell, u + (model->i_alpha + model->solids[s].material) * tile->n_cell, weld->alpha[s]);
        weld_bear(weld, tile, s, u);
    }
    for (unsigned k = 0; k < model_stretches(model); k++) {
        double *V = weld->V[elastic_block(model, k, 1)];
        pick_take_rows(weld->n, weld->cell, model->n_stretch, tile->n_cell, u + model_stretch(model, k) * tile->n_cell,
                       WELD_BATCH, V);
        weld_turn(weld, V, false);
    }
}

/* Shear traction and stiffness of each solid, per its own volume. */
static void weld_pull(struct weld *weld)
{
    static const double zero[WELD_BATCH];
    const struct model *model = weld->model;
    double normal[WELD_BATCH], stiff[WELD_BATCH];
    const double *m[SCENE_MATERIALS];
    for (unsigned s = 0; s < model->n_solid; s++) {
        const struct elastic_side side = {.normal = normal,
                                          .shear = {weld->t[0][s], weld->t[1][s]},
                                          .stiff = stiff,
                                          .rigid = weld->k[s]};
        for (unsigned other = 0; other < model->n_solid; other++) m[other] = other == s ? weld->m[s] : zero;
        elastic_sides(model, 0, weld->n, WELD_BATCH, weld->V[0], m, zero, &side);
        for (size_t i = 0; i < weld->n; i++) {
            double per = weld->alpha[s][i] > MIX_ABSENT ? 1.0 / weld->alpha[s][i] : 0.0;
            weld->k[s][i] *= per;
            for (unsigned d = 0; d + 1 < model->n_velocity; d++) weld->t[d][s][i] *= per;
        }
    }
}

/* Adds a solid: its impedance rho c, how fast its shear waves run, c^2/alpha, and both times each other; and looks for
 * the slowest c^2. */
static BULLA_KERNEL void weld_run(size_t n, const double *restrict alpha, const double *restrict m,
                                  const double *restrict k, const struct weld_waves *waves)
{
    double *restrict impedance = waves->impedance, *restrict run = waves->run, *restrict rush = waves->rush;
    double *restrict least = waves->least;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double stiff = k[i], a = alpha[i], Z = impedance[i], all = run[i], sum = rush[i], old = least[i];
        double own = stiff / m[i], c2 = own * a, z = sqrt(stiff * m[i] / a);
        int bears = stiff > 0.0;
        impedance[i] = Z + (bears ? z : 0.0);
        run[i] = all + (bears ? own : 0.0);
        rush[i] = sum + (bears ? z * own : 0.0);
        least[i] = (bears & (c2 < old)) ? c2 : old;
    }
}

static BULLA_KERNEL void weld_shorten(size_t n, double dt, const double *restrict steep, const struct weld_waves *waves,
                                      double *restrict part)
{
    const double *restrict impedance = waves->impedance, *restrict run = waves->run, *restrict rush = waves->rush;
    const double *restrict least = waves->least;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double Z = impedance[i], all = WELD_EACH * run[i] + WELD_STIFF * (rush[i] / Z);
        double x = dt * steep[i] * all / sqrt(least[i]), way = part[i] * (x / (1.0 + x));
        part[i] = Z > 0.0 ? way : 0.0;
    }
}

/* How much of the way to one traction waves can take in dt. */
static void weld_haste(struct weld *weld, double dt)
{
    double impedance[WELD_BATCH] = {0}, run[WELD_BATCH] = {0}, rush[WELD_BATCH] = {0}, least[WELD_BATCH];
    const struct weld_waves waves = {impedance, run, rush, least};
    for (size_t i = 0; i < weld->n; i++) least[i] = DBL_MAX;
    for (unsigned s = 0; s < weld->model->n_solid; s++)
        weld_run(weld->n, weld->alpha[s], weld->m[s], weld->k[s], &waves);
    weld_shorten(weld->n, dt, weld->steep, &waves, weld->part);
}

/* Adds a solid's share in what gives. One that bears no shear takes no part. */
static BULLA_KERNEL void weld_share(size_t n, const double *restrict alpha, const double *restrict k,
                                    const double *restrict t, double *restrict sum, double *restrict give)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double stiff = k[i], share = alpha[i] / stiff;
        share = stiff > 0.0 ? share : 0.0;
        sum[i] += share * t[i];
        give[i] += share;
    }
}

static BULLA_KERNEL void weld_way(size_t n, const double *restrict part, const double *restrict sum,
                                  const double *restrict give, const double *restrict t, const double *restrict k,
                                  double *restrict slide)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double stiff = k[i], a = part[i] * (sum[i] / give[i] - t[i]) / stiff;
        a = stiff > 0.0 ? a : 0.0;
        slide[i] = fabs(a) > WELD_NOTHING ? a : 0.0;
    }
}

/* What the solids slide by along tangent d. */
static void weld_slide(struct weld *weld, unsigned d)
{
    double sum[WELD_BATCH] = {0}, give[WELD_BATCH] = {0};
    unsigned n_solid = weld->model->n_solid;
    for (unsigned s = 0; s < n_solid; s++) weld_share(weld->n, weld->alpha[s], weld->k[s], weld->t[d][s], sum, give);
    for (unsigned s = 0; s < n_solid; s++)
        weld_way(weld->n, weld->part, sum, give, weld->t[d][s], weld->k[s], weld->a[d][s]);
}

/* Stretch k of all points sheared by what its solid slides by: (1 + a n^T) in two halves. */
static void weld_shear(struct weld *weld, unsigned k)
{
    const struct model *model = weld->model;
    unsigned dim = (unsigned)model->dim, s = model_bearer(model, k);
    double gradient[9][WELD_BATCH] = {{0}}, none[6][WELD_BATCH] = {{0}}, one[WELD_BATCH], out[6][WELD_BATCH];
    for (size_t i = 0; i < weld->n; i++) one[i] = 1.0;
    for (unsigned d = 0; d + 1 < model->n_velocity; d++)
        for (size_t i = 0; i < weld->n; i++) gradient[(d + 1) * dim][i] = -weld->a[d][s][i];
    const struct elastic_rates rates = {
        .carried = none[0], .m_old = one, .m_new = one, .div = none[0], .gradient = gradient[0]};
    double *V = weld->V[elastic_block(model, k, 1)];
    elastic_advance(model, weld->n, WELD_BATCH, 1.0, V, &rates, out[0]);
    elastic_unimodular(model, weld->n, WELD_BATCH, out[0]);
    for (unsigned c = 0; c < model->n_stretch; c++) memcpy(V + c * WELD_BATCH, out[c], weld->n * sizeof *V);
}

static void weld_scatter(struct weld *weld, const struct term_tile *tile, double *u)
{
    const struct model *model = weld->model;
    for (unsigned k = 0; k < model_stretches(model); k++) {
        double *V = weld->V[elastic_block(model, k, 1)];
        unsigned s = model_bearer(model, k);
        weld_shear(weld, k);
        weld_turn(weld, V, true);
        for (size_t i = 0; i < weld->n; i++) {
            if (weld->a[0][s][i] == 0.0 && weld->a[1][s][i] == 0.0) continue;
            for (unsigned c = 0; c < model->n_stretch; c++)
                u[(model_stretch(model, k) + c) * tile->n_cell + weld->cell[i]] = V[c * WELD_BATCH + i];
        }
    }
}

static void weld_batch(struct weld *weld, const struct term_tile *tile, double *u)
{
    if (!weld->n) return;
    weld_gather(weld, tile, u);
    weld_pull(weld);
    weld_haste(weld, tile->dt);
    for (unsigned d = 0; d + 1 < tile->model->n_velocity; d++) weld_slide(weld, d);
    weld_scatter(weld, tile, u);
    weld->n = 0;
}

static size_t weld_apply(const struct term_tile *tile, double *u_new)
{
    struct weld *weld = tile->own;
    unsigned at[WELD_LOOK];
    weld->model = tile->model;
    weld->n = 0;
    for (size_t from = 0; from < tile->n_cell; from += WELD_LOOK) {
        size_t left = tile->n_cell - from, n = weld_pick(tile, u_new, from, left < WELD_LOOK ? left : WELD_LOOK, at);
        for (size_t i = 0; i < n; i++) {
            weld_look(weld, tile, u_new, at[i]);
            if (weld->n == WELD_BATCH) weld_batch(weld, tile, u_new);
        }
    }
    weld_batch(weld, tile, u_new);
    return 0;
}

const struct term weld_term = {
    .name = "weld",
    .owner = "core/scheme/weld.c",
    .equation = "V_l <- (1 + a_l n^T) V_l: where solids meet they share the shear traction",
    .wanted = weld_wanted,
    .open = weld_open,
    .close = mem_free,
    .apply = weld_apply,
};
