/* bound.c - see bound.h.
 *
 * Mirrors and copies act on layers. Characteristic boundaries (non-reflecting, incoming wave)
 * compose the state behind the face from the outgoing Riemann invariant of the cell inside and
 * the incoming one of the far field plus the wave,
 *     p + Z u = p_i + Z u_i,      p - Z u = (p_0 + p') - Z (u_0 - p'/Z),      Z = rho c,
 * u along the outward normal, so that a wave at normal incidence enters or leaves without a
 * reflection to first order. Densities follow each material's isentrope from inside. */
#include "scheme/bound.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/pulse.h"
#include "paint/paint.h"
#include "phys/elastic.h"
#include "phys/mix.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BOUND_ROW = FRAME_CELLS / (2 * SCENE_GHOSTS) }; /* most face cells of a frame */

static const struct scene_boundary *bound_of(const struct bound *bound, const struct frame *frame, int side)
{
    return &bound->model->scene->boundary[frame->axis][side];
}

static bool bound_is_characteristic(const struct scene_boundary *boundary)
{
    return boundary->type == SCENE_NONREFLECTING || boundary->type == SCENE_INCOMING_WAVE;
}

/* Cells of a face of a tile. */
static size_t bound_face_cells(const struct mesh *mesh, int axis)
{
    return mesh->n_cell / (size_t)mesh->n[axis];
}

static void bound_keep_reference(struct bound *bound, unsigned local, int axis, int side, const double *w)
{
    const struct mesh *mesh = bound->mesh;
    const struct model *model = bound->model;
    size_t cells = bound_face_cells(mesh, axis), n = (size_t)mesh->n[axis], inner = 1;
    for (int d = 0; d < axis; d++) inner *= (size_t)mesh->n[d];
    double *reference = mem_new(2 * cells, sizeof *reference);
    const double *p = w + model->i_E * mesh->n_cell, *u = w + (model->i_u + (unsigned)axis) * mesh->n_cell;
    for (size_t c = 0; c < cells; c++) {
        size_t cell = (c / inner * n + (side ? n - 1 : 0)) * inner + c % inner;
        reference[c] = p[cell];
        reference[cells + c] = side ? u[cell] : -u[cell];
    }
    bound->reference[local * MESH_FACES + (unsigned)(2 * axis + side)] = reference;
}

static struct bound *bound_start(const struct model *model, const struct mesh *mesh, const struct level *level)
{
    struct bound *bound = mem_new(1, sizeof *bound);
    *bound = (struct bound){.model = model, .mesh = mesh, .level = level, .n_local = level->n_local};
    bound->reference = mem_new((size_t)level->n_local * MESH_FACES, sizeof *bound->reference);
    return bound;
}

static bool bound_refers(const struct bound *bound, unsigned local, int face)
{
    return bound->level->neighbours[local][face].kind == NEIGHBOUR_BOUNDARY &&
           bound_is_characteristic(&bound->model->scene->boundary[face / 2][face % 2]);
}

struct bound *bound_new(const struct model *model, const struct mesh *mesh, const struct level *level)
{
    struct bound *bound = bound_start(model, mesh, level);
    for (unsigned t = 0; t < level->n_local; t++)
        for (int face = 0; face < 2 * mesh->dim; face++)
            if (bound_refers(bound, t, face)) bound_keep_reference(bound, t, face / 2, face % 2, level->w[t]);
    return bound;
}

/* References of one tile from its initial state; u and w are scratch of a tile's block. */
static int bound_paint_tile(struct bound *bound, unsigned local, double *u, double *w)
{
    const struct mesh *mesh = bound->mesh;
    const struct level *level = bound->level;
    size_t n_cell = mesh->n_cell;
    bool painted = false;
    for (int face = 0; face < 2 * mesh->dim; face++) {
        if (!bound_refers(bound, local, face)) continue;
        if (!painted) {
            TRY(paint_tile(bound->model, mesh, level, &level->tiles[level->first + local], u));
            for (size_t i = 0; i < n_cell; i++) w[bound->model->i_E * n_cell + i] = 1e5; /* where an iteration starts */
            mix_primitives(bound->model, n_cell, n_cell, u, w);
        }
        painted = true;
        bound_keep_reference(bound, local, face / 2, face % 2, w);
    }
    return STATUS_OK;
}

