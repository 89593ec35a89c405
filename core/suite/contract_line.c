/* contract_line.c - see contract_line.h. */
#include "suite/contract_line.h"

#include <math.h>

/* A step from one state to another: what rho e changes by, what its slopes at both ends say (`size`: without their
 * cancelling), and what rounding may do. */
struct contract_line_stride {
    double change, slope, size, noise;
};

static struct contract_line_stride contract_line_stride(const struct contract_points *suite, const double from[2],
                                                        const double to[2])
{
    struct contract_point at[2] = {contract_point_at(suite, from[0], from[1]), contract_point_at(suite, to[0], to[1])};
    double dr = 0.5 * (to[0] - from[0]), dp = 0.5 * (to[1] - from[1]);
    struct contract_line_stride stride = {.change = at[1].rho_e - at[0].rho_e};
    for (int i = 0; i < 2; i++) {
        stride.slope += at[i].de_dp * dp + at[i].de_drho * dr;
        stride.size += at[i].de_dp * fabs(dp) + (fabs(at[i].de_drho) + at[i].c2 * at[i].de_dp) * fabs(dr);
        stride.noise += 1e-10 * (fabs(at[i].rho_e) + at[i].de_dp * fabs(i ? to[1] : from[1]));
    }
    return stride;
}

/* By how much slopes do not explain a change. */
static double contract_line_misfit(struct contract_line_stride stride)
{
    return fabs(stride.change - stride.slope) - 1e-3 * stride.size - stride.noise;
}

/* Looks for a jump of rho e between two states: in both halves while slopes do not explain the change, down to steps in
 * which hardly anything may change; over p, rho e may not fall in them either. Slopes that are wrong all along would
 * lead everywhere: when `left` steps are used up, only into the half that they explain less. */
static void contract_line_follow(const struct contract_points *suite, const double from[2], const double to[2],
                                 int depth, int *left)
{
    struct contract_line_stride stride = contract_line_stride(suite, from, to);
    bool explained = contract_line_misfit(stride) <= 0.0;
    if (explained || depth == 0) {
        double most = 3.0 * (stride.size + stride.noise), least = from[0] == to[0] ? -stride.noise : -most;
        contract_error(suite->contract, !explained && !(stride.change >= least && stride.change <= most),
                       "rho %.9g, p %.9g to rho %.9g, p %.9g: rho e changes by %.4g, slopes say %.4g", from[0], from[1],
                       to[0], to[1], stride.change, stride.slope);
        return;
    }
    const double middle[2] = {0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])};
    bool lower = true, upper = true;
    if (--*left < 0) {
        lower = !(contract_line_misfit(contract_line_stride(suite, from, middle)) <
                  contract_line_misfit(contract_line_stride(suite, middle, to)));
        upper = !lower;
    }
    if (lower) contract_line_follow(suite, from, middle, depth - 1, left);
    if (upper) contract_line_follow(suite, middle, to, depth - 1, left);
}

static void contract_line_between(const struct contract_points *suite, const double from[2], const double to[2])
{
    int left = 200;
    contract_line_follow(suite, from, to, 30, &left);
}

/* Lines of constant density from p_min up, and of constant pressure wherever it is above p_min. */
void contract_line_all(const struct contract_points *suite)
{
    double most = suite->box->rho[1] * 1.5 > 4600.0 ? suite->box->rho[1] * 1.5 : 4600.0;
    contract_begin(suite->contract, "rho e grows with p and has no jumps", 0.0);
    for (double rho = 1e-3; rho < most; rho *= 1.1) {
        double p_min = contract_point_p_min(suite, rho), next = 1.1 * rho, next_min = contract_point_p_min(suite, next);
        double least = 1e-9 * fabs(p_min) > 1e-3 ? 1e-9 * fabs(p_min) : 1e-3,
               high = p_min > next_min ? p_min : next_min;
        for (double above = least; above < 1e11; above *= 10.0)
            contract_line_between(suite, (const double[]){rho, p_min + above},
                                  (const double[]){rho, p_min + 10.0 * above});
        for (double p = 1e3; p < 1e11; p *= 10.0)
            if (p > 1.01 * high) contract_line_between(suite, (const double[]){rho, p}, (const double[]){next, p});
    }
}
