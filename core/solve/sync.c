/* sync.c - see sync.h. */
#include "solve/sync.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "levels/restrict.h"
#include "levels/spread.h"
#include "mesh/halo.h"
#include "phys/elastic.h"
#include "solve/verdict.h"
#include "solve/wake.h"

#include <math.h>
#include <string.h>

/* How often refluxing of a tile is spread anew, with what went wrong the last time. */
enum { SYNC_ATTEMPTS = 5 };

/* A fraction this far out of its range is round-off. */
#define SYNC_TRACE 1e-15

/* What neither a coarse tile nor the finer cells beside it hold of a material they owe, up to this share of their
 * density: it counts as absent there until more of it comes, or its other phase pays (phys/phase.c). */
#define SYNC_DEBT 1e-4

void sync_down(struct stage *coarse, struct stage *fine)
{
    struct around *around = coarse->work->around;
    struct curve *curve = coarse->work->curve;
    coarse->bound->t = coarse->t + coarse->dt;
    curve_take(curve, coarse->l, coarse->level->w);
    halo_start(coarse->level->halo, coarse->level->w);
    around_start(around, coarse->l, coarse->bound);
    halo_finish(coarse->level->halo);
    around_finish(around, coarse->l, coarse->bound);
    prolong_strips(coarse->work->prolong, coarse->mesh, coarse->l, coarse->bound, 1);
    around_finer(around, coarse->l, coarse->bound, 1);
    curve_finer(curve, coarse->l, 1);
    link_down(fine->level->link);
    around_down(around, fine->l);
    curve_down(curve, fine->l);
    census_receive(&fine->census);
    reflux_clear(coarse->reflux);
}

/* Did a tile get averages of the finer level? */
static bool sync_averaged(const struct stage *stage, unsigned local)
{
    const struct tile *tile = stage_tile(stage, local);
    return tile->covered && !tile->sleeps;
}

/* Closes a tile whose fields were averaged or moved: averages of stretches are none yet. */
static void sync_touch(struct stage *stage, unsigned local)
{
    size_t n_cell = stage->mesh->n_cell;
    elastic_settle(stage->model, n_cell, n_cell, stage->level->u_old[local]);
    verdict_touch(stage, local);
}

/* Fractions back into [0, 1] and to sum 1 where refluxing has moved them. */
static long long sync_bound_fractions(const struct model *model, size_t n_cell, const double *delta, double *u)
{
    long long clipped = 0;
    for (size_t i = 0; i < n_cell; i++) {
        double sum = 0.0;
        bool moved = false, acted = false;
        for (unsigned l = 0; l < model->n_alpha; l++) {
            double *alpha = &u[l * n_cell + i];
            moved = moved || delta[l * n_cell + i] != 0.0;
            acted = acted || *alpha < 0.0 || *alpha > 1.0;
            *alpha = *alpha > 0.0 ? *alpha < 1.0 ? *alpha : 1.0 : 0.0;
            sum += *alpha;
        }
        if (!moved) continue;
        clipped += acted;
        for (unsigned l = 0; l < model->n_alpha; l++) u[l * n_cell + i] /= sum;
    }
    return clipped;
}

/* What refluxing one tile works on: blocks of [n_field][n_cell], and the troubles of spread.h. */
struct sync_work {
    double *before, *delta, *rest; /* the fields before it, what it adds, what belongs to the finer level */
    unsigned char *trouble;
    long long *spread; /* counts tiles that had any */
    bool rests;        /* some tile left a rest */
};

static struct sync_work sync_work_new(const struct stage *stage, long long *spread)
{
    size_t block = stage->model->n_field * stage->mesh->n_cell;
    struct sync_work work = {.before = mem_new(3 * block, sizeof *work.before), .spread = spread};
    work.delta = work.before + block;
    work.rest = work.delta + block;
    work.trouble = mem_new(stage->mesh->n_cell, sizeof *work.trouble);
    return work;
}

