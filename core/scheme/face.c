/* face.c - see face.h.
 *
 * Both edges of all cells of a component lie behind each other in one row (edges.h), so that one call of an
 * equation of state serves both sides of the faces. */
#include "scheme/face.h"

#include "base/mem.h"
#include "phys/bearing.h"
#include "phys/present.h"
#include "phys/row.h"
#include "scheme/edges.h"
#include "scheme/face_carry.h"
#include "scheme/face_stress.h"
#include "scheme/face_sum.h"
#include "scheme/low_mach.h"
#include "scheme/shelter.h"
#include "scheme/tilt.h"
#include "scheme/viscous_face.h"
#include "scheme/wood.h"

#include <string.h>

/* Both edges of the cells of a row lie behind each other, upper then lower, n_cell each: face i
 * has upper edge i on its left and lower edge i + step on its right. */
struct face_own {
    struct edges *edges;
    double *state;                /* primitives at the edges: [n_field][2 FACE_ROOM] */
    double *m, *rho, *energy, *c; /* completed: [n_material], then one each, of 2 FACE_ROOM */
    double *term, *stiffness;     /* one material's rho e and rho c^2 */
    double *give;                 /* of the mixture at the edges, where Wood's speed is asked for; else NULL */
    double *origin, *strain;      /* of the face state: pressure of the side it comes from, compression since */
    double *lagged;               /* one material's pressure at the edges, where it is not p */
    double *zero;                 /* stands in for the velocities of unused axes */
    double *robust;               /* fluxes of the robust solver, same order as the block behind face_work.alpha */
    const double *side_u[2][3], *side_m[2][SCENE_MATERIALS], *side_alpha[2][SCENE_MATERIALS];
    double *flux_m[SCENE_MATERIALS], *flux_u[3], *flux_alpha[SCENE_MATERIALS];
    double *robust_m[SCENE_MATERIALS], *robust_u[3], *robust_alpha[SCENE_MATERIALS];
    unsigned n_flux;
    struct face_stress *stress; /* NULL without a solid */
};

static double *face_row(size_t components)
{
    return mem_new(components * FACE_ROOM, sizeof(double));
}

/* A block of flux components in the order alpha, m, momentum, energy, u. */
static void face_split(const struct model *model, double *block, double **alpha, double **m, double **momentum)
{
    for (unsigned l = 0; l < model->n_alpha; l++) alpha[l] = block + l * FACE_ROOM;
    for (unsigned l = 0; l < model->n_material; l++) m[l] = block + (model->n_alpha + l) * FACE_ROOM;
    for (unsigned d = 0; d < model->n_velocity; d++)
        momentum[d] = block + (model->n_alpha + model->n_material + d) * FACE_ROOM;
}

/* Rows that a solver needs for the tangential face velocities. */
static unsigned face_slides(const struct model *model)
{
    return model->n_stretch ? 2 * (model->n_velocity - 1) : 0;
}

/* The slides stand behind u in the flux blocks. */
static void face_slide(struct face_work *work, const struct model *model)
{
    struct face_own *own = work->own;
    unsigned half = face_slides(model) / 2, at = own->n_flux - 2 * half;
    work->slide_left = work->alpha + at * FACE_ROOM;
    work->slide_right = work->slide_left + half * FACE_ROOM;
    for (unsigned k = 0; k < half; k++) {
        own->stress->slide_left[k] = work->slide_left + k * FACE_ROOM;
        own->stress->slide_right[k] = work->slide_right + k * FACE_ROOM;
        own->stress->robust_left[k] = own->robust + (at + k) * FACE_ROOM;
        own->stress->robust_right[k] = own->robust + (at + half + k) * FACE_ROOM;
    }
}

