/* phase_block.c - see phase_block.h. */
#include "phys/phase_block.h"

#include "phys/mix.h"
#include "phys/phase_pair.h"
#include "phys/traction.h"

#include <math.h>
#include <string.h>

static double phase_block_constant(const struct model_eos *eos)
{
    return BULLA_EOS_HAS(eos->law, gas_constant) ? eos->law->gas_constant(eos->self) : 0.0;
}

void phase_block_family(const struct model *model, const struct model_phase *phase, struct equilibrium_family *ret)
{
    ret->n = phase->scene->apart ? EQUILIBRIUM_GAS : phase->n;
    ret->mixing = phase->scene->mixing;
    ret->exchange = phase->scene->rate != SCENE_PHASE_NONE;
    for (unsigned k = 0; k < ret->n; k++) {
        const struct model_eos *eos = &model->eos[phase->member[k]];
        ret->eos[k] = *eos;
        ret->R[k] = phase_block_constant(eos);
    }
}

/* Volume that the vapour has left (its mass is gone, by flow or to the midpoint's account) is the liquid's: with it
 * nobody would know what the liquid bears, and the guard would say so (solve/guard.c) when this step is over. */
static bool phase_block_leave(struct phase_block *block, size_t i)
{
    const struct model *model = block->model;
    unsigned liquid = block->phase->member[EQUILIBRIUM_LIQUID], vapour = block->phase->member[EQUILIBRIUM_VAPOUR];
    double *alpha = &block->u[model->i_alpha + vapour][i];
    if (!(*alpha > PHASE_PAIR_FELT) || block->u[model->i_m + vapour][i] > 0.0) return false;
    block->u[model->i_alpha + liquid][i] += *alpha;
    *alpha = 0.0;
    return true;
}

void phase_block_settle(const struct phase_block *block, size_t i, size_t stride, double *w, double *u)
{
    const struct model *model = block->model;
    for (unsigned k = 0; k <= EQUILIBRIUM_VAPOUR; k++) {
        unsigned l = block->phase->member[k];
        u[(model->i_alpha + l) * stride + block->at[i]] = block->u[model->i_alpha + l][i];
        u[(model->i_m + l) * stride + block->at[i]] = block->cells.m[k][i];
    }
    w[model->i_E * stride + block->at[i]] = block->w[model->i_E][i];
}

void phase_block_gather(struct phase_block *block, size_t stride, const double *u, const double *w)
{
    const struct model *model = block->model;
    for (unsigned a = 0; a < model->n_active; a++) {
        unsigned q = model->active[a];
        for (size_t i = 0; i < block->n; i++) block->u[q][i] = u[q * stride + block->at[i]];
    }
    for (size_t i = 0; i < block->n; i++) {
        block->w[model->i_E][i] = w[model->i_E * stride + block->at[i]];
        block->left[i] = phase_block_leave(block, i);
    }
    mix_primitives(model, block->n, EQUILIBRIUM_BLOCK, block->u[0], block->w[0]);
}

/* Where a material is among those that share a temperature; family.n: it is none of them. */
static unsigned phase_block_place(const struct phase_block *block, unsigned l)
{
    unsigned k = 0;
    while (k < block->family.n && block->phase->member[k] != l) k++;
    return k;
}

/* What gases with a heat of their own take of the vapour's mole fraction. */
static void phase_block_mingle(struct phase_block *block)
{
    struct equilibrium_cells *cells = &block->cells;
    cells->apart = block->phase->scene->apart;
    memset(cells->moles, 0, sizeof cells->moles);
    for (unsigned k = block->family.n; k < block->phase->n; k++) {
        unsigned l = block->phase->member[k];
        double R = phase_block_constant(&block->model->eos[l]);
        for (size_t i = 0; i < cells->n; i++)
            cells->moles[i] +=
                block->w[block->model->i_alpha + l][i] > 0.0 ? R * block->u[block->model->i_m + l][i] : 0.0;
    }
}

/* Two stages may take more of a phase out of a cell than there was, vapour that the midpoint has made: what is missing
 * is of one substance with the other phase. */
static void phase_block_owe(struct equilibrium_cells *cells)
{
    double *liquid = cells->m[EQUILIBRIUM_LIQUID], *vapour = cells->m[EQUILIBRIUM_VAPOUR];
    for (size_t i = 0; i < cells->n; i++) {
        double all = liquid[i] + vapour[i];
        if (liquid[i] < 0.0 || vapour[i] < 0.0) {
            liquid[i] = liquid[i] < 0.0 ? 0.0 : all;
            vapour[i] = all - liquid[i];
        }
    }
}

