/* weld.c - see weld.h.
 *
 * Few cells hold two solids: they are gathered into rows. Their stretches are turned into the frame of the interface, n
 * first, where elastic_sides() knows tractions and stiffness of any law, and elastic_advance() shears. */
#include "scheme/weld.h"

#include "base/mem.h"
#include "phys/bearing.h"
#include "phys/elastic.h"
#include "phys/mix.h"
#include "scheme/strain.h"
#include "scheme/terms.h"

#include <math.h>
#include <string.h>

enum { WELD_BATCH = 64 };

/* Steps of fractions that small count less: an even mixture has no interface. */
#define WELD_TRACE 1e-3

/* Shears below this are round-off, and leave bits as they are. */
#define WELD_NOTHING 1e-14

/* The cells of a tile in which solids meet. */
struct weld {
    const struct model *model;
    size_t n, cell[WELD_BATCH];
    double frame[3][3][WELD_BATCH];                                            /* n and two tangents */
    double part[WELD_BATCH];                                                   /* of the way to one traction */
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

/* Does the cell hold several solids, and an interface? Then it comes into the batch. */
static void weld_look(struct weld *weld, const struct term_tile *tile, const double *u, size_t cell)
{
    const struct model *model = tile->model;
    unsigned there = 0;
    double g[3];
    for (unsigned s = 0; s < model->n_solid; s++) {
        unsigned l = model->solids[s].material;
        double alpha = u[(model->i_alpha + l) * tile->n_cell + cell], m = u[(model->i_m + l) * tile->n_cell + cell];
        there += alpha > MIX_ABSENT && m > ELASTIC_NOTHING;
    }
    if (there < 2) return;
    weld_colour(tile, u, cell, g);
    double size = sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]), weight = size / WELD_TRACE;
    if (!(size > 0.0)) return;
    weld_aim(weld, weld->n, g, size);
    weld->part[weld->n] = weight < 1.0 ? weight * weight : 1.0;
    weld->cell[weld->n++] = cell;
}

/* V of a stretch of point i: R V R^T with the rows of the frame as R, or back. */
static void weld_turn(struct weld *weld, size_t i, double *V, bool back)
{
    unsigned n = weld->model->n_stretch;
    double full[3][3], half[3][3];
    for (unsigned a = 0; a < 3; a++)
        for (unsigned b = 0; b < 3; b++) {
            unsigned c = elastic_component(a < b ? a : b, a < b ? b : a);
            full[a][b] = c < n ? V[c * WELD_BATCH + i] : 0.0;
        }
    for (unsigned a = 0; a < 3; a++)
        for (unsigned b = 0; b < 3; b++) {
            half[a][b] = 0.0;
            for (unsigned d = 0; d < 3; d++)
                half[a][b] += (back ? weld->frame[d][a][i] : weld->frame[a][d][i]) * full[d][b];
        }
    for (unsigned a = 0; a < 3; a++)
        for (unsigned b = a; b < 3; b++) {
            unsigned c = elastic_component(a, b);
            double sum = 0.0;
            for (unsigned d = 0; d < 3; d++) sum += half[a][d] * (back ? weld->frame[d][b][i] : weld->frame[b][d][i]);
            if (c < n) V[c * WELD_BATCH + i] = sum;
        }
}

static void weld_gather(struct weld *weld, const struct term_tile *tile, const double *u)
{
    const struct model *model = weld->model;
    for (unsigned s = 0; s < model->n_solid; s++) {
        const struct model_solid *solid = &model->solids[s];
        for (size_t i = 0; i < weld->n; i++) {
            const double *at = u + weld->cell[i];
            double m = at[(model->i_m + solid->material) * tile->n_cell];
            double broken = solid->damage.law ? at[solid->damage.field * tile->n_cell] : 0.0;
            weld->alpha[s][i] = at[(model->i_alpha + solid->material) * tile->n_cell];
            weld->m[s][i] = m > ELASTIC_NOTHING ? m * bearing_part(broken / m) : 0.0;
        }
    }
    for (unsigned k = 0; k < model_stretches(model); k++) {
        double *V = weld->V[elastic_block(model, k, 1)];
        for (unsigned c = 0; c < model->n_stretch; c++)
            for (size_t i = 0; i < weld->n; i++)
                V[c * WELD_BATCH + i] = u[(model_stretch(model, k) + c) * tile->n_cell + weld->cell[i]];
        for (size_t i = 0; i < weld->n; i++) weld_turn(weld, i, V, false);
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

/* What the solids of point i slide by. One that bears no shear takes no part. */
static void weld_slide(struct weld *weld, size_t i)
{
    const struct model *model = weld->model;
    for (unsigned d = 0; d + 1 < model->n_velocity; d++) {
        double sum = 0.0, give = 0.0;
        for (unsigned s = 0; s < model->n_solid; s++) {
            double k = weld->k[s][i], share = k > 0.0 ? weld->alpha[s][i] / k : 0.0;
            sum += share * weld->t[d][s][i];
            give += share;
        }
        for (unsigned s = 0; s < model->n_solid; s++) {
            double k = weld->k[s][i], a = k > 0.0 ? weld->part[i] * (sum / give - weld->t[d][s][i]) / k : 0.0;
            weld->a[d][s][i] = fabs(a) > WELD_NOTHING ? a : 0.0;
        }
    }
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
        for (size_t i = 0; i < weld->n; i++) {
            if (weld->a[0][s][i] == 0.0 && weld->a[1][s][i] == 0.0) continue;
            weld_turn(weld, i, V, true);
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
    for (size_t i = 0; i < weld->n; i++) weld_slide(weld, i);
    weld_scatter(weld, tile, u);
    weld->n = 0;
}

static size_t weld_apply(const struct term_tile *tile, double *u_new)
{
    struct weld *weld = tile->own;
    weld->model = tile->model;
    weld->n = 0;
    for (size_t cell = 0; cell < tile->n_cell; cell++) {
        weld_look(weld, tile, u_new, cell);
        if (weld->n == WELD_BATCH) weld_batch(weld, tile, u_new);
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