struct face_work *face_new(const struct model *model)
{
    struct face_work *work = mem_new(1, sizeof *work);
    struct face_own *own = work->own = mem_new(1, sizeof *own);
    unsigned n = model->n_material;
    work->model = model;
    own->n_flux = model->n_alpha + n + model->n_velocity + 2 + face_slides(model);
    own->stress = face_stress_new(model);
    if (model->n_normal) work->aimed = own->stress->aimed;
    work->frame = face_row(model->n_field);
    work->mask = face_row(1);
    if (model->scene->n_rigid) work->flat = face_row(1);
    own->edges = edges_new(model, FACE_ROOM);
    own->state = face_row(2 * model->n_field);
    own->m = face_row(model->n_inner ? 4 * n : 2 * n); /* behind them those that bear */
    own->rho = face_row(2);
    own->energy = face_row(2);
    own->c = face_row(2);
    own->term = face_row(2);
    own->stiffness = face_row(2);
    if (model->scene->scheme.wood && model->n_alpha) own->give = face_row(2);
    own->origin = face_row(1);
    own->strain = face_row(1);
    own->zero = face_row(2);
    own->robust = face_row(own->n_flux);
    work->alpha = face_row(own->n_flux);
    work->m = work->alpha + model->n_alpha * FACE_ROOM;
    work->momentum = work->m + n * FACE_ROOM;
    work->energy = work->momentum + model->n_velocity * FACE_ROOM;
    work->u = work->energy + FACE_ROOM;
    work->stretch = model->n_stretch ? face_row(model->n_stretched) : NULL;
    work->strains = model->n_inner ? face_row(model->n_inner) : NULL;
    work->solid = model->n_stretch && model->n_alpha ? face_row(model->n_solid) : NULL;
    work->seen_left = shelter_wanted(model) ? face_row(2 * model->n_velocity) : NULL;
    work->seen_right = work->seen_left ? work->seen_left + model->n_velocity * FACE_ROOM : NULL;
    work->heat_below = model->conducts && model->n_alpha ? face_row(2 * model->n_alpha) : NULL;
    work->heat_above = work->heat_below ? work->heat_below + model->n_alpha * FACE_ROOM : NULL;
    work->carried = face_row((model->n_fick ? 3 : 2) * model->n_alpha); /* face_mingled */
    work->strained = work->carried + model->n_alpha * FACE_ROOM;
    for (int side = 0; side < 2 && model->forced; side++) work->rise[side] = face_row(1);
    for (int side = 0; side < 2 && model->n_normal; side++) work->lean[side] = face_row(1);
    if (model_jumps(model)) {
        work->lag = face_row(n + 1);
        work->tension = work->lag + n * FACE_ROOM;
        own->lagged = face_row(2);
    }
    face_split(model, work->alpha, own->flux_alpha, own->flux_m, own->flux_u);
    face_split(model, own->robust, own->robust_alpha, own->robust_m, own->robust_u);
    face_slide(work, model);
    for (int i = 0; i < 4; i++) work->faces.work[i] = face_row(1);
    return work;
}

void face_free(struct face_work *work)
{
    if (!work) return;
    struct face_own *own = work->own;
    double *rows[] = {own->state,
                      own->m,
                      own->rho,
                      own->energy,
                      own->c,
                      own->term,
                      own->stiffness,
                      own->give,
                      own->zero,
                      own->robust,
                      work->alpha,
                      work->frame,
                      work->mask,
                      work->flat,
                      work->faces.work[0],
                      work->faces.work[1],
                      work->faces.work[2],
                      work->faces.work[3],
                      work->carried,
                      work->heat_below,
                      own->origin,
                      own->strain,
                      work->stretch,
                      work->strains,
                      work->solid,
                      work->seen_left,
                      work->lag,
                      own->lagged,
                      work->lean[0],
                      work->lean[1],
                      work->rise[0],
                      work->rise[1]};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) mem_free(rows[i]);
    edges_free(own->edges);
    face_stress_free(own->stress);
    mem_free(own);
    mem_free(work);
}

