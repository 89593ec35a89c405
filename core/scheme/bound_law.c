/* bound_law.c - see bound_law.h. A module gets the velocity along the outward normal first, and copies of what is
 * inside beside the rows that it may write. */
#include "scheme/bound_law.h"

#include "bulla/boundary.h"
#include "scheme/frame.h"

#include <string.h>

enum {
    BOUND_LAW_ROW = FRAME_CELLS / (2 * SCENE_GHOSTS), /* most face cells of a frame */
    BOUND_LAW_ROWS = 2 * SCENE_MATERIALS + SCENE_AXES + 1
};

static uint32_t bound_law_traits(const struct scene_boundary *boundary)
{
    return ((const struct bulla_boundary *)boundary->law.module->table)->traits;
}

bool bound_law_mirrors(const struct scene_boundary *boundary)
{
    return boundary->law.module && bound_law_traits(boundary) & BULLA_BEHIND_MIRRORS;
}

bool bound_law_is_isentropic(const struct scene_boundary *boundary)
{
    return bound_law_traits(boundary) & BULLA_BEHIND_ISENTROPIC;
}

bool bound_law_brings(const struct scene_boundary *boundary)
{
    return bound_law_traits(boundary) & BULLA_BEHIND_BRINGS;
}

/* The rows that a module sees, inside and behind. */
struct bound_law_view {
    const double *alpha[SCENE_MATERIALS], *rho[SCENE_MATERIALS], *u[SCENE_AXES], *p;
    double *alpha_behind[SCENE_MATERIALS], *rho_behind[SCENE_MATERIALS], *u_behind[SCENE_AXES], *p_behind;
    double inside[BOUND_LAW_ROWS][BOUND_LAW_ROW], whole[BOUND_LAW_ROW];
    unsigned n_row;
};

/* A copy of a row, for reading. */
static const double *bound_law_keep(struct bound_law_view *view, size_t n, const double *row)
{
    double *to = view->inside[view->n_row++];
    memcpy(to, row, n * sizeof *to);
    return to;
}

static void bound_law_look(const struct bound_law_row *row, struct bound_law_view *view)
{
    const struct model *model = row->model;
    view->n_row = 0;
    for (size_t i = 0; i < row->n; i++) view->whole[i] = 1.0; /* of the only material of a path */
    for (unsigned l = 0; l < model->n_material; l++) {
        view->alpha_behind[l] = model->n_alpha ? row->w + (model->i_alpha + l) * row->stride : view->whole;
        view->rho_behind[l] = row->w + (model->i_m + l) * row->stride;
        view->alpha[l] = bound_law_keep(view, row->n, view->alpha_behind[l]);
        view->rho[l] = bound_law_keep(view, row->n, view->rho_behind[l]);
    }
    for (unsigned d = 0, next = 1; d < model->n_velocity; d++) {
        unsigned to = d == (unsigned)row->axis ? 0 : next++;
        view->u_behind[to] = row->w + (model->i_u + d) * row->stride;
        view->u[to] = bound_law_keep(view, row->n, view->u_behind[to]);
    }
    view->p_behind = row->w + model->i_E * row->stride;
    view->p = bound_law_keep(view, row->n, view->p_behind);
}

/* Along the outward normal, and back. */
static void bound_law_turn(const struct bound_law_row *row)
{
    double *u = row->w + (row->model->i_u + (unsigned)row->axis) * row->stride;
    for (size_t i = 0; i < row->n && row->side == 0; i++) u[i] = -u[i];
}

void bound_law_fill(const struct scene_boundary *boundary, const struct bound_law_row *row)
{
    const struct bulla_boundary *law = boundary->law.module->table;
    struct bound_law_view view;
    bound_law_turn(row);
    bound_law_look(row, &view);
    const struct bulla_behind faces = {.size = sizeof faces,
                                       .n_material = row->model->n_material,
                                       .n_velocity = row->model->n_velocity,
                                       .first = row->model->first,
                                       .axis = (uint32_t)row->axis,
                                       .side = (uint32_t)row->side,
                                       .n = row->n,
                                       .t = row->t,
                                       .depth = row->depth,
                                       .x = {row->x[0], row->x[1], row->x[2]},
                                       .alpha = view.alpha,
                                       .rho = view.rho,
                                       .u = view.u,
                                       .p = view.p,
                                       .Z = row->Z,
                                       .p_start = row->p_start,
                                       .u_start = row->u_start,
                                       .alpha_behind = view.alpha_behind,
                                       .rho_behind = view.rho_behind,
                                       .u_behind = view.u_behind,
                                       .p_behind = view.p_behind};
    law->fill(boundary->law.self, &faces);
    bound_law_turn(row);
}
