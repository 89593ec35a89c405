/* phase.c - see phase.h. Acting cells are gathered into blocks; all else is untouched. */
#include "phys/phase.h"

#include "phys/mix.h"
#include "phys/phase_rate.h"
#include "phys/traction.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { PHASE_BLOCK = EQUILIBRIUM_BLOCK };

#define PHASE_NEAR 1e-9 /* temperatures and D/(R T) that differ by less fit */
#define PHASE_TORN 0.1  /* of the saturation pressure: liquid below evaporates whatever `onset` says */

typedef double phase_row[PHASE_BLOCK];

/* Cells that may act. */
struct phase_block {
    const struct model *model;
    const struct model_phase *phase;
    const unsigned char *shore; /* of the tile, or NULL */
    struct equilibrium_family family;
    size_t n;
    size_t at[PHASE_BLOCK]; /* place in the tile */
    phase_row u[MODEL_FIELDS], w[MODEL_FIELDS], T[SCENE_MATERIALS], blur;
    bool warm[PHASE_BLOCK];    /* temperatures fit */
    bool thermal[PHASE_BLOCK]; /* no exchange: beyond the end of the curve, or held */
    bool alone[PHASE_BLOCK];   /* liquid without vapour, which has to nucleate */
    bool left[PHASE_BLOCK];    /* the liquid has taken volume that had no vapour left */
    struct equilibrium_cells cells, start;
    int status; /* of scripts */
};

static double phase_constant(const struct model_eos *eos)
{
    return BULLA_EOS_HAS(eos->law, gas_constant) ? eos->law->gas_constant(eos->self) : 0.0;
}

static void phase_family(const struct model *model, const struct model_phase *phase, struct equilibrium_family *ret)
{
    ret->n = phase->scene->apart ? EQUILIBRIUM_GAS : phase->n;
    ret->mixing = phase->scene->mixing;
    ret->exchange = phase->scene->rate != SCENE_PHASE_NONE;
    for (unsigned k = 0; k < ret->n; k++) {
        const struct model_eos *eos = &model->eos[phase->member[k]];
        ret->eos[k] = *eos;
        ret->R[k] = phase_constant(eos);
    }
}

/* What one phase lacks the other one owes, as in phase_owe, also where they do not meet: the lacking one is gone. */
static void phase_repay(const struct model *model, const struct model_phase *phase, size_t stride, double *u, size_t i)
{
    unsigned liquid = phase->member[EQUILIBRIUM_LIQUID], vapour = phase->member[EQUILIBRIUM_VAPOUR];
    double *m = u + model->i_m * stride + i, *alpha = u + model->i_alpha * stride + i;
    unsigned from = m[liquid * stride] < 0.0 ? vapour : liquid, to = from == vapour ? liquid : vapour;
    if (!(m[to * stride] < 0.0) || !(m[from * stride] + m[to * stride] > 0.0)) return;
    m[from * stride] += m[to * stride];
    alpha[from * stride] += alpha[to * stride];
    m[to * stride] = alpha[to * stride] = 0.0;
}

/* Is there liquid, and something that it can evaporate into? */
static bool phase_meets(const struct model *model, const struct model_phase *phase, size_t stride, const double *u,
                        size_t i)
{
    const double *alpha = u + model->i_alpha * stride + i;
    double thin = 0.0;
    if (!(alpha[phase->member[EQUILIBRIUM_LIQUID] * stride] > PHASE_FELT)) return false;
    for (unsigned k = EQUILIBRIUM_VAPOUR; k < phase->n; k++) thin += alpha[phase->member[k] * stride];
    return thin > PHASE_FELT || phase->scene->everywhere;
}

/* Volume that the vapour has left (its mass is gone, by flow or to the midpoint's account) is the liquid's: with it
 * nobody would know what the liquid bears, and the guard would say so (solve/guard.c) when this step is over. */