/* Elastic energy, stress and speeds of n edges. */
static void face_load(struct face_work *work, const struct frame *frame, size_t n, const double *rho)
{
    const struct model *model = work->model;
    struct face_own *own = work->own;
    const double *m[SCENE_MATERIALS];
    if (!model->n_stretch) return;
    for (unsigned s = 0; s < model->n_solid; s++)
        m[s] = model->n_alpha ? own->m + 2 * model->solids[s].material * FACE_ROOM : rho;
    bearing_of(model, n, 2 * FACE_ROOM, own->state, 2 * FACE_ROOM, own->m + 2 * model->n_material * FACE_ROOM, m);
    struct face_stress_edges edges = {
        .frame = frame, .n = n, .state = own->state, .m = m, .rho = rho, .energy = own->energy, .rho_c2 = own->c};
    face_stress_complete(own->stress, model, &edges);
}

static BULLA_KERNEL void face_lag(size_t n, const double *restrict p, const double *restrict lag, double *restrict own)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) own[i] = p[i] + lag[i];
}

/* Pressure of material l at the edges: what the cell's traction leaves it, and what lies across the face. */
static const double *face_pressure(const struct face_work *work, const struct frame *frame, unsigned l, size_t n)
{
    const struct model *model = work->model;
    const struct face_own *own = work->own;
    const double *p = own->state + 2 * model->i_E * FACE_ROOM;
    size_t cells = n / 2;
    if (model->split) p = face_stress_pressure(own->stress, model, l, own->state);
    if (!model_jumps(model)) return p;
    const double *above = work->lag + l * FACE_ROOM + frame_reach(frame), *below = above - frame->inner;
    face_lag(cells, p, above, own->lagged);
    face_lag(cells, p + cells, below, own->lagged + cells);
    return own->lagged;
}

/* Velocity d at the edges, 0: that normal to the faces. */
static double *face_velocity(const struct face_work *work, const struct frame *frame, unsigned d)
{
    const struct face_own *own = work->own;
    return own->state + 2 * (work->model->i_u + axis_component(frame->axis, d)) * FACE_ROOM;
}

/* Cells in which a liquid evaporates at its surface, NULL without any. */
static const double *face_fronts(struct face_work *work, const struct frame *frame)
{
    const struct model *model = work->model;
    const struct face_own *own = work->own;
    double *front = own->strain;
    if (!model->fronts || model->scene->scheme.low_mach <= LOW_MACH_FRONT) return NULL;
    memset(front, 0, frame->count * sizeof *front);
    for (unsigned k = 0; k < model->n_phase; k++) {
        unsigned liquid = model->phases[k].member[0];
        if (model->phases[k].scene->onset > 0.0)
            low_mach_surface(frame->count, work->frame + (model->i_alpha + liquid) * FACE_ROOM, front);
    }
    return front + frame_reach(frame);
}

/* Cells whose faces keep their jumps: troubled ones, beside open sides, and where vapour is squeezed. */
static const double *face_kept(const struct face_work *work, const struct frame *frame, bool masked)
{
    const struct face_own *own = work->own;
    const double *mask = masked ? work->mask : NULL;
    if (work->model->squeezed)
        mask = edges_squeezed(own->edges, work->model, frame, work->frame, mask, own->stiffness + FACE_ROOM);
    return low_mach_kept(frame, work->open[frame->axis], mask, own->stiffness);
}

/* Velocities at the faces of a row of cells, before they have an energy; rho c^2 is still that in own->c. */
static void face_calm(struct face_work *work, const struct frame *frame, const double *rho, bool masked)
{
    const struct model *model = work->model;
    struct face_own *own = work->own;
    if (model->scene->scheme.low_mach >= 1.0 && !model->fronts) return;
    size_t cells = frame_edged(frame);
    const struct low_mach faces = {.n = cells - frame->inner,
                                   .right = cells + frame->inner,
                                   .least = model->scene->scheme.low_mach,
                                   .rho = rho,
                                   .rho_c2 = own->c,
                                   .reach = frame_reach(frame),
                                   .p = work->frame + model->i_E * FACE_ROOM,
                                   .lean = {model->n_normal ? work->lean[0] : NULL, work->lean[1]},
                                   .mask = face_kept(work, frame, masked),
                                   .step = frame->inner,
                                   .front = face_fronts(work, frame),
                                   .part = own->term};
    double *normal = face_velocity(work, frame, 0);
    low_mach_weigh(&faces, normal);
    low_mach_draw(&faces, normal);
    if (!model->resists || model->elastic) return; /* shear of solids is a wave of its own */
    low_mach_lighten(&faces);
    for (unsigned d = 1; d < model->n_velocity; d++) low_mach_draw(&faces, face_velocity(work, frame, d));
}

