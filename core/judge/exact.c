/* exact.c - see exact.h.
 *
 * The pressure between the waves is the root of an increasing function, found by bisection down
 * to neighbouring doubles: no starting value, no tolerance, no failure. Inside a rarefaction the
 * pressure on a ray is found by false position. Cell averages are sums over the pieces of the
 * solution; a piece of a fan is smooth and integrated by Gauss points. */
#include "judge/exact.h"

#include "base/status.h"

#include <math.h>
#include <stdbool.h>

static double exact_volume(const struct exact_side *side, double rho)
{
    return 1 / rho - side->covolume; /* h */
}

/* Velocity change across a wave that takes a side to pressure p: Toro (4.6), (4.7) in h, P. */
static double exact_jump(const struct exact_side *side, double p)
{
    double g = side->gamma, h = exact_volume(side, side->rho);
    double before = side->p + side->p_inf, after = p + side->p_inf;
    if (p > side->p) return (p - side->p) * sqrt(2 * h / ((g + 1) * after + (g - 1) * before));
    return 2 * sqrt(g * before * h) / (g - 1) * (pow(after / before, (g - 1) / (2 * g)) - 1);
}

/* Density behind a wave that takes a side to pressure p: Toro (4.50), (4.53). */
static double exact_density(const struct exact_side *side, double p)
{
    double g = side->gamma, h = exact_volume(side, side->rho);
    double ratio = (p + side->p_inf) / (side->p + side->p_inf), k = (g - 1) / (g + 1);
    if (p > side->p) return 1 / (h * (k * ratio + 1) / (ratio + k) + side->covolume);
    return 1 / (h * pow(ratio, -1 / g) + side->covolume);
}

static double exact_sound(const struct exact_side *side, double rho, double p)
{
    return sqrt(side->gamma * (p + side->p_inf) / exact_volume(side, rho)) / rho;
}

/* Speed in space of the characteristic of side k (0: u - c, 1: u + c) at pressure p of its fan. */
static double exact_ray(const struct exact *exact, int k, double p)
{
    const struct exact_side *side = &exact->side[k];
    double sign = k ? 1 : -1, rho = exact_density(side, p);
    return side->u + sign * (exact_jump(side, p) + exact_sound(side, rho, p));
}

static double exact_imbalance(const struct exact_side side[2], double p)
{
    return exact_jump(&side[0], p) + exact_jump(&side[1], p) + side[1].u - side[0].u;
}

static double exact_star(const struct exact_side side[2], double least)
{
    double low = least, high = (side[0].p > side[1].p ? side[0].p : side[1].p) + 1e-300;
    while (exact_imbalance(side, high) < 0) high += high - least;
    for (;;) {
        double middle = low + (high - low) / 2;
        if (middle <= low || middle >= high) return middle;
        if (exact_imbalance(side, middle) < 0) low = middle;
        else high = middle;
    }
}

static void exact_wave(struct exact *exact, int k)
{
    const struct exact_side *side = &exact->side[k];
    double sign = k ? 1 : -1;
    exact->rho_star[k] = exact_density(side, exact->p_star);
    if (exact->p_star > side->p) { /* shock: mass flux through it, Toro (4.20) */
        double g = side->gamma, h = exact_volume(side, side->rho);
        double after = exact->p_star + side->p_inf, before = side->p + side->p_inf;
        double flux = sqrt(((g + 1) * after + (g - 1) * before) / (2 * h));
        exact->head[k] = exact->tail[k] = side->u + sign * flux / side->rho;
        return;
    }
    exact->head[k] = exact_ray(exact, k, side->p);
    exact->tail[k] = exact_ray(exact, k, exact->p_star);
}

int exact_solve(const struct exact_side side[2], struct exact *ret_exact)
{
    double least = -(side[0].p_inf < side[1].p_inf ? side[0].p_inf : side[1].p_inf);
    for (int k = 0; k < 2; k++)
        if (!(side[k].rho > 0) || !(side[k].p > least) || !(exact_volume(&side[k], side[k].rho) > 0))
            return status_fail(STATUS_CASE,
                               "no Riemann problem: density %g kg/m3, pressure %g Pa is no state of its material",
                               side[k].rho, side[k].p);
    if (exact_imbalance(side, least) >= 0)
        return status_fail(STATUS_CASE,
                           "the two states separate so fast that a vacuum opens: no exact solution offered");
    struct exact exact = {.side = {side[0], side[1]}};
    exact.p_star = exact_star(side, least);
    exact.u_star =
        (side[0].u + side[1].u + exact_jump(&side[1], exact.p_star) - exact_jump(&side[0], exact.p_star)) / 2;
    exact_wave(&exact, 0);
    exact_wave(&exact, 1);
    *ret_exact = exact;
    return STATUS_OK;
}