/* Materials with pressures of their own: cells->p becomes that of the vapour. Behind surface tension the liquid has p +
 * jump, and both with their volumes what the surface stores: sum m h = E + p + jump alpha_l of the start, since it
 * gives jump d alpha_l (tension.c). Solids that share their traction have p + s'_nn. */
static void phase_block_curve(struct phase_block *block, const struct traction_pressures *parts)
{
    struct equilibrium_cells *cells = &block->cells;
    unsigned liquid = block->phase->member[EQUILIBRIUM_LIQUID], vapour = block->phase->member[EQUILIBRIUM_VAPOUR];
    cells->jumps = block->model->lagged;
    for (unsigned l = 0, o = 0; l < block->model->n_material && cells->jumps; l++) {
        if (phase_block_place(block, l) < block->family.n) continue;
        for (size_t i = 0; i < cells->n; i++) cells->own[o][i] = parts->lag[l][i] - parts->lag[vapour][i];
        o++;
    }
    for (size_t i = 0; i < cells->n && cells->jumps; i++) {
        cells->jump[i] = parts->lag[liquid][i] - parts->lag[vapour][i];
        cells->p[i] += parts->lag[vapour][i];
        cells->energy[i] += cells->jump[i] * block->u[block->model->i_alpha + liquid][i];
    }
}

/* Adds what material l gives way in Wood's mixture, alpha/(rho c^2). */
static void phase_block_give(struct phase_block *block, unsigned l, const double *rho_c2)
{
    const double *alpha = block->w[block->model->i_alpha + l];
    if (!(block->phase->scene->over > 0.0)) return;
    if (l == 0) memset(block->slow, 0, sizeof block->slow);
    for (size_t i = 0; i < block->n; i++) block->slow[i] += alpha[i] > 0.0 ? alpha[i] / rho_c2[i] : 0.0;
}

/* From that to 1/c. */
static void phase_block_sound(struct phase_block *block)
{
    if (!(block->phase->scene->over > 0.0)) return;
    for (size_t i = 0; i < block->n; i++) {
        double rho = 0.0;
        for (unsigned l = 0; l < block->model->n_material; l++) rho += block->u[block->model->i_m + l][i];
        block->slow[i] = sqrt(rho * block->slow[i]);
    }
}

void phase_block_fill(struct phase_block *block)
{
    const struct model *model = block->model;
    struct equilibrium_cells *cells = &block->cells;
    size_t n = block->n;
    cells->n = n;
    cells->n_other = 0;
    struct traction_pressures parts; /* large: filled as far as it is used */
    traction_part(model, n, EQUILIBRIUM_BLOCK, block->w[0], &parts);
    memset(cells->energy, 0, sizeof cells->energy);
    memset(block->blur, 0, sizeof block->blur);
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct model_eos *eos = &model->eos[l];
        const double *alpha = block->w[model->i_alpha + l], *rho = block->w[model->i_m + l];
        const double *p = traction_pressure(model, n, l, block->w[model->i_E], &parts);
        unsigned k = phase_block_place(block, l), o = cells->n_other;
        phase_block_row rho_e, rho_c2, least;
        eos->law->state(eos->self, n, rho, p, rho_e, rho_c2);
        phase_block_give(block, l, rho_c2);
        if (k < block->family.n) eos->law->temperature(eos->self, n, rho, p, block->T[k]);
        else eos->law->p_min(eos->self, n, rho, least), cells->other[cells->n_other++] = *eos;
        for (size_t i = 0; i < n; i++) {
            double there = alpha[i] > 0.0 && (k < block->family.n || p[i] > least[i]) ? 1.0 : 0.0;
            double m = there * block->u[model->i_m + l][i];
            cells->energy[i] += there > 0.0 ? alpha[i] * rho_e[i] : 0.0;
            if (there > 0.0 && rho_c2[i] > block->blur[i]) block->blur[i] = rho_c2[i];
            if (k < 2) cells->m[k][i] = block->u[model->i_m + l][i];
            else if (k < block->family.n) cells->m[k][i] = m;
            if (k < block->family.n) cells->v[k][i] = there > 0.0 ? 1.0 / rho[i] : 0.0;
            if (k < block->family.n) continue;
            cells->m_other[o][i] = m;
            cells->v0[o][i] = 1.0 / rho[i];
            cells->e0[o][i] = rho_e[i] / rho[i];
        }
    }
    phase_block_sound(block);
    phase_block_owe(cells);
    phase_block_mingle(block);
    memcpy(cells->p, block->w[model->i_E], n * sizeof(double));
    memcpy(cells->T, block->T[EQUILIBRIUM_LIQUID], n * sizeof(double));
    phase_block_curve(block, &parts);
}

