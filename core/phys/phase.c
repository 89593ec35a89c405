/* phase.c - see phase.h. Acting cells are gathered into blocks; all else is untouched. */
#include "phys/phase.h"

#include "phys/phase_bear.h"
#include "phys/phase_block.h"
#include "phys/phase_pair.h"
#include "phys/phase_rate.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define PHASE_NEAR 1e-9 /* temperatures and D/(R T) that differ by less fit */
#define PHASE_TORN 0.1  /* of the saturation pressure: liquid below evaporates whatever `onset` says */

/* What one phase lacks the other one owes, as in phase_block_owe, also where they do not meet: the lacking one is gone.
 */
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
    if (!(alpha[phase->member[EQUILIBRIUM_LIQUID] * stride] > PHASE_PAIR_FELT)) return false;
    for (unsigned k = EQUILIBRIUM_VAPOUR; k < phase->n; k++) thin += alpha[phase->member[k] * stride];
    return thin > PHASE_PAIR_FELT || phase->scene->everywhere;
}

/* Liquid and vapour of cell i. */
static struct saturation phase_both(const struct phase_block *block, size_t i)
{
    const struct equilibrium_family *family = &block->family;
    const double v_l = block->cells.v[0][i], v_v = block->cells.v[1][i];
    return (struct saturation){{family->eos[0].law, family->eos[1].law},
                               {family->eos[0].self, family->eos[1].self},
                               {v_l > 0.0 ? 1.0 / v_l : 0.0, v_v > 0.0 ? 1.0 / v_v : 0.0},
                               block->cells.jumps ? block->cells.jump[i] : 0.0};
}

/* D/(R T) of cell i at its pressure and liquid temperature, for an own vapour alone. */
static double phase_drive_alone(const struct phase_block *block, size_t i)
{
    const struct saturation both = phase_both(block, i);
    double T = block->cells.T[i];
    return phase_bear_drive(&both, block->cells.p[i], T) / (block->family.R[EQUILIBRIUM_VAPOUR] * T);
}

/* Does the liquid of cell i, which is alone, stay what it is? */
static bool phase_stays(const struct phase_block *block, size_t i)
{
    const struct saturation both = phase_both(block, i);
    return phase_bear_stays(block->phase->scene, &both, block->cells.p[i], block->cells.T[i]);
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
    drive->alone = phase_drive_alone(block, i);
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
    block->thermal[i] = phase_bear_ends(scene, p);
    block->alone[i] = !(phase_thin(block, i) > PHASE_PAIR_FELT);
    if (block->alone[i]) return phase_stays(block, i);
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

/* How long exchange takes in cell i; 0: no time. What condenses at once strikes a blow each time that a cell fills with
 * liquid; while sound of the mixture crosses some cells the vapour is squeezed first, as in any shock. */
static double phase_time(const struct phase_block *block, size_t i, bool condenses)
{
    const struct scene_phase *scene = block->phase->scene;
    if (scene->rate == SCENE_PHASE_RELAXATION) return scene->time;
    return condenses && scene->over > 0.0 ? scene->over * block->h * block->slow[i] : 0.0;
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
    double time = phase_time(block, i, after < before);
    if (time > 0.0) m = before - (after - before) * expm1(-dt / time);
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

static void phase_run(struct phase_block *block, size_t stride, double dt, double *w, double *u,
                      struct equilibrium_effort *effort)
{
    size_t left = 0;
    phase_block_gather(block, stride, u, w);
    phase_block_fill(block);
    memset(block->warm, 0, sizeof block->warm);
    memset(block->alone, 0, sizeof block->alone);
    for (size_t i = 0; i < block->n; i++) {
        if (block->left[i]) phase_block_settle(block, i, stride, w, u);
        if (!phase_fits(block, i)) phase_block_move(block, i, left++);
    }
    block->cells.n = left;
    if (left == 0) return;
    memcpy(block->start.m[0], block->cells.m[0], sizeof(phase_block_row));
    memcpy(block->start.m[1], block->cells.m[1], sizeof(phase_block_row));
    equilibrium_solve(&block->family, &block->cells, effort);
    for (size_t i = 0; i < left; i++) {
        phase_limit(block, i, dt);
        phase_block_scatter(block, i, stride, w, u);
    }
}

int phase_act(const struct model *model, unsigned k, size_t n, size_t stride, double dt, double h,
              const unsigned char *shore, double *w, double *u, struct equilibrium_effort *effort)
{
    struct phase_block block; /* large: filled as far as it is used */
    block.model = model;
    block.phase = &model->phases[k];
    block.h = h;
    block.shore = shore;
    block.n = 0;
    block.status = 0;
    phase_block_family(model, block.phase, &block.family);
    for (size_t i = 0; i < n; i++) {
        if (!phase_meets(model, block.phase, stride, u, i)) {
            phase_repay(model, block.phase, stride, u, i);
            continue;
        }
        block.at[block.n++] = i;
        if (block.n < EQUILIBRIUM_BLOCK) continue;
        phase_run(&block, stride, dt, w, u, effort);
        block.n = 0;
    }
    if (block.n) phase_run(&block, stride, dt, w, u, effort);
    return block.status;
}
