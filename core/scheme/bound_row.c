/* bound_row.c - see bound_row.h. */
#include "scheme/bound_row.h"

#include "phys/mix.h"

#include <math.h>
#include <string.h>

void bound_row_sound(const struct model *model, const struct bound_row *row, double *rho, double *sound)
{
    double stiff[SCENE_MATERIALS * BOUND_ROW], c2[BOUND_ROW];
    mix_stiffness(model, row->n, row->stride, row->w, stiff);
    mix_speed2(model, row->n, row->stride, row->w, stiff, c2);
    for (size_t c = 0; c < row->n; c++) {
        rho[c] = 0.0;
        sound[c] = sqrt(c2[c]);
        for (unsigned l = 0; l < model->n_material; l++)
            rho[c] += (model->n_alpha ? row->w[(model->i_alpha + l) * row->stride + c] : 1.0) *
                      row->w[(model->i_m + l) * row->stride + c];
    }
}

/* rho_l moved along its isentrope by dp: midpoint rule on d rho / dp = 1/c^2. Where the law has no sound on the way, or
 * linear waves leave nothing of it (a trace of gas in a solid under tension), rho_l stays what it is inside. */
static void bound_row_isentrope(const struct model_eos *eos, size_t n, const double *p, const double *p_new,
                                double *rho, double *scratch)
{
    double *e = scratch, *rho_c2 = scratch + n, *half_rho = scratch + 2 * n, *half_p = scratch + 3 * n;
    eos->law->state(eos->self, n, rho, p, e, rho_c2);
    for (size_t i = 0; i < n; i++) {
        half_p[i] = 0.5 * (p[i] + p_new[i]);
        half_rho[i] = rho[i] + 0.5 * (p_new[i] - p[i]) * rho[i] / rho_c2[i];
        if (!(rho_c2[i] > 0.0 && half_rho[i] > 0.0)) half_p[i] = p[i], half_rho[i] = rho[i];
    }
    eos->law->state(eos->self, n, half_rho, half_p, e, rho_c2);
    for (size_t i = 0; i < n; i++) {
        double moved = rho[i] + (p_new[i] - p[i]) * half_rho[i] / rho_c2[i];
        rho[i] = rho_c2[i] > 0.0 && moved > 0.0 ? moved : rho[i];
    }
}

/* Puts the point c back to what lies inside. */
static void bound_row_restore(const struct model *model, struct bound_row *row, size_t c, const double *old,
                              const double *const *old_u, const double *rho)
{
    row->w[model->i_E * row->stride + c] = old[c];
    for (unsigned d = 0; d < model->n_velocity; d++)
        if (old_u[d]) row->w[(model->i_u + d) * row->stride + c] = old_u[d][c];
    for (unsigned l = 0; l < model->n_material; l++)
        row->w[(model->i_m + l) * row->stride + c] = rho[l * BOUND_ROW + c];
}

void bound_row_follow(const struct model *model, struct bound_row *row, const double *old, const double *const *old_u)
{
    double scratch[4 * BOUND_ROW], inside[SCENE_MATERIALS * BOUND_ROW], rho[BOUND_ROW], sound[BOUND_ROW];
    const double *p = row->w + model->i_E * row->stride;
    for (unsigned l = 0; l < model->n_material; l++) {
        double *own = row->w + (model->i_m + l) * row->stride;
        memcpy(inside + l * BOUND_ROW, own, row->n * sizeof *own);
        bound_row_isentrope(&model->eos[l], row->n, old, p, own, scratch);
    }
    bound_row_sound(model, row, rho, sound);
    for (size_t c = 0; c < row->n; c++)
        if (!(sound[c] > 0.0 && rho[c] > 0.0)) bound_row_restore(model, row, c, old, old_u, inside);
}
