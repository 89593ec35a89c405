/* two_wave.h - the solvers that know two signals only: HLL and Rusanov, as modules.
 *
 * One material: the flux of Harten, Lax & van Leer (Toro 2009, 10.21) for every conserved U,
 *     F = 1/2 (F_L + F_R) + 1/2 sigma (F_L - F_R) - D (U_R - U_L),
 *     sigma = (S_R + S_L)/(S_R - S_L),  D = -S_L S_R/(S_R - S_L),  signals clipped to S_L <= 0 <= S_R,
 * a form that gives p exactly where p does not jump and mirrors exactly.
 *
 * Several materials: alpha moves with the flux alpha* u*, alpha* between the two sides, so the
 * upwind side is the most dissipative choice there is and a fluid at rest cannot diffuse alpha at
 * all. Mass and energy must then not diffuse across a contact either, or p would leave
 * equilibrium: for any law rho e changes with m_l at fixed alpha. So the contact is resolved
 * as in contact.h, with the signals of the solver; what is left of its diffusion acts on
 * shear, which is what these solvers are chosen for in two and three dimensions.
 *
 * Solids: one material averages tractions too, with -s_nt in F of momentum and -s_nt u_t in F of energy; several do as
 * shear.h says. The velocity that moves the stretch is that of shear.h in both cases.
 *
 * The including module defines CONTACT_SPEEDS (wave.h). */
#ifndef TWO_WAVE_H
#define TWO_WAVE_H

#define CONTACT_SHEAR 1
#define CONTACT_SLOW 0
#include "contact.h"

/* F from the two fluxes and the jump of U. */
static inline double two_wave_flux(double f_left, double f_right, double jump, double sigma, double spread)
{
    return 0.5 * (f_left + f_right) + 0.5 * sigma * (f_left - f_right) - spread * jump;
}

/* Normal momentum, energy and face velocity; leaves sigma in work[0] and D in work[1]. */
BULLA_KERNEL static void two_wave_normal(const struct bulla_faces *faces)
{
    const double *restrict rho_l = faces->left.rho, *restrict rho_r = faces->right.rho;
    const double *restrict u_l = faces->left.u[0], *restrict u_r = faces->right.u[0];
    const double *restrict p_l = faces->left.p, *restrict p_r = faces->right.p;
    const double *restrict c_l = faces->left.c, *restrict c_r = faces->right.c;
    const double *restrict e_l = faces->left.rho_E, *restrict e_r = faces->right.rho_E;
    double *restrict momentum = faces->flux.momentum[0], *restrict energy = faces->flux.rho_E;
    double *restrict u = faces->flux.u, *restrict tilt = faces->work[0], *restrict diffusion = faces->work[1];
    const size_t n = faces->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct wave_side left = {rho_l[i], u_l[i], p_l[i], c_l[i], e_l[i]};
        struct wave_side right = {rho_r[i], u_r[i], p_r[i], c_r[i], e_r[i]};
        struct wave wave = wave_contact(CONTACT_SPEEDS(left, right), left, right);
        double s_left = wave_least(wave.s_left, 0.0), s_right = wave_most(wave.s_right, 0.0);
        double sigma = (s_right + s_left) / (s_right - s_left), spread = wave_spread(wave);
        double q_l = left.rho * left.u, q_r = right.rho * right.u;
        double p = 0.5 * (left.p + right.p) + 0.5 * sigma * (left.p - right.p);
        momentum[i] = two_wave_flux(q_l * left.u, q_r * right.u, q_r - q_l, sigma, spread) + p;
        double work_l = left.u * (left.rho_E + left.p), work_r = right.u * (right.rho_E + right.p);
        energy[i] = two_wave_flux(work_l, work_r, right.rho_E - left.rho_E, sigma, spread);
        u[i] = wave_face_velocity(wave, left, right);
        tilt[i] = sigma;
        diffusion[i] = spread;
    }
}

