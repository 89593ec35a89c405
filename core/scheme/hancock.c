/* hancock.c - see hancock.h. First the sweeps, as for rates: per axis and component u_a s_a(w) is added up in the
 * layout of the tile. Then the step, in batches of cells. A cell that holds one material alone has the same bits on any
 * path. */
#include "scheme/hancock.h"

#include "base/mem.h"
#include "phys/mix.h"
#include "phys/row.h"
#include "scheme/source.h"
#include "scheme/terms.h"

#include <math.h>
#include <string.h>

enum { HANCOCK_BATCH = 256 };

/* Fractions below this are not asked whether their state is admissible, as by the guard. */
#define HANCOCK_PRESENT 1e-6

struct hancock {
    size_t n_cell;
    bool forced;           /* are there sources? */
    double *carried;       /* [n_field][n_cell] sum_a u_a s_a(w) */
    double *div, *rise[3]; /* sum_a s_a(u_a); s_a(p) */
    double *batch;         /* [n_field][HANCOCK_BATCH] the new state */
    double *zeros;         /* [n_cell] what the first axis adds to */
    double ones[HANCOCK_BATCH];
};

struct hancock *hancock_new(const struct model *model, const struct mesh *mesh)
{
    struct hancock *hancock = mem_new(1, sizeof *hancock);
    size_t n_cell = mesh->n_cell;
    hancock->n_cell = n_cell;
    hancock->forced = model->scene->sources != NULL;
    hancock->carried = mem_new((model->n_field + 5) * n_cell, sizeof(double));
    hancock->div = hancock->carried + model->n_field * n_cell;
    for (size_t d = 0; d < 3; d++) hancock->rise[d] = hancock->div + (d + 1) * n_cell;
    hancock->zeros = hancock->div + 4 * n_cell;
    hancock->batch = mem_new(model->n_field * (size_t)HANCOCK_BATCH, sizeof(double));
    for (size_t i = 0; i < HANCOCK_BATCH; i++) hancock->ones[i] = 1.0;
    return hancock;
}

void hancock_free(struct hancock *hancock)
{
    if (!hancock) return;
    mem_free(hancock->carried);
    mem_free(hancock->batch);
    mem_free(hancock);
}

/* Edges of the cells of a piece: runs of rows as in frames, the first cell's at `upper` and `lower`; `cell` in the
 * tile. The first axis adds to zeros, wherever the sums are. */
struct hancock_edges {
    struct frame_runs runs;
    const double *upper, *lower, *zeros;
    size_t cell;
    double per_h;
};

/* Rows of a run: sums so far, sums, and edges. */
struct hancock_row {
    const double *was, *up, *low;
    double *sum;
};

static inline struct hancock_row hancock_row(const struct hancock_edges *edges, size_t k, double *sum)
{
    size_t cell = edges->cell + k * edges->runs.tile, row = k * edges->runs.row;
    const double *was = edges->zeros ? edges->zeros + cell : sum + cell;
    return (struct hancock_row){was, edges->upper + row, edges->lower + row, sum + cell};
}

/* sum += s */
static BULLA_KERNEL void hancock_differ(const struct hancock_edges *edges, double *sum)
{
    size_t n = edges->runs.n;
    double per_h = edges->per_h;
    for (size_t k = 0; k < edges->runs.count; k++) {
        const struct hancock_row row = hancock_row(edges, k, sum);
#pragma omp simd
        for (size_t i = 0; i < n; i++) row.sum[i] = row.was[i] + (row.up[i] - row.low[i]) * per_h;
    }
}

/* sum += u s */
static BULLA_KERNEL void hancock_carry(const struct hancock_edges *edges, const double *speed, double *sum)
{
    size_t n = edges->runs.n;
    double per_h = edges->per_h;
    for (size_t k = 0; k < edges->runs.count; k++) {
        const struct hancock_row row = hancock_row(edges, k, sum);
        const double *u = speed + edges->cell + k * edges->runs.tile;
#pragma omp simd
        for (size_t i = 0; i < n; i++) row.sum[i] = row.was[i] + u[i] * ((row.up[i] - row.low[i]) * per_h);
    }
}

/* sum += (A+ u+ - A- u-)/V, along r */
static BULLA_KERNEL void hancock_spread(const struct hancock_edges *edges, const struct metric *metric, double *sum)
{
    const double *area = metric->area, *volume = metric->volume;
    size_t n = edges->runs.n;
    for (size_t k = 0; k < edges->runs.count; k++) {
        const struct hancock_row row = hancock_row(edges, k, sum);
#pragma omp simd
        for (size_t i = 0; i < n; i++)
            row.sum[i] = row.was[i] + (area[i + 1] * row.up[i] - area[i] * row.low[i]) / volume[i];
    }
}

