/* flow.c - see flow.h. */
#include "solve/flow.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "levels/restrict.h"
#include "phys/elastic.h"
#include "phys/mix.h"
#include "phys/row.h"
#include "phys/warm.h"
#include "solve/regrid.h"
#include "solve/rkl.h"
#include "solve/stage_exchange.h"
#include "solve/verdict.h"

#include <math.h>
#include <string.h>

/* How often a flow that fails is halved. */
enum { FLOW_HALVES = 6 };

/* Where the middle of a flow is, as a part of it, or the next stage. */
#define FLOW_MIDDLE 0.4

/* Most z of exp(-z), by which a flow changes: RKL2 is off by z^3/18, 0.4 %. The mean rates of the whole and of its part
 * c differ by z (1 - c)/2 of themselves. */
#define FLOW_BEND 0.4

/* Most parts that a flow is taken in for that. */
enum { FLOW_PARTS = 16 };

/* Changes below this part of what there is are not looked at. */
#define FLOW_FAINT 1e-9

/* One flow. */
struct flow {
    struct state *state;
    double t, tau;
    int s; /* stages */
};

/* Explicit steps of the fastest cell of all levels in a time. */
static double flow_steps(const struct state *state, double tau)
{
    double most = 0.0;
    for (int l = 0; l < state->mesh->n_level; l++) {
        double own = rkl_steps(state->stages[l], tau);
        if (own > most) most = own;
    }
    return most;
}

bool flow_binds(const struct state *state, double dt)
{
    const struct scene *scene = state->scene;
    if (scene->scheme.diffusion != SCENE_DIFFUSION_RKL2 || !rkl_flows(scene)) return false;
    for (int l = 0; l < state->mesh->n_level; l++) {
        double own = scene->mesh.subcycle ? ldexp(dt, -l) : dt;
        if (rkl_stages(rkl_steps(state->stages[l], own)) > 0) return true;
    }
    return false;
}

/* Rates of what diffuses in a tile. Fields that its path leaves alone have none. */
static void flow_rates(struct stage *stage, unsigned local)
{
    struct work *work = stage->work;
    size_t n = stage->mesh->n_cell;
    const struct model *path = stage->census.tiles[local].path = census_choose(&stage->census, local);
    struct stage_tile_work own;
    if (path->kapila) mix_stiffness_everywhere(path, n, n, stage->level->w[local], work->rho_c2);
    stage_rates(stage, local, TERM_DIFFUSION, rkl_bears(stage->rkl->s[0]) * stage->dt, true, &own);
    for (unsigned q = 0, active = 0; q < stage->model->n_field; q++) {
        if (active < path->n_active && path->active[active] == q) active++;
        else memset(work->rates + q * n, 0, n * sizeof *work->rates);
    }
}

/* Momentum and energy of z_j, in the middle. */
static void flow_keep(struct stage *stage, unsigned local)
{
    struct rkl *rkl = stage->rkl;
    size_t rows = rkl_half(stage);
    const double *z = rkl->z + local * rkl->block + stage->model->i_u * stage->mesh->n_cell;
    memcpy(rkl->half + local * rows, z, rows * sizeof *rkl->half);
}

/* What a stage makes of a tile: z_1 and M(u), or z_j. Corrections follow. */
static void flow_tile(struct stage *stage, unsigned local)
{
    struct rkl *rkl = stage->rkl;
    size_t at = local * rkl->block;
    const struct rkl_stage now = rkl_stage(rkl->s[0], rkl->j);
    double *M0 = rkl->M0 + at, *z = rkl->z + at, *before = rkl->before + at;
    flow_rates(stage, local);
    if (rkl->j > 1) {
        rkl_go_on(rkl->block, &now, stage->dt, M0, stage->work->rates, z, before);
        return;
    }
    memcpy(M0, stage->work->rates, rkl->block * sizeof *M0);
    rkl_begin(rkl->block, stage->dt * now.mu_tilde, M0, z, before);
}

