/* bound_fill.c - see bound.h: the layers behind a boundary, one function for each way to fill them. Which type is
 * filled in which way stands in case/scene_boundary.h.
 *
 * Mirrors and copies act on layers. Characteristic boundaries (non-reflecting, incoming wave) compose the state behind
 * the face from the outgoing Riemann invariant of the cell inside and the incoming one of the far field plus the wave,
 *     u + U(p) = u_i + U(p_i),      u - U(p) = u_0 + U(p_0) - 2 U(p_0 + p'),      U = int dp/(rho c),
 * u along the outward normal, on each material's isentrope from inside, so that a wave at normal incidence enters or
 * leaves without a reflection, be it weak or strong. What leaves from a point: bound_ray.h. */
#include "scheme/bound.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/pulse.h"
#include "phys/elastic.h"
#include "phys/mix.h"
#include "scheme/bound_law.h"
#include "scheme/bound_layer.h"
#include "scheme/bound_ray.h"
#include "scheme/bound_row.h"
#include "scheme/source_weight.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The layers behind one side of a gathered piece of a local tile. */
struct bound_fill {
    struct bound *bound;
    unsigned local;
    const struct frame *frame;
    int side;
    size_t pitch;
    double *w;
    int layer; /* that is composed, from 0 at the face */
    bool flow; /* no waves: bound_fill_flow */
};

/* What lies inside, twice. Nobody looks behind periodic faces in this way: there are neighbours. */
static void bound_fill_copy(const struct bound_fill *fill)
{
    const struct model *model = fill->bound->model;
    for (unsigned i = 0; i < model->n_active; i++)
        bound_layer_fill(fill->frame, fill->side, false, 1.0, fill->w + model->active[i] * fill->pitch);
}

/* Is this component of a normal or a stretch one of those that a mirror across `axis` turns round? */
static bool bound_fill_is_crossed(const struct model *model, int axis, unsigned q)
{
    unsigned n = (unsigned)axis, c;
    if (!model_is_stretch(model, q, &c) || c < 3) return model->n_normal && q == model->i_normal + n;
    return c == elastic_component(n, (n + 1) % 3) || c == elastic_component(n, (n + 2) % 3);
}

/* Behind a wall that holds the matter stretches lie as they are, so that both sides bear one stress; a surface then
 * lies as it is, too: turned, it would bear another pressure there (tilt.h), and the wall would leak. */
static void bound_fill_mirror(const struct bound_fill *fill, bool no_slip)
{
    const struct model *model = fill->bound->model;
    int axis = fill->frame->axis;
    for (unsigned i = 0; i < model->n_active; i++) {
        unsigned q = model->active[i];
        bool turned = !no_slip && bound_fill_is_crossed(model, axis, q), moves = q >= model->i_u && q < model->i_E;
        bool reversed = moves ? no_slip || q == model->i_u + (unsigned)axis : turned;
        double way = reversed ? -1.0 : 1.0;
        if (!no_slip && axis == 0 && model_is_turn(model, q))
            way = bound_layer_lever(fill->bound->mesh, fill->bound->level, fill->side);
        bound_layer_fill(fill->frame, fill->side, true, way, fill->w + q * fill->pitch);
    }
}

/* The cells that lie `depth` cells inside the outermost ones. */
static void bound_fill_take(const struct bound_fill *fill, int depth, struct bound_row *row)
{
    const struct model *model = fill->bound->model;
    const struct frame *frame = fill->frame;
    for (unsigned a = 0; a < model->n_active; a++)
        for (size_t q = model->active[a], o = 0; o < frame->outer; o++)
            memcpy(row->w + q * row->stride + o * frame->inner,
                   fill->w + q * fill->pitch + frame_at(frame, o, bound_layer_inside(frame, fill->side, depth)),
                   frame->inner * sizeof *fill->w);
}

static void bound_fill_put(const struct bound_fill *fill, const struct bound_row *row)
{
    const struct model *model = fill->bound->model;
    const struct frame *frame = fill->frame;
    for (unsigned a = 0; a < model->n_active; a++)
        for (int ghost = fill->layer; ghost < (int)frame->ghosts; ghost++)
            for (size_t q = model->active[a], o = 0; o < frame->outer; o++)
                memcpy(fill->w + q * fill->pitch + frame_at(frame, o, bound_layer_behind(frame, fill->side, ghost)),
                       row->w + q * row->stride + o * frame->inner, frame->inner * sizeof *fill->w);
}

