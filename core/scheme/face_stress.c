/* face_stress.c - see face_stress.h. */
#include "scheme/face_stress.h"

#include "base/mem.h"
#include "phys/elastic.h"
#include "phys/pick.h"
#include "phys/row.h"
#include "phys/traction.h"

#include <math.h>
#include <string.h>

struct face_stress *face_stress_new(const struct model *model)
{
    if (!model->n_stretch) return NULL;
    struct face_stress *stress = mem_new(1, sizeof *stress);
    double **rows[] = {&stress->energy,       &stress->normal,       &stress->shear[0],    &stress->shear[1],
                       &stress->stiff,        &stress->rigid,        &stress->traction,    &stress->held.mean,
                       &stress->held.pull[0], &stress->held.pull[1], &stress->held.pull[2]};
    double *block = mem_new(sizeof rows / sizeof *rows * 2 * FACE_ROOM, sizeof *block);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) *rows[i] = block + i * 2 * FACE_ROOM;
    if (model->split) stress->own = mem_new((size_t)model->n_material * 2 * FACE_ROOM, sizeof *block);
    if (model->n_normal) stress->aimed = mem_new(1, sizeof *stress->aimed);
    return stress;
}

void face_stress_free(struct face_stress *stress)
{
    if (stress) mem_free(stress->energy);
    if (stress) mem_free(stress->own);
    if (stress) mem_free(stress->aimed);
    mem_free(stress);
}

static bool face_stress_wanted(const struct model *path)
{
    return path->split;
}

static void face_stress_frame(const struct term_piece *piece)
{
    double mean[FACE_ROOM], *w = piece->faces->frame;
    if (piece->model->n_normal) {
        tilt_frame(piece);
        return;
    }
    traction_mean(piece->model, piece->frame->count, FACE_ROOM, w, mean);
    row_take(piece->frame->count, mean, w + piece->model->i_E * FACE_ROOM);
}

static BULLA_KERNEL void face_stress_press(size_t n, const double *restrict traction, double *restrict own)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) own[i] += traction[i];
}

/* Adds what solids have on the normals of the edges of one side, and leaves their sums. Rows begin with the side. */
static void face_stress_tilt(struct face_stress *stress, const struct model *model, size_t side, size_t from,
                             const double *state)
{
    const struct tilt_aimed *aimed = stress->aimed;
    const struct traction_aimed cells = {aimed->n, aimed->at, FACE_ROOM, aimed->normal};
    double packed[SCENE_MATERIALS * FACE_ROOM], pull[3 * SCENE_MATERIALS * FACE_ROOM], alpha[FACE_ROOM];
    double *mean = stress->held.mean + side * FACE_ROOM;
    traction_at(model, &cells, 2 * FACE_ROOM, state + from, FACE_ROOM, packed, pull);
    memset(mean, 0, aimed->n * sizeof *mean);
    for (unsigned d = 0; d < model->n_velocity; d++)
        memset(stress->held.pull[d] + side * FACE_ROOM, 0, aimed->n * sizeof *mean);
    for (unsigned s = 0; s < model->n_solid; s++) {
        unsigned l = model->solids[s].material;
        const double *part = packed + s * FACE_ROOM;
        double *own = stress->own + (size_t)l * 2 * FACE_ROOM + from;
        for (size_t k = 0; k < aimed->n; k++) own[aimed->at[k]] += part[k];
        pick_take(aimed->n, aimed->at, state + 2 * (model->i_alpha + l) * FACE_ROOM + from, alpha);
        row_add_product(aimed->n, alpha, part, mean);
        for (unsigned d = 0; d < model->n_velocity; d++)
            row_add_product(aimed->n, alpha, pull + (3 * s + d) * FACE_ROOM, stress->held.pull[d] + side * FACE_ROOM);
    }
}

/* Does material l have pressures of its own at the edges? With normals fluids have the traction. */
static bool face_stress_owns(const struct model *model, unsigned l)
{
    return !model->n_normal || model_is_solid(model, l);
}

void face_stress_split(struct face_stress *stress, const struct model *model, size_t n, const double *state)
{
    const double *traction = state + 2 * model->i_E * FACE_ROOM;
    if (!model->n_normal) traction_own(model, 2 * n, 2 * FACE_ROOM, state, 2 * FACE_ROOM, stress->own);
    for (unsigned l = 0; l < model->n_material; l++) {
        double *own = stress->own + (size_t)l * 2 * FACE_ROOM;
        if (!model->n_normal) face_stress_press(2 * n, traction, own);
        else if (face_stress_owns(model, l)) memcpy(own, traction, 2 * n * sizeof *own);
    }
    if (!model->n_normal) return;
    for (size_t side = 0; side < 2; side++) face_stress_tilt(stress, model, side, side * n, state);
}