/* Speeds of mixtures that expand. */
static void face_slow(struct face_work *work, const struct frame *frame)
{
    const struct model *model = work->model;
    struct face_own *own = work->own;
    size_t cells = frame_edged(frame);
    const double *u = work->frame + (model->i_u + (unsigned)frame->axis) * FACE_ROOM + frame_reach(frame);
    const struct wood faces = {cells - frame->inner, cells + frame->inner, frame->inner, u, own->rho, own->give};
    wood_slow(&faces, own->c);
}

/* Partial densities, internal energy and rho c^2 of n edges. */
static void face_ask(struct face_work *work, const struct frame *frame, size_t n, const double *rho)
{
    const struct model *model = work->model;
    struct face_own *own = work->own;
    const struct face_sum sum = {n, own->rho, own->energy, own->c};
    if (!model->n_alpha) {
        const double *own_p = face_pressure(work, frame, 0, n);
        model->eos[0].law->state(model->eos[0].self, n, rho, own_p, own->energy, own->c);
    }
    for (unsigned l = 0; l < model->n_alpha; l++) {
        const double *rho_l = own->state + 2 * (model->i_m + l) * FACE_ROOM,
                     *alpha = own->state + 2 * (model->i_alpha + l) * FACE_ROOM;
        double *m = own->m + 2 * l * FACE_ROOM, *stiffness = own->stiffness;
        const double *own_p = face_pressure(work, frame, l, n);
        struct present present = {n, alpha, rho_l, own_p};
        present_state(&model->eos[l], &present, own->term, stiffness);
        face_sum_material(&sum, l == 0, &(struct face_sum_share){alpha, rho_l, own->term, stiffness}, m);
        if (own->give) wood_give(n, l, alpha, stiffness, own->give);
    }
}

/* Draws the pressures at the faces of thick liquids together; are there any? */
static bool face_thick(struct face_work *work, const struct frame *frame, const double *rho, bool masked)
{
    const struct model *model = work->model;
    struct face_own *own = work->own;
    if (work->per_h[frame->axis] == 0.0 || !viscous_face_wanted(model)) return false;
    double *p = own->state + 2 * model->i_E * FACE_ROOM;
    size_t cells = frame_edged(frame);
    const struct viscous_face faces = {.n = cells - frame->inner,
                                       .right = cells + frame->inner,
                                       .step = frame->inner,
                                       .edges = 2 * cells,
                                       .pitch = 2 * FACE_ROOM,
                                       .per_h = work->per_h[frame->axis],
                                       .room = FACE_ROOM,
                                       .cells = work->frame + model->i_alpha * FACE_ROOM + frame_reach(frame),
                                       .alpha = own->state + 2 * model->i_alpha * FACE_ROOM,
                                       .rho_l = own->state + 2 * model->i_m * FACE_ROOM,
                                       .rho = rho,
                                       .rho_c2 = own->c,
                                       .mask = low_mach_kept(frame, work->open[frame->axis], masked ? work->mask : NULL,
                                                             own->stiffness),
                                       .N = own->term,
                                       .part = own->origin,
                                       .mixed = own->strain};
    return viscous_face_draw(model, &faces, p);
}