struct bound *bound_paint(const struct model *model, const struct mesh *mesh, const struct level *level,
                          struct bound *before, const int *from)
{
    struct bound *bound = bound_start(model, mesh, level);
    double *u = mem_new(2 * model->n_field * mesh->n_cell, sizeof *u), *w = u + model->n_field * mesh->n_cell;
    for (unsigned t = 0; t < level->n_local && !bound->status; t++) {
        if (!from || from[t] < 0) {
            bound->status = bound_paint_tile(bound, t, u, w);
            continue;
        }
        double **old = before->reference + (size_t)from[t] * MESH_FACES;
        memcpy(bound->reference + (size_t)t * MESH_FACES, old, MESH_FACES * sizeof *old);
        memset(old, 0, MESH_FACES * sizeof *old);
    }
    if (bound->status) bound->message = mem_text(status_text());
    mem_free(u);
    bound_free(before);
    return bound;
}

void bound_free(struct bound *bound)
{
    if (!bound) return;
    for (size_t i = 0; i < (size_t)bound->n_local * MESH_FACES; i++) mem_free(bound->reference[i]);
    mem_free(bound->reference);
    mem_free(bound->message);
    mem_free(bound);
}

/* Frame layer behind the face, counted from it, and the layer inside that mirrors it. */
static int bound_layer(const struct frame *frame, int side, int ghost)
{
    return side ? (int)frame->n + ghost : -1 - ghost;
}

static int bound_inside(const struct frame *frame, int side, int ghost)
{
    return side ? (int)frame->n - 1 - ghost : ghost;
}

static void bound_layers(const struct frame *frame, int side, bool mirror, double factor, double *w)
{
    for (int ghost = 0; ghost < (int)frame->ghosts; ghost++)
        for (size_t o = 0; o < frame->outer; o++) {
            double *to = w + frame_at(frame, o, bound_layer(frame, side, ghost));
            const double *from = w + frame_at(frame, o, bound_inside(frame, side, mirror ? ghost : 0));
            for (size_t i = 0; i < frame->inner; i++) to[i] = factor * from[i];
        }
}

void bound_copy(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w)
{
    (void)data;
    (void)local;
    (void)pitch;
    bound_layers(frame, side, false, 1.0, w);
}

/* Is this component of the stretch one of those that a mirror across `axis` turns round? */
static bool bound_is_crossed(const struct model *model, int axis, unsigned q)
{
    unsigned n = (unsigned)axis;
    if (q < model->i_V + 3) return false;
    return q == model->i_V + elastic_component(n, (n + 1) % 3) || q == model->i_V + elastic_component(n, (n + 2) % 3);
}

static void bound_mirror(const struct model *model, const struct frame *frame, int side, bool no_slip, size_t pitch,
                         double *w)
{
    for (unsigned i = 0; i < model->n_active; i++) {
        unsigned q = model->active[i];
        bool velocity = q >= model->i_u && q < model->i_E;
        bool reversed = velocity ? no_slip || q == model->i_u + (unsigned)frame->axis
                                 : !no_slip && bound_is_crossed(model, frame->axis, q);
        bound_layers(frame, side, true, reversed ? -1.0 : 1.0, w + q * pitch);
    }
}

/* One row of boundary cells taken out of the frame: [n_field] components of `stride` points. */
struct bound_row {
    size_t n, stride;
    double *w;
};

static void bound_take(const struct model *model, const struct frame *frame, int side, size_t pitch, const double *w,
                       struct bound_row *row)
{
    for (unsigned a = 0; a < model->n_active; a++)
        for (size_t q = model->active[a], o = 0; o < frame->outer; o++)
            memcpy(row->w + q * row->stride + o * frame->inner,
                   w + q * pitch + frame_at(frame, o, bound_inside(frame, side, 0)), frame->inner * sizeof *w);
}

static void bound_put(const struct model *model, const struct frame *frame, int side, size_t pitch,
                      const struct bound_row *row, double *w)
{
    for (unsigned a = 0; a < model->n_active; a++)
        for (int ghost = 0; ghost < (int)frame->ghosts; ghost++)
            for (size_t o = 0; o < frame->outer; o++)
                memcpy(w + model->active[a] * pitch + frame_at(frame, o, bound_layer(frame, side, ghost)),
                       row->w + model->active[a] * row->stride + o * frame->inner, frame->inner * sizeof *w);
}

