/* helmholtz_direct.h - a table of e, c^2 and T over (rho, y) of helmholtz_band.h: no search for T, a tenth of the
 * arithmetic, but three functions that fit each other only as well as the table is fine.
 *
 * Between nodes they are bicubic (Hermite, from values and slopes) or bilinear. e and c^2 of a node lie together, 64 or
 * 16 bytes, T apart: what a flow asks for all the time is two pieces of two nodes. Derivatives are those of the
 * interpolated e, so that Newton's method for the pressure of a mixture sees one function.
 *
 * Beyond the edges of the domain, q = y^2 outside of COLD .. 1, everything goes on linearly in p at constant density
 * with the values and slopes of the edge: e = E + d E_y/(2 y),   T = T_b + d T_y/(2 y),   d = q - y^2,   dq/dp = s/rho,
 *     c^2 = c_b^2 + (p - p_b)(1/rho^2 - W')/W,   W = (de/dp) along the edge. */
#ifndef HELMHOLTZ_DIRECT_H
#define HELMHOLTZ_DIRECT_H

#include "helmholtz_band.h"

enum { HELMHOLTZ_E, HELMHOLTZ_C2, HELMHOLTZ_WARM, HELMHOLTZ_FIELDS };

struct helmholtz_direct {
    int n, cubic; /* nodes in each direction (0: there is no table); bicubic? */
    struct helmholtz_band band;
    struct helmholtz_steps steps;
    double *value; /* HELMHOLTZ_FIELDS x n x n: what the nodes are made of */
    double *state; /* n x n x {e, c^2}: value, and if bicubic slopes in rho, in y and in both */
    double *warm;  /* n x n x {T} likewise */
};

/* The answer at (rho, p), which lies at `row`, `rung`, `level`. `inside` (a constant in loops): within COLD .. 1. */
PATCH_INLINE struct helmholtz_answer helmholtz_direct_answer(const struct helmholtz_direct *table, const int cubic,
                                                             const int inside, struct helmholtz_row row,
                                                             struct helmholtz_rung rung, struct helmholtz_level level)
{
    const int size = cubic ? 8 : 2;
    int at = (row.i * table->n + rung.k) * size, up = at + table->n * size;
    struct patch_weights x = patch_weights(cubic, row.x), y = patch_weights(cubic, rung.t);
    struct patch e = patch_at(cubic, table->state, at, up, size, &x, &y);
    struct patch c = patch_at(cubic, table->state + size / 2, at, up, size, &x, &y);
    double half = 0.5 * table->steps.per_y / level.y, E_q = e.f_y * half;
    double per = helmholtz_band_per(&table->band, level.per_rho);
    struct helmholtz_lines lines = helmholtz_band_lines(&table->band, row, per);
    double W = E_q * lines.s * level.per_rho; /* dq/dp = s/rho */
    double q_r = (level.f - lines.f0) * lines.s_r - (level.f * level.per_rho + lines.f0_r) * lines.s;
    struct helmholtz_answer answer = {.e = e.f, .e_p = W, .e_r = e.f_x * per + E_q * q_r, .c2 = c.f};
    if (!inside) {
        double over = level.q > 1.0 ? level.q - 1.0 : 0.0;
        over = level.q < HELMHOLTZ_COLD ? level.q - HELMHOLTZ_COLD : over;
        double E_qr = e.f_xy * half * per, widen = E_qr / E_q + lines.s_r / lines.s - level.per_rho; /* W'/W */
        double p_over = over / (lines.s * level.per_rho), stiff = level.per_rho * level.per_rho / W - widen;
        double far = c.f + p_over * stiff, least = HELMHOLTZ_LEAST_C2 * c.f;
        far = far > least ? far : least;
        answer.e += over * E_q;
        answer.e_r += over * E_qr;
        answer.c2 = over == 0.0 ? c.f : far;
    }
    return answer;
}

/* T, and on which side of the domain (rho, p) lies: -1, 0, 1. */
PATCH_INLINE double helmholtz_direct_T(const struct helmholtz_direct *table, const int cubic, struct helmholtz_row row,
                                       struct helmholtz_rung rung, struct helmholtz_level level, double *ret_side)
{
    const int size = cubic ? 4 : 1;
    int at = (row.i * table->n + rung.k) * size, up = at + table->n * size;
    struct patch_weights x = patch_weights(cubic, row.x), y = patch_weights(cubic, rung.t);
    struct patch T = patch_at(cubic, table->warm, at, up, size, &x, &y);
    double over = level.q > 1.0 ? level.q - 1.0 : 0.0, side = level.q > 1.0 ? 1.0 : 0.0;
    over = level.q < HELMHOLTZ_COLD ? level.q - HELMHOLTZ_COLD : over;
    *ret_side = level.q < HELMHOLTZ_COLD ? -1.0 : side;
    return T.f + over * T.f_y * (0.5 * table->steps.per_y / level.y);
}

#endif
