/* divergence.c - see divergence.h. */
#include "scheme/divergence.h"

#include "scheme/terms.h"

/* rate -= a (upper - lower) of n cells. */
static inline void divergence_row(size_t n, double a, const double *restrict below, const double *restrict above,
                                  double *restrict row)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double low = below[i], up = above[i], old = row[i];
        row[i] = old - a * (up - low);
    }
}

/* Of all lines, `part` cells at once, which divide n. Inlined with a number, a part has no loop. */
static inline void divergence_parts(const struct frame_runs *lines, size_t part, double a, const double *lower,
                                    const double *upper, double *rate)
{
    size_t count = lines->count, n = lines->n, row = lines->row, tile = lines->tile;
    for (size_t k = 0; k < count; k++, lower += row, upper += row, rate += tile)
        for (size_t i = 0; i < n; i += part) divergence_row(part, a, lower + i, upper + i, rate + i);
}

static BULLA_KERNEL void divergence_rows(const struct frame_runs *lines, double a, const double *lower,
                                         const double *upper, double *rate)
{
    if (lines->n % 16 == 0) divergence_parts(lines, 16, a, lower, upper, rate);
    else if (lines->n % 8 == 0) divergence_parts(lines, 8, a, lower, upper, rate);
    else divergence_parts(lines, lines->n, a, lower, upper, rate);
}

/* Rows along axis 0 in curved coordinates: rate -= (A+ (F+ - q) - A- (F- - q)) / V; q is the cell's pressure for the
 * radial momentum, else a row of zeros for all lines. */
static BULLA_KERNEL void divergence_curved(const struct frame_runs *lines, const double *restrict area,
                                           const double *restrict volume, const double *lower, const double *upper,
                                           const double *q, size_t q_step, double *rate)
{
    size_t n = lines->n;
    for (size_t k = 0; k < lines->count; k++) {
        const double *restrict below = lower + k * lines->row, *restrict above = upper + k * lines->row;
        const double *restrict taken = q + k * q_step;
        double *restrict row = rate + k * lines->tile;
#pragma omp simd
        for (size_t i = 0; i < n; i++) {
            double low = below[i], up = above[i], inside = taken[i], old = row[i];
            row[i] = old - (area[i + 1] * (up - inside) - area[i] * (low - inside)) / volume[i];
        }
    }
}

/* A force at faces, half of it to the cell on either side: rate += a (upper + lower) */
static BULLA_KERNEL void divergence_mean(const struct frame_runs *lines, double a, const double *lower,
                                         const double *upper, double *rate)
{
    size_t n = lines->n;
    for (size_t k = 0; k < lines->count; k++) {
        const double *restrict below = lower + k * lines->row, *restrict above = upper + k * lines->row;
        double *restrict row = rate + k * lines->tile;
#pragma omp simd
        for (size_t i = 0; i < n; i++) {
            double low = below[i], up = above[i], old = row[i];
            row[i] = old + a * (up + low);
        }
    }
}

/* The same along axis 0 in curved coordinates: rate += (A+ F+ + A- F-) / 2V. */
static BULLA_KERNEL void divergence_mean_curved(const struct frame_runs *lines, const struct metric *metric,
                                                const double *force, double *rate)
{
    const double *restrict area = metric->area, *restrict volume = metric->volume;
    size_t n = lines->n;
    for (size_t k = 0; k < lines->count; k++) {
        const double *restrict at = force + k * lines->row;
        double *restrict row = rate + k * lines->tile;
#pragma omp simd
        for (size_t i = 0; i < n; i++) {
            double low = at[i], up = at[i + 1], old = row[i];
            row[i] = old + 0.5 * (area[i + 1] * up + area[i] * low) / volume[i];
        }
    }
}

/* For components that no cell value is taken off. */
static const double divergence_zero[METRIC_CELLS];

/* Lines whose first face and cell are these. */
struct divergence_span {
    const struct frame_runs *lines;
    size_t face, next, cell; /* next: from a face to the upper one of its cell */
    double per_h;            /* of the axis [1/m] */
    bool curved;             /* axis 0 of a curved geometry */
};

static void divergence_force(const struct term_tile *tile, const struct divergence_span *span,
                             const struct term_flux *flux)
{
    double *rate = tile->rates + flux->rate * tile->n_cell + span->cell;
    const double *force = flux->below + span->face;
    if (span->curved) divergence_mean_curved(span->lines, tile->metric, force, rate);
    else divergence_mean(span->lines, 0.5 * span->per_h, force, force + span->next, rate);
}

static void divergence_flux(const struct term_tile *tile, const struct divergence_span *span,
                            const struct term_flux *flux)
{
    double *rate = tile->rates + flux->rate * tile->n_cell + span->cell;
    const double *below = flux->below + span->face, *above = flux->above + span->face + span->next;
    const struct metric *metric = tile->metric;
    bool balanced = flux->kind == TERM_BALANCED && tile->hoop, turns = model_is_turn(tile->model, flux->rate);
    if (span->curved && flux->kind != TERM_DIFFERENCE)
        divergence_curved(span->lines, turns ? metric->turn_area : metric->area,
                          turns ? metric->turn_volume : metric->volume, below, above,
                          balanced ? tile->hoop + span->cell : divergence_zero, balanced ? span->lines->tile : 0, rate);
    else divergence_rows(span->lines, span->per_h, below, above, rate);
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
    const struct frame_runs lines = frame_runs(frame);
    const struct divergence_span span = {.lines = &lines,
                                         .face = face_at(frame, 0, 0),
                                         .next = frame->inner,
                                         .cell = frame_tile_at(frame, 0, 0),
                                         .per_h = 1.0 / tile->level->h[frame->axis],
                                         .curved = tile->model->beta > 0 && frame->axis == 0};
    divergence_span(tile, frame->axis, &span);
}
