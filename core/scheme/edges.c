/* edges.c - see edges.h.
 *
 * The scheme is a module; the limited slopes that it may ask for are core's (MUSCL, van Leer 1979), and so is the last
 * word. Limited slopes keep edges between neighbouring cells, hence alpha in [0, 1] and densities positive. A scheme
 * that does not promise that (bulla/reconstruction.h) is looked at: limited slopes stand in where a fraction would
 * leave 0 to 1, or take more than the cell has, and where anything else overshoots the range of the neighbours by much.
 * Each component for itself: else round-off in a uniform one would limit the others. With three or more materials,
 * limiters of two sides, or a scheme that promises nothing, fractions are scaled to sum 1. Because alpha_l and rho_l
 * are reconstructed (not m_l), a contact at uniform p, u and rho_l has face energies linear in alpha: p and u stay
 * uniform to round-off for every law. */
#include "scheme/edges.h"

#include "base/mem.h"
#include "phys/row.h"
#include "plug/vet.h"
#include "scheme/edges_front.h"
#include "scheme/edges_squeeze.h"
#include "scheme/edges_slope.h"
#include "scheme/slant.h"

#include <string.h>

/* Part of the range of a cell and its two neighbours that edges may leave it by. A parabola takes a sixth. */
#define EDGES_SLACK 0.25

/* Part of the least neighbour that an edge of what is positive keeps. */
#define EDGES_LEAST 0.5

struct edges {
    size_t pitch;
    struct edges_slope plain, fraction, along;
    bool steep;                    /* do fractions have edges of two sides? */
    bool drawn;                    /* do paths of the scene draw pressure by itself, and not as the scheme would? */
    double *rows;                  /* all work space */
    double *mark, *spare;          /* where a row needs limited edges; these */
    double *sum;                   /* of fractions at edges */
    const double *w[MODEL_FIELDS]; /* for schemes that take all rows */
    double *lower[MODEL_FIELDS], *upper[MODEL_FIELDS];
    const struct bulla_limited *limited[MODEL_FIELDS];
};

/* What a call is about: cells with edges, and where the first is. */
struct edges_row {
    const struct frame *frame;
    size_t cells, step;
    const double *w; /* the first cell with edges, component 0 */
    const double *mask;
    const double *rise[2], *lean[2];
    double *state;
};

struct edges *edges_new(const struct model *model, size_t pitch)
{
    enum { ROWS = 11, SLANT_ROWS = 2 };
    struct edges *edges = mem_new(1, sizeof *edges);
    size_t n = slant_acts(model) ? ROWS + SLANT_ROWS : ROWS;
    double *rows = edges->rows = mem_new(n * pitch, sizeof *rows);
    edges->pitch = pitch;
    edges->mark = rows + 2 * pitch;
    edges->spare = rows + 3 * pitch;
    edges->sum = rows + 5 * pitch;
    struct edges_slope plain = {.call = {.size = sizeof(struct bulla_limited), .edges = edges_slope_limit},
                                .limiter = model->limiter,
                                .difference = rows,
                                .slope = rows + pitch,
                                .below = edges->spare,
                                .above = edges->spare + pitch,
                                .three = rows + 8 * pitch};
    edges->plain = edges->fraction = edges->along = plain;
    edges->fraction.limiter = model->limiter_alpha;
    edges->along.limiter = model->limiter_along;
    edges->fraction.room = rows + ROWS * pitch;
    edges->fraction.rows = model->n_field;
    edges->fraction.pitch = pitch;
    edges->steep = vet_two_sided(model->limiter_alpha.law);
    bool alike = model->reconstruction->bounded && !vet_two_sided(model->limiter.law); /* to the bit */
    edges->drawn = (model->tilted || model->forced) && !alike;
    return edges;
}

void edges_free(struct edges *edges)
{
    if (!edges) return;
    mem_free(edges->rows);
    mem_free(edges);
}

static const struct bulla_limited *edges_limited(const struct edges *edges, const struct model *model, unsigned q)
{
    return model_is_fraction(model, q) ? &edges->fraction.call : &edges->plain.call;
}

/* Row q of cells, and its upper edges. */
static const double *edges_inside(const struct edges *edges, const struct edges_row *row, unsigned q)
{
    return row->w + q * edges->pitch;
}

static double *edges_upper(const struct edges *edges, const struct edges_row *row, unsigned q)
{
    return row->state + 2 * q * edges->pitch;
}

