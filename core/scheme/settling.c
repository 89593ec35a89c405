/* settling.c - see settling.h. */
#include "scheme/settling.h"

#include "phys/mix.h"
#include "phys/settle.h"
#include "phys/traction.h"
#include "scheme/closure.h"
#include "scheme/convection.h"
#include "scheme/exchange.h"
#include "scheme/response.h"
#include "scheme/terms.h"

#include <string.h>

enum { SETTLING_BATCH = 32 };

static bool settling_wanted(const struct model *path)
{
    return settle_wanted(path) && closure_wanted(path);
}

static unsigned settling_rows(const struct model *path)
{
    return path->n_material;
}

static double *settling_row(const struct term_tile *tile)
{
    return tile->rates + terms_first(tile->terms, &settling_term) * tile->n_cell;
}

/* What volume brings along; the exchange, which is made later, leaves other things in its rows. */
static void settling_cells(struct term_tile *tile)
{
    const double *carried = tile->rates + terms_first(tile->terms, &exchange_term) * tile->n_cell;
    memcpy(settling_row(tile), carried, tile->model->n_alpha * tile->n_cell * sizeof *carried);
}

/* The pressure of fluid l of a cell after the stage, by its own motion; `old`: before it. */
static double settling_pressure(const struct term_tile *tile, unsigned l, size_t cell, double old, double p,
                                const double *u_new)
{
    const struct model *model = tile->model;
    size_t n = tile->n_cell, at = (model->i_alpha + l) * n + cell;
    double dt = tile->dt, div = -tile->rates[terms_first(tile->terms, &convection_term) * n + cell];
    double strained = tile->rates[(terms_first(tile->terms, &exchange_term) + model->n_alpha + l) * n + cell];
    double alpha = tile->u[at], here = tile->w[at];
    double moved = alpha + dt * (tile->rates[at] + here * div), K = tile->rho_c2[l * n + cell];
    double brought = alpha * old + dt * (settling_row(tile)[l * n + cell] + here * p * div);
    double strain = dt * div - dt * strained / moved + (u_new[at] - moved) / moved;
    return brought / moved - K * (strain < 0.0 ? strain / (1.0 + strain) : strain);
}

/* Of n cells, into the rows of the term: the old pressure where the law has no such state. */
static void settling_pressures(const struct term_tile *tile, unsigned l, size_t n, const size_t *cell,
                               const double *old, const double *p, const double *u_new)
{
    const struct model *model = tile->model;
    const double *m = u_new + (model->i_m + l) * tile->n_cell, *alpha = u_new + (model->i_alpha + l) * tile->n_cell;
    double rho[SETTLING_BATCH], least[SETTLING_BATCH], *row = settling_row(tile) + l * tile->n_cell;
    for (size_t i = 0; i < n; i++) rho[i] = m[cell[i]] / alpha[cell[i]];
    model->eos[l].law->p_min(model->eos[l].self, n, rho, least);
    for (size_t i = 0; i < n; i++) {
        double now = settling_pressure(tile, l, cell[i], old[i], p[i], u_new);
        row[cell[i]] = now > least[i] ? now : old[i];
    }
}

/* Pressures of all materials of n cells of a block of fields: conserved ones or primitives. */
static void settling_own(const struct term_tile *tile, size_t n, const size_t *cell, bool conserved,
                         const double *fields, double (*p)[SETTLING_BATCH])
{
    const struct model *model = tile->model;
    double u[MODEL_FIELDS][SETTLING_BATCH], w[MODEL_FIELDS][SETTLING_BATCH];
    struct traction_pressures parts;
    memset(w, 0, model->n_field * sizeof *w);
    for (unsigned a = 0; a < model->n_active; a++) {
        unsigned q = model->active[a];
        for (size_t i = 0; i < n; i++) u[q][i] = w[q][i] = fields[q * tile->n_cell + cell[i]];
    }
    if (conserved) mix_primitives(model, n, SETTLING_BATCH, u[0], w[0]);
    traction_part(model, n, SETTLING_BATCH, w[0], &parts);
    for (unsigned l = 0; l < model->n_material; l++)
        memcpy(p[l], traction_pressure(model, n, l, w[model->i_E], &parts), n * sizeof **p);
}

static size_t settling_apply(const struct term_tile *tile, double *u_new)
{
    const struct model *model = tile->model;
    size_t cell[SETTLING_BATCH], n = 0;
    double old[SCENE_MATERIALS][SETTLING_BATCH], p[SCENE_MATERIALS][SETTLING_BATCH];
    for (size_t c = 0; c < tile->n_cell; c++) {
        if (settle_is(model, tile->n_cell, u_new + c)) cell[n++] = c;
        if (!n || (n < SETTLING_BATCH && c + 1 < tile->n_cell)) continue;
        settling_own(tile, n, cell, true, tile->u, old);
        settling_own(tile, n, cell, false, tile->w, p);
        for (unsigned l = 0; l < model->n_alpha; l++) settling_pressures(tile, l, n, cell, old[l], p[l], u_new);
        n = 0;
    }
    settle_fluids(model, tile->n_cell, tile->n_cell, settling_row(tile), response_stiffness(tile), u_new);
    return 0;
}

const struct term settling_term = {
    .name = "settling",
    .owner = "core/scheme/settling.c",
    .equation = "in cells of solid and fluid: the heat of the solid is its own",
    .wanted = settling_wanted,
    .rows = settling_rows,
    .cells = settling_cells,
    .apply = settling_apply,
};