/* What a level shows the next finer one. */
static void flow_down(struct stage *coarse, struct stage *fine)
{
    struct work *work = coarse->work;
    prolong_strips(work->prolong, coarse->mesh, coarse->l, coarse->bound, 0);
    around_finer(work->around, coarse->l, coarse->bound, 0);
    curve_finer(work->curve, coarse->l, 0);
    link_down(fine->level->link);
    around_down(work->around, fine->l);
    curve_down(work->curve, fine->l);
    census_receive(&fine->census); /* as of now: paths of the finer level hang on it */
}

static void flow_level(const struct flow *flow, int l, int j)
{
    struct stage *stage = flow->state->stages[l];
    struct rkl *rkl = stage->rkl;
    stage->t = flow->t;
    stage->dt = flow->tau;
    stage->from = stage->part = 0.0; /* ghosts are of this very time */
    stage->at = j > 1 ? rkl_stage(flow->s, j - 1).at : 0.0;
    rkl->s[0] = flow->s;
    rkl->j = j;
    reflux_weigh(stage->reflux, 1.0, true);
    stage_exchange_start(stage);
    stage_tiles(stage, flow_tile);
    if (l + 1 < flow->state->mesh->n_level) flow_down(stage, flow->state->stages[l + 1]);
    if (j == 1) return;
    double *z = rkl->z;
    rkl->z = rkl->before;
    rkl->before = z;
}

/* Momentum and energy of a tile get what the fluxes of the finer level change in its rates. */
static void flow_correct_tile(struct stage *stage, unsigned local, double *delta)
{
    const struct model *model = stage->model;
    struct rkl *rkl = stage->rkl;
    size_t n_cell = stage->mesh->n_cell, at = local * rkl->block;
    double part = stage->dt * rkl_stage(rkl->s[0], rkl->j).mu_tilde;
    reflux_delta(stage->reflux, local, 1.0, delta);
    for (size_t i = model->i_u * n_cell; i < (model->i_E + 1) * n_cell; i++) {
        rkl->z[at + i] += part * delta[i];
        if (rkl->j == 1) rkl->M0[at + i] += delta[i];
    }
}

static void flow_correct(struct stage *coarse, struct stage *fine)
{
    const struct link *link = fine->level->link;
    if (coarse->model->scene->mesh.reflux == SCENE_REFLUX_OFF) return;
    double *delta = mem_new(coarse->rkl->block, sizeof *delta);
    reflux_clear(coarse->reflux);
    reflux_commit(fine->reflux, 1.0);
    link_up(fine->level->link);
    for (unsigned local = 0; local < coarse->level->n_local; local++)
        if (link->source_from[local] < link->source_from[local + 1]) flow_correct_tile(coarse, local, delta);
    mem_free(delta);
}

/* Fractions from the heat of the materials, which stands in their rows of z. */
static void flow_warm(const struct stage *stage, unsigned local)
{
    const struct model *model = stage->model;
    const struct level *level = stage->level;
    const double *heat = stage->rkl->z + local * stage->rkl->block + model->i_alpha * stage->mesh->n_cell;
    size_t n = stage->mesh->n_cell, p = model->i_E * n;
    double *w = stage->work->u_star;
    if (!model->kapila || !stage->census.tiles[local].path->n_alpha) return;
    memcpy(w + p, level->w[local] + p, n * sizeof *w); /* where an iteration starts */
    mix_primitives(model, n, n, level->u_new[local], w);
    warm_mix(model, n, n, w, heat, level->u_old[local]);
}

/* u_old = u + z of a tile. */
static void flow_add_tile(const struct stage *stage, unsigned local)
{
    const struct rkl *rkl = stage->rkl;
    size_t heat = stage->model->n_alpha * stage->mesh->n_cell; /* the first rows */
    double *u = stage->level->u_old[local];
    memcpy(u, stage->level->u_new[local], rkl->block * sizeof *u);
    row_add(rkl->block - heat, rkl->z + local * rkl->block + heat, u + heat);
    flow_warm(stage, local);
}

/* u_old = u + z, cells under finer ones their averages (of all: no tile sleeps). */
static void flow_add(const struct flow *flow)
{
    const struct mesh *mesh = flow->state->mesh;
    for (int l = mesh->n_level - 1; l >= 0; l--) {
        const struct stage *stage = flow->state->stages[l];
        for (unsigned local = 0; local < stage->level->n_local; local++) flow_add_tile(stage, local);
        if (l + 1 == mesh->n_level) continue;
        restrict_averages(mesh, l + 1, 0);
        link_up(mesh->levels[l + 1].link);
        restrict_take(mesh, l + 1, 0);
    }
}

