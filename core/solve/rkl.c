/* rkl.c - see rkl.h.
 *
 * Of a tile, u_new holds what the rest has made of u_old, and w the primitives of the stage under way: nobody else
 * needs them before the integrator's own stage is done. */
#include "solve/rkl.h"

#include "base/comm.h"
#include "base/mem.h"
#include "phys/elastic.h"
#include "phys/mix.h"
#include "phys/row.h"
#include "solve/operate.h"
#include "solve/stage_exchange.h"
#include "solve/verdict.h"

#include <math.h>
#include <string.h>

/* The pace of what diffuses is cfl lambda over this (scheme/viscous.c, conduction.c). */
#define RKL_REAL 1.8

/* How much faster decay may become within a step than it was at its beginning. */
#define RKL_MARGIN 1.1

/* Explicit steps below which nothing is gained: the integrator bears that much. */
#define RKL_IDLE 0.25

int rkl_stages(double steps)
{
    double s = ceil(0.5 * (sqrt(9.0 + 8.0 * RKL_MARGIN * RKL_REAL * steps) - 1.0));
    if (!(steps > RKL_IDLE)) return 0; /* not a number: the guard will see it */
    return s < 3.0 ? 3 : s < RKL_MOST ? (int)s | 1 : RKL_MOST;
}

double rkl_relief(void)
{
    return rkl_bears(RKL_MOST);
}

double rkl_bears(int s)
{
    return 2.0 * RKL_MARGIN * RKL_REAL / (s * s + s - 2);
}

bool rkl_flows(const struct scene *scene)
{
    return scene->mesh.levels > 0 || scene->n_material > 1;
}

static double rkl_b(int j)
{
    return j < 3 ? 1.0 / 3.0 : (j * j + j - 2) / (2.0 * j * (j + 1));
}

struct rkl_stage rkl_stage(int s, int j)
{
    double all = s * s + s - 2, w = 4.0 / all;
    if (j == 1) return (struct rkl_stage){.mu_tilde = rkl_b(1) * w, .at = rkl_b(1) * w};
    struct rkl_stage stage = {.mu = (2.0 * j - 1.0) / j * rkl_b(j) / rkl_b(j - 1),
                              .nu = -(j - 1.0) / j * rkl_b(j) / rkl_b(j - 2),
                              .at = (j * j + j - 2) / all};
    stage.mu_tilde = stage.mu * w;
    stage.gamma_tilde = -(1.0 - rkl_b(j - 1)) * stage.mu_tilde;
    return stage;
}

size_t rkl_half(const struct stage *stage)
{
    return (stage->model->n_velocity + 1) * stage->mesh->n_cell;
}

struct rkl *rkl_new(const struct stage *stage)
{
    if (stage->model->scene->scheme.diffusion != SCENE_DIFFUSION_RKL2) return NULL;
    struct rkl *rkl = mem_new(1, sizeof *rkl);
    rkl->block = stage->model->n_field * stage->mesh->n_cell;
    size_t all = stage->level->n_local * rkl->block;
    rkl->z = mem_new(all, sizeof *rkl->z);
    rkl->before = mem_new(all, sizeof *rkl->before);
    rkl->M0 = mem_new(all, sizeof *rkl->M0);
    if (rkl_flows(stage->model->scene)) rkl->half = mem_new(stage->level->n_local * rkl_half(stage), sizeof *rkl->half);
    return rkl;
}

void rkl_free(struct rkl *rkl)
{
    if (!rkl) return;
    mem_free(rkl->z);
    mem_free(rkl->before);
    mem_free(rkl->M0);
    mem_free(rkl->half);
    mem_free(rkl);
}

/* The fastest pace of what diffuses, of all ranks [1/s], as terms say it. */
static double rkl_pace(const struct stage *stage)
{
    const struct level *level = stage->level;
    struct work *work = stage->work;
    double most = 0.0;
    for (unsigned local = 0; local < level->n_local; local++) {
        const struct term_pace pace = {.model = stage->model,
                                       .level = level,
                                       .n_cell = stage->mesh->n_cell,
                                       .w = level->w[local],
                                       .c2 = work->c2,
                                       .part = TERM_DIFFUSION};
        terms_pace(work->terms[0], &pace, work->rates);
        double own = row_most(pace.n_cell, work->rates);
        if (own > most) most = own;
    }
    comm_max(&most, 1);
    return most;
}

static double rkl_step(const struct stage *stage)
{
    return stage->tableau->stage[stage->turn].step * stage->dt;
}

double rkl_steps(const struct stage *stage, double dt)
{
    return rkl_pace(stage) * dt / stage->model->scene->scheme.cfl;
}

/* Flows of the whole step are not planned here (solve/flow.h). */
void rkl_plan(struct stage *stage)
{
    struct rkl *rkl = stage->rkl;
    if (!rkl || rkl_flows(stage->model->scene)) return;
    double steps = rkl_steps(stage, stage->dt);
    int whole = rkl_stages(steps);
    for (int turn = 0; turn < stage->tableau->n; turn++) {
        int s = rkl_stages(stage->tableau->stage[turn].step * steps);
        rkl->s[turn] = whole && !s ? 3 : s;
    }
}

bool rkl_acts(const struct stage *stage)
{
    return stage->rkl && stage->rkl->s[0] > 0;
}