static void sync_work_free(struct sync_work *work)
{
    mem_free(work->before);
    mem_free(work->trouble);
}

static struct spread sync_spread(const struct stage *stage, unsigned local, const struct sync_work *work,
                                 struct metric *metric)
{
    const struct mesh *mesh = stage->mesh;
    if (mesh->beta) metric_of_tile(mesh, stage->level, stage_tile(stage, local), metric);
    return (struct spread){.model = stage->model,
                           .mesh = mesh,
                           .tile = stage_tile(stage, local),
                           .metric = metric,
                           .u = work->before,
                           .trouble = work->trouble};
}

/* Adds `delta` to a tile and closes it; returns the number of cells that cannot bear it. */
static long long sync_add(struct stage *stage, unsigned local, const struct sync_work *work)
{
    const struct model *model = stage->model;
    size_t n_cell = stage->mesh->n_cell;
    double *u = stage->level->u_old[local];
    stage->guard->last = false; /* sync_blame wants the marks, also behind the last attempt of a step */
    guard_clear(stage->guard);
    guard_attempt(stage->guard);
    for (size_t i = 0; i < model->n_field * n_cell; i++) u[i] = work->before[i] + work->delta[i];
    long long clipped = sync_bound_fractions(model, n_cell, work->delta, u);
    sync_touch(stage, local);
    if (guard_bad(stage->guard) == 0) stage->clipped += clipped;
    return guard_bad(stage->guard);
}

/* The same with masses that may be owed. */
static bool sync_owe(struct stage *stage, unsigned local, const struct sync_work *work)
{
    stage->guard->debt = SYNC_DEBT;
    bool bears = sync_add(stage, local, work) == 0;
    stage->guard->debt = GUARD_ROUND_OFF;
    return bears;
}

/* Fractions that refluxing would make negative have no place for it: what is clipped is missing in the pressure. */
static bool sync_expect_trouble(const struct stage *stage, const struct sync_work *work)
{
    size_t n_cell = stage->mesh->n_cell;
    bool any = false;
    memset(work->trouble, SPREAD_NONE, n_cell);
    for (unsigned l = 0; l < stage->model->n_alpha; l++)
        for (size_t i = 0; i < n_cell; i++) {
            double step = work->delta[l * n_cell + i], sum = work->before[l * n_cell + i] + step;
            if (step == 0.0 || (sum >= -SYNC_TRACE && sum <= 1.0 + SYNC_TRACE)) continue;
            work->trouble[i] = SPREAD_HALF;
            any = true;
        }
    return any;
}

/* Troubled cells keep half of what they can bear, those that are in trouble even so keep nothing. */
static void sync_blame(const struct stage *stage, unsigned local, unsigned char *trouble)
{
    const unsigned char *fresh = stage->guard->fresh[local];
    for (size_t i = 0; i < stage->mesh->n_cell; i++)
        if (fresh[i] && trouble[i] != SPREAD_ALL) trouble[i]++;
}

/* How much a face has to do with the rest of a cell beside it: the masses that it took and that are wanting; if none
 * is, the energy. */
static double sync_share(const struct stage *stage, const double *change, const double *rest)
{
    const struct model *model = stage->model;
    double share = 1e-30; /* where none did, all are alike */
    bool masses = false;
    for (unsigned q = model->i_m; q < model->i_u; q++) masses = masses || rest[q * stage->mesh->n_cell] < 0.0;
    for (unsigned q = masses ? model->i_m : model->i_E; q < (masses ? model->i_u : model->i_E + 1); q++) {
        double wanting = rest[q * stage->mesh->n_cell];
        if (wanting < 0.0 && change[q] < 0.0) share += change[q] / wanting;
    }
    return share;
}

/* The rest of each cell, times its volume, shared among the faces it lies at, into their strips (which are free between
 * steps). */
