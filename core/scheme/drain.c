/* drain.c - see drain.h. Energies are made of the frame before anything changes it (`frame`), and added to the fluxes
 * when those are there (`faces`). */
#include "scheme/drain.h"

#include "base/mem.h"
#include "mesh/axis.h"
#include "phys/row.h"

#include <string.h>

/* Rows of a frame with pitch FACE_ROOM. */
struct drain {
    double *rows;                    /* all of the below */
    double *energy;                  /* rho_l e_l of each material */
    double *c2, *kinetic;            /* u^2/2 */
    double *gas, *open, *all, *mass; /* vapour and gases; of the faces: w and more, volume of all gases, mass */
    double *volume;                  /* of one material through the faces */
};

/* Does vapour of the pair diffuse through gases? */
static bool drain_diffuses(const struct model *path, const struct model_phase *phase)
{
    for (unsigned k = 0; k < path->n_fick; k++)
        for (unsigned g = 0; g < path->ficks[k].n; g++)
            if (path->ficks[k].member[g] == phase->member[1]) return true;
    return false;
}

/* Does the pair evaporate at a surface that heat or diffusion feeds? */
static bool drain_acts(const struct model *path, const struct model_phase *phase)
{
    const struct scene_phase *scene = phase->scene;
    return scene->onset > 0.0 ? path->conducts : drain_diffuses(path, phase);
}

static bool drain_wanted(const struct model *path)
{
    for (unsigned k = 0; k < path->n_phase; k++)
        if (drain_acts(path, &path->phases[k])) return true;
    return false;
}

static void *drain_open(const struct term_room *room)
{
    struct drain *own = mem_new(1, sizeof *own);
    size_t n = room->model->n_material;
    double **single[] = {&own->c2, &own->kinetic, &own->gas, &own->open, &own->all, &own->mass, &own->volume};
    size_t n_single = sizeof single / sizeof *single;
    double *at = own->rows = mem_new((n + n_single) * FACE_ROOM, sizeof *own->rows);
    own->energy = at;
    for (size_t i = 0; i < n_single; i++) *single[i] = at + (n + i) * FACE_ROOM;
    return own;
}

static void drain_close(void *data)
{
    struct drain *own = data;
    mem_free(own->rows);
    mem_free(own);
}

static BULLA_KERNEL void drain_square(size_t n, const double *restrict u, double *restrict kinetic)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double k = kinetic[i], v = u[i];
        kinetic[i] = k + 0.5 * v * v;
    }
}

static void drain_frame(const struct term_piece *piece)
{
    const struct model *path = piece->model;
    struct drain *own = piece->own;
    size_t n = piece->frame->count;
    const double *w = piece->faces->frame, *p = w + path->i_E * FACE_ROOM;
    for (unsigned k = 0; k < path->n_phase; k++)
        for (unsigned j = 0; drain_acts(path, &path->phases[k]) && j < path->phases[k].n; j++) {
            unsigned l = path->phases[k].member[j];
            const double *rho = w + (path->i_m + l) * FACE_ROOM;
            path->eos[l].law->state(path->eos[l].self, n, rho, p, own->energy + l * FACE_ROOM, own->c2);
        }
    memset(own->kinetic, 0, n * sizeof *own->kinetic);
    for (unsigned e = 0; e < path->n_velocity; e++) drain_square(n, w + (path->i_u + e) * FACE_ROOM, own->kinetic);
}

/* q/g_W of the faces, with the sign of the way that the liquid goes; u: of the lower cells. */
static BULLA_KERNEL void drain_weigh(size_t n, size_t step, double most, const double *restrict u,
                                     const double *restrict liquid, double *restrict open)
{
    const double *before = u - step, *after = u + 2 * step, *next = liquid + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = liquid[i], b = next[i], dry = a < b ? a : b, sum = a + b;
        double apart = after[i] - before[i], speed = DRAIN_SPEED * apart, w = speed < most ? speed : most;
        double q = w * dry * ((b - a) / sum);
        open[i] = (dry > 0.0) & (apart > 0.0) ? q : 0.0;
    }
}

/* Faces of troubled cells stay as they are. */
static BULLA_KERNEL void drain_spare(size_t n, size_t step, const double *restrict mask, double *restrict open)
{
    const double *next = mask + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double held = mask[i] + next[i], q = open[i];
        open[i] = held > 0.0 ? 0.0 : q;
    }
}

/* A gas goes against the liquid, from the wetter cell; `all` is what goes with it. */
static BULLA_KERNEL void drain_return(size_t n, size_t step, const double *restrict open, const double *restrict alpha,
                                      double *restrict volume, double *restrict all)
{
    const double *next = alpha + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double q = open[i], sum = all[i], low = alpha[i], high = next[i], part = q * (q > 0.0 ? high : low);
        volume[i] = -part;
        all[i] = sum + part;
    }
}