static bool bound_fill_has_rays(const struct bound_fill *fill)
{
    return bound_has_rays(fill->bound->model, 2 * fill->frame->axis + fill->side);
}

static const struct scene_boundary *bound_fill_boundary(const struct bound_fill *fill)
{
    return &fill->bound->model->scene->domain.boundary[fill->frame->axis][fill->side];
}

/* Fills the layers with the states that `compose` makes of the cells inside: one for all, but where waves leave from a
 * point and where a module mirrors. */
static void bound_fill_composed(const struct bound_fill *fill,
                                void (*compose)(const struct bound_fill *fill, struct bound_row *row))
{
    double space[MODEL_FIELDS * (size_t)BOUND_ROW];
    struct bound_row row = {.n = fill->frame->outer * fill->frame->inner, .stride = BOUND_ROW, .w = space};
    struct bound_fill each = *fill;
    bool mirrors = bound_law_mirrors(bound_fill_boundary(fill));
    int layers = mirrors || bound_fill_has_rays(fill) ? (int)fill->frame->ghosts : 1;
    for (each.layer = 0; each.layer < layers; each.layer++) {
        bound_fill_take(fill, mirrors ? each.layer : 0, &row);
        compose(&each, &row);
        bound_fill_put(&each, &row);
    }
}

/* Index of point c of a row among the cells of the tile's face. */
static size_t bound_fill_face_cell(const struct frame *frame, size_t c)
{
    return (frame->outer_from + c / frame->inner) * frame->tile_inner + frame->inner_from + c % frame->inner;
}

/* Centre of the boundary face of point c of a row. */
static void bound_fill_position(const struct bound_fill *fill, size_t c, double ret_x[3])
{
    const struct level *level = fill->bound->level;
    frame_place(fill->frame, fill->bound->mesh, level, &level->tiles[level->first + fill->local], fill->side, c, ret_x);
}

/* Keeps the first failure: of which value, at which point, beside which cell of the tile. */
static void bound_fill_fail(const struct bound_fill *fill, int status, const char *what, const double x[3])
{
    struct bound *bound = fill->bound;
    const struct mesh *mesh = bound->mesh;
    const struct level *level = bound->level;
    double corner[3];
    int cell[3] = {0};
    if (bound->status) return;
    bound->status = status;
    bound->message = mem_text(status_text());
    mesh_corner(mesh, level, &level->tiles[level->first + fill->local], corner);
    for (int d = 0; d < mesh->dim; d++) {
        int at = (int)floor((x[d] - corner[d]) / level->h[d]);
        cell[d] = at < 0 ? 0 : at < mesh->n[d] ? at : mesh->n[d] - 1;
    }
    snprintf(bound->blind, sizeof bound->blind, "%s at (%.9g, %.9g, %.9g) m, beside cell (%d, %d, %d)", what, x[0],
             x[1], x[2], cell[0], cell[1], cell[2]);
}

/* A value of the boundary at a point into `ret`; NaN where its script fails. False then. */
static bool bound_fill_ask(const struct bound_fill *fill, const struct scene_value *value, const char *what,
                           const double x[3], double *ret)
{
    int status = scene_value_at(value, x, x[0], fill->bound->t, ret);
    if (!status) return true;
    bound_fill_fail(fill, status, what, x);
    *ret = (double)NAN;
    return false;
}

/* Velocities behind a wall that moves: their mean with those inside is the wall's. */
static void bound_fill_drag(const struct bound_fill *fill, unsigned d)
{
    static const char *const names[] = {"velocity_x of the wall", "velocity_y of the wall", "velocity_z of the wall"};
    const struct frame *frame = fill->frame;
    const struct scene_value *value = &bound_fill_boundary(fill)->velocity[d];
    double *u = fill->w + (fill->bound->model->i_u + d) * fill->pitch;
    for (size_t c = 0; c < frame->outer * frame->inner; c++) {
        double x[3], wall;
        bound_fill_position(fill, c, x);
        bound_fill_ask(fill, value, names[d], x, &wall);
        for (int ghost = 0; ghost < (int)frame->ghosts; ghost++)
            u[frame_at(frame, c / frame->inner, bound_layer_behind(frame, fill->side, ghost)) + c % frame->inner] +=
                2.0 * wall;
    }
}

