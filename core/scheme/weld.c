/* weld.c - see weld.h. */
#include "scheme/weld.h"

#include "base/mem.h"
#include "phys/pick.h"
#include "scheme/seam.h"

#include <float.h>
#include <math.h>

/* What the waves of a solid count in how fast tractions become one: each alike, and by its part of the impedance.
 * Measured: with less of the first a contact that moves into the stiffer solid sends more, with more of it one of a
 * dense stiff solid; with less of both 100 : 1 is sheared as if the solids lay beside each other. */
#define WELD_EACH 0.2
#define WELD_STIFF 1.1

/* Shear waves of the solids of each cell: impedances, c^2/alpha, that times the impedance, the slowest c^2. */
struct weld_waves {
    double *impedance, *run, *rush, *least;
};

static bool weld_wanted(const struct model *path)
{
    return path->n_solid > 1 && path->n_velocity > 1 && path->n_alpha > 0;
}

/* Direction in which the number of the solid changes, (sum alpha) sum (s - mean) grad alpha_s, times the spacing; of
 * two solids a grad b - b grad a. */
static void weld_colour(const struct term_tile *tile, const double *u, size_t cell, double g[3])
{
    const struct model *model = tile->model;
    double all = 0.0, sum = 0.0, weight[SCENE_MATERIALS];
    for (unsigned s = 0; s < model->n_solid; s++) {
        double alpha = u[(model->i_alpha + model->solids[s].material) * tile->n_cell + cell];
        all += alpha;
        sum += alpha * s;
    }
    for (unsigned s = 0; s < model->n_solid; s++) weight[s] = sum - s * all;
    seam_gradient(tile, cell, weight, g);
}

/* Of n cells from cell `from` on those that hold several solids. Returns how many there are. */
static size_t weld_pick(const struct term_tile *tile, const double *u, size_t from, size_t n, unsigned *at)
{
    unsigned char there[SEAM_LOOK] = {0};
    for (unsigned s = 0; s < tile->model->n_solid; s++) seam_count(tile, s, u, from, n, there);
    for (size_t i = 0; i < n; i++) there[i] = there[i] > 1;
    return pick_marked(n, (unsigned)from, there, at);
}

/* Has a cell that holds several solids an interface? Then it comes into the batch. */
static void weld_look(struct seam *seam, const struct term_tile *tile, const double *u, unsigned cell)
{
    double g[3];
    weld_colour(tile, u, cell, g);
    seam_add(seam, tile, cell, g);
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
static void weld_haste(struct seam *seam, double dt)
{
    double impedance[SEAM_BATCH] = {0}, run[SEAM_BATCH] = {0}, rush[SEAM_BATCH] = {0}, least[SEAM_BATCH];
    const struct weld_waves waves = {impedance, run, rush, least};
    for (size_t i = 0; i < seam->n; i++) least[i] = DBL_MAX;
    for (unsigned s = 0; s < seam->model->n_solid; s++)
        weld_run(seam->n, seam->alpha[s], seam->m[s], seam->k[s], &waves);
    weld_shorten(seam->n, dt, seam->steep, &waves, seam->part);
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
        slide[i] = fabs(a) > SEAM_NOTHING ? a : 0.0;
    }
}

/* What the solids slide by along tangent d. */
static void weld_along(struct seam *seam, unsigned d)
{
    double sum[SEAM_BATCH] = {0}, give[SEAM_BATCH] = {0};
    unsigned n_solid = seam->model->n_solid;
    for (unsigned s = 0; s < n_solid; s++) weld_share(seam->n, seam->alpha[s], seam->k[s], seam->t[d][s], sum, give);
    for (unsigned s = 0; s < n_solid; s++)
        weld_way(seam->n, seam->part, sum, give, seam->t[d][s], seam->k[s], seam->a[d][s]);
}

static void weld_slide(struct seam *seam, const struct term_tile *tile)
{
    weld_haste(seam, tile->dt);
    for (unsigned d = 0; d + 1 < tile->model->n_velocity; d++) weld_along(seam, d);
}

static size_t weld_apply(const struct term_tile *tile, double *u_new)
{
    static const struct seam_work work = {weld_pick, weld_look, weld_slide};
    seam_apply(&work, tile, u_new);
    return 0;
}

const struct term weld_term = {
    .name = "weld",
    .owner = "core/scheme/weld.c",
    .equation = "V_l <- (1 + a_l n^T) V_l: where solids meet they share the shear traction",
    .wanted = weld_wanted,
    .open = seam_open,
    .close = mem_free,
    .apply = weld_apply,
};