/* Centre of the boundary face of point c of a row. */
static void bound_position(const struct bound *bound, unsigned local, const struct frame *frame, int side, size_t c,
                           double ret_x[3])
{
    const struct mesh *mesh = bound->mesh;
    const struct level *level = bound->level;
    size_t o = frame->outer_from + c / frame->inner, i = frame->inner_from + c % frame->inner;
    size_t below = 1, at[3];
    mesh_corner(mesh, level, &level->tiles[level->first + local], ret_x);
    for (int d = 0; d < 3; d++) {
        if (d == frame->axis) {
            below = 1;
            continue;
        }
        size_t index = d < frame->axis ? i : o;
        at[d] = index / below % (size_t)mesh->n[d];
        below *= (size_t)mesh->n[d];
        ret_x[d] += d < mesh->dim ? ((double)at[d] + 0.5) * level->h[d] : 0.0;
    }
    ret_x[frame->axis] = side ? mesh->upper[frame->axis] : mesh->lower[frame->axis];
}

/* Keeps the first failure: of which value, at which point, beside which cell of the tile. */
static void bound_fail(struct bound *bound, unsigned local, int status, const char *what, const double x[3])
{
    const struct mesh *mesh = bound->mesh;
    const struct level *level = bound->level;
    double corner[3];
    int cell[3] = {0};
    if (bound->status) return;
    bound->status = status;
    bound->message = mem_text(status_text());
    mesh_corner(mesh, level, &level->tiles[level->first + local], corner);
    for (int d = 0; d < mesh->dim; d++) {
        int at = (int)floor((x[d] - corner[d]) / level->h[d]);
        cell[d] = at < 0 ? 0 : at < mesh->n[d] ? at : mesh->n[d] - 1;
    }
    snprintf(bound->blind, sizeof bound->blind, "%s at (%.9g, %.9g, %.9g) m, beside cell (%d, %d, %d)", what, x[0],
             x[1], x[2], cell[0], cell[1], cell[2]);
}

/* rho_l moved along its isentrope by dp: midpoint rule on d rho / dp = 1/c^2. */
static void bound_isentrope(const struct model_eos *eos, size_t n, const double *p, const double *p_new, double *rho,
                            double *scratch)
{
    double *e = scratch, *rho_c2 = scratch + n, *half_rho = scratch + 2 * n, *half_p = scratch + 3 * n;
    eos->law->state(eos->self, n, rho, p, e, rho_c2);
    for (size_t i = 0; i < n; i++) {
        half_p[i] = 0.5 * (p[i] + p_new[i]);
        half_rho[i] = rho[i] + 0.5 * (p_new[i] - p[i]) * rho[i] / rho_c2[i];
    }
    eos->law->state(eos->self, n, half_rho, half_p, e, rho_c2);
    for (size_t i = 0; i < n; i++) rho[i] += (p_new[i] - p[i]) * half_rho[i] / rho_c2[i];
}

/* Gauge pressure of the wave and far-field pressure at the points of a row. */
static void bound_targets(struct bound *bound, unsigned local, const struct frame *frame, int side, size_t n,
                          double *ret_far, double *ret_wave)
{
    const struct scene_boundary *boundary = bound_of(bound, frame, side);
    for (size_t c = 0; c < n; c++) {
        double x[3];
        bound_position(bound, local, frame, side, c, x);
        int status = STATUS_OK;
        if (boundary->pressure.given) status = scene_value_at(&boundary->pressure, x, x[0], bound->t, &ret_far[c]);
        if (status) bound_fail(bound, local, status, "far-field pressure", x);
        ret_wave[c] = 0.0;
        if (!status && boundary->type == SCENE_INCOMING_WAVE)
            status = pulse_pressure(boundary, bound->t, x, &ret_wave[c]);
        if (!status) continue;
        bound_fail(bound, local, status, "pressure of the wave", x);
        ret_wave[c] = (double)NAN;
    }
}