/* Fluids slip along a wall that moves, or stick to it. What it has along its normal flows through the face, which
 * stays: the state between the wall and the wave that it sends. */
static void bound_fill_wall(const struct bound_fill *fill, bool no_slip)
{
    bound_fill_mirror(fill, no_slip);
    for (unsigned d = 0; bound_fill_boundary(fill)->moves && d < fill->bound->model->n_velocity; d++)
        if (no_slip || d == (unsigned)fill->frame->axis) bound_fill_drag(fill, d);
}

static void bound_fill_slip(const struct bound_fill *fill)
{
    bound_fill_wall(fill, false);
}

static void bound_fill_no_slip(const struct bound_fill *fill)
{
    bound_fill_wall(fill, true);
}

/* What is outside at the points of a row: the far-field pressure, where the case gives one, and the same with what
 * enters of the gauge pressure of the wave, if there is one (case/pulse.h). */
static void bound_fill_outside(const struct bound_fill *fill, size_t n, bool wave, double *far, double *top)
{
    const struct scene_boundary *boundary = bound_fill_boundary(fill);
    for (size_t c = 0; c < n; c++) {
        double x[3], gauge = 0.0;
        bound_fill_position(fill, c, x);
        if (boundary->pressure.given) bound_fill_ask(fill, &boundary->pressure, "far-field pressure", x, &far[c]);
        int status =
            !wave ? STATUS_OK : pulse_entering(boundary, fill->bound->t, x, fill->frame->axis, fill->side, &gauge);
        if (status) bound_fill_fail(fill, status, "pressure of the wave", x);
        top[c] = status ? (double)NAN : far[c] + gauge;
    }
}

/* What stood at the boundary at the start: a row of p, one of the velocity outwards. */
static const double *bound_fill_start(const struct bound_fill *fill)
{
    unsigned face = (unsigned)(2 * fill->frame->axis + fill->side);
    return fill->bound->reference[fill->local * MESH_FACES + face];
}

/* What comes from outside at a point: p_0 and u_0, p_0 + p', and the simple waves from inside to both pressures. */
struct bound_fill_outer {
    double far, u, top;
    const struct bound_wave *to_far, *to_top;
};

/* Both invariants: p and u behind the face from those inside, U counted from the pressure there; NAN where that is not
 * borne. */
static void bound_fill_meet(const struct bound_fill_outer *outer, double outward, double *p, double *u)
{
    double leaving = outward * *u;
    double entering = outer->u + bound_wave_reach(outer->to_far, outer->far - *p) -
                      2.0 * bound_wave_reach(outer->to_top, outer->top - *p);
    double du = 0.5 * (leaving - entering);
    bool up = (du > 0.0) == (outer->top > outer->far);
    *p += bound_wave_push(up ? outer->to_top : outer->to_far, du);
    *u = outward * (0.5 * (leaving + entering));
}

static void bound_fill_characteristic(const struct bound_fill *fill, struct bound_row *row, bool wave)
{
    const struct model *model = fill->bound->model;
    const struct frame *frame = fill->frame;
    size_t n = row->n, cells = frame->tile_outer * frame->tile_inner;
    double far[BOUND_ROW], top[BOUND_ROW], old[BOUND_ROW], old_u[BOUND_ROW], rho[BOUND_ROW], c_s[BOUND_ROW];
    struct bound_wave to_far[BOUND_ROW], to_top[BOUND_ROW];
    const double *reference = bound_fill_start(fill);
    double *p = row->w + model->i_E * row->stride, *u = row->w + (model->i_u + (unsigned)frame->axis) * row->stride;
    double outward = fill->side ? 1.0 : -1.0;
    for (size_t c = 0; c < n; c++) far[c] = reference[bound_fill_face_cell(frame, c)];
    bound_fill_outside(fill, n, wave, far, top);
    bound_row_sound(model, row, rho, c_s);
    bound_row_waves(model, row, rho, c_s, far, to_far);
    if (wave) bound_row_waves(model, row, rho, c_s, top, to_top);
    memcpy(old, p, n * sizeof *p);
    memcpy(old_u, u, n * sizeof *u);
    for (size_t c = 0; c < n; c++) {
        if (outward * u[c] >= c_s[c]) continue; /* supersonic outflow: nothing comes back */
        const struct bound_fill_outer outer = {far[c], reference[cells + bound_fill_face_cell(frame, c)], top[c],
                                               &to_far[c], wave ? &to_top[c] : &to_far[c]};
        bound_fill_meet(&outer, outward, &p[c], &u[c]);
    }
    const double *inside[SCENE_AXES] = {NULL};
    inside[frame->axis] = old_u;
    bound_row_follow(model, row, old, inside);
}

