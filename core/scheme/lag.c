/* lag.c - see lag.h. */
#include "scheme/lag.h"

#include "phys/row.h"
#include "phys/traction.h"
#include "scheme/closure.h"
#include "scheme/exchange.h"
#include "scheme/terms.h"

#include <string.h>

static bool lag_wanted(const struct model *path)
{
    return model_jumps(path);
}

/* What volume of a material carries through the faces beside the mean pressure there: energy, and a pressure that it
 * had (exchange.h). */
static void lag_faces(const struct term_piece *piece)
{
    const struct model *path = piece->model;
    struct face_work *faces = piece->faces;
    size_t n = faces->faces.n, reach = frame_reach(piece->frame);
    for (unsigned l = 0; l < path->n_material; l++) {
        const double *lag = faces->lag + l * FACE_ROOM + reach, *volume = faces->alpha + l * FACE_ROOM;
        row_add_product(n, volume, lag, faces->energy);
        row_add_product(n, volume, lag, faces->carried + l * FACE_ROOM);
    }
}

/* Volume that comes in is compared with the pressure that its own material has in the cell. */
static void lag_cells(struct term_tile *tile)
{
    const struct model *path = tile->model;
    if (!closure_term.wanted(path)) return;
    double *carried = tile->rates + terms_first(tile->terms, &exchange_term) * tile->n_cell;
    for (size_t from = 0; from < tile->n_cell; from += TRACTION_BATCH) {
        size_t n = tile->n_cell - from < TRACTION_BATCH ? tile->n_cell - from : TRACTION_BATCH;
        struct traction_pressures parts; /* large: filled as far as it is used */
        double owed[TRACTION_BATCH];
        traction_part(path, n, tile->n_cell, tile->w + from, &parts);
        for (unsigned l = 0; l < path->n_material; l++) {
            memset(owed, 0, n * sizeof *owed);
            row_add_product(n, parts.lag[l], tile->rates + (path->i_alpha + l) * tile->n_cell + from, owed);
            row_take(n, owed, carried + l * tile->n_cell + from);
        }
    }
}

const struct term lag_term = {
    .name = "lags",
    .owner = "core/scheme/lag.c",
    .equation = "d(rho E)/dt -= div(sum alpha_l (p_l - p) u): materials keep their own pressures",
    .wanted = lag_wanted,
    .faces = lag_faces,
    .cells = lag_cells,
};