static void sync_write_rest(const struct stage *stage, unsigned local, const struct spread *spread,
                            const struct sync_work *work, bool any)
{
    const struct link *up = stage->reflux->up;
    const struct mesh *mesh = stage->mesh;
    double change[MODEL_FIELDS], *shares = mem_new(mesh->n_cell, sizeof *shares);
    for (int write = 0; write < 2; write++)
        for (unsigned s = up->source_from[local]; s < up->source_from[local + 1]; s++)
            for (size_t i = 0; i < up->face_cells; i++) {
                size_t cell = reflux_cell(mesh, &up->sources[s], i);
                double *strip = up->sources[s].strip[0] + i, share = 0.0;
                if (any) reflux_source(stage->reflux, s, i, spread->metric, stage->dt, change);
                if (any) share = sync_share(stage, change, work->rest + cell);
                if (!write) shares[cell] += share;
                for (unsigned q = 0; write && q < stage->model->n_field; q++)
                    strip[q * up->face_cells] = any ? spread_volume(spread, q, cell) * (share / shares[cell]) *
                                                          work->rest[q * mesh->n_cell + cell]
                                                    : 0.0;
            }
    mem_free(shares);
}

/* Refluxes a tile, with the troubles known so far; returns whether it can bear it. */
static bool sync_try(struct stage *stage, unsigned local, bool trouble, struct sync_work *work)
{
    struct metric metric;
    const struct spread spread = sync_spread(stage, local, work, &metric);
    bool any = false;
    if (trouble) {
        memset(work->rest, 0, stage->model->n_field * stage->mesh->n_cell * sizeof *work->rest);
        reflux_delta(stage->reflux, local, stage->dt, work->delta);
        any = spread_change(&spread, work->delta, work->rest);
    }
    if (sync_add(stage, local, work) > 0) return false;
    sync_write_rest(stage, local, &spread, work, any);
    work->rests = work->rests || any;
    return true;
}

/* One tile with coarse-fine faces; a NaN counts as what it is. */
static int sync_tile_faces(struct stage *stage, unsigned local, struct sync_work *work)
{
    memcpy(work->before, stage->level->u_old[local],
           stage->model->n_field * stage->mesh->n_cell * sizeof *work->before);
    if (stage->model->scene->mesh.reflux == SCENE_REFLUX_OFF) {
        sync_touch(stage, local);
        return STATUS_OK;
    }
    reflux_delta(stage->reflux, local, stage->dt, work->delta);
    bool trouble = sync_expect_trouble(stage, work);
    *work->spread += trouble;
    for (int attempt = 0; attempt < SYNC_ATTEMPTS; attempt++) {
        if (sync_try(stage, local, trouble, work)) return STATUS_OK;
        *work->spread += !trouble;
        trouble = true;
        sync_blame(stage, local, work->trouble);
    }
    return status_fail(STATUS_RUN, "at t = %.9g s the fluxes of the finer level cannot be taken over: %s",
                       stage->t + stage->dt, stage->guard->cause);
}

/* Local tiles that averages or refluxing have changed: those for which other ranks send something, or the others. */
static int sync_tiles(struct stage *stage, struct sync_work *work, bool wait)
{
    const struct link *link = stage->reflux->up;
    int status = STATUS_OK;
    for (unsigned tile = 0; tile < stage->level->n_local && !status; tile++) {
        if (link->waits[tile] != wait) continue;
        bool faces = link->source_from[tile] < link->source_from[tile + 1];
        guard_attempt(stage->guard);
        if (faces) status = sync_tile_faces(stage, tile, work);
        else if (sync_averaged(stage, tile)) sync_touch(stage, tile);
    }
    return status;
}