const double *face_stress_pressure(const struct face_stress *stress, const struct model *model, unsigned l,
                                   const double *state)
{
    if (!face_stress_owns(model, l)) return state + 2 * model->i_E * FACE_ROOM;
    return stress->own + (size_t)l * 2 * FACE_ROOM;
}

/* Elastic parts are added; the traction and the shear speed are made. */
static BULLA_KERNEL void face_stress_add(size_t n, const struct face_stress *stress, const double *restrict p,
                                         const double *restrict rho, double *restrict energy, double *restrict rho_c2)
{
    const double *restrict elastic = stress->energy, *restrict normal = stress->normal, *restrict stiff = stress->stiff;
    double *restrict rigid = stress->rigid, *restrict traction = stress->traction;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double e = energy[i], s = rho_c2[i], g = rigid[i];
        energy[i] = e + elastic[i];
        rho_c2[i] = s + stiff[i];
        traction[i] = p[i] - normal[i];
        rigid[i] = sqrt(g / rho[i]);
    }
}

void face_stress_complete(struct face_stress *stress, const struct model *model, const struct face_stress_edges *edges)
{
    const struct elastic_side side = {.energy = stress->energy,
                                      .normal = stress->normal,
                                      .shear = {stress->shear[0], stress->shear[1]},
                                      .stiff = stress->stiff,
                                      .rigid = stress->rigid};
    elastic_sides(model, edges->frame->axis, edges->n, 2 * FACE_ROOM, edges->state + 2 * model->i_V * FACE_ROOM,
                  edges->m, edges->rho_c2, &side);
    face_stress_add(edges->n, stress, edges->state + 2 * model->i_E * FACE_ROOM, edges->rho, edges->energy,
                    edges->rho_c2);
    if (model->split && !model->n_normal)
        memcpy(stress->traction, edges->state + 2 * model->i_E * FACE_ROOM, edges->n * sizeof *edges->rho);
    const struct tilt_edges tilt = {edges->state,   stress->aimed,    &stress->held,
                                    stress->normal, stress->traction, stress->shear};
    if (model->n_normal) tilt_share(model, edges->frame, &tilt);
}

void face_stress_point(struct face_stress *stress, const struct model *model, size_t right, struct bulla_faces *faces)
{
    faces->solid = stress != NULL;
    if (!stress) return;
    for (unsigned side = 0; side < 2; side++) {
        size_t from = side ? right : 0;
        for (unsigned k = 0; k + 1 < model->n_velocity; k++) stress->sides[side][k] = stress->shear[k] + from;
        *(side ? &faces->shear_right : &faces->shear_left) =
            (struct bulla_shear){.c_s = stress->rigid + from, .s = stress->sides[side]};
        (side ? &faces->right : &faces->left)->p = stress->traction + from;
    }
    faces->slide_left = stress->slide_left;
    faces->slide_right = stress->slide_right;
}

static BULLA_KERNEL void face_stress_upwind(size_t n, const double *restrict mass, const double *restrict left,
                                            const double *restrict right, double *restrict flux)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double m = mass[i], a = left[i], b = right[i];
        flux[i] = (m >= 0.0 ? a : b) * m;
    }
}

void face_stress_carry(const struct model *model, size_t n, size_t right, const double *state, const double *m,
                       double *out)
{
    for (unsigned k = 0; k < model_stretches(model); k++) {
        unsigned first = model_stretch(model, k), l = model->solids[model_bearer(model, k)].material;
        for (unsigned q = first; q < first + model->n_stretch; q++) {
            const double *edges = state + 2 * q * FACE_ROOM;
            face_stress_upwind(n, m + l * FACE_ROOM, edges, edges + right, out + (q - model->i_V) * FACE_ROOM);
        }
    }
}

void face_stress_age(const struct model *model, size_t n, size_t right, const double *state, const double *m,
                     double *out)
{
    for (unsigned k = 0; k < model->n_memory; k++) {
        unsigned q = model->memories[k].field, l = model->solids[model->memories[k].solid].material;
        const double *edges = state + 2 * q * FACE_ROOM;
        face_stress_upwind(n, m + l * FACE_ROOM, edges, edges + right, out + (q - model->i_inner) * FACE_ROOM);
    }
}

const struct term face_stress_term = {
    .name = "traction",
    .owner = "core/scheme/face_stress.c",
    .equation = "p_l = p + s'_l,nn - S: -s_nn is common to the materials of a cell, and is reconstructed",
    .wanted = face_stress_wanted,
    .open = tilt_open,
    .close = mem_free,
    .frame = face_stress_frame,
};
