/* divergence.c - see divergence.h. */
#include "scheme/divergence.h"

#include "scheme/terms.h"

/* Rows of consecutive cells of a piece: how many, how long, and how far apart those of faces and of the tile's cells. */
struct divergence_lines {
    size_t count, n, face, cell;
};

/* rate -= a (upper - lower) */
static BULLA_KERNEL void divergence_rows(const struct divergence_lines *lines, double a, const double *lower,
                                         const double *upper, double *rate)
{
    size_t n = lines->n;
    for (size_t k = 0; k < lines->count; k++) {
        const double *restrict below = lower + k * lines->face, *restrict above = upper + k * lines->face;
        double *restrict row = rate + k * lines->cell;
#pragma omp simd
        for (size_t i = 0; i < n; i++) {
            double low = below[i], up = above[i], old = row[i];
            row[i] = old - a * (up - low);
        }
    }
}

/* Rows along axis 0 in curved coordinates: rate -= (A+ (F+ - q) - A- (F- - q)) / V; q is the cell's pressure for the
 * radial momentum, else a row of zeros for all lines. */
static BULLA_KERNEL void divergence_curved(const struct divergence_lines *lines, const struct metric *metric,
                                           const double *lower, const double *upper, const double *q, size_t q_step,
                                           double *rate)
{
    const double *restrict area = metric->area, *restrict volume = metric->volume;
    size_t n = lines->n;
    for (size_t k = 0; k < lines->count; k++) {
        const double *restrict below = lower + k * lines->face, *restrict above = upper + k * lines->face;
        const double *restrict taken = q + k * q_step;
        double *restrict row = rate + k * lines->cell;
#pragma omp simd
        for (size_t i = 0; i < n; i++) {
            double low = below[i], up = above[i], inside = taken[i], old = row[i];
            row[i] = old - (area[i + 1] * (up - inside) - area[i] * (low - inside)) / volume[i];
        }
    }
}

/* For components that no cell value is taken off. */
static const double divergence_zero[METRIC_CELLS];

/* One flux through lines whose first face and cell these are. */
static void divergence_flux(const struct term_tile *tile, const struct frame *frame, const struct term_flux *flux,
                            const struct divergence_lines *lines, size_t face, size_t cell)
{
    double *rate = tile->rates + flux->rate * tile->n_cell + cell;
    const double *below = flux->below + face, *above = flux->above + face + frame->inner;
    bool curved = tile->model->beta > 0 && frame->axis == 0 && flux->kind != TERM_DIFFERENCE;
    bool balanced = flux->kind == TERM_BALANCED;
    if (curved)
        divergence_curved(lines, tile->metric, below, above, balanced ? tile->hoop + cell : divergence_zero,
                          balanced ? lines->cell : 0, rate);
    else divergence_rows(lines, 1.0 / tile->level->h[frame->axis], below, above, rate);
}

void divergence_add(const struct term_tile *tile, const struct frame *frame)
{
    const struct terms *terms = tile->terms;
    bool whole = frame->inner == frame->tile_inner; /* then the rows of an outer slice follow each other */
    const struct divergence_lines lines = {.count = frame->outer,
                                           .n = whole ? frame->n * frame->inner : frame->inner,
                                           .face = frame_layers(frame) * frame->inner,
                                           .cell = frame->n * frame->tile_inner};
    for (size_t row = 0; row < (whole ? 1 : frame->n); row++)
        for (unsigned i = 0; i < terms->n_flux[frame->axis]; i++) {
            const struct term_flux *flux = &terms->flux[frame->axis][i];
            if (flux->kind != TERM_TOLD)
                divergence_flux(tile, frame, flux, &lines, face_at(frame, 0, row), frame_tile_at(frame, 0, row));
        }
}