/* Is this the row of pressure, and drawn by itself afterwards? */
static bool edges_waits(const struct edges *edges, const struct model *model, const struct edges_row *row, unsigned q)
{
    return q == model->i_E && (row->lean[0] || row->rise[0] || edges->drawn);
}

static void edges_each(const struct edges *edges, const struct model *model, const struct edges_row *row)
{
    for (unsigned i = 0; i < model_edged(model); i++) {
        unsigned q = model->active[i];
        if (edges_waits(edges, model, row, q)) continue;
        double *upper = edges_upper(edges, row, q);
        model->reconstruction->edges(model->reconstruction_self, edges_limited(edges, model, q), row->cells, row->step,
                                     edges_inside(edges, row, q), upper + row->cells, upper);
    }
}

/* Active components are numbered by group, so their rows are, too. */
static void edges_together(struct edges *edges, const struct model *model, const struct edges_row *row)
{
    for (unsigned i = 0; i < model_edged(model); i++) {
        unsigned q = model->active[i];
        edges->w[i] = edges_inside(edges, row, q);
        edges->upper[i] = edges_upper(edges, row, q);
        edges->lower[i] = edges->upper[i] + row->cells;
        edges->limited[i] = edges_limited(edges, model, q);
    }
    struct bulla_cells cells = {.size = sizeof cells,
                                .axis = (uint32_t)row->frame->axis,
                                .n = row->cells,
                                .step = row->step,
                                .n_row = model_edged(model),
                                .n_alpha = model->n_alpha,
                                .n_rho = model->n_material,
                                .n_u = model->n_velocity,
                                .n_stretch = model_edged(model) - model_drawn(model),
                                .w = edges->w,
                                .lower = edges->lower,
                                .upper = edges->upper,
                                .limited = edges->limited};
    cells.i_rho = cells.n_alpha;
    cells.i_u = cells.i_rho + cells.n_rho;
    cells.i_p = cells.i_u + cells.n_u;
    cells.i_stretch = model_drawn(model); /* behind plastic strains */
    model->reconstruction->all(model->reconstruction_self, &cells);
}

/* An edge of a fraction takes at most what the cell has: of the material, and of all others. */
static BULLA_KERNEL void edges_mark_fraction(size_t n, const double *restrict w, const double *restrict lower,
                                             const double *restrict upper, double *restrict mark)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double here = w[i], a = lower[i], b = upper[i], was = mark[i];
        double twice = 2.0 * here, least = twice > 1.0 ? twice - 1.0 : 0.0, most = twice < 1.0 ? twice : 1.0;
        int good = (a >= least) & (a <= most) & (b >= least) & (b <= most);
        mark[i] = good ? was : 1.0;
    }
}

/* An edge of anything else stays near the range of the cell and its neighbours; of `part` above 0 also that part of the
 * least of them, where it is positive. */
static BULLA_KERNEL void edges_mark_value(size_t n, double part, const double *before, const double *w,
                                          const double *after, const double *lower, const double *upper, double *mark)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = before[i], y = w[i], z = after[i], a = lower[i], b = upper[i];
        double low = x < y ? x : y, high = x < y ? y : x;
        low = z < low ? z : low;
        high = z > high ? z : high;
        double slack = EDGES_SLACK * (high - low), floor = part * low, least = low - slack, most = high + slack;
        int nearer = (floor > 0.0) & (floor > least);
        least = nearer ? floor : least;
        int good = (a >= least) & (a <= most) & (b >= least) & (b <= most);
        mark[i] = good ? 0.0 : 1.0;
    }
}

static BULLA_KERNEL void edges_choose(size_t n, const double *restrict mark, const double *restrict limited,
                                      double *restrict edge)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double m = mark[i], a = limited[i], b = edge[i];
        edge[i] = m > 0.0 ? a : b;
    }
}

/* Is a cell marked? */
static bool edges_any(const struct edges *edges, size_t n)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++) sum += edges->mark[i];
    return sum > 0.0;
}

/* Limited edges of a component in marked cells. */
static void edges_replace(const struct edges *edges, const struct model *model, const struct edges_row *row, unsigned q)
{
    size_t n = row->cells;
    double *upper = edges_upper(edges, row, q), *spare = edges->spare;
    edges_slope_limit(edges_limited(edges, model, q), n, row->step, edges_inside(edges, row, q), spare + n, spare);
    edges_choose(n, edges->mark, spare, upper);
    edges_choose(n, edges->mark, spare + n, upper + n);
}

