/* cling.c - see cling.h. Rows of faces without two solids are passed over; those of the others get gradients as in
 * viscous.c. */
#include "scheme/cling.h"

#include "base/mem.h"
#include "phys/bearing.h"
#include "phys/elastic.h"
#include "scheme/viscous_slopes.h"

#include <math.h>
#include <string.h>

/* Of h rho c. Less leaves pulses where a contact moves into the stiffer solid, more where waves of the softer one are
 * slow. */
#define CLING_PART 0.2

/* Of one rank. */
struct cling {
    struct viscous_slopes slopes;
    struct viscous_strain strain;
    double speed[SCENE_MATERIALS]; /* of shear waves, by solid of the path [m/s] */
};

static void *cling_open(const struct term_room *room)
{
    struct cling *cling = mem_new(1, sizeof *cling);
    viscous_slopes_open(room->mesh, &cling->slopes);
    return cling;
}

static void cling_close(void *own)
{
    struct cling *cling = own;
    viscous_slopes_close(&cling->slopes);
    mem_free(cling);
}

/* Shear speeds of solids that are not strained, at 1 kg/m3. */
static void cling_speeds(const struct model *path, double *ret)
{
    double V[MODEL_STRETCHES * 6] = {0}, one = 1.0, zero = 0.0, rigid = 0.0, spare[5];
    const double *m[SCENE_MATERIALS];
    const struct elastic_side side = {&spare[0], &spare[1], {&spare[2], &spare[3]}, &spare[4], &rigid};
    for (unsigned k = 0; k < model_stretches(path); k++)
        for (unsigned d = 0; d < 3; d++) V[elastic_block(path, k, 1) + d] = 1.0;
    for (unsigned s = 0; s < path->n_solid; s++) {
        for (unsigned other = 0; other < path->n_solid; other++) m[other] = other == s ? &one : &zero;
        elastic_sides(path, 0, 1, 1, V, m, &zero, &side);
        ret[s] = sqrt(rigid);
    }
}

static void cling_begin(struct term_tile *tile)
{
    struct cling *cling = tile->own;
    viscous_slopes_look(&cling->slopes, tile);
    cling->slopes.colour = NULL; /* how the surface lies does not matter */
    cling_speeds(tile->model, cling->speed);
}

/* Means of the fractions of a solid in both cells of each face, and what it adds to the density there. */
static BULLA_KERNEL void cling_mean(size_t n, size_t step, const double *restrict a, const double *restrict r,
                                    double *restrict alpha, double *restrict rho)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double left = a[i], right = a[i + step], sum = rho[i];
        alpha[i] = 0.5 * (left + right);
        rho[i] = sum + 0.5 * (left * r[i] + right * r[i + step]);
    }
}

/* A solid that breaks counts less. */
static void cling_break(size_t n, size_t step, const double *broken, double *alpha)
{
    for (size_t i = 0; i < n; i++) alpha[i] *= 0.5 * (bearing_part(broken[i]) + bearing_part(broken[i + step]));
}

/* Adds a pair of solids of which one is as slow as c. Returns the sum. */
static BULLA_KERNEL double cling_pair(size_t n, double c, const double *restrict a, const double *restrict b,
                                      double *restrict eta)
{
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (size_t i = 0; i < n; i++) {
        double both = 4.0 * a[i] * b[i], old = eta[i], add = both * both * c;
        eta[i] = old + add;
        sum += add;
    }
    return sum;
}

static BULLA_KERNEL void cling_scale(size_t n, double length, const double *restrict rho, double *restrict eta)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) eta[i] *= length * rho[i];
}

/* eta at a row of faces; false: nothing anywhere. */
static bool cling_eta(const struct term_piece *piece, const struct viscous_block *row, double *eta)
{
    const struct model *path = piece->model;
    const double *speed = ((const struct cling *)piece->own)->speed;
    const double *w = piece->faces->frame + row->face + frame_reach(piece->frame);
    double alpha[SCENE_MATERIALS][STRAIN_POINTS], rho[STRAIN_POINTS], sum = 0.0;
    size_t n = row->n, step = piece->frame->inner;
    memset(eta, 0, n * sizeof *eta);
    memset(rho, 0, n * sizeof *rho);
    for (unsigned s = 0; s < path->n_solid; s++) {
        const struct model_solid *solid = &path->solids[s];
        cling_mean(n, step, w + (path->i_alpha + solid->material) * FACE_ROOM,
                   w + (path->i_m + solid->material) * FACE_ROOM, alpha[s], rho);
        if (solid->damage.law) cling_break(n, step, w + solid->damage.field * FACE_ROOM, alpha[s]);
        for (unsigned l = 0; l < s; l++)
            sum += cling_pair(n, speed[s] < speed[l] ? speed[s] : speed[l], alpha[s], alpha[l], eta);
    }
    if (sum > 0.0) cling_scale(n, CLING_PART * piece->tile->level->h[piece->frame->axis], rho, eta);
    return sum > 0.0;
}

/* Takes tau of component (i, axis) off the flux of momentum, and its power off that of energy. */
static BULLA_KERNEL void cling_push(size_t n, const double *restrict eta, const double *restrict D,
                                    const double *restrict div, double part, const double *restrict u,
                                    double *restrict momentum, double *restrict energy)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double tau = 2.0 * eta[i] * (D[i] - part * div[i]), m = momentum[i], e = energy[i];
        momentum[i] = m - tau;
        energy[i] = e - tau * u[i];
    }
}

static void cling_row(const struct term_piece *piece, const struct viscous_block *row, const double *eta)
{
    struct cling *cling = piece->own;
    struct face_work *faces = piece->faces;
    unsigned axis = (unsigned)piece->frame->axis;
    double speed[STRAIN_POINTS];
    viscous_slopes_strain(&cling->slopes, row, &cling->strain);
    for (unsigned d = 0; d < piece->model->n_velocity; d++) {
        unsigned i = axis_component(piece->frame->axis, d);
        viscous_slopes_speed(&cling->slopes, row, i, speed);
        cling_push(row->n, eta, cling->strain.D[elastic_component(i, axis)], cling->strain.div, d ? 0.0 : 1.0 / 3.0,
                   speed, faces->momentum + d * FACE_ROOM + row->face, faces->energy + row->face);
    }
}

static void cling_faces(const struct term_piece *piece)
{
    struct cling *cling = piece->own;
    struct viscous_walk walk = {&cling->slopes, piece->frame, 0, 0};
    struct viscous_block rest, row;
    double eta[STRAIN_POINTS];
    while (viscous_slopes_next(&walk, &rest))
        while (rest.rows) {
            viscous_slopes_part(&rest, 1, &row);
            if (cling_eta(piece, &row, eta)) cling_row(piece, &row, eta);
        }
}

const struct term cling_term = {
    .name = "cling",
    .owner = "core/scheme/cling.c",
    .equation = "tau = 2 eta (D - div u/3), eta = 0.2 h rho (4 alpha_k alpha_l)^2 c: between solids that meet",
    .wanted = model_clings,
    .open = cling_open,
    .close = cling_close,
    .begin = cling_begin,
    .faces = cling_faces,
};