static bool phase_leave(struct phase_block *block, size_t i)
{
    const struct model *model = block->model;
    unsigned liquid = block->phase->member[EQUILIBRIUM_LIQUID], vapour = block->phase->member[EQUILIBRIUM_VAPOUR];
    double *alpha = &block->u[model->i_alpha + vapour][i];
    if (!(*alpha > PHASE_FELT) || block->u[model->i_m + vapour][i] > 0.0) return false;
    block->u[model->i_alpha + liquid][i] += *alpha;
    *alpha = 0.0;
    return true;
}

/* That into the tile, with the masses that phase_owe has made. */
static void phase_settle(const struct phase_block *block, size_t i, size_t stride, double *w, double *u)
{
    const struct model *model = block->model;
    for (unsigned k = 0; k <= EQUILIBRIUM_VAPOUR; k++) {
        unsigned l = block->phase->member[k];
        u[(model->i_alpha + l) * stride + block->at[i]] = block->u[model->i_alpha + l][i];
        u[(model->i_m + l) * stride + block->at[i]] = block->cells.m[k][i];
    }
    w[model->i_E * stride + block->at[i]] = block->cells.p[i];
}

static void phase_gather(struct phase_block *block, size_t stride, const double *u, const double *w)
{
    const struct model *model = block->model;
    for (unsigned a = 0; a < model->n_active; a++) {
        unsigned q = model->active[a];
        for (size_t i = 0; i < block->n; i++) block->u[q][i] = u[q * stride + block->at[i]];
    }
    for (size_t i = 0; i < block->n; i++) {
        block->w[model->i_E][i] = w[model->i_E * stride + block->at[i]];
        block->left[i] = phase_leave(block, i);
    }
    mix_primitives(model, block->n, PHASE_BLOCK, block->u[0], block->w[0]);
}

/* Where a material is among those that share a temperature; family.n: it is none of them. */
static unsigned phase_place(const struct phase_block *block, unsigned l)
{
    unsigned k = 0;
    while (k < block->family.n && block->phase->member[k] != l) k++;
    return k;
}

/* What gases with a heat of their own take of the vapour's mole fraction. */
static void phase_mingle(struct phase_block *block)
{
    struct equilibrium_cells *cells = &block->cells;
    cells->apart = block->phase->scene->apart;
    memset(cells->moles, 0, sizeof cells->moles);
    for (unsigned k = block->family.n; k < block->phase->n; k++) {
        unsigned l = block->phase->member[k];
        double R = phase_constant(&block->model->eos[l]);
        for (size_t i = 0; i < cells->n; i++)
            cells->moles[i] +=
                block->w[block->model->i_alpha + l][i] > 0.0 ? R * block->u[block->model->i_m + l][i] : 0.0;
    }
}

/* Two stages may take more of a phase out of a cell than there was, vapour that the midpoint has made: what is missing
 * is of one substance with the other phase. */
static void phase_owe(struct equilibrium_cells *cells)
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

/* Surface tension between liquid and vapour: cells->p becomes that of the vapour, the liquid has p + jump, and both
 * with their volumes what the surface stores: sum m h = E + p + jump alpha_l of the start, since it gives jump d
 * alpha_l (tension.c). */
static void phase_curve(struct phase_block *block, const struct traction_pressures *parts)
{
    struct equilibrium_cells *cells = &block->cells;
    unsigned liquid = block->phase->member[EQUILIBRIUM_LIQUID], vapour = block->phase->member[EQUILIBRIUM_VAPOUR];
    cells->jumps = block->model->n_pair > 0;
    for (size_t i = 0; i < cells->n && cells->jumps; i++) {
        cells->jump[i] = parts->lag[liquid][i] - parts->lag[vapour][i];
        cells->p[i] += parts->lag[vapour][i];
        cells->energy[i] += cells->jump[i] * block->u[block->model->i_alpha + liquid][i];
    }
}