/* A volume through the faces with what it takes along from where it comes. */
static BULLA_KERNEL void drain_carry(size_t n, size_t step, const double *restrict volume, const double *restrict rho,
                                     const double *restrict rho_e, const double *restrict kinetic,
                                     const double *restrict p, double *restrict mass, double *restrict m,
                                     double *restrict energy, double *restrict alpha, double *restrict carried)
{
    const double *rho_r = rho + step, *rho_e_r = rho_e + step, *kinetic_r = kinetic + step, *p_r = p + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double q = volume[i], rho_0 = rho[i], rho_1 = rho_r[i], e_0 = rho_e[i], e_1 = rho_e_r[i], k_0 = kinetic[i],
               k_1 = kinetic_r[i], p_0 = p[i], p_1 = p_r[i], old = m[i], sum = energy[i], a = alpha[i], c = carried[i];
        double flow = q * (q > 0.0 ? rho_0 : rho_1), e = q > 0.0 ? e_0 : e_1, k = q > 0.0 ? k_0 : k_1;
        mass[i] = flow;
        m[i] = old + flow;
        energy[i] = sum + (q * e + flow * k);
        alpha[i] = a + q;
        carried[i] = c + q * (q > 0.0 ? p_0 : p_1);
    }
}

static BULLA_KERNEL void drain_push(size_t n, size_t step, const double *restrict mass, const double *restrict u,
                                    double *restrict momentum)
{
    const double *next = u + step;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double flow = mass[i], low = u[i], high = next[i], old = momentum[i];
        momentum[i] = old + flow * (flow > 0.0 ? low : high);
    }
}

/* Material l goes through the faces with `volume`. */
static void drain_move(const struct term_piece *piece, unsigned l, const double *volume)
{
    const struct model *path = piece->model;
    struct drain *own = piece->own;
    struct face_work *faces = piece->faces;
    size_t n = faces->faces.n, step = piece->frame->inner, reach = frame_reach(piece->frame);
    const double *w = faces->frame + reach;
    drain_carry(n, step, volume, w + (path->i_m + l) * FACE_ROOM, own->energy + l * FACE_ROOM + reach,
                own->kinetic + reach, w + path->i_E * FACE_ROOM, own->mass, faces->m + l * FACE_ROOM, faces->energy,
                faces->alpha + l * FACE_ROOM, faces->carried + l * FACE_ROOM);
    for (unsigned d = 0; d < path->n_velocity; d++)
        drain_push(n, step, own->mass, w + (path->i_u + axis_component(piece->frame->axis, d)) * FACE_ROOM,
                   faces->momentum + d * FACE_ROOM);
}

/* Is there a surface of the pair in the piece? */
static bool drain_meets(const struct term_piece *piece, const struct model_phase *phase)
{
    const struct model *path = piece->model;
    struct drain *own = piece->own;
    size_t n = piece->frame->count;
    const double *alpha = piece->faces->frame + path->i_alpha * FACE_ROOM;
    memset(own->gas, 0, n * sizeof *own->gas);
    for (unsigned j = 1; j < phase->n; j++) row_add(n, alpha + phase->member[j] * FACE_ROOM, own->gas);
    return row_most(n, own->gas) > 0.0 && row_most(n, alpha + phase->member[0] * FACE_ROOM) > 0.0;
}

static void drain_pair(const struct term_piece *piece, const struct model_phase *phase)
{
    const struct model *path = piece->model;
    struct drain *own = piece->own;
    const struct face_work *faces = piece->faces;
    size_t n = faces->faces.n, step = piece->frame->inner, reach = frame_reach(piece->frame);
    int axis = piece->frame->axis;
    const double *w = faces->frame + reach, *alpha = w + path->i_alpha * FACE_ROOM;
    double most = DRAIN_MOST * piece->tile->level->h[axis] / piece->tile->dt;
    if (!drain_meets(piece, phase)) return;
    drain_weigh(n, step, most, w + (path->i_u + (unsigned)axis) * FACE_ROOM, alpha + phase->member[0] * FACE_ROOM,
                own->open);
    if (piece->tile->masked) drain_spare(n, step, faces->mask + reach, own->open);
    memset(own->all, 0, n * sizeof *own->all);
    for (unsigned j = 1; j < phase->n; j++) {
        drain_return(n, step, own->open, alpha + phase->member[j] * FACE_ROOM, own->volume, own->all);
        drain_move(piece, phase->member[j], own->volume);
    }
    drain_move(piece, phase->member[0], own->all);
}

static void drain_faces(const struct term_piece *piece)
{
    for (unsigned k = 0; k < piece->model->n_phase; k++)
        if (drain_acts(piece->model, &piece->model->phases[k])) drain_pair(piece, &piece->model->phases[k]);
}

const struct term drain_term = {
    .name = "drain",
    .owner = "core/scheme/drain.c",
    .equation = "d alpha_l/dt -= div q, masses, momentum and energy with it: liquid behind its surface goes back to it",
    .wanted = drain_wanted,
    .open = drain_open,
    .close = drain_close,
    .frame = drain_frame,
    .faces = drain_faces,
};
