/* cut_wall.c - see cut_wall.h. */
#include "scheme/cut_wall.h"

#include "phys/mix.h"
#include "phys/row.h"

#include <math.h>
#include <string.h>

/* (gamma + 1)/4, (gamma - 1)/2 and gamma of a gas of two atoms; 2 gamma/(gamma - 1) is 7. */
#define CUT_WALL_STEEP 0.6
#define CUT_WALL_THIN 0.2
#define CUT_WALL_GAMMA 1.4

static BULLA_KERNEL void cut_wall_solve(size_t n, const double *restrict p, const double *restrict rho,
                                        const double *restrict c2, const double *restrict u, double *restrict ret)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double towards = u[i], steep = CUT_WALL_STEEP * towards, here = p[i], r = rho[i], s = c2[i];
        double push = r * towards * (steep + sqrt(steep * steep + s));
        double left = 1.0 + CUT_WALL_THIN * towards / sqrt(s), kept = left > 0.0 ? left : 0.0;
        double cube = kept * kept * kept, pull = r * s / CUT_WALL_GAMMA * (1.0 - cube * cube * kept);
        ret[i] = towards > 0.0 ? here + push : here - pull;
    }
}

/* Velocity of row i towards the wall, relative to it, times the length of its area vector; and the square of that. */
static double cut_wall_along(const struct cut_wall *wall, size_t i, double *ret_square)
{
    const struct rigid_cells *cells = wall->cells;
    size_t at = wall->at[i];
    double along = 0.0;
    *ret_square = 0.0;
    for (int d = 0; d < wall->model->dim; d++) {
        double W = cells->wall[d][at], speed = cells->speed[d] ? cells->speed[d][at] : 0.0;
        along += W * (wall->w[(wall->model->i_u + (unsigned)d) * wall->stride + i] - speed);
        *ret_square += W * W;
    }
    return along;
}

static void cut_wall_towards(const struct cut_wall *wall, double *u)
{
    for (size_t i = 0; i < wall->n; i++) {
        double square, along = cut_wall_along(wall, i, &square);
        u[i] = square > 0.0 ? along / sqrt(square) : 0.0;
    }
}

void cut_wall_slide(const struct cut_wall *wall, bool stop, double *w)
{
    for (size_t i = 0; i < wall->n; i++) {
        double square, along = cut_wall_along(wall, i, &square), *u = w + wall->model->i_u * wall->stride + i;
        if (!(square > 0.0)) continue;
        for (int d = 0; d < wall->model->dim && stop; d++)
            along -= wall->cells->wall[d][wall->at[i]] * u[(size_t)d * wall->stride];
        for (int d = 0; d < wall->model->dim; d++) {
            double *at = &u[(size_t)d * wall->stride];
            *at = (stop ? 0.0 : *at) - along / square * wall->cells->wall[d][wall->at[i]];
        }
    }
}

static void cut_wall_density(const struct cut_wall *wall, double *rho)
{
    const struct model *model = wall->model;
    memset(rho, 0, wall->n * sizeof *rho);
    for (unsigned l = 0; l < model->n_material; l++) {
        const double *rho_l = wall->w + (model->i_m + l) * wall->stride;
        if (model->n_alpha) row_add_product(wall->n, wall->w + (model->i_alpha + l) * wall->stride, rho_l, rho);
        else row_add(wall->n, rho_l, rho);
    }
}

void cut_wall_pressure(const struct cut_wall *wall, double *ret_p)
{
    const struct model *model = wall->model;
    double *rho = wall->scratch, *c2 = rho + wall->stride, *u = c2 + wall->stride, *stiff = u + wall->stride;
    mix_stiffness(model, wall->n, wall->stride, wall->w, stiff);
    mix_speed2(model, wall->n, wall->stride, wall->w, stiff, c2);
    cut_wall_density(wall, rho);
    cut_wall_towards(wall, u);
    cut_wall_solve(wall->n, wall->w + model->i_E * wall->stride, rho, c2, u, ret_p);
}