/* Primitives of all levels; averages of stretches are none yet. */
static void flow_show(const struct flow *flow)
{
    for (int l = 0; l < flow->state->mesh->n_level; l++) {
        struct stage *stage = flow->state->stages[l];
        size_t n = stage->mesh->n_cell;
        for (unsigned local = 0; local < stage->level->n_local; local++) {
            double *u = stage->level->u_old[local];
            if (stage_tile(stage, local)->covered) elastic_settle(stage->model, n, n, u);
            mix_pressure_sum(&stage->effort, mix_primitives(stage->model, n, n, u, stage->level->w[local]));
        }
    }
}

static void flow_open(const struct flow *flow)
{
    for (int l = 0; l < flow->state->mesh->n_level; l++) {
        struct stage *stage = flow->state->stages[l];
        guard_clear(stage->guard);
        guard_attempt(stage->guard);
        for (unsigned local = 0; local < stage->level->n_local; local++)
            memcpy(stage->level->u_new[local], stage->level->u_old[local], stage->rkl->block * sizeof *stage->rkl->z);
    }
}

/* Judges what the flow has made; returns the number of inadmissible cells of the rank that has most. */
static double flow_close(const struct flow *flow)
{
    double bad = 0.0;
    for (int l = 0; l < flow->state->mesh->n_level; l++) {
        struct stage *stage = flow->state->stages[l];
        size_t n = stage->mesh->n_cell;
        for (unsigned local = 0; local < stage->level->n_local; local++) {
            if (stage_tile(stage, local)->covered) elastic_settle(stage->model, n, n, stage->level->u_old[local]);
            verdict_touch(stage, local);
        }
        verdict_survey(stage);
        bad += (double)guard_bad(stage->guard);
    }
    comm_max(&bad, 1);
    return bad;
}

static void flow_undo(const struct flow *flow)
{
    for (int l = 0; l < flow->state->mesh->n_level; l++) {
        struct stage *stage = flow->state->stages[l];
        for (unsigned local = 0; local < stage->level->n_local; local++)
            memcpy(stage->level->u_old[local], stage->level->u_new[local], stage->rkl->block * sizeof *stage->rkl->z);
        verdict_reset(stage);
    }
}

/* The words of the first rank and level that found a bad cell. */
static int flow_give_up(const struct flow *flow)
{
    int code = STATUS_OK;
    for (int l = 0; l < flow->state->mesh->n_level && !code; l++) {
        const char *cause = flow->state->stages[l]->guard->cause;
        if (cause[0])
            code = status_fail(STATUS_RUN, "step %ld at t = %.9g s: what diffuses cannot go through %.3g s: %s",
                               flow->state->step + 1, flow->t, flow->tau, cause);
    }
    return comm_agree(code);
}

/* The stage in the middle of a flow. */
static int flow_middle(int s)
{
    int j = 2;
    while (j + 1 < s && rkl_stage(s, j).at < FLOW_MIDDLE) j++;
    return j;
}

/* What momentum and energy have changed by in a flow, what they would have at the pace of its first part, and what
 * there is. */
struct flow_bend {
    double change[2], bend[2], size[2];
};

static BULLA_KERNEL void flow_bent(size_t n, double per, const double *restrict z, const double *restrict half,
                                   double *restrict bend)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) bend[i] = fabs(z[i] - per * half[i]);
}

static BULLA_KERNEL void flow_sizes(size_t n, const double *restrict a, double *restrict size)
{
#pragma omp simd
    for (size_t i = 0; i < n; i++) size[i] = fabs(a[i]);
}

static void flow_most(size_t n, const double *row, double *most)
{
    double own = row_most(n, row);
    if (own > *most) *most = own;
}