/* Partial densities, total energy and fastest speed of n edges. */
static void face_complete(struct face_work *work, const struct frame *frame, size_t n, bool masked)
{
    const struct model *model = work->model;
    struct face_own *own = work->own;
    if (model->split) face_stress_split(own->stress, model, n / 2, own->state);
    const double *u[3] = {own->zero, own->zero, own->zero};
    const double *rho = model->n_alpha ? own->rho : own->state + 2 * model->i_m * FACE_ROOM; /* one material: rho_l */
    for (unsigned d = 0; d < model->n_velocity; d++) u[d] = own->state + 2 * (model->i_u + d) * FACE_ROOM;
    face_ask(work, frame, n, rho);
    if (face_thick(work, frame, rho, masked)) face_ask(work, frame, n, rho);
    face_load(work, frame, n, rho);
    face_calm(work, frame, rho, masked);
    face_sum_finish(&(struct face_sum){n, own->rho, own->energy, own->c}, rho, u);
    if (own->give) face_slow(work, frame);
}

static void face_point(struct face_work *work, const struct frame *frame, size_t cells)
{
    const struct model *model = work->model;
    struct face_own *own = work->own;
    struct bulla_faces *faces = &work->faces;
    faces->n = cells - frame->inner;
    faces->n_material = model->n_material;
    faces->n_alpha = model->n_alpha;
    faces->n_velocity = model->n_velocity;
    faces->mixed = model->mixed;
    for (unsigned side = 0; side < 2; side++) {
        size_t from = side ? cells + frame->inner : 0; /* right: the lower edge of the cell behind the face */
        for (unsigned d = 0; d < model->n_velocity; d++)
            own->side_u[side][d] = own->state + 2 * (model->i_u + axis_component(frame->axis, d)) * FACE_ROOM + from;
        const double *rho = model->n_alpha ? own->rho : own->state + 2 * model->i_m * FACE_ROOM;
        own->side_m[side][0] = rho + from;
        for (unsigned l = 0; l < model->n_alpha; l++) own->side_m[side][l] = own->m + 2 * l * FACE_ROOM + from;
        for (unsigned l = 0; l < model->n_alpha; l++)
            own->side_alpha[side][l] = own->state + 2 * (model->i_alpha + l) * FACE_ROOM + from;
        struct bulla_side *states = side ? &faces->right : &faces->left;
        *states = (struct bulla_side){.rho = rho + from,
                                      .p = own->state + 2 * model->i_E * FACE_ROOM + from,
                                      .rho_E = own->energy + from,
                                      .c = own->c + from,
                                      .u = own->side_u[side],
                                      .m = own->side_m[side],
                                      .alpha = own->side_alpha[side]};
    }
    face_stress_point(model->n_stretch ? own->stress : NULL, model, cells + frame->inner, faces);
    faces->flux = (struct bulla_flux){
        .m = own->flux_m, .momentum = own->flux_u, .rho_E = work->energy, .u = work->u, .alpha = own->flux_alpha};
}

/* The robust solver at all faces of the row, taken over at those of troubled cells. */
static void face_solve_robust(struct face_work *work, const struct frame *frame, size_t n)
{
    const struct model *model = work->model;
    struct face_own *own = work->own;
    double *energy = own->robust + (size_t)(work->energy - work->alpha), *u = energy + FACE_ROOM;
    work->faces.flux = (struct bulla_flux){
        .m = own->robust_m, .momentum = own->robust_u, .rho_E = energy, .u = u, .alpha = own->robust_alpha};
    if (model->n_stretch) {
        work->faces.slide_left = own->stress->robust_left;
        work->faces.slide_right = own->stress->robust_right;
    }
    model->robust->solve(NULL, &work->faces);
    const double *mask = work->mask + frame_reach(frame);
    for (size_t i = 0; i < n; i++) {
        if (mask[i] + mask[i + frame->inner] == 0.0) continue;
        for (unsigned q = 0; q < own->n_flux; q++) work->alpha[q * FACE_ROOM + i] = own->robust[q * FACE_ROOM + i];
    }
}