/* Fractions of a cell go together, so that their sum survives. */
static void edges_bound_fractions(const struct edges *edges, const struct model *model, const struct edges_row *row)
{
    size_t n = row->cells;
    memset(edges->mark, 0, n * sizeof *edges->mark);
    for (unsigned q = model->i_alpha; q < model->i_alpha + model->n_alpha; q++) {
        const double *upper = edges_upper(edges, row, q);
        edges_mark_fraction(n, edges_inside(edges, row, q), upper + n, upper, edges->mark);
    }
    if (!edges_any(edges, n)) return;
    for (unsigned q = model->i_alpha; q < model->i_alpha + model->n_alpha; q++) edges_replace(edges, model, row, q);
}

static void edges_bound(const struct edges *edges, const struct model *model, const struct edges_row *row)
{
    size_t n = row->cells;
    edges_bound_fractions(edges, model, row);
    for (unsigned i = model->n_alpha; i < model_edged(model); i++) {
        unsigned q = model->active[i];
        if (edges_waits(edges, model, row, q)) continue;
        const double *w = edges_inside(edges, row, q), *upper = edges_upper(edges, row, q);
        bool positive = q < model->i_u || (q == model->i_E && !model->elastic) || model_is_inner(model, q);
        edges_mark_value(n, positive ? EDGES_LEAST : 0.0, w - row->step, w, w + row->step, upper + n, upper,
                         edges->mark);
        if (edges_any(edges, n)) edges_replace(edges, model, row, q);
    }
}

/* Without K a mixed cell is as stiff as its stiffest material makes it, so an edge must not look like the
 * pure softer one: the face would yield with that impedance and overshoot. Edges keep at least half of
 * what the cell has of every material. */
static BULLA_KERNEL void edges_temper(size_t n, const double *restrict alpha, double *restrict edge)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], e = edge[i], least = 0.5 * a, most = 0.5 + 0.5 * a;
        e = e > least ? e : least;
        edge[i] = e < most ? e : most;
    }
}

/* Pressure where forces act or solids have normals, and beside such tiles, by any scheme: with limited slopes. */
static void edges_press(const struct edges *edges, const struct model *model, const struct edges_row *row)
{
    double *upper = edges_upper(edges, row, model->i_E);
    edges_slope_press(&edges->plain, &(struct edges_pressure){.n = row->cells,
                                                              .step = row->step,
                                                              .p = edges_inside(edges, row, model->i_E),
                                                              .rise = {row->rise[0], row->rise[1]},
                                                              .lean = {row->lean[0], row->lean[1]},
                                                              .lower = upper + row->cells,
                                                              .upper = upper});
}

/* First-order states at the faces of troubled cells. */
static void edges_flatten(size_t n, size_t step, const double *w, const double *mask, double *left, double *right)
{
    for (size_t i = 0; i < n; i++) {
        if (mask[i] + mask[i + step] == 0.0) continue;
        left[i] = w[i];
        right[i] = w[i + step];
    }
}

/* The same for pressure, which holds the forces. */
static void edges_flatten_held(const struct edges_row *row, const double *p, double *left, double *right)
{
    size_t step = row->step;
    for (size_t i = 0; i < row->cells - step; i++) {
        if (row->mask[i] + row->mask[i + step] == 0.0) continue;
        left[i] = p[i] + row->rise[1][i];
        right[i] = p[i + step] - row->rise[0][i + step];
    }
}

static void edges_settle(const struct edges *edges, const struct model *model, const struct edges_row *row)
{
    size_t n = row->cells, step = row->step;
    for (unsigned i = 0; i < model_edged(model); i++) {
        unsigned q = model->active[i];
        const double *w = edges_inside(edges, row, q);
        double *upper = edges_upper(edges, row, q);
        if (model_is_fraction(model, q) && !model->kapila) {
            edges_temper(n, w, upper);
            edges_temper(n, w, upper + n);
        }
        if (!row->mask) continue;
        if (row->rise[0] && q == model->i_E) edges_flatten_held(row, w, upper, upper + n + step);
        else edges_flatten(n - step, step, w, row->mask, upper, upper + n + step);
    }
}

/* Two fractions over their sum, in one go. */
static BULLA_KERNEL void edges_scale_two(size_t n, double *restrict one, double *restrict other)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = one[i], b = other[i], sum = a + b;
        one[i] = a / sum;
        other[i] = b / sum;
    }
}