static void bound_characteristic(struct bound *bound, unsigned local, const struct frame *frame, int side,
                                 struct bound_row *row)
{
    const struct model *model = bound->model;
    size_t n = row->n, cells = frame->tile_outer * frame->tile_inner;
    double far[BOUND_ROW], wave[BOUND_ROW], old[BOUND_ROW], c2[BOUND_ROW], scratch[4 * BOUND_ROW];
    double stiff[SCENE_MATERIALS * BOUND_ROW];
    const double *reference = bound->reference[local * MESH_FACES + (unsigned)(2 * frame->axis + side)];
    double *p = row->w + model->i_E * row->stride, *u = row->w + (model->i_u + (unsigned)frame->axis) * row->stride;
    double outward = side ? 1.0 : -1.0;
    for (size_t c = 0; c < n; c++)
        far[c] = reference[(frame->outer_from + c / frame->inner) * frame->tile_inner + frame->inner_from +
                           c % frame->inner];
    bound_targets(bound, local, frame, side, n, far, wave);
    mix_stiffness(model, n, row->stride, row->w, stiff);
    mix_speed2(model, n, row->stride, row->w, stiff, c2);
    memcpy(old, p, n * sizeof *p);
    for (size_t c = 0; c < n; c++) {
        size_t face = (frame->outer_from + c / frame->inner) * frame->tile_inner + frame->inner_from + c % frame->inner;
        double rho = 0.0, sound = sqrt(c2[c]), inside = outward * u[c];
        for (unsigned l = 0; l < model->n_material; l++)
            rho += (model->n_alpha ? row->w[(model->i_alpha + l) * row->stride + c] : 1.0) *
                   row->w[(model->i_m + l) * row->stride + c];
        if (inside >= sound) continue; /* supersonic outflow: nothing comes back */
        double Z = rho * sound, leaving = old[c] + Z * inside;
        double entering = far[c] + 2.0 * wave[c] - Z * reference[cells + face];
        p[c] = 0.5 * (leaving + entering);
        u[c] = outward * (0.5 * (leaving - entering) / Z);
    }
    for (unsigned l = 0; l < model->n_material; l++)
        bound_isentrope(&model->eos[l], n, old, p, row->w + (model->i_m + l) * row->stride, scratch);
}

/* A value of an inflow into `ret`; NaN where its script fails. False then. */
static bool bound_ask(struct bound *bound, unsigned local, const struct scene_value *value, const char *what,
                      const double x[3], double *ret)
{
    int status = scene_value_at(value, x, x[0], bound->t, ret);
    if (!status) return true;
    bound_fail(bound, local, status, what, x);
    *ret = (double)NAN;
    return false;
}

static void bound_inflow(struct bound *bound, unsigned local, const struct frame *frame, int side,
                         struct bound_row *row)
{
    static const char *const velocity[] = {"velocity_x", "velocity_y", "velocity_z"};
    const struct model *model = bound->model;
    const struct scene_boundary *boundary = bound_of(bound, frame, side);
    for (size_t c = 0; c < row->n; c++) {
        double x[3], *at = row->w + c;
        bound_position(bound, local, frame, side, c, x);
        bool good = bound_ask(bound, local, &boundary->pressure, "pressure", x, &at[model->i_E * row->stride]);
        for (unsigned l = 0; l < model->n_material; l++) {
            if (model->n_alpha) at[(model->i_alpha + l) * row->stride] = boundary->fractions[l];
            double *rho = &at[(model->i_m + l) * row->stride];
            *rho = model->eos[l].rho_fill;
            if (boundary->density[l].given && good)
                good = bound_ask(bound, local, &boundary->density[l], "density", x, rho);
        }
        for (unsigned d = 0; d < model->n_velocity; d++) {
            double *u = &at[(model->i_u + d) * row->stride];
            *u = 0.0;
            if (boundary->velocity[d].given && good)
                good = bound_ask(bound, local, &boundary->velocity[d], velocity[d], x, u);
        }
        for (unsigned v = 0; v < model->n_stretch; v++) at[(model->i_V + v) * row->stride] = v < 3 ? 1.0 : 0.0;
    }
}

void bound_fill(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w)
{
    struct bound *bound = data;
    const struct model *model = bound->model;
    const struct scene_boundary *boundary = bound_of(bound, frame, side);
    double space[MODEL_FIELDS * (size_t)BOUND_ROW];
    struct bound_row row = {.n = frame->outer * frame->inner, .stride = BOUND_ROW, .w = space};
    switch (boundary->type) {
    case SCENE_AXIS:
    case SCENE_SYMMETRY:
    case SCENE_REFLECTING: bound_mirror(model, frame, side, false, pitch, w); return;
    case SCENE_NO_SLIP: bound_mirror(model, frame, side, true, pitch, w); return;
    case SCENE_PERIODIC: /* has neighbours, never a boundary */
    case SCENE_OUTFLOW:
        for (unsigned i = 0; i < model->n_active; i++)
            bound_layers(frame, side, false, 1.0, w + model->active[i] * pitch);
        return;
    case SCENE_NONREFLECTING:
    case SCENE_INCOMING_WAVE:
        bound_take(model, frame, side, pitch, w, &row);
        bound_characteristic(bound, local, frame, side, &row);
        break;
    case SCENE_INFLOW:
        bound_take(model, frame, side, pitch, w, &row);
        bound_inflow(bound, local, frame, side, &row);
        break;
    }
    bound_put(model, frame, side, pitch, &row, w);
}