void phase_block_move(struct phase_block *block, size_t i, size_t to)
{
    struct equilibrium_cells *cells = &block->cells;
    if (i == to) return;
    block->at[to] = block->at[i];
    block->slow[to] = block->slow[i];
    block->warm[to] = block->warm[i];
    block->thermal[to] = block->thermal[i];
    block->alone[to] = block->alone[i];
    for (unsigned l = 0; l < block->model->n_material; l++)
        block->u[block->model->i_alpha + l][to] = block->u[block->model->i_alpha + l][i];
    for (unsigned k = 0; k < block->family.n; k++) {
        cells->m[k][to] = cells->m[k][i];
        cells->v[k][to] = cells->v[k][i];
    }
    for (unsigned k = 0; k < cells->n_other; k++) {
        cells->m_other[k][to] = cells->m_other[k][i];
        cells->v0[k][to] = cells->v0[k][i];
        cells->e0[k][to] = cells->e0[k][i];
        if (cells->jumps) cells->own[k][to] = cells->own[k][i];
    }
    cells->energy[to] = cells->energy[i];
    cells->moles[to] = cells->moles[i];
    if (cells->jumps) cells->jump[to] = cells->jump[i];
    cells->p[to] = cells->p[i];
    cells->T[to] = cells->T[i];
}

/* What the surface gives when the materials of cell i fill alpha, and the mean pressure then. */
static void phase_block_pay(const struct phase_block *block, size_t i, const double *alpha, size_t stride, double *w,
                            double *u)
{
    const struct model *model = block->model;
    unsigned liquid = block->phase->member[EQUILIBRIUM_LIQUID];
    const struct equilibrium_cells *cells = &block->cells;
    double jump = cells->jump[i], mean = jump * alpha[liquid];
    for (unsigned l = 0, o = 0; l < model->n_material; l++) {
        if (phase_block_place(block, l) < block->family.n) continue;
        double thinner = cells->m_other[o][i] > 0.0 ? cells->v0[o][i] / cells->v_other[o][i] : 1.0;
        mean += cells->own[o++][i] * thinner * alpha[l];
    }
    u[model->i_E * stride + block->at[i]] -= jump * (alpha[liquid] - block->u[model->i_alpha + liquid][i]);
    w[model->i_E * stride + block->at[i]] += mean;
}

/* Is it one of the gases beside the vapour? */
static bool phase_block_gas(const struct model_phase *phase, unsigned l)
{
    bool gas = false;
    for (unsigned k = EQUILIBRIUM_GAS; k < phase->n; k++) gas = gas || phase->member[k] == l;
    return gas;
}

void phase_block_scatter(const struct phase_block *block, size_t i, size_t stride, double *w, double *u)
{
    const struct model *model = block->model;
    const struct equilibrium_cells *cells = &block->cells;
    double alpha[SCENE_MATERIALS], sum = 0.0, thin = 0.0, all = block->start.m[0][i] + block->start.m[1][i];
    double *at = u + block->at[i];
    bool same = cells->m[EQUILIBRIUM_VAPOUR][i] == block->start.m[EQUILIBRIUM_VAPOUR][i];
    if (cells->regime[i] == EQUILIBRIUM_NONE || (same && block->warm[i])) return;
    for (unsigned l = 0, o = 0; l < model->n_material; l++) {
        unsigned k = phase_block_place(block, l);
        double m = k < block->family.n ? cells->m[k][i] : cells->m_other[o][i];
        double v = k < block->family.n ? cells->v[k][i] : cells->v_other[o][i];
        o += k == block->family.n;
        alpha[l] = m > 0.0 ? m * v : k < 2 ? 0.0 : block->u[model->i_alpha + l][i];
        sum += alpha[l];
        thin += k == EQUILIBRIUM_VAPOUR || phase_block_gas(block->phase, l) ? alpha[l] : 0.0;
    }
    if (block->alone[i] && !(thin > PHASE_PAIR_FELT)) return; /* no bubble that would be felt */
    for (unsigned l = 0; l < model->n_material; l++) at[(model->i_alpha + l) * stride] = alpha[l] /= sum;
    at[(model->i_m + block->phase->member[EQUILIBRIUM_VAPOUR]) * stride] = cells->m[EQUILIBRIUM_VAPOUR][i];
    at[(model->i_m + block->phase->member[EQUILIBRIUM_LIQUID]) * stride] = all - cells->m[EQUILIBRIUM_VAPOUR][i];
    w[model->i_E * stride + block->at[i]] = cells->p[i];
    if (cells->jumps) phase_block_pay(block, i, alpha, stride, w, u);
}
