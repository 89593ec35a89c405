/* contact.h - fluxes with a resolved contact: HLLC (Toro, Spruce & Speares 1994; Toro 2009, 10.4).
 *
 * What lies upwind of the contact goes through the face: mass, volume fraction and energy move
 * together with one velocity, so a jump of alpha or density at uniform p and u leaves both
 * exactly uniform, and stands still in a fluid at rest. On the upwind side K, between the signals:
 *     chi = rho*_K/rho_K = (S_K - u_K)/(S_K - S_M) = 1 + (S_M - u_K)/(S_K - S_M),
 *     mass fluxes m_K chi S_M,   rho E* = chi rho E_K + (p* S_M - p_K u_K)/(S_K - S_M).
 * alpha and the tangential velocities do not change across the signals.
 *
 * The including module defines CONTACT_SPEEDS, one of the functions of wave.h, and CONTACT_SHEAR:
 * 1 to diffuse jumps of tangential velocity as the two-wave average does (a remedy against the
 * carbuncle), 0 to keep them sharp; and CONTACT_SLOW for solids (shear.h). With CONTACT_RELEASE 1, of fluids alone,
 * signals between unlike mixtures are those of wave_release: the module says in work[3] how unlike, 0 to 1. */
#ifndef CONTACT_H
#define CONTACT_H

#include "shear.h"

#ifndef CONTACT_RELEASE
#define CONTACT_RELEASE 0
#endif

/* What a face carries: densities of side K go through with velocity `carrier`. */
struct contact {
    double u, p, rho, rho_E, carrier;
};

static inline struct contact contact_at(struct wave wave, struct wave_side left, struct wave_side right)
{
    double u = wave_face_velocity(wave, left, right);
    int from_left = u >= 0.0, inside = (wave.s_left < 0.0) & (wave.s_right > 0.0);
    double rho = from_left ? left.rho : right.rho, u_k = from_left ? left.u : right.u;
    double p_k = from_left ? left.p : right.p, rho_E = from_left ? left.rho_E : right.rho_E;
    double inverse = 1.0 / ((from_left ? wave.s_left : wave.s_right) - wave.s_contact);
    double chi = 1.0 + (wave.s_contact - u_k) * inverse;
    double rho_E_star = chi * rho_E + (wave.p_star * wave.s_contact - p_k * u_k) * inverse;
    return (struct contact){.u = u,
                            .p = inside ? wave.p_star : p_k,
                            .rho = rho,
                            .rho_E = inside ? rho_E_star : rho_E,
                            .carrier = inside ? chi * wave.s_contact : u_k};
}

/* Normal momentum, energy and face velocity. Leaves the carrier in work[0], the mass flux in
 * work[1] and in work[2] what resists shear: the diffusion speed times the lighter density. */
BULLA_KERNEL static void contact_normal(const struct bulla_faces *faces)
{
    const double *restrict rho_l = faces->left.rho, *restrict rho_r = faces->right.rho;
    const double *restrict u_l = faces->left.u[0], *restrict u_r = faces->right.u[0];
    const double *restrict p_l = faces->left.p, *restrict p_r = faces->right.p;
    const double *restrict c_l = faces->left.c, *restrict c_r = faces->right.c;
    const double *restrict e_l = faces->left.rho_E, *restrict e_r = faces->right.rho_E;
    double *restrict momentum = faces->flux.momentum[0], *restrict energy = faces->flux.rho_E;
    double *restrict u = faces->flux.u, *restrict carrier = faces->work[0];
    double *restrict mass = faces->work[1], *restrict resist = faces->work[2];
    const double *restrict alien = faces->work[3];
    const size_t n = faces->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct wave_side left = {rho_l[i], u_l[i], p_l[i], c_l[i], e_l[i]};
        struct wave_side right = {rho_r[i], u_r[i], p_r[i], c_r[i], e_r[i]};
        struct wave wave = CONTACT_SPEEDS(left, right);
        if (CONTACT_RELEASE) wave = wave_release(wave, left, right, alien[i]);
        wave = wave_contact(wave, left, right);
        struct contact face = contact_at(wave, left, right);
        carrier[i] = face.carrier;
        mass[i] = face.rho * face.carrier;
        momentum[i] = face.rho * face.carrier * face.u + face.p;
        energy[i] = face.u * (face.rho_E + face.p);
        u[i] = face.u;
        if (CONTACT_SHEAR) resist[i] = wave_spread(wave) * wave_least(left.rho, right.rho);
    }
}