/* Volume fluxes and what they carry. */
static void face_transport(struct face_work *work, size_t right)
{
    const struct model *model = work->model;
    struct face_own *own = work->own;
    if (model->n_stretch) face_stress_carry(model, work->faces.n, right, own->state, work->m, work->stretch);
    if (model->n_stretch && work->strains)
        face_stress_age(model, work->faces.n, right, own->state, work->m, work->strains);
    if (!model->n_alpha) return;
    const double *p = own->state + 2 * model->i_E * FACE_ROOM;
    const struct face_carry carry = {.model = model,
                                     .faces = &work->faces,
                                     .pitch = FACE_ROOM,
                                     .u = work->u,
                                     .p_left = p,
                                     .p_right = p + right,
                                     .alpha = work->alpha,
                                     .carried = work->carried,
                                     .strained = work->strained,
                                     .solid = work->solid,
                                     .origin = own->origin,
                                     .strain = own->strain};
    face_carry_volumes(&carry);
}

void face_begin(struct face_work *work, const struct frame *frame)
{
    work->held = false;
    if (work->flat) memset(work->flat, 0, frame->count * sizeof *work->flat);
    for (unsigned l = 0; work->lag && l < work->model->n_material; l++)
        memset(work->lag + l * FACE_ROOM, 0, frame->count * sizeof *work->lag);
}

void face_rise(struct face_work *work, const struct frame *frame, const double *below, const double *above)
{
    const double *more[2] = {below, above};
    for (int side = 0; side < 2; side++) {
        if (work->held) row_add(frame->count, more[side], work->rise[side]);
        else memcpy(work->rise[side], more[side], frame->count * sizeof(double));
    }
    work->held = true;
}

/* Cells whose faces get first-order states: troubled ones, and those that terms have marked. */
static const double *face_flat(const struct face_work *work, const struct frame *frame, bool masked)
{
    if (masked && work->flat) row_add(frame->count, work->mask, work->flat);
    return work->flat ? work->flat : masked ? work->mask : NULL;
}

/* No flux in these rows; NULL: there are none. */
static void face_none(double *rows, unsigned n)
{
    if (rows) memset(rows, 0, n * (size_t)FACE_ROOM * sizeof *rows);
}

void face_rest(struct face_work *work, const struct frame *frame)
{
    struct face_own *own = work->own;
    const struct model *model = work->model;
    work->faces.n = frame_edged(frame) - frame->inner;
    face_none(work->alpha, own->n_flux);
    face_none(work->stretch, model->n_stretched);
    face_none(work->strains, model->n_inner);
    face_none(work->solid, model->n_solid);
    face_none(work->tension, 1);
    for (unsigned side = 0; side < 2; side++)
        for (unsigned d = 0; d < model->n_velocity; d++) own->side_u[side][d] = own->zero;
    work->faces.left.u = own->side_u[0];
    work->faces.right.u = own->side_u[1];
}

const double *face_edges(struct face_work *work, const struct frame *frame, bool masked)
{
    const struct model *model = work->model;
    const struct face_own *own = work->own;
    struct edges_cells in = {work->frame, face_flat(work, frame, masked), {NULL, NULL}, {NULL, NULL}};
    if (work->held) in.rise[0] = work->rise[0], in.rise[1] = work->rise[1];
    if (model->n_normal) in.lean[0] = work->lean[0], in.lean[1] = work->lean[1];
    edges_fill(own->edges, model, frame, &in, own->state);
    return own->state;
}

void face_solve(struct face_work *work, const struct frame *frame, bool masked)
{
    const struct model *model = work->model;
    size_t cells = frame_edged(frame);
    face_edges(work, frame, masked);
    face_complete(work, frame, 2 * cells, masked);
    face_point(work, frame, cells);
    model->riemann->solve(model->riemann_self, &work->faces);
    if (masked) face_solve_robust(work, frame, work->faces.n);
    face_transport(work, cells + frame->inner);
}