/* Rows of n fractions over their sum. */
static void edges_scale(size_t n, unsigned n_alpha, size_t pitch, double *alpha, double *sum)
{
    if (n_alpha == 2) {
        edges_scale_two(n, alpha, alpha + pitch);
        return;
    }
    memset(sum, 0, n * sizeof *sum);
    for (unsigned l = 0; l < n_alpha; l++) row_add(n, alpha + l * pitch, sum);
    for (unsigned l = 0; l < n_alpha; l++) row_divide(n, sum, alpha + l * pitch);
}

/* Limited fractions of three or more materials need not sum to 1. Of two they do, since slopes are odd and hardly
 * enlarge round-off; steep functions of both differences enlarge it. */
static void edges_normalise(const struct edges *edges, const struct model *model, const struct edges_row *row)
{
    bool sum_is_1 = model->scene->n_material < 3 && model->reconstruction->bounded && !edges->steep;
    if (!model->n_alpha || sum_is_1) return; /* two of three are scaled as all three would be */
    edges_scale(2 * row->cells, model->n_alpha, 2 * edges->pitch, edges_upper(edges, row, model->i_alpha), edges->sum);
}

/* Surfaces that evaporate: what is left of them for edges to know. */
static void edges_beside(struct edges *edges, const struct model *model, const struct edges_row *row)
{
    if (!row->mask) memset(edges->mark, 0, row->cells * sizeof *edges->mark);
    edges_front(&(struct edges_front){.model = model,
                                      .n = row->cells,
                                      .step = row->step,
                                      .pitch = edges->pitch,
                                      .w = row->w,
                                      .state = row->state,
                                      .mask = row->mask ? row->mask : edges->mark,
                                      .axis = row->frame->axis,
                                      .thin = edges->spare});
}

/* Vapour that is squeezed: what is left of slopes. That of the pressure not where forces hold it; beside solids the
 * paths of fluids alone and of all materials do the same. */
static void edges_between(struct edges *edges, const struct model *model, const struct edges_row *row)
{
    bool alone = model->tilted && !model->forced && !row->rise[0];
    edges_squeeze(&(struct edges_squeeze){.model = model,
                                          .n = row->cells,
                                          .step = row->step,
                                          .pitch = edges->pitch,
                                          .w = row->w,
                                          .state = row->state,
                                          .axis = row->frame->axis,
                                          .pressure = alone || !edges_waits(edges, model, row, model->i_E),
                                          .thin = edges->spare});
}

const double *edges_squeezed(const struct edges *edges, const struct model *model, const struct frame *frame,
                             const double *w, const double *mask, double *room)
{
    size_t reach = frame_reach(frame);
    if (mask) memcpy(room, mask, frame->count * sizeof *room);
    else memset(room, 0, frame->count * sizeof *room);
    edges_squeeze_mark(&(struct edges_squeeze){.model = model,
                                               .n = frame_edged(frame),
                                               .step = frame->inner,
                                               .pitch = edges->pitch,
                                               .w = w + reach,
                                               .axis = frame->axis,
                                               .thin = edges->spare},
                       room + reach);
    return room;
}

/* Fractions whose limiter goes by the slant of their surface. */
static void edges_slant(struct edges *edges, const struct model *model, const struct edges_row *row)
{
    edges->fraction.soft = slant_acts(model) ? &edges->along : NULL;
    edges->fraction.cells = row->w;
    edges->fraction.slant = row->w + (model->i_slant + (unsigned)row->frame->axis) * edges->pitch;
}

void edges_fill(struct edges *edges, const struct model *model, const struct frame *frame, const struct edges_cells *in,
                double *state)
{
    size_t reach = frame_reach(frame);
    const struct edges_row row = {.frame = frame,
                                  .cells = frame_edged(frame),
                                  .step = frame->inner,
                                  .w = in->w + reach,
                                  .mask = in->mask ? in->mask + reach : NULL,
                                  .rise = {in->rise[0] ? in->rise[0] + reach : NULL,
                                           in->rise[1] ? in->rise[1] + reach : NULL},
                                  .lean = {in->lean[0] ? in->lean[0] + reach : NULL,
                                           in->lean[1] ? in->lean[1] + reach : NULL},
                                  .state = state};
    edges_slant(edges, model, &row);
    if (model->reconstruction->all) edges_together(edges, model, &row);
    else edges_each(edges, model, &row);
    if (!model->reconstruction->bounded) edges_bound(edges, model, &row);
    if (edges_waits(edges, model, &row, model->i_E)) edges_press(edges, model, &row);
    if (model->squeezed) edges_between(edges, model, &row);
    if (model->fronts && model->conducts) edges_beside(edges, model, &row);
    edges_settle(edges, model, &row);
    edges_normalise(edges, model, &row);
}
