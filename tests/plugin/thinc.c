/* thinc.c - a reconstruction from outside the tree that looks at all components: fractions of two materials follow a
 * hyperbolic tangent across an interface (Xiao, Honma & Kono, Int. J. Numer. Methods Fluids 48 (2005) 1023-1040),
 * everything else has the slopes of the case. For tests of schemes that are no limiters. */
#include <bulla/reconstruction.h>

#include <math.h>
#include <stddef.h>

#define THINC_STEEPNESS 1.6
#define THINC_PURE 1e-4 /* no interface in cells this close to 0 or 1 */

/* At the fuller or the emptier edge of a cell with the fraction c; no more than the cell has of both materials. */
static double thinc_edge(double c, int fuller)
{
    double t = tanh(THINC_STEEPNESS), a = (exp(THINC_STEEPNESS * (2.0 * c - 1.0)) / cosh(THINC_STEEPNESS) - 1.0) / t;
    double value = 0.5 * (1.0 + (fuller ? (t + a) / (1.0 + a * t) : a));
    double least = c > 0.5 ? 2.0 * c - 1.0 : 0.0, most = c < 0.5 ? 2.0 * c : 1.0;
    value = value > least ? value : least;
    return value < most ? value : most;
}

/* Of the first fraction; the second takes the rest. */
static void thinc_sharpen(const struct bulla_cells *cells)
{
    const double *w = cells->w[cells->i_alpha];
    for (size_t i = 0; i < cells->n; i++) {
        double c = w[i], before = *(w + i - cells->step), after = w[i + cells->step];
        if (!((after - c) * (c - before) > 0.0 && c > THINC_PURE && c < 1.0 - THINC_PURE)) continue;
        for (uint32_t l = 0; l < 2; l++) {
            double lower = thinc_edge(c, after < before), upper = thinc_edge(c, after > before);
            cells->lower[cells->i_alpha + l][i] = l ? 1.0 - lower : lower;
            cells->upper[cells->i_alpha + l][i] = l ? 1.0 - upper : upper;
        }
    }
}

static void thinc_all(const void *self, const struct bulla_cells *cells)
{
    (void)self;
    for (uint32_t q = 0; q < cells->n_row; q++)
        cells->limited[q]->edges(cells->limited[q], cells->n, cells->step, cells->w[q], cells->lower[q],
                                 cells->upper[q]);
    if (cells->n_alpha == 2) thinc_sharpen(cells);
}

static const struct bulla_reconstruction thinc_table = {.size = sizeof(struct bulla_reconstruction),
                                                        .layers = 2,
                                                        .all = thinc_all};

BULLA_EXPORT const struct bulla_module bulla_module = {
    .magic = BULLA_MAGIC,
    .abi = BULLA_ABI,
    .size = sizeof(struct bulla_module),
    .kind = "reconstruction",
    .name = "thinc",
    .version = "1.0",
    .doc = "Interfaces of two materials as hyperbolic tangents, limited slopes elsewhere.",
    .cite = "Xiao, Honma & Kono, Int. J. Numer. Methods Fluids 48 (2005) 1023-1040",
    .table = &thinc_table,
};