/* Masses, temperatures and energy of the family and the others. Traces that fluxes do not see are left out of both. */
static void phase_fill(struct phase_block *block)
{
    const struct model *model = block->model;
    struct equilibrium_cells *cells = &block->cells;
    size_t n = block->n;
    cells->n = n;
    cells->n_other = 0;
    struct traction_pressures parts; /* large: filled as far as it is used */
    traction_part(model, n, PHASE_BLOCK, block->w[0], &parts);
    memset(cells->energy, 0, sizeof cells->energy);
    memset(block->blur, 0, sizeof block->blur);
    for (unsigned l = 0; l < model->n_material; l++) {
        const struct model_eos *eos = &model->eos[l];
        const double *alpha = block->w[model->i_alpha + l], *rho = block->w[model->i_m + l];
        const double *p = traction_pressure(model, n, l, block->w[model->i_E], &parts);
        unsigned k = phase_place(block, l), o = cells->n_other;
        phase_row rho_e, rho_c2;
        eos->law->state(eos->self, n, rho, p, rho_e, rho_c2);
        if (k < block->family.n) eos->law->temperature(eos->self, n, rho, p, block->T[k]);
        else cells->other[cells->n_other++] = *eos;
        for (size_t i = 0; i < n; i++) {
            double there = alpha[i] > 0.0 ? 1.0 : 0.0, m = there * block->u[model->i_m + l][i];
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
    phase_owe(cells);
    phase_mingle(block);
    memcpy(cells->p, block->w[model->i_E], n * sizeof(double));
    memcpy(cells->T, block->T[EQUILIBRIUM_LIQUID], n * sizeof(double));
    phase_curve(block, &parts);
}

/* D/(R T) of cell i at its pressure and liquid temperature, for an own vapour alone, shifted by what the liquid
 * bears. */
static double phase_drive_alone(const struct phase_block *block, size_t i, double tension, double superheat)
{
    const struct equilibrium_family *family = &block->family;
    const double v_l = block->cells.v[0][i], v_v = block->cells.v[1][i];
    const struct saturation pair = {{family->eos[0].law, family->eos[1].law},
                                    {family->eos[0].self, family->eos[1].self},
                                    {v_l > 0.0 ? 1.0 / v_l : 0.0, v_v > 0.0 ? 1.0 / v_v : 0.0},
                                    block->cells.jumps ? block->cells.jump[i] : 0.0};
    double p = block->cells.p[i] + tension, T = block->cells.T[i] - superheat;
    if (!(p > 0.0)) return -HUGE_VAL;
    return saturation_at(&pair, p, T).drive / (family->R[EQUILIBRIUM_VAPOUR] * T);
}

/* What the vapour that is there has of the moles of the gases. */
static double phase_share(const struct phase_block *block, size_t i)
{
    const struct equilibrium_family *family = &block->family;
    double moles = family->mixing ? block->cells.moles[i] : 0.0,
           vapour = block->cells.m[EQUILIBRIUM_VAPOUR][i] * family->R[EQUILIBRIUM_VAPOUR];
    for (unsigned k = EQUILIBRIUM_GAS; k < family->n && family->mixing; k++)
        moles += block->cells.m[k][i] * family->R[k];
    return moles > 0.0 ? vapour / (vapour + moles) : 1.0;
}

/* D/(R T) of a cell: for an own vapour alone, and for what is there among gases. Asked when first needed, and once:
 * most cells wait or have two temperatures, and need it for nothing or for one decision. */
struct phase_drive {
    bool asked;
    double alone, all;
};

static const struct phase_drive *phase_drive(const struct phase_block *block, size_t i, struct phase_drive *drive)
{
    if (drive->asked) return drive;
    double share = phase_share(block, i);
    drive->alone = phase_drive_alone(block, i, 0.0, 0.0);
    drive->all = share > 0.0 ? drive->alone + log(share) : -HUGE_VAL;
    drive->asked = true;
    return drive;
}

/* Volume fraction of vapour and gases. */
static double phase_thin(const struct phase_block *block, size_t i)
{
    double thin = 0.0;
    for (unsigned k = EQUILIBRIUM_VAPOUR; k < block->phase->n; k++)
        thin += block->w[block->model->i_alpha + block->phase->member[k]][i];
    return thin;
}

/* Would liquid evaporate that `onset` holds back? That at the shore is not held: behind it there is none. What is
 * stretched to below PHASE_TORN of its saturation pressure is not held: the vapour of such cells would else thin out
 * without end as they are pulled. */
static bool phase_held(const struct phase_block *block, size_t i, struct phase_drive *drive)
{
    if (!(phase_thin(block, i) < block->phase->scene->onset)) return false;
    if (block->shore && block->shore[block->at[i]]) return false;
    return phase_drive(block, i, drive)->all < 0.0 && drive->alone > log(PHASE_TORN);
}

/* Volume fraction of the liquid. */
static double phase_wet(const struct phase_block *block, size_t i)
{
    return block->w[block->model->i_alpha + block->phase->member[EQUILIBRIUM_LIQUID]][i];
}

/* Volume fraction of the vapour. */
static double phase_steam(const struct phase_block *block, size_t i)
{
    return block->u[block->model->i_alpha + block->phase->member[EQUILIBRIUM_VAPOUR]][i];
}

/* Temperatures of all that is there, to what the closure resolves of p. */
static bool phase_warm(const struct phase_block *block, size_t i, double near)
{
    double T = block->T[EQUILIBRIUM_LIQUID][i];
    for (unsigned k = EQUILIBRIUM_VAPOUR; k < block->family.n; k++) {
        double alpha = block->w[block->model->i_alpha + block->phase->member[k]][i];
        if (alpha > 0.0 && !(fabs(block->T[k][i] - T) <= near * T)) return false;
    }
    return true;
}

/* Does cell i need nothing? */
static bool phase_fits(struct phase_block *block, size_t i)
{
    const struct scene_phase *scene = block->phase->scene;
    struct phase_drive asked = {0};
    double p = block->cells.p[i], near = PHASE_NEAR + 4.0 * DBL_EPSILON * block->blur[i] / fabs(p);
    double all = block->cells.m[EQUILIBRIUM_LIQUID][i] + block->cells.m[EQUILIBRIUM_VAPOUR][i];
    if (!isfinite(p) || !(block->cells.T[i] > 0.0) || !(all > 0.0)) return true; /* guard's */
    block->thermal[i] = scene->rate == SCENE_PHASE_NONE || p > scene->curve.p_max;
    block->alone[i] = !(phase_thin(block, i) > PHASE_FELT);
    if (block->alone[i])
        return block->thermal[i] || !(phase_drive_alone(block, i, scene->tension, scene->superheat) < 0.0);
    block->thermal[i] = block->thermal[i] || phase_held(block, i, &asked);
    if (phase_wet(block, i) < scene->wet && phase_drive(block, i, &asked)->all > 0.0) return true;
    if (phase_steam(block, i) <= scene->nucleus && phase_drive(block, i, &asked)->all > 0.0) return true;
    block->warm[i] = phase_warm(block, i, near);
    if (!block->warm[i]) return false;
    if (block->thermal[i]) return true;
    double drive = phase_drive(block, i, &asked)->all;
    if (scene->direction == SCENE_PHASE_EVAPORATION && drive >= 0.0) return true;
    if (scene->direction == SCENE_PHASE_CONDENSATION && drive <= 0.0) return true;
    if (!(block->cells.m[EQUILIBRIUM_VAPOUR][i] > 0.0) && drive >= 0.0) return true;
    return fabs(drive) <= near;
}

/* Cell i takes place `to`. */
static void phase_move(struct phase_block *block, size_t i, size_t to)
{
    struct equilibrium_cells *cells = &block->cells;
    if (i == to) return;
    block->at[to] = block->at[i];
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
    }
    cells->energy[to] = cells->energy[i];
    cells->moles[to] = cells->moles[i];
    if (cells->jumps) cells->jump[to] = cells->jump[i];
    cells->p[to] = cells->p[i];
    cells->T[to] = cells->T[i];
}

/* Answers of single cells take the place of those of the block. */
static void phase_take(const struct equilibrium_point *point, struct equilibrium_cells *cells, size_t i)
{
    for (unsigned k = 0; k < point->family->n; k++) cells->m[k][i] = point->m[k], cells->v[k][i] = point->v[k];
    for (unsigned k = 0; k < point->n_other; k++) cells->v_other[k][i] = point->v_other[k];
    cells->p[i] = point->p;
    cells->T[i] = point->T;
}

/* The state of cell i with other masses of liquid and vapour. */
static void phase_hold(struct phase_block *block, size_t i, double m_v)
{
    struct equilibrium_cells *cells = &block->cells;
    double all = block->start.m[EQUILIBRIUM_LIQUID][i] + block->start.m[EQUILIBRIUM_VAPOUR][i];
    struct equilibrium_point point;
    equilibrium_point_take(&block->family, cells, i, &point);
    point.m[EQUILIBRIUM_VAPOUR] = m_v;
    point.m[EQUILIBRIUM_LIQUID] = all - m_v;
    if (!equilibrium_point_solve(&point)) cells->regime[i] = EQUILIBRIUM_NONE;
    else phase_take(&point, cells, i);
}

/* The least vapour that condensation leaves in cell i: what fills the nucleus at the equilibrium's p and T. With it p
 * is higher, so it fills less, and no second call condenses more. */
static double phase_nucleus(const struct phase_block *block, size_t i)
{
    const struct model_eos *eos = &block->family.eos[EQUILIBRIUM_VAPOUR];
    double before = block->start.m[EQUILIBRIUM_VAPOUR][i], rho;
    eos->law->density(eos->self, 1, &block->cells.p[i], &block->cells.T[i], &rho);
    double least = block->phase->scene->nucleus * rho;
    return least < before ? least : before;
}

/* Only as far as the rate, the direction and the end of the curve let it go. `start` has the masses of before, at one p
 * and T where they are asked. */
static void phase_limit(struct phase_block *block, size_t i, double dt)
{
    const struct scene_phase *scene = block->phase->scene;
    struct equilibrium_cells *cells = &block->cells;
    double before = block->start.m[EQUILIBRIUM_VAPOUR][i], after = cells->m[EQUILIBRIUM_VAPOUR][i], m = after;
    double all = before + block->start.m[EQUILIBRIUM_LIQUID][i];
    if (cells->regime[i] == EQUILIBRIUM_NONE) return;
    bool wrong = (scene->direction == SCENE_PHASE_EVAPORATION && after < before) ||
                 (scene->direction == SCENE_PHASE_CONDENSATION && after > before);
    if (scene->rate == SCENE_PHASE_RELAXATION) m = before - (after - before) * expm1(-dt / scene->time);
    if (scene->rate == SCENE_PHASE_HERTZ_KNUDSEN || scene->rate == SCENE_PHASE_LUA) {
        struct equilibrium_point point;
        int status;
        equilibrium_point_take(&block->family, cells, i, &point);
        m = phase_rate_step(&point, scene, before, after, dt, &status);
        block->status = block->status ? block->status : status;
    }
    if (wrong || block->thermal[i]) m = before;
    if (m < before && scene->nucleus > 0.0) {
        double least = phase_nucleus(block, i);
        m = m < least ? least : m;
    }
    if (m < EQUILIBRIUM_NOTHING * all) m = 0.0;
    if (all - m < EQUILIBRIUM_NOTHING * all) m = all;
    if (m != after) phase_hold(block, i, m);
}

/* What the surface gives when the liquid of cell i fills alpha, and the mean pressure then. */
static void phase_pay(const struct phase_block *block, size_t i, double alpha, size_t stride, double *w, double *u)
{
    const struct model *model = block->model;
    double jump = block->cells.jump[i];
    double before = block->u[model->i_alpha + block->phase->member[EQUILIBRIUM_LIQUID]][i];
    u[model->i_E * stride + block->at[i]] -= jump * (alpha - before);
    w[model->i_E * stride + block->at[i]] += jump * alpha;
}

/* Is it one of the gases beside the vapour? */
static bool phase_gas(const struct model_phase *phase, unsigned l)
{
    bool gas = false;
    for (unsigned k = EQUILIBRIUM_GAS; k < phase->n; k++) gas = gas || phase->member[k] == l;
    return gas;
}

/* Into the tile. */
static void phase_scatter(const struct phase_block *block, size_t i, size_t stride, double *w, double *u)
{
    const struct model *model = block->model;
    const struct equilibrium_cells *cells = &block->cells;
    unsigned liquid = block->phase->member[EQUILIBRIUM_LIQUID];
    double alpha[SCENE_MATERIALS], sum = 0.0, thin = 0.0, all = block->start.m[0][i] + block->start.m[1][i];
    double *at = u + block->at[i];
    bool same = cells->m[EQUILIBRIUM_VAPOUR][i] == block->start.m[EQUILIBRIUM_VAPOUR][i];
    if (cells->regime[i] == EQUILIBRIUM_NONE || (same && block->warm[i])) return;
    for (unsigned l = 0, o = 0; l < model->n_material; l++) {
        unsigned k = phase_place(block, l);
        double m = k < block->family.n ? cells->m[k][i] : cells->m_other[o][i];
        double v = k < block->family.n ? cells->v[k][i] : cells->v_other[o][i];
        o += k == block->family.n;
        alpha[l] = m > 0.0 ? m * v : k < 2 ? 0.0 : block->u[model->i_alpha + l][i];
        sum += alpha[l];
        thin += k == EQUILIBRIUM_VAPOUR || phase_gas(block->phase, l) ? alpha[l] : 0.0;
    }
    if (block->alone[i] && !(thin > PHASE_FELT)) return; /* no bubble that would be felt */
    for (unsigned l = 0; l < model->n_material; l++) at[(model->i_alpha + l) * stride] = alpha[l] / sum;
    at[(model->i_m + block->phase->member[EQUILIBRIUM_VAPOUR]) * stride] = cells->m[EQUILIBRIUM_VAPOUR][i];
    at[(model->i_m + block->phase->member[EQUILIBRIUM_LIQUID]) * stride] = all - cells->m[EQUILIBRIUM_VAPOUR][i];
    w[model->i_E * stride + block->at[i]] = cells->p[i];
    if (cells->jumps) phase_pay(block, i, alpha[liquid] / sum, stride, w, u);
}

static void phase_run(struct phase_block *block, size_t stride, double dt, double *w, double *u,
                      struct equilibrium_effort *effort)
{
    size_t left = 0;
    phase_gather(block, stride, u, w);
    phase_fill(block);
    memset(block->warm, 0, sizeof block->warm);
    memset(block->alone, 0, sizeof block->alone);
    for (size_t i = 0; i < block->n; i++) {
        if (block->left[i]) phase_settle(block, i, stride, w, u);
        if (!phase_fits(block, i)) phase_move(block, i, left++);
    }
    block->cells.n = left;
    if (left == 0) return;
    memcpy(block->start.m[0], block->cells.m[0], sizeof(phase_row));
    memcpy(block->start.m[1], block->cells.m[1], sizeof(phase_row));
    equilibrium_solve(&block->family, &block->cells, effort);
    for (size_t i = 0; i < left; i++) {
        phase_limit(block, i, dt);
        phase_scatter(block, i, stride, w, u);
    }
}

int phase_act(const struct model *model, unsigned k, size_t n, size_t stride, double dt, const unsigned char *shore,
              double *w, double *u, struct equilibrium_effort *effort)
{
    struct phase_block block; /* large: filled as far as it is used */
    block.model = model;
    block.phase = &model->phases[k];
    block.shore = shore;
    block.n = 0;
    block.status = 0;
    phase_family(model, block.phase, &block.family);
    for (size_t i = 0; i < n; i++) {
        if (!phase_meets(model, block.phase, stride, u, i)) {
            phase_repay(model, block.phase, stride, u, i);
            continue;
        }
        block.at[block.n++] = i;
        if (block.n < PHASE_BLOCK) continue;
        phase_run(&block, stride, dt, w, u, effort);
        block.n = 0;
    }
    if (block.n) phase_run(&block, stride, dt, w, u, effort);
    return block.status;
}
