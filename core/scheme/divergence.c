/* divergence.c - see divergence.h. */
#include "scheme/divergence.h"

#include "scheme/terms.h"

/* rate -= a (upper - lower) */
static BULLA_KERNEL void divergence_row(size_t n, double a, const double *restrict lower, const double *restrict upper,
                                        double *restrict rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double low = lower[i], up = upper[i], old = rate[i];
        rate[i] = old - a * (up - low);
    }
}

/* A row of cells of one tile along axis 0 in curved coordinates: rate -= (A+ (F+ - q) - A- (F- - q)) / V;
 * q is the cell's pressure for the radial momentum, else a row of zeros. */
static BULLA_KERNEL void divergence_curved(size_t n, const double *restrict area, const double *restrict volume,
                                           const double *restrict lower, const double *restrict upper,
                                           const double *restrict q, double *restrict rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double low = lower[i], up = upper[i], inside = q[i], old = rate[i];
        rate[i] = old - (area[i + 1] * (up - inside) - area[i] * (low - inside)) / volume[i];
    }
}

/* rate += a (upper + lower) */
static BULLA_KERNEL void divergence_mean(size_t n, double a, const double *restrict lower, const double *restrict upper,
                                         double *restrict rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double low = lower[i], up = upper[i], old = rate[i];
        rate[i] = old + a * (up + low);
    }
}

/* The same along axis 0 in curved coordinates: rate += (A+ F+ + A- F-) / 2V. */
static BULLA_KERNEL void divergence_mean_curved(size_t n, const double *restrict area, const double *restrict volume,
                                                const double *restrict force, double *restrict rate)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double low = force[i], up = force[i + 1], old = rate[i];
        rate[i] = old + 0.5 * (area[i + 1] * up + area[i] * low) / volume[i];
    }
}

/* For components that no cell value is taken off. */
static const double divergence_zero[METRIC_CELLS];

/* One row of consecutive cells: where its faces start and where its cells lie in the tile. */
struct divergence_span {
    size_t face, cell, n, step;
    double per_h; /* of the axis [1/m] */
    bool curved;  /* axis 0 of a curved geometry */
};

static void divergence_force(const struct term_tile *tile, const struct divergence_span *span,
                             const struct term_flux *flux)
{
    double *rate = tile->rates + flux->rate * tile->n_cell + span->cell;
    const double *force = flux->below + span->face;
    if (span->curved) divergence_mean_curved(span->n, tile->metric->area, tile->metric->volume, force, rate);
    else divergence_mean(span->n, 0.5 * span->per_h, force, force + span->step, rate);
}

static void divergence_flux(const struct term_tile *tile, const struct divergence_span *span,
                            const struct term_flux *flux)
{
    double *rate = tile->rates + flux->rate * tile->n_cell + span->cell;
    const struct metric *metric = tile->metric;
    if (span->curved && flux->kind != TERM_DIFFERENCE)
        divergence_curved(span->n, metric->area, metric->volume, flux->below + span->face,
                          flux->above + span->face + span->step,
                          flux->kind == TERM_BALANCED ? tile->hoop + span->cell : divergence_zero, rate);
    else divergence_row(span->n, span->per_h, flux->below + span->face, flux->above + span->face + span->step, rate);
}

static void divergence_span(const struct term_tile *tile, int axis, const struct divergence_span *span)
{
    const struct terms *terms = tile->terms;
    for (unsigned i = 0; i < terms->n_flux[axis]; i++) {
        const struct term_flux *flux = &terms->flux[axis][i];
        if (flux->kind == TERM_FORCE) divergence_force(tile, span, flux);
        else if (flux->kind != TERM_TOLD) divergence_flux(tile, span, flux);
    }
}

void divergence_add(const struct term_tile *tile, const struct frame *frame)
{
    bool whole = frame->inner == frame->tile_inner; /* then the rows of an outer slice follow each other */
    size_t rows = whole ? 1 : frame->n, length = whole ? frame->n * frame->inner : frame->inner;
    for (size_t o = 0; o < frame->outer; o++)
        for (size_t row = 0; row < rows; row++) {
            const struct divergence_span span = {.face = face_at(frame, o, row),
                                                 .cell = frame_tile_at(frame, o, row),
                                                 .n = length,
                                                 .step = frame->inner,
                                                 .per_h = 1.0 / tile->level->h[frame->axis],
                                                 .curved = tile->model->beta > 0 && frame->axis == 0};
            divergence_span(tile, frame->axis, &span);
        }
}