/* The upwind partial density with the carrier: mass flux of one material. */
BULLA_KERNEL static void contact_mass(size_t n, const double *restrict m_l, const double *restrict m_r,
                                      const double *restrict u, const double *restrict carrier, double *restrict flux)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double left = m_l[i], right = m_r[i];
        flux[i] = (u[i] >= 0.0 ? left : right) * carrier[i];
    }
}

/* The upwind volume fraction: the most dissipative value between the sides. */
BULLA_KERNEL static void contact_fraction(size_t n, const double *restrict alpha_l, const double *restrict alpha_r,
                                          const double *restrict u, double *restrict alpha)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double left = alpha_l[i], right = alpha_r[i];
        alpha[i] = u[i] >= 0.0 ? left : right;
    }
}

/* Tangential momentum of velocity component k. With CONTACT_SHEAR a jump of u_t is diffused like
 * a viscous stress tau = resist (u_tR - u_tL), which takes tau times the mean u_t of energy along. */
BULLA_KERNEL static void contact_tangential(const struct bulla_faces *faces, unsigned k)
{
    const double *restrict t_l = faces->left.u[k], *restrict t_r = faces->right.u[k];
    const double *restrict u = faces->flux.u, *restrict mass = faces->work[1], *restrict resist = faces->work[2];
    double *restrict momentum = faces->flux.momentum[k], *restrict energy = faces->flux.rho_E;
    const size_t n = faces->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double left = t_l[i], right = t_r[i];
        double flux = mass[i] * (u[i] >= 0.0 ? left : right);
        if (CONTACT_SHEAR) {
            double stress = resist[i] * (right - left);
            energy[i] -= stress * (0.5 * (left + right));
            flux -= stress;
        }
        momentum[i] = flux;
    }
}

/* The same with solids; impedances in work[0] and work[3]. Two fluids are left as above. */
BULLA_KERNEL static void contact_traction(const struct bulla_faces *faces, unsigned k)
{
    const double *restrict t_l = faces->left.u[k], *restrict t_r = faces->right.u[k];
    const double *restrict s_l = faces->shear_left.s[k - 1], *restrict s_r = faces->shear_right.s[k - 1];
    const double *restrict z_l = faces->work[0], *restrict z_r = faces->work[3];
    const double *restrict u = faces->flux.u, *restrict mass = faces->work[1], *restrict resist = faces->work[2];
    double *restrict momentum = faces->flux.momentum[k], *restrict energy = faces->flux.rho_E;
    double *restrict slide_l = faces->slide_left[k - 1], *restrict slide_r = faces->slide_right[k - 1];
    const size_t n = faces->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct shear_side left = {t_l[i], s_l[i], z_l[i]}, right = {t_r[i], s_r[i], z_r[i]};
        struct shear_face face = shear_at(left, right, mass[i], u[i] >= 0.0);
        double flux = face.momentum, work = face.work;
        if (CONTACT_SHEAR) {
            double stress = left.z + right.z > 0.0 ? 0.0 : resist[i] * (right.u - left.u);
            work += stress * (0.5 * (left.u + right.u));
            flux -= stress;
        }
        momentum[i] = flux;
        energy[i] -= work;
        slide_l[i] = face.slide_left;
        slide_r[i] = face.slide_right;
    }
}

static void contact_along(const struct bulla_faces *faces)
{
    if (faces->n_velocity == 1) return;
    if (faces->solid) shear_impedance(faces, faces->work[0], faces->work[3]);
    for (unsigned k = 1; k < faces->n_velocity; k++) {
        if (faces->solid) contact_traction(faces, k);
        else contact_tangential(faces, k);
    }
}

static void contact_solve(const struct bulla_faces *faces)
{
    const struct bulla_side *left = &faces->left, *right = &faces->right;
    const struct bulla_flux *flux = &faces->flux;
    contact_normal(faces);
    for (unsigned l = 0; l < faces->n_material; l++)
        contact_mass(faces->n, left->m[l], right->m[l], flux->u, faces->work[0], flux->m[l]);
    for (unsigned l = 0; l < faces->n_alpha; l++)
        contact_fraction(faces->n, left->alpha[l], right->alpha[l], flux->u, flux->alpha[l]);
    contact_along(faces); /* last: impedances take the place of the carrier */
}

#endif