/* The edges of component q. */
static void hancock_at(const struct hancock *hancock, const struct frame *frame, const double *state, unsigned q,
                       struct hancock_edges *edges)
{
    edges->upper = state + 2 * q * FACE_ROOM + frame_at(frame, 0, 0) - frame_reach(frame);
    edges->lower = edges->upper + frame_edged(frame);
    edges->zeros = frame->axis == 0 ? hancock->zeros : NULL;
}

static void hancock_piece(const struct hancock *hancock, const struct term_tile *tile, const struct frame *frame)
{
    const struct model *model = tile->model;
    unsigned along = model->i_u + (unsigned)frame->axis;
    const double *state = face_edges(tile->terms->faces, frame, false), *u = tile->w + along * tile->n_cell;
    struct hancock_edges edges = {.runs = frame_runs(frame),
                                  .cell = frame_tile_at(frame, 0, 0),
                                  .per_h = 1.0 / tile->level->h[frame->axis]};
    for (unsigned i = 0; i < model->n_active; i++) {
        unsigned q = model->active[i];
        hancock_at(hancock, frame, state, q, &edges);
        hancock_carry(&edges, u, hancock->carried + q * tile->n_cell);
    }
    hancock_at(hancock, frame, state, along, &edges);
    if (model->beta > 0 && frame->axis == 0) hancock_spread(&edges, tile->metric, hancock->div);
    else hancock_differ(&edges, hancock->div);
    hancock_at(hancock, frame, state, model->i_E, &edges);
    edges.zeros = hancock->zeros;
    hancock_differ(&edges, hancock->rise[frame->axis]);
}

/* Rates of the sources: forces alone. */
static void hancock_sources(const struct hancock *hancock, struct term_tile *tile, void *const *own)
{
    const struct terms *terms = tile->terms;
    if (!hancock->forced) return;
    memset(tile->rates, 0, terms->n_rates * tile->n_cell * sizeof *tile->rates);
    for (unsigned i = 0; i < terms->n; i++) {
        tile->own = own[terms->number[i]];
        if (terms->at[i] == &source_term) source_term.cells(tile);
    }
}

/* What a material gives way, alpha_l/(rho_l c_l^2); of one that is alone its own stiffness, to the bit. */
static BULLA_KERNEL void hancock_soften(size_t n, const double *restrict alpha, const double *restrict rho_c2,
                                        double *restrict give, double *restrict alone)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], s = rho_c2[i], share = a / s, sum = give[i], own = alone[i];
        give[i] = sum + (s > 0.0 ? share : 0.0);
        alone[i] = a == 1.0 ? s : own;
    }
}

static BULLA_KERNEL void hancock_stiffen(size_t n, const double *restrict give, double *restrict stiff)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double alone = stiff[i], wood = 1.0 / give[i];
        stiff[i] = alone > 0.0 ? alone : wood;
    }
}

/* rho c_w^2 over rho_l c_l^2; 1 of a trace in a state of no stiffness. */
static BULLA_KERNEL void hancock_part(size_t n, const double *restrict stiff, const double *restrict rho_c2,
                                      double *restrict part)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s = rho_c2[i], ratio = stiff[i] / s;
        part[i] = s > 0.0 ? ratio : 1.0;
    }
}

/* rho_l after tau. A factor between 0 and 2 keeps it positive. */
static BULLA_KERNEL void hancock_density(size_t n, double tau, const double *restrict rho,
                                         const double *restrict carried, const double *restrict div,
                                         const double *restrict part, double *restrict now)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = -(tau * div[i] * part[i]), grown = 1.0 + x / (1.0 + fabs(x));
        now[i] = (rho[i] - tau * carried[i]) * grown;
    }
}

/* alpha_l after tau, in 0 to 1 and no trace; the sum of them. */
static BULLA_KERNEL void hancock_fraction(size_t n, double tau, const double *restrict alpha,
                                          const double *restrict carried, const double *restrict div,
                                          const double *restrict part, double *restrict now, double *restrict sum)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double y = tau * div[i] * (part[i] - 1.0), grown = 1.0 + y / (1.0 + fabs(y)), old = sum[i];
        double a = (alpha[i] - tau * carried[i]) * grown;
        a = a > MIX_ABSENT ? a : 0.0;
        a = a < 1.0 ? a : 1.0;
        now[i] = a;
        sum[i] = old + a;
    }
}

