/* bound_fill.c - see bound.h: the layers behind a boundary, one function for each way to fill them. Which type is filled
 * in which way stands in case/scene_boundary.h.
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
#include "phys/elastic.h"
#include "phys/mix.h"
#include "scheme/bound_law.h"
#include "scheme/bound_layer.h"
#include "scheme/source_weight.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BOUND_FILL_ROW = FRAME_CELLS / (2 * SCENE_GHOSTS) }; /* most face cells of a frame */

/* The layers behind one side of a gathered piece of a local tile. */
struct bound_fill {
    struct bound *bound;
    unsigned local;
    const struct frame *frame;
    int side;
    size_t pitch;
    double *w;
    int layer; /* that is composed, from 0 at the face */
};

/* What lies inside, twice. Nobody looks behind periodic faces in this way: there are neighbours. */
static void bound_fill_copy(const struct bound_fill *fill)
{
    const struct model *model = fill->bound->model;
    for (unsigned i = 0; i < model->n_active; i++)
        bound_layer_fill(fill->frame, fill->side, false, 1.0, fill->w + model->active[i] * fill->pitch);
}

/* Is this component of a stretch one of those that a mirror across `axis` turns round? */
static bool bound_fill_is_crossed(const struct model *model, int axis, unsigned q)
{
    unsigned n = (unsigned)axis, c;
    if (!model_is_stretch(model, q, &c) || c < 3) return false;
    return c == elastic_component(n, (n + 1) % 3) || c == elastic_component(n, (n + 2) % 3);
}

static void bound_fill_mirror(const struct bound_fill *fill, bool no_slip)
{
    const struct model *model = fill->bound->model;
    int axis = fill->frame->axis;
    for (unsigned i = 0; i < model->n_active; i++) {
        unsigned q = model->active[i];
        bool velocity = q >= model->i_u && q < model->i_E;
        bool normal = model->n_normal && q == model->i_normal + (unsigned)axis;
        bool turned = normal || (!no_slip && bound_fill_is_crossed(model, axis, q));
        bool reversed = velocity ? no_slip || q == model->i_u + (unsigned)axis : turned;
        bound_layer_fill(fill->frame, fill->side, true, reversed ? -1.0 : 1.0, fill->w + q * fill->pitch);
    }
}

/* One row of boundary cells taken out of the frame: [n_field] components of `stride` points. */
struct bound_fill_row {
    size_t n, stride;
    double *w;
};

/* The cells that lie `depth` cells inside the outermost ones. */
static void bound_fill_take(const struct bound_fill *fill, int depth, struct bound_fill_row *row)
{
    const struct model *model = fill->bound->model;
    const struct frame *frame = fill->frame;
    for (unsigned a = 0; a < model->n_active; a++)
        for (size_t q = model->active[a], o = 0; o < frame->outer; o++)
            memcpy(row->w + q * row->stride + o * frame->inner,
                   fill->w + q * fill->pitch + frame_at(frame, o, bound_layer_inside(frame, fill->side, depth)),
                   frame->inner * sizeof *fill->w);
}

static void bound_fill_put(const struct bound_fill *fill, const struct bound_fill_row *row)
{
    const struct model *model = fill->bound->model;
    const struct frame *frame = fill->frame;
    for (unsigned a = 0; a < model->n_active; a++)
        for (int ghost = fill->layer; ghost < (int)frame->ghosts; ghost++)
            for (size_t q = model->active[a], o = 0; o < frame->outer; o++)
                memcpy(fill->w + q * fill->pitch + frame_at(frame, o, bound_layer_behind(frame, fill->side, ghost)),
                       row->w + q * row->stride + o * frame->inner, frame->inner * sizeof *fill->w);
}

/* Do sound waves leave through this side of a ball, where there is one axis? Pressure alone does not say what leaves a
 * solid. */
static bool bound_fill_is_round(const struct bound_fill *fill)
{
    const struct model *model = fill->bound->model;
    return model->beta == 2 && !model->elastic && fill->side == 1;
}

static const struct scene_boundary *bound_fill_boundary(const struct bound_fill *fill)
{
    return &fill->bound->model->scene->domain.boundary[fill->frame->axis][fill->side];
}

/* Fills the layers with the states that `compose` makes of the cells inside: one for all, but around a ball and where a
 * module mirrors. */