/* Rates of a part of the terms, from the primitives of a tile, into work->rates. */
static struct term_tile *rkl_rates(struct stage *stage, unsigned local, enum term_part part,
                                   struct stage_tile_work *own)
{
    stage_rates(stage, local, part, rkl_step(stage), false, own);
    return &own->tile;
}

static BULLA_KERNEL void rkl_begin_row(size_t n, double a, const double *restrict M0, double *restrict z,
                                       double *restrict before)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        z[i] = a * M0[i];
        before[i] = 0.0;
    }
}

static BULLA_KERNEL void rkl_go_on_row(size_t n, const struct rkl_stage *restrict stage, double tau,
                                       const double *restrict M0, const double *restrict M, const double *restrict z,
                                       double *restrict before)
{
    double mu = stage->mu, nu = stage->nu, a = tau * stage->mu_tilde, b = tau * stage->gamma_tilde;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double old = before[i];
        before[i] = (mu * z[i] + nu * old) + (a * M[i] + b * M0[i]);
    }
}

void rkl_begin(size_t n, double a, const double *restrict M0, double *restrict z, double *restrict before)
{
    rkl_begin_row(n, a, M0, z, before);
}

void rkl_go_on(size_t n, const struct rkl_stage *restrict stage, double tau, const double *restrict M0,
               const double *restrict M, const double *restrict z, double *restrict before)
{
    rkl_go_on_row(n, stage, tau, M0, M, z, before);
}

/* What all but diffusion makes of a tile, M(u) in the first stage of the integrator, and z_1. */
static void rkl_first(struct stage *stage, unsigned local)
{
    struct rkl *rkl = stage->rkl;
    struct work *work = stage->work;
    size_t at = local * rkl->block;
    double a = rkl_step(stage) * rkl_stage(rkl->s[stage->turn], 1).mu_tilde;
    struct stage_tile_work own;
    stage->census.tiles[local].skipped = false;
    if (stage->turn == 0) {
        rkl_rates(stage, local, TERM_DIFFUSION, &own);
        memcpy(rkl->M0 + at, work->rates, rkl->block * sizeof *rkl->M0);
    }
    struct term_tile *tile = rkl_rates(stage, local, TERM_SLOW, &own);
    stage->clipped += (long long)rate_apply(tile, work->own, stage->level->u_new[local]);
    stage->cells += (long long)stage->mesh->n_cell;
    rkl_begin(rkl->block, a, rkl->M0 + at, rkl->z + at, rkl->before + at);
}

static void rkl_next(struct stage *stage, unsigned local)
{
    struct rkl *rkl = stage->rkl;
    size_t at = local * rkl->block;
    const struct rkl_stage next = rkl_stage(rkl->s[stage->turn], rkl->j);
    struct stage_tile_work own;
    rkl_rates(stage, local, TERM_DIFFUSION, &own);
    rkl_go_on(rkl->block, &next, rkl_step(stage), rkl->M0 + at, stage->work->rates, rkl->z + at, rkl->before + at);
}

/* Y = u + c (u' - u) + z */
static BULLA_KERNEL void rkl_add(size_t n, double c, const double *restrict u, const double *restrict made,
                                 const double *restrict z, double *restrict Y)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double a = made[i], b = u[i];
        Y[i] = (b + c * (a - b)) + z[i];
    }
}

/* Primitives of what stands at c, for the next stage. */
static void rkl_show(struct stage *stage, double c)
{
    const struct level *level = stage->level;
    const struct rkl *rkl = stage->rkl;
    double *Y = stage->work->u_star;
    size_t n = stage->mesh->n_cell;
    for (unsigned local = 0; local < level->n_local; local++) {
        rkl_add(rkl->block, c, level->u_old[local], level->u_new[local], rkl->z + local * rkl->block, Y);
        elastic_settle(stage->model, n, n, Y);
        mix_pressure_sum(&stage->effort, mix_primitives(stage->model, n, n, Y, level->w[local]));
    }
}

/* What the integrator's stage has made: u' + z; of all but the last also its primitives, judged. */
static void rkl_close(struct stage *stage)
{
    const struct level *level = stage->level;
    const struct rkl *rkl = stage->rkl;
    bool last = stage->turn + 1 == stage->tableau->n;
    for (unsigned local = 0; local < level->n_local; local++) {
        double *u = level->u_new[local], *w = level->w[local];
        row_add(rkl->block, rkl->z + local * rkl->block, u);
        if (last) continue;
        verdict_hold(stage, local, w);
        operate_tile(stage, local, u, w);
        verdict_judge(stage, local, stage->turn, level->u_old[local], u, w);
        census_turn(&stage->census.tiles[local]);
    }
}

void rkl_take(struct stage *stage)
{
    struct rkl *rkl = stage->rkl;
    int s = rkl->s[stage->turn];
    double step = stage->tableau->stage[stage->turn].step;
    stage_tiles(stage, rkl_first);
    for (rkl->j = 2; rkl->j <= s; rkl->j++) {
        double c = rkl_stage(s, rkl->j - 1).at, *z = rkl->z;
        rkl_show(stage, c);
        stage->at = c * step;
        stage_exchange_start(stage);
        stage_tiles(stage, rkl_next);
        rkl->z = rkl->before;
        rkl->before = z;
    }
    rkl_close(stage);
    cost_lap(&stage->work->cost, COST_UPDATE);
}