/* Mass flux of material l. */
BULLA_KERNEL static void two_wave_mass(const struct bulla_faces *faces, unsigned l)
{
    const double *restrict m_l = faces->left.m[l], *restrict m_r = faces->right.m[l];
    const double *restrict u_l = faces->left.u[0], *restrict u_r = faces->right.u[0];
    const double *restrict tilt = faces->work[0], *restrict diffusion = faces->work[1];
    double *restrict flux = faces->flux.m[l];
    const size_t n = faces->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double left = m_l[i], right = m_r[i];
        flux[i] = two_wave_flux(left * u_l[i], right * u_r[i], right - left, tilt[i], diffusion[i]);
    }
}

BULLA_KERNEL static void two_wave_tangential(const struct bulla_faces *faces, unsigned k)
{
    const double *restrict rho_l = faces->left.rho, *restrict rho_r = faces->right.rho;
    const double *restrict t_l = faces->left.u[k], *restrict t_r = faces->right.u[k];
    const double *restrict u_l = faces->left.u[0], *restrict u_r = faces->right.u[0];
    const double *restrict tilt = faces->work[0], *restrict diffusion = faces->work[1];
    double *restrict flux = faces->flux.momentum[k];
    const size_t n = faces->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double left = rho_l[i] * t_l[i], right = rho_r[i] * t_r[i];
        flux[i] = two_wave_flux(left * u_l[i], right * u_r[i], right - left, tilt[i], diffusion[i]);
    }
}

/* Adds what tractions along tangent k - 1 take of momentum and energy. */
BULLA_KERNEL static void two_wave_traction(const struct bulla_faces *faces, unsigned k)
{
    const double *restrict t_l = faces->left.u[k], *restrict t_r = faces->right.u[k];
    const double *restrict s_l = faces->shear_left.s[k - 1], *restrict s_r = faces->shear_right.s[k - 1];
    const double *restrict tilt = faces->work[0];
    double *restrict momentum = faces->flux.momentum[k], *restrict energy = faces->flux.rho_E;
    const size_t n = faces->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double left = s_l[i], right = s_r[i], sigma = tilt[i];
        momentum[i] -= two_wave_flux(left, right, 0.0, sigma, 0.0);
        energy[i] -= two_wave_flux(left * t_l[i], right * t_r[i], 0.0, sigma, 0.0);
    }
}

/* Face velocity along tangent k - 1; impedances in work[2] and work[3]. */
BULLA_KERNEL static void two_wave_slide(const struct bulla_faces *faces, unsigned k)
{
    const double *restrict t_l = faces->left.u[k], *restrict t_r = faces->right.u[k];
    const double *restrict s_l = faces->shear_left.s[k - 1], *restrict s_r = faces->shear_right.s[k - 1];
    const double *restrict z_l = faces->work[2], *restrict z_r = faces->work[3];
    const double *restrict u = faces->flux.u, *restrict rho_l = faces->left.rho, *restrict rho_r = faces->right.rho;
    double *restrict slide_l = faces->slide_left[k - 1], *restrict slide_r = faces->slide_right[k - 1];
    const size_t n = faces->n;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        struct shear_side left = {t_l[i], s_l[i], z_l[i]}, right = {t_r[i], s_r[i], z_r[i]};
        double velocity = u[i], before = rho_l[i], after = rho_r[i];
        int from_left = velocity >= 0.0;
        struct shear_face face = shear_at(left, right, (from_left ? before : after) * velocity, from_left);
        slide_l[i] = face.slide_left;
        slide_r[i] = face.slide_right;
    }
}

static void two_wave_solid(const struct bulla_faces *faces)
{
    shear_impedance(faces, faces->work[2], faces->work[3]);
    for (unsigned k = 1; k < faces->n_velocity; k++) {
        two_wave_traction(faces, k);
        two_wave_slide(faces, k);
    }
}

static void two_wave_solve(const void *self, const struct bulla_faces *faces)
{
    (void)self;
    if (faces->mixed | faces->n_alpha) {
        contact_solve(faces);
        return;
    }
    two_wave_normal(faces);
    for (unsigned k = 1; k < faces->n_velocity; k++) two_wave_tangential(faces, k);
    for (unsigned l = 0; l < faces->n_material; l++) two_wave_mass(faces, l);
    if (faces->solid) two_wave_solid(faces);
}

static const struct bulla_riemann two_wave_table = {.size = sizeof(struct bulla_riemann),
                                                    .solve = two_wave_solve,
                                                    .solids = 1,
                                                    .resists = 1};

#endif