/* Pressure on a ray inside the fan of side k: false position with the Illinois rule (Dowell & Jarratt
 * 1971), which keeps the root bracketed and needs some ten steps where bisection needs fifty. */
static double exact_fan(const struct exact *exact, int k, double speed)
{
    double low = exact->p_star, high = exact->side[k].p, sign = k ? 1 : -1; /* sign * ray grows with p */
    double below = sign * (exact->tail[k] - speed), above = sign * (exact->head[k] - speed);
    for (int last = 0; high - low > 1e-15 * (fabs(low) + fabs(high));) {
        double p = low + (high - low) * (below / (below - above));
        if (p <= low || p >= high) return p;
        double error = sign * (exact_ray(exact, k, p) - speed);
        if (error == 0) return p;
        if (error < 0) {
            if (last < 0) above /= 2;
            low = p;
            below = error;
        } else {
            if (last > 0) below /= 2;
            high = p;
            above = error;
        }
        if (last == (error < 0 ? -1 : 1) && fabs(error) < 1e-15 * (fabs(exact->tail[k]) + fabs(exact->head[k])))
            return p;
        last = error < 0 ? -1 : 1;
    }
    return low + (high - low) / 2;
}

void exact_sample(const struct exact *exact, double speed, double ret_value[EXACT_VALUES])
{
    int k = speed > exact->u_star;
    const struct exact_side *side = &exact->side[k];
    double sign = k ? 1 : -1, p = exact->p_star;
    if (sign * speed >= sign * exact->head[k]) p = side->p;
    else if (sign * speed > sign * exact->tail[k]) p = exact_fan(exact, k, speed);
    ret_value[EXACT_RHO] = exact_density(side, p);
    ret_value[EXACT_U] = side->u + sign * exact_jump(side, p);
    ret_value[EXACT_P] = p;
    ret_value[EXACT_LEFT] = !k;
}

/* Adds the integral over speeds [from, to], a range without kinks. `parts` 0: constant there; else as
 * many pieces of 8 Gauss points. */
static void exact_piece(const struct exact *exact, double from, double to, int parts, double sum[EXACT_VALUES])
{
    static const double node[8] = {-0.9602898564975363, -0.7966664774136267, -0.5255324099163290, -0.1834346424956498,
                                   0.1834346424956498,  0.5255324099163290,  0.7966664774136267,  0.9602898564975363};
    static const double weight[8] = {0.1012285362903763, 0.2223810344533745, 0.3137066458778873, 0.3626837833783620,
                                     0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    double value[EXACT_VALUES];
    if (parts == 0) {
        exact_sample(exact, from + (to - from) / 2, value);
        for (int v = 0; v < EXACT_VALUES; v++) sum[v] += (to - from) * value[v];
        return;
    }
    double half = (to - from) / (2 * parts);
    for (int i = 0; i < 8 * parts; i++) {
        exact_sample(exact, from + (2 * (i / 8) + 1) * half + half * node[i % 8], value);
        for (int v = 0; v < EXACT_VALUES; v++) sum[v] += weight[i % 8] * half * value[v];
    }
}

/* Pieces for the part [from, to] of a fan: 16 for all of it. */
static int exact_parts(const struct exact *exact, int k, double from, double to)
{
    return 1 + (int)(15 * (to - from) / fabs(exact->head[k] - exact->tail[k]));
}

void exact_average(const struct exact *exact, double t, double lower, double upper, double ret_value[EXACT_VALUES])
{
    double edge[7] = {-INFINITY,      exact->head[0], exact->tail[0], exact->u_star,
                      exact->tail[1], exact->head[1], INFINITY};
    double first = lower / t, last = upper / t, sum[EXACT_VALUES] = {0};
    for (int piece = 0; piece < 6; piece++) {
        double from = edge[piece] > first ? edge[piece] : first, to = edge[piece + 1] < last ? edge[piece + 1] : last;
        bool fan = piece == 1 || piece == 4;
        if (to > from) exact_piece(exact, from, to, fan ? exact_parts(exact, piece == 4, from, to) : 0, sum);
    }
    for (int v = 0; v < EXACT_VALUES; v++) ret_value[v] = sum[v] / (last - first);
}
