/* exact.h - the exact solution of a Riemann problem between two materials of the NASG family.
 *
 * Ideal and stiffened gases are members of the family (covolume 0, p_inf 0). With h = 1/rho - b
 * and P = p + p_inf the wave relations are those of an ideal gas of specific volume h (Toro
 * 2009, chapter 4; Le Metayer & Saurel 2016, Phys. Fluids 28, 046102); the covolume b enters
 * only where speeds in space are formed. Reference of the verification tubes: cell averages,
 * not point values, so that it has no sampling error of its own. */
#ifndef EXACT_H
#define EXACT_H

enum { EXACT_RHO, EXACT_U, EXACT_P, EXACT_LEFT, EXACT_VALUES }; /* LEFT: 1 in the left material, else 0 */

struct exact_side {
    double gamma, p_inf, covolume; /* 1, Pa, m3/kg */
    double rho, u, p;              /* undisturbed state */
};

struct exact {
    struct exact_side side[2]; /* left, right */
    double p_star, u_star;     /* between the waves */
    double rho_star[2];        /* left and right of the contact */
    double head[2], tail[2];   /* speeds of the outer and inner edge of each wave; equal for a shock */
};

/* Solves for the star states. States that separate into vacuum are STATUS_CASE. */
int exact_solve(const struct exact_side side[2], struct exact *ret_exact);

/* Values on the ray x/t = speed. */
void exact_sample(const struct exact *exact, double speed, double ret_value[EXACT_VALUES]);

/* Averages over the cell [lower, upper] at time t > 0, to round-off; the waves start at x = 0. */
void exact_average(const struct exact *exact, double t, double lower, double upper, double ret_value[EXACT_VALUES]);

#endif