static void bound_fill_compose_far(const struct bound_fill *fill, struct bound_row *row)
{
    bound_fill_characteristic(fill, row, false);
}

/* What bound_ray.h wants: centres of the faces, the far field, the cells inside. */
struct bound_fill_rays {
    double x[SCENE_AXES][BOUND_ROW], far_p[BOUND_ROW], far_u[SCENE_AXES][BOUND_ROW];
    double rho[BOUND_ROW], c_s[BOUND_ROW], Z[BOUND_ROW], old[BOUND_ROW], old_u[SCENE_AXES][BOUND_ROW];
    double p[BOUND_RAY_DEPTHS][BOUND_ROW], u[BOUND_RAY_DEPTHS][SCENE_AXES][BOUND_ROW];
};

static void bound_fill_rays_far(const struct bound_fill *fill, size_t c, struct bound_fill_rays *rays)
{
    const struct frame *frame = fill->frame;
    const double *start = bound_fill_start(fill) + bound_fill_face_cell(frame, c);
    size_t cells = frame->tile_outer * frame->tile_inner;
    unsigned axis = (unsigned)frame->axis, n = fill->bound->model->n_velocity;
    double x[SCENE_AXES];
    bound_fill_position(fill, c, x);
    for (int d = 0; d < SCENE_AXES; d++) rays->x[d][c] = x[d];
    rays->far_p[c] = start[0];
    rays->far_u[axis][c] = fill->side ? start[cells] : -start[cells];
    if (fill->bound->model->dim == 1)
        rays->far_u[axis][c] = 0.0; /* whatever flows at the start, it falls off as 1/r2 */
    for (unsigned k = 0; k + 1 < n; k++) rays->far_u[(axis + 1 + k) % n][c] = start[(2 + k) * cells];
    const struct scene_value *pressure = &bound_fill_boundary(fill)->pressure;
    if (pressure->given && !fill->flow) bound_fill_ask(fill, pressure, "far-field pressure", x, &rays->far_p[c]);
}

/* Pressures and velocities of the cells inside. */
static void bound_fill_rays_inside(const struct bound_fill *fill, size_t c, struct bound_fill_rays *rays)
{
    const struct model *model = fill->bound->model;
    const struct frame *frame = fill->frame;
    for (int depth = 0; depth < BOUND_RAY_DEPTHS; depth++) {
        const double *cell = fill->w + frame_at(frame, c / frame->inner, bound_layer_inside(frame, fill->side, depth)) +
                             c % frame->inner;
        rays->p[depth][c] = cell[model->i_E * fill->pitch];
        for (unsigned d = 0; d < model->n_velocity; d++) rays->u[depth][d][c] = cell[(model->i_u + d) * fill->pitch];
    }
}

