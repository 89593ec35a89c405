/* contract_point.c - see contract_point.h. */
#include "suite/contract_point.h"

#include <math.h>

enum { POINT_TRIES = 4000 };

struct contract_point contract_point_at(const struct contract_points *suite, double rho, double p)
{
    struct contract_point point;
    suite->eos->state(suite->self, 1, &rho, &p, &point.rho_e, &point.stiffness);
    point.c2 = point.stiffness / rho;
    suite->eos->derivatives(suite->self, 1, &rho, &p, &point.de_dp, &point.de_drho);
    suite->eos->temperature(suite->self, 1, &rho, &p, &point.T);
    suite->eos->entropy(suite->self, 1, &rho, &p, &point.s);
    return point;
}

double contract_point_p_min(const struct contract_points *suite, double rho)
{
    double p;
    suite->eos->p_min(suite->self, 1, &rho, &p);
    return p;
}

double contract_point_temperature(const struct contract_points *suite, double rho, double p)
{
    double T;
    suite->eos->temperature(suite->self, 1, &rho, &p, &T);
    return T;
}

/* Pressures near p_min as well as high ones. */
bool contract_point_draw(const struct contract_points *suite, uint64_t *seed, double *ret_rho, double *ret_p)
{
    const struct contract_eos_box *box = suite->box;
    for (int i = 0; i < POINT_TRIES; i++) {
        double rho = exp(contract_random(seed, log(box->rho[0]), log(box->rho[1])));
        double p_min = contract_point_p_min(suite, rho), low = p_min > box->p_least ? p_min : box->p_least;
        double close = exp(contract_random(seed, log(1e-3 * fabs(p_min) + 100.0), log(box->p_most)));
        double p = low + (i % 2 ? contract_random(seed, 0.0, box->p_most - low) : close);
        double T = contract_point_temperature(suite, rho, p);
        *ret_rho = rho;
        *ret_p = p;
        if (p > low && p < box->p_most && T >= box->T[0] && T <= box->T[1]) return true;
    }
    return false;
}
