/* face_carry.c - see face_carry.h. */
#include "scheme/face_carry.h"

#include "bulla/module.h"
#include "phys/row.h"

/* Pressure and compression of the side that u* points away from. */
static BULLA_KERNEL void face_carry_trace(size_t n, const double *restrict u, const double *restrict p_left,
                                          const double *restrict p_right, const struct bulla_side *left,
                                          const struct bulla_side *right, double *restrict origin,
                                          double *restrict strain)
{
    const double *restrict c_left = left->c, *restrict c_right = right->c, *restrict u_left = left->u[0],
                           *restrict u_right = right->u[0];
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double v = u[i], pl = p_left[i], pr = p_right[i], cl = c_left[i], cr = c_right[i];
        double dl = u_left[i] - v, dr = v - u_right[i];
        origin[i] = v >= 0.0 ? pl : pr;
        strain[i] = (v >= 0.0 ? dl : dr) / (v >= 0.0 ? cl : cr);
    }
}

static BULLA_KERNEL void face_carry_volume(size_t n, const double *restrict u, const double *restrict origin,
                                           const double *restrict strain, double *restrict alpha,
                                           double *restrict carried, double *restrict strained)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double volume = alpha[i] * u[i];
        alpha[i] = volume;
        carried[i] = volume * origin[i];
        strained[i] = volume * strain[i];
    }
}

static void face_carry_solids(const struct face_carry *carry)
{
    const struct model *model = carry->model;
    const struct bulla_faces *faces = carry->faces;
    for (unsigned s = 0; s < model->n_solid; s++) {
        unsigned l = model->solids[s].material;
        row_mean(faces->n, faces->left.alpha[l], faces->right.alpha[l], carry->solid + s * carry->pitch);
    }
}

void face_carry_volumes(const struct face_carry *carry)
{
    const struct bulla_faces *faces = carry->faces;
    const size_t pitch = carry->pitch;
    if (carry->model->n_stretch) face_carry_solids(carry);
    face_carry_trace(faces->n, carry->u, carry->p_left, carry->p_right, &faces->left, &faces->right, carry->origin,
                     carry->strain);
    for (unsigned l = 0; l < carry->model->n_alpha; l++)
        face_carry_volume(faces->n, carry->u, carry->origin, carry->strain, carry->alpha + l * pitch,
                          carry->carried + l * pitch, carry->strained + l * pitch);
}