static void bound_fill_composed(const struct bound_fill *fill,
                                void (*compose)(const struct bound_fill *fill, struct bound_fill_row *row))
{
    double space[MODEL_FIELDS * (size_t)BOUND_FILL_ROW];
    struct bound_fill_row row = {.n = fill->frame->outer * fill->frame->inner, .stride = BOUND_FILL_ROW, .w = space};
    struct bound_fill each = *fill;
    bool mirrors = bound_law_mirrors(bound_fill_boundary(fill));
    int layers = mirrors || bound_fill_is_round(fill) ? (int)fill->frame->ghosts : 1;
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

/* Fluids slip along a wall that moves, or stick to it. What it has along its normal flows through the face, which stays:
 * the state between the wall and the wave that it sends. */
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

/* rho_l moved along its isentrope by dp: midpoint rule on d rho / dp = 1/c^2. */
static void bound_fill_isentrope(const struct model_eos *eos, size_t n, const double *p, const double *p_new,
                                 double *rho, double *scratch)
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

/* What comes from outside at the points of a row: the far-field pressure, where the case gives one, and what enters
 * of the gauge pressure of the wave, if there is one (case/pulse.h). */
static void bound_fill_outside(const struct bound_fill *fill, size_t n, bool wave, double *far, double *gauge)
{
    const struct scene_boundary *boundary = bound_fill_boundary(fill);
    for (size_t c = 0; c < n; c++) {
        double x[3];
        bound_fill_position(fill, c, x);
        if (boundary->pressure.given) bound_fill_ask(fill, &boundary->pressure, "far-field pressure", x, &far[c]);
        gauge[c] = 0.0;
        int status =
            !wave ? STATUS_OK : pulse_entering(boundary, fill->bound->t, x, fill->frame->axis, fill->side, &gauge[c]);
        if (!status) continue;
        bound_fill_fail(fill, status, "pressure of the wave", x);
        gauge[c] = (double)NAN;
    }
}

/* Plane waves that leave have p' - Z u' = 0 behind the face, primes: less the far field. Waves from a centre, p' = f'(t -
 * r/c)/r and Z u' = p' + c f/r^2, have not: what the cell inside has of it is the memory of f, and goes on to the layer
 * at r + d by
 *     p' - Z u' = -c f(t - (r + d)/c)/(r + d)^2 = ((p' - Z u')_i r^2 + d r p'_i)/(r + d)^2,
 * so that d(p' - Z u')/dt = -(c/r) p': a pressure that is not the far field's falls off within 2 r/c. */
static double bound_fill_near(const struct bound_fill *fill, double p, double Z_u)
{
    double h = fill->bound->level->h[0], d = (fill->layer + 1) * h;
    double r = fill->bound->mesh->upper[0] - 0.5 * h, behind = r + d;
    return ((p - Z_u) * r + d * p) * r / (behind * behind);
}

/* p + Z u of the cell that lies `depth` cells inside the outermost one of a line. */
static double bound_fill_leaving(const struct bound_fill *fill, int depth, double Z)
{
    const struct model *model = fill->bound->model;
    const double *cell = fill->w + frame_at(fill->frame, 0, bound_layer_inside(fill->frame, fill->side, depth));
    return cell[model->i_E * fill->pitch] + Z * cell[model->i_u * fill->pitch];
}

/* What leaves goes on as it comes; not at shocks. */
static double bound_fill_onward(const struct bound_fill *fill, double Z)
{
    double last = bound_fill_leaving(fill, 0, Z), before = bound_fill_leaving(fill, 1, Z);
    double a = last - before, b = before - bound_fill_leaving(fill, 2, Z);
    return a * b <= 0.0 ? 0.0 : (fill->layer + 1) * (fabs(a) < fabs(b) ? a : b);
}

/* Density and speed of sound of the mixture in a row. */
static void bound_fill_sound(const struct model *model, const struct bound_fill_row *row, double *rho, double *sound)
{
    double stiff[SCENE_MATERIALS * BOUND_FILL_ROW], c2[BOUND_FILL_ROW];
    mix_stiffness(model, row->n, row->stride, row->w, stiff);
    mix_speed2(model, row->n, row->stride, row->w, stiff, c2);
    for (size_t c = 0; c < row->n; c++) {
        rho[c] = 0.0;
        sound[c] = sqrt(c2[c]);
        for (unsigned l = 0; l < model->n_material; l++)
            rho[c] += (model->n_alpha ? row->w[(model->i_alpha + l) * row->stride + c] : 1.0) *
                      row->w[(model->i_m + l) * row->stride + c];
    }
}

/* What stood at the boundary at the start: a row of p, one of the velocity outwards. */
static const double *bound_fill_start(const struct bound_fill *fill)
{
    unsigned face = (unsigned)(2 * fill->frame->axis + fill->side);
    return fill->bound->reference[fill->local * MESH_FACES + face];
}

/* Each material along its isentrope from the pressures `old` to those that the row has. */
static void bound_fill_follow(const struct model *model, struct bound_fill_row *row, const double *old)
{
    double scratch[4 * BOUND_FILL_ROW];
    const double *p = row->w + model->i_E * row->stride;
    for (unsigned l = 0; l < model->n_material; l++)
        bound_fill_isentrope(&model->eos[l], row->n, old, p, row->w + (model->i_m + l) * row->stride, scratch);
}

static void bound_fill_characteristic(const struct bound_fill *fill, struct bound_fill_row *row, bool wave)
{
    const struct model *model = fill->bound->model;
    const struct frame *frame = fill->frame;
    size_t n = row->n, cells = frame->tile_outer * frame->tile_inner;
    double far[BOUND_FILL_ROW], gauge[BOUND_FILL_ROW], old[BOUND_FILL_ROW], rho[BOUND_FILL_ROW], c_s[BOUND_FILL_ROW];
    const double *reference = bound_fill_start(fill);
    double *p = row->w + model->i_E * row->stride, *u = row->w + (model->i_u + (unsigned)frame->axis) * row->stride;
    double outward = fill->side ? 1.0 : -1.0;
    bool round = !wave && bound_fill_is_round(fill);
    for (size_t c = 0; c < n; c++) far[c] = reference[bound_fill_face_cell(frame, c)];
    bound_fill_outside(fill, n, wave, far, gauge);
    bound_fill_sound(model, row, rho, c_s);
    memcpy(old, p, n * sizeof *p);
    for (size_t c = 0; c < n; c++) {
        double inside = outward * u[c];
        if (inside >= c_s[c]) continue; /* supersonic outflow: nothing comes back */
        double Z = rho[c] * c_s[c], leaving = old[c] + Z * inside;
        double u_far = reference[cells + bound_fill_face_cell(frame, c)];
        double entering = far[c] + 2.0 * gauge[c] - Z * u_far;
        if (round) leaving += bound_fill_onward(fill, Z);
        if (round) entering += bound_fill_near(fill, old[c] - far[c], Z * (inside - u_far));
        p[c] = 0.5 * (leaving + entering);
        u[c] = outward * (0.5 * (leaving - entering) / Z);
    }
    bound_fill_follow(model, row, old);
}

static void bound_fill_compose_far(const struct bound_fill *fill, struct bound_fill_row *row)
{
    bound_fill_characteristic(fill, row, false);
}

static void bound_fill_far(const struct bound_fill *fill)
{
    bound_fill_composed(fill, bound_fill_compose_far);
}

static void bound_fill_compose_wave(const struct bound_fill *fill, struct bound_fill_row *row)
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
    for (unsigned k = 0; k < model->n_pair; k++) at[model->pairs[k].i_kappa * stride] = 0.0;
    for (unsigned k = 0; k < model->n_pull; k++) at[model->pulls[k].field * stride] = 0.0;
}