/* Fractions at sum 1; where there is nothing of a material its density stands in. */
static BULLA_KERNEL void hancock_settle(size_t n, const double *restrict sum, double fill, double *restrict alpha,
                                        double *restrict rho)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i] / sum[i], density = rho[i];
        alpha[i] = a;
        rho[i] = a > 0.0 ? density : fill;
    }
}

static BULLA_KERNEL void hancock_velocity(size_t n, double tau, const double *restrict u,
                                          const double *restrict carried, const double *restrict rise,
                                          const double *restrict rho, double *restrict now)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) now[i] = u[i] - tau * (carried[i] + rise[i] / rho[i]);
}

static BULLA_KERNEL void hancock_push(size_t n, double tau, const double *restrict force, const double *restrict rho,
                                      double *restrict now)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double u = now[i];
        now[i] = u + tau * (force[i] / rho[i]);
    }
}

static BULLA_KERNEL void hancock_pressure(size_t n, double tau, const double *restrict p,
                                          const double *restrict carried, const double *restrict div,
                                          const double *restrict stiff, double *restrict now)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) now[i] = p[i] - tau * (carried[i] + stiff[i] * div[i]);
}

/* bad > 0 where p is no number, or what there is of a material is not admissible. */
static BULLA_KERNEL void hancock_judge(size_t n, const double *restrict p, const double *restrict alpha,
                                       const double *restrict rho, const double *restrict rho_c2, double *restrict bad)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = alpha[i], q = p[i] - p[i], old = bad[i];
        double good = rho_c2[i] > 0.0 ? 1.0 : 0.0;
        good = rho[i] > 0.0 ? good : 0.0;
        good = a > HANCOCK_PRESENT ? good : 1.0;
        good = q == 0.0 ? good : 0.0;
        bad[i] = old + (1.0 - good);
    }
}

static BULLA_KERNEL void hancock_select(size_t n, const double *restrict where, const double *restrict a,
                                        const double *restrict b, double *restrict now)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double x = a[i], y = b[i];
        now[i] = where[i] > 0.0 ? x : y;
    }
}

/* n cells from `from`: rows of the tile, and of the state that is made. */
struct hancock_batch {
    const struct hancock *hancock;
    const struct term_tile *tile;
    size_t from, n;
    double stiff[HANCOCK_BATCH], rho[HANCOCK_BATCH]; /* rho c_w^2 and rho of the cells */
};

static const double *hancock_tile(const struct hancock_batch *batch, const double *rows, unsigned q)
{
    return rows + q * batch->tile->n_cell + batch->from;
}

static double *hancock_now(const struct hancock_batch *batch, unsigned q)
{
    return batch->hancock->batch + q * (size_t)HANCOCK_BATCH;
}

/* Stiffness and density of the cells. */
static void hancock_begin(struct hancock_batch *batch)
{
    const struct term_tile *tile = batch->tile;
    const struct model *model = tile->model;
    size_t n = batch->n;
    double give[HANCOCK_BATCH];
    if (!model->n_alpha) {
        memcpy(batch->stiff, hancock_tile(batch, tile->rho_c2, 0), n * sizeof *batch->stiff);
        memcpy(batch->rho, hancock_tile(batch, tile->w, model->i_m), n * sizeof *batch->rho);
        return;
    }
    memset(give, 0, n * sizeof *give);
    memset(batch->stiff, 0, n * sizeof *batch->stiff);
    memset(batch->rho, 0, n * sizeof *batch->rho);
    for (unsigned l = 0; l < model->n_alpha; l++) {
        const double *alpha = hancock_tile(batch, tile->w, model->i_alpha + l);
        hancock_soften(n, alpha, hancock_tile(batch, tile->rho_c2, l), give, batch->stiff);
        row_add_product(n, alpha, hancock_tile(batch, tile->w, model->i_m + l), batch->rho);
    }
    hancock_stiffen(n, give, batch->stiff);
}