static void bound_fill_compose_rays(const struct bound_fill *fill, struct bound_row *row)
{
    const struct model *model = fill->bound->model;
    struct bound_fill_rays rays;
    struct bound_ray_row leave = {.from = &bound_fill_boundary(fill)->beam,
                                  .axis = fill->frame->axis,
                                  .dim = model->dim,
                                  .n_velocity = model->n_velocity,
                                  .outward = fill->side ? 1.0 : -1.0,
                                  .h = fill->bound->level->h[fill->frame->axis],
                                  .layer = fill->layer,
                                  .n = row->n,
                                  .Z = rays.Z,
                                  .far_p = rays.far_p,
                                  .c_s = rays.c_s,
                                  .to_p = row->w + model->i_E * row->stride};
    for (unsigned d = 0; d < SCENE_AXES; d++) {
        leave.x[d] = rays.x[d];
        leave.far_u[d] = rays.far_u[d];
        for (int depth = 0; depth < BOUND_RAY_DEPTHS; depth++) leave.u[depth][d] = rays.u[depth][d];
        leave.to_u[d] = row->w + (model->i_u + d) * row->stride;
    }
    for (int depth = 0; depth < BOUND_RAY_DEPTHS; depth++) leave.p[depth] = rays.p[depth];
    bound_row_sound(model, row, rays.rho, rays.c_s);
    for (size_t c = 0; c < row->n; c++) {
        rays.Z[c] = rays.rho[c] * rays.c_s[c];
        bound_fill_rays_far(fill, c, &rays);
        bound_fill_rays_inside(fill, c, &rays);
    }
    if (fill->flow) {
        bound_ray_flow(&leave);
        return;
    }
    memcpy(rays.old, leave.to_p, row->n * sizeof *rays.old);
    for (unsigned d = 0; d < model->n_velocity; d++) memcpy(rays.old_u[d], leave.to_u[d], row->n * sizeof *rays.old);
    bound_ray_leave(&leave);
    const double *inside[SCENE_AXES] = {rays.old_u[0], rays.old_u[1], rays.old_u[2]};
    bound_row_follow(model, row, rays.old, inside);
}

static void bound_fill_far(const struct bound_fill *fill)
{
    bound_fill_composed(fill, bound_fill_has_rays(fill) ? bound_fill_compose_rays : bound_fill_compose_far);
}

static void bound_fill_compose_wave(const struct bound_fill *fill, struct bound_row *row)
{
    bound_fill_characteristic(fill, row, true);
}

static void bound_fill_wave(const struct bound_fill *fill)
{
    bound_fill_composed(fill, bound_fill_compose_wave);
}

/* What comes in has no stretch, no strain, and no surface yet. */
static void bound_fill_fresh(const struct model *model, double *at, size_t stride)
{
    for (unsigned s = 0; s < model->n_inner; s++) at[(model->i_inner + s) * stride] = 0.0;
    for (unsigned k = 0; k < model_stretches(model); k++)
        elastic_identity(model, 1, stride, at + model_stretch(model, k) * stride);
    for (unsigned d = 0; d < model->n_normal; d++) at[(model->i_normal + d) * stride] = 0.0;
    for (unsigned d = 0; d < model->n_slant; d++) at[(model->i_slant + d) * stride] = 0.0;
    for (unsigned k = 0; k < model->n_pair; k++) at[model->pairs[k].i_kappa * stride] = 0.0;
}

static void bound_fill_compose_state(const struct bound_fill *fill, struct bound_row *row)
{
    static const char *const velocity[] = {"velocity_x", "velocity_y", "velocity_z"};
    const struct model *model = fill->bound->model;
    const struct scene_boundary *boundary = bound_fill_boundary(fill);
    for (size_t c = 0; c < row->n; c++) {
        double x[3], *at = row->w + c;
        bound_fill_position(fill, c, x);
        bool good = bound_fill_ask(fill, &boundary->pressure, "pressure", x, &at[model->i_E * row->stride]);
        for (unsigned l = 0; l < model->n_material; l++) {
            if (model->n_alpha) at[(model->i_alpha + l) * row->stride] = boundary->fractions[l];
            double *rho = &at[(model->i_m + l) * row->stride];
            *rho = model->eos[l].rho_fill;
            if (boundary->density[l].given && good)
                good = bound_fill_ask(fill, &boundary->density[l], "density", x, rho);
        }
        for (unsigned d = 0; d < model->n_velocity; d++) {
            double *u = &at[(model->i_u + d) * row->stride];
            *u = 0.0;
            if (boundary->velocity[d].given && good)
                good = bound_fill_ask(fill, &boundary->velocity[d], velocity[d], x, u);
        }
        bound_fill_fresh(model, at, row->stride);
    }
}

static void bound_fill_state(const struct bound_fill *fill)
{
    bound_fill_composed(fill, bound_fill_compose_state);
}

/* Turns the components of a mirror image round, but for the velocity, which is the module's. */
static void bound_fill_reverse(const struct bound_fill *fill, struct bound_row *row)
{
    const struct model *model = fill->bound->model;
    int axis = fill->frame->axis;
    for (unsigned i = 0; i < model->n_active; i++) {
        unsigned q = model->active[i];
        for (size_t c = 0; c < row->n && bound_fill_is_crossed(model, axis, q); c++)
            row->w[q * row->stride + c] *= -1.0;
    }
}