static void flow_bend_tile(const struct stage *stage, unsigned local, double per, struct flow_bend *most)
{
    const struct rkl *rkl = stage->rkl;
    size_t n = stage->mesh->n_cell, from = stage->model->i_u * n;
    const double *z = rkl->z + local * rkl->block + from, *half = rkl->half + local * rkl_half(stage);
    const double *u = stage->level->u_new[local] + from;
    double *row = stage->work->rates;
    for (unsigned d = 0; d <= stage->model->n_velocity; d++, z += n, half += n, u += n) {
        int energy = d == stage->model->n_velocity;
        flow_bent(n, per, z, half, row);
        flow_most(n, row, &most->bend[energy]);
        flow_sizes(n, z, row);
        flow_most(n, row, &most->change[energy]);
        flow_sizes(n, u, row);
        flow_most(n, row, &most->size[energy]);
    }
}

/* In how many parts the flow that was taken should be. Tiles under finer ones do not count. */
static int flow_parts(const struct flow *flow)
{
    double c = rkl_stage(flow->s, flow_middle(flow->s)).at, parts = 1.0;
    struct flow_bend most = {0};
    for (int l = 0; l < flow->state->mesh->n_level; l++) {
        const struct stage *stage = flow->state->stages[l];
        for (unsigned local = 0; local < stage->level->n_local; local++)
            if (!stage_tile(stage, local)->covered) flow_bend_tile(stage, local, 1.0 / c, &most);
    }
    comm_max(most.change, sizeof most / sizeof *most.change);
    for (int i = 0; i < 2; i++) {
        double own = 2.0 / (1.0 - c) * most.bend[i] / (FLOW_BEND * most.change[i]);
        if (most.change[i] > FLOW_FAINT * most.size[i] && own > parts) parts = own;
    }
    return parts < FLOW_PARTS ? (int)ceil(parts) : FLOW_PARTS;
}

static void flow_keep_all(const struct flow *flow)
{
    for (int l = 0; l < flow->state->mesh->n_level; l++)
        for (unsigned local = 0; local < flow->state->stages[l]->level->n_local; local++)
            flow_keep(flow->state->stages[l], local);
}

/* One flow; returns what flow_close does. */
static double flow_once(const struct flow *flow)
{
    int n_level = flow->state->mesh->n_level, middle = flow_middle(flow->s);
    flow_open(flow);
    for (int j = 1; j <= flow->s; j++) {
        for (int l = 0; l < n_level; l++) flow_level(flow, l, j);
        for (int l = n_level - 2; l >= 0; l--) flow_correct(flow->state->stages[l], flow->state->stages[l + 1]);
        if (j == middle) flow_keep_all(flow);
        flow_add(flow);
        if (j < flow->s) flow_show(flow);
    }
    return flow_close(flow);
}

static int flow_through(struct state *state, double t, double tau, int halves, int *parts);

static int flow_divided(struct state *state, double t, double tau, int n, int halves, int *parts)
{
    for (int i = 0; i < n; i++) TRY(flow_through(state, t + i * tau / n, tau / n, halves, parts));
    return STATUS_OK;
}

/* A flow, in halves if it must be; one that asks for more than the most stages is one of them. *parts 0: it is looked
 * whether it should be in more than one. */
static int flow_through(struct state *state, double t, double tau, int halves, int *parts)
{
    double steps = flow_steps(state, tau);
    struct flow flow = {state, t, tau, rkl_stages(steps)};
    if (steps * rkl_relief() <= 1.0 || !isfinite(steps)) { /* the guard sees what is not a number */
        if (!flow.s) flow.s = 3;
        if (flow_once(&flow) == 0.0) {
            if (*parts) return STATUS_OK;
            *parts = flow_parts(&flow);
            if (*parts == 1) return STATUS_OK;
            flow_undo(&flow);
            return flow_divided(state, t, tau, *parts, halves, parts);
        }
        if (halves == FLOW_HALVES) return flow_give_up(&flow);
        halves++;
        flow_undo(&flow);
    }
    return flow_divided(state, t, tau, 2, halves, parts);
}

int flow_take(struct state *state, double t, double tau, int *parts)
{
    int status = flow_divided(state, t, tau, *parts ? *parts : 1, 0, parts);
    for (int l = 0; l < state->mesh->n_level; l++) {
        guard_clear(state->stages[l]->guard);
        state->stages[l]->rkl->s[0] = 0; /* the integrator's own stages take none */
    }
    if (!status) regrid_signals(state);
    return status;
}