/* Fractions and densities. */
static void hancock_materials(const struct hancock_batch *batch)
{
    const struct hancock *hancock = batch->hancock;
    const struct term_tile *tile = batch->tile;
    const struct model *model = tile->model;
    size_t n = batch->n;
    double sum[HANCOCK_BATCH], part[HANCOCK_BATCH], tau = tile->dt;
    const double *div = hancock->div + batch->from, *ratio = hancock->ones;
    memset(sum, 0, n * sizeof *sum);
    for (unsigned l = 0; l < model->n_material; l++) {
        unsigned r = model->i_m + l, a = model->i_alpha + l;
        if (model->n_alpha) {
            hancock_part(n, batch->stiff, hancock_tile(batch, tile->rho_c2, l), part);
            hancock_fraction(n, tau, hancock_tile(batch, tile->w, a), hancock_tile(batch, hancock->carried, a), div,
                             part, hancock_now(batch, a), sum);
            ratio = part;
        }
        hancock_density(n, tau, hancock_tile(batch, tile->w, r), hancock_tile(batch, hancock->carried, r), div, ratio,
                        hancock_now(batch, r));
    }
    for (unsigned l = 0; l < model->n_alpha; l++)
        hancock_settle(n, sum, model->eos[l].rho_fill, hancock_now(batch, model->i_alpha + l),
                       hancock_now(batch, model->i_m + l));
}

/* Velocities and pressure. */
static void hancock_motion(const struct hancock_batch *batch)
{
    static const double level[HANCOCK_BATCH]; /* pressure does not rise along axes that are not used */
    const struct hancock *hancock = batch->hancock;
    const struct term_tile *tile = batch->tile;
    const struct model *model = tile->model;
    unsigned p = model->i_E;
    for (unsigned d = 0; d < model->n_velocity; d++) {
        unsigned q = model->i_u + d;
        const double *rise = (int)d < model->dim ? hancock->rise[d] + batch->from : level;
        hancock_velocity(batch->n, tile->dt, hancock_tile(batch, tile->w, q), hancock_tile(batch, hancock->carried, q),
                         rise, batch->rho, hancock_now(batch, q));
        if (hancock->forced)
            hancock_push(batch->n, tile->dt, hancock_tile(batch, tile->rates, q), batch->rho, hancock_now(batch, q));
    }
    hancock_pressure(batch->n, tile->dt, hancock_tile(batch, tile->w, p), hancock_tile(batch, hancock->carried, p),
                     hancock->div + batch->from, batch->stiff, hancock_now(batch, p));
}

/* To `to` what is admissible, elsewhere what is there. */
static void hancock_write(const struct hancock_batch *batch, double *to)
{
    const struct term_tile *tile = batch->tile;
    const struct model *model = tile->model;
    size_t n = batch->n;
    double bad[HANCOCK_BATCH], rho_c2[SCENE_MATERIALS * HANCOCK_BATCH];
    memset(bad, 0, n * sizeof *bad);
    mix_stiffness(model, n, HANCOCK_BATCH, batch->hancock->batch, rho_c2);
    for (unsigned l = 0; l < model->n_material; l++)
        hancock_judge(n, hancock_now(batch, model->i_E),
                      model->n_alpha ? hancock_now(batch, model->i_alpha + l) : batch->hancock->ones,
                      hancock_now(batch, model->i_m + l), rho_c2 + l * (size_t)HANCOCK_BATCH, bad);
    for (unsigned i = 0; i < model->n_active; i++) {
        unsigned q = model->active[i];
        hancock_select(n, bad, hancock_tile(batch, tile->w, q), hancock_now(batch, q),
                       to + q * tile->n_cell + batch->from);
    }
}

static void hancock_step(const struct hancock *hancock, const struct term_tile *tile, double *to)
{
    for (size_t from = 0; from < tile->n_cell; from += HANCOCK_BATCH) {
        struct hancock_batch batch; /* large: filled as far as it is used */
        batch.hancock = hancock;
        batch.tile = tile;
        batch.from = from;
        batch.n = tile->n_cell - from < HANCOCK_BATCH ? tile->n_cell - from : HANCOCK_BATCH;
        hancock_begin(&batch);
        hancock_materials(&batch);
        hancock_motion(&batch);
        hancock_write(&batch, to);
    }
}

void hancock_take(struct hancock *hancock, struct term_tile *tile, void *const *own, const struct rate_watch *watch,
                  double *w_new)
{
    const struct model *model = tile->model;
    tile->terms->faces->model = model;
    for (int axis = 0; axis < tile->mesh->dim; axis++) {
        size_t pieces = frame_pieces(tile->mesh, axis);
        for (size_t index = 0; index < pieces; index++) {
            struct frame frame = frame_piece(tile->mesh, axis, index);
            rate_gather(tile, own, &frame, watch);
            hancock_piece(hancock, tile, &frame);
        }
    }
    hancock_sources(hancock, tile, own);
    mix_stiffness(model, tile->n_cell, tile->n_cell, tile->w, tile->rho_c2);
    hancock_step(hancock, tile, w_new);
}