/* What is not the module's: stretches and the like, and densities where it leaves them to us. */
static void bound_fill_rest(const struct bound_fill *fill, struct bound_row *row, const double *old)
{
    const struct model *model = fill->bound->model;
    const struct scene_boundary *boundary = bound_fill_boundary(fill);
    static const double *const kept[SCENE_AXES]; /* velocities stay the module's */
    if (bound_law_is_isentropic(boundary)) bound_row_follow(model, row, old, kept);
    if (bound_law_mirrors(boundary)) bound_fill_reverse(fill, row);
    for (size_t c = 0; c < row->n && bound_law_brings(boundary); c++) bound_fill_fresh(model, row->w + c, row->stride);
}

static void bound_fill_compose_law(const struct bound_fill *fill, struct bound_row *row)
{
    const struct model *model = fill->bound->model;
    const struct frame *frame = fill->frame;
    size_t cells = frame->tile_outer * frame->tile_inner;
    double x[3][BOUND_ROW], Z[BOUND_ROW], rho[BOUND_ROW], start[2][BOUND_ROW];
    double old[BOUND_ROW];
    bool refers = scene_boundary_is(model->scene, 2 * frame->axis + fill->side, SCENE_BOUNDARY_REFERS);
    bound_row_sound(model, row, rho, Z);
    for (size_t c = 0; c < row->n; c++) {
        double at[3];
        Z[c] *= rho[c];
        bound_fill_position(fill, c, at);
        for (int d = 0; d < 3; d++) x[d][c] = at[d];
        for (size_t k = 0; k < 2 && refers; k++)
            start[k][c] = bound_fill_start(fill)[k * cells + bound_fill_face_cell(frame, c)];
    }
    memcpy(old, row->w + model->i_E * row->stride, row->n * sizeof *old);
    bound_law_fill(bound_fill_boundary(fill),
                   &(struct bound_law_row){.model = model,
                                           .axis = frame->axis,
                                           .side = fill->side,
                                           .t = fill->bound->t,
                                           .depth = (fill->layer + 0.5) * fill->bound->level->h[frame->axis],
                                           .n = row->n,
                                           .stride = row->stride,
                                           .x = {x[0], x[1], x[2]},
                                           .Z = Z,
                                           .p_start = refers ? start[0] : NULL,
                                           .u_start = refers ? start[1] : NULL,
                                           .w = row->w});
    bound_fill_rest(fill, row, old);
}

static void bound_fill_law(const struct bound_fill *fill)
{
    bound_fill_composed(fill, bound_fill_compose_law);
}

#define BOUND_FILL_WAY(type, word, what, written, way, means) [SCENE_##type] = bound_fill_##way,
static void (*const bound_fill_ways[])(const struct bound_fill *fill) = {
    SCENE_BOUNDARY_TABLE(BOUND_FILL_WAY)[SCENE_BOUNDARY_MODULE] = bound_fill_law};
_Static_assert(sizeof bound_fill_ways / sizeof *bound_fill_ways == SCENE_BOUNDARY_TYPES, "a way for each type");

/* Pressure holds the forces behind a boundary, too. */
static void bound_fill_hold(const struct bound_fill *fill)
{
    struct bound *bound = fill->bound;
    const struct level *level = bound->level;
    const struct source_value_place place = {level, &level->tiles[level->first + fill->local], bound->t,
                                             fill->frame->axis};
    bound->sources->path = bound->model;
    source_weight_continue(bound->sources, &place, fill->frame, fill->side, fill->pitch, fill->w);
}

void bound_fill(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w)
{
    const struct bound_fill fill = {data, local, frame, side, pitch, w, 0, false};
    bound_fill_ways[bound_fill_boundary(&fill)->type](&fill);
    if (fill.bound->sources) bound_fill_hold(&fill);
}

void bound_fill_flow(void *data, unsigned local, const struct frame *frame, int side, size_t pitch, double *w)
{
    const struct bound_fill fill = {data, local, frame, side, pitch, w, 0, true};
    bound_fill_composed(&fill, bound_fill_compose_rays);
}