static void bound_fill_compose_state(const struct bound_fill *fill, struct bound_fill_row *row)
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
static void bound_fill_reverse(const struct bound_fill *fill, struct bound_fill_row *row)
{
    const struct model *model = fill->bound->model;
    int axis = fill->frame->axis;
    for (unsigned i = 0; i < model->n_active; i++) {
        unsigned q = model->active[i];
        bool normal = model->n_normal && q == model->i_normal + (unsigned)axis;
        for (size_t c = 0; c < row->n && (normal || bound_fill_is_crossed(model, axis, q)); c++)
            row->w[q * row->stride + c] *= -1.0;
    }
}

/* What is not the module's: stretches and the like, and densities where it leaves them to us. */
static void bound_fill_rest(const struct bound_fill *fill, struct bound_fill_row *row, const double *old)
{
    const struct model *model = fill->bound->model;
    const struct scene_boundary *boundary = bound_fill_boundary(fill);
    if (bound_law_is_isentropic(boundary)) bound_fill_follow(model, row, old);
    if (bound_law_mirrors(boundary)) bound_fill_reverse(fill, row);
    for (size_t c = 0; c < row->n && bound_law_brings(boundary); c++) bound_fill_fresh(model, row->w + c, row->stride);
}

static void bound_fill_compose_law(const struct bound_fill *fill, struct bound_fill_row *row)
{
    const struct model *model = fill->bound->model;
    const struct frame *frame = fill->frame;
    size_t cells = frame->tile_outer * frame->tile_inner;
    double x[3][BOUND_FILL_ROW], Z[BOUND_FILL_ROW], rho[BOUND_FILL_ROW], start[2][BOUND_FILL_ROW];
    double old[BOUND_FILL_ROW];
    bool refers = scene_boundary_is(model->scene, 2 * frame->axis + fill->side, SCENE_BOUNDARY_REFERS);
    bound_fill_sound(model, row, rho, Z);
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
    const struct bound_fill fill = {data, local, frame, side, pitch, w, 0};
    bound_fill_ways[bound_fill_boundary(&fill)->type](&fill);
    if (fill.bound->sources) bound_fill_hold(&fill);
}