/* Adds what a coarse cell could not take to the fine cells beside it; i: its place in the face's patch. */
static bool sync_take_cell(const struct stage *fine, const struct spread *spread, const struct link_face *face,
                           size_t i, double *delta)
{
    const struct mesh *mesh = fine->mesh;
    size_t cells = fine->level->link->face_cells, n = (size_t)mesh->n[0], half = n / 2;
    int axis = face->face / 2, a = axis == 0, b = axis == 2 ? 1 : 2; /* the other axes */
    double amount[MODEL_FIELDS], any = 0.0, units = 1 << mesh->dim;
    if (mesh->beta) units = 1 << (mesh->dim - 1); /* a metric's volume holds that of the first axis */
    for (unsigned q = 0; q < fine->model->n_field; q++) {
        amount[q] = units / (1 << (mesh->dim - 1)) * face->strip[0][q * cells + i];
        any += fabs(amount[q]);
    }
    for (int child = 0; any > 0.0 && child < 1 << (mesh->dim - 1); child++) {
        size_t at[3] = {0};
        at[axis] = face->face % 2 ? n - 1 : 0;
        if (a < mesh->dim) at[a] = 2 * (i % half) + (size_t)(child & 1);
        if (b < mesh->dim) at[b] = 2 * (i / half) + (size_t)(child >> 1);
        spread_amount(spread, at[0] + n * (at[1] + (size_t)mesh->n[1] * at[2]), amount, delta);
    }
    return any > 0.0;
}

/* What the coarse cells around a fine tile could not take. */
static int sync_take_tile(struct stage *fine, unsigned local, const struct sync_work *work)
{
    size_t block = fine->model->n_field * fine->mesh->n_cell;
    struct metric metric;
    bool any = false;
    memcpy(work->before, fine->level->u_old[local], block * sizeof *work->before);
    memset(work->delta, 0, block * sizeof *work->delta);
    const struct spread spread = sync_spread(fine, local, work, &metric);
    for (int side = 0; side < 2 * fine->mesh->dim; side++) {
        const struct neighbour *neighbour = &fine->level->neighbours[local][side];
        if (neighbour->kind != NEIGHBOUR_COARSE) continue;
        for (size_t i = 0; i < fine->level->link->face_cells; i++)
            any = sync_take_cell(fine, &spread, &fine->level->link->faces[neighbour->index], i, work->delta) || any;
    }
    if (!any || sync_add(fine, local, work) == 0 || sync_owe(fine, local, work)) return STATUS_OK;
    return status_fail(STATUS_RUN, "at t = %.9g s the fluxes of the finer level cannot be given back: %s",
                       fine->t + fine->dt, fine->guard->cause);
}

static void sync_close(struct stage *stage)
{
    guard_clear(stage->guard);
    guard_attempt(stage->guard);
    verdict_survey(stage);
}

/* The finer level takes back what coarse cells could not give it; then the averages are made anew. */
static int sync_take(struct stage *coarse, struct stage *fine, struct sync_work *work)
{
    struct link *link = fine->level->link;
    int status = STATUS_OK;
    link_down(link);
    memset(work->trouble, SPREAD_NONE, fine->mesh->n_cell);
    for (unsigned tile = 0; tile < fine->level->n_local && !status; tile++) status = sync_take_tile(fine, tile, work);
    sync_close(fine);
    restrict_averages(coarse->mesh, fine->l, 0);
    link_up(link);
    restrict_take(coarse->mesh, fine->l, 0);
    for (unsigned tile = 0; tile < coarse->level->n_local; tile++)
        if (sync_averaged(coarse, tile)) sync_touch(coarse, tile);
    return status;
}

int sync_up(struct stage *coarse, struct stage *fine, long long *spread)
{
    struct sync_work work = sync_work_new(coarse, spread);
    struct link *link = fine->level->link;
    wake_leave(coarse);
    restrict_averages(coarse->mesh, fine->l, 0);
    link_up_start(link);
    int status = sync_tiles(coarse, &work, false);
    link_up_finish(link);
    restrict_take(coarse->mesh, fine->l, 0);
    if (!status) status = sync_tiles(coarse, &work, true);
    double found = status ? 2.0 : work.rests ? 1.0 : 0.0; /* one reduction where nothing happens */
    comm_max(&found, 1);
    if (found == 1.0) status = sync_take(coarse, fine, &work);
    sync_close(coarse);
    sync_work_free(&work);
    return found > 0.0 ? comm_agree(status) : STATUS_OK;
}
