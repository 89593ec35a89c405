/* regrid.c - see regrid.h.
 *
 * Every rank makes its piece of the new sets; where they differ from what is there, tiles go to their new owners and
 * all levels are replaced at once. Then they are filled, coarse before fine: new tiles find the final state they are
 * made from. */
#include "solve/regrid.h"

#include "base/comm.h"
#include "base/gather.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "mesh/carry.h"
#include "mesh/deal.h"
#include "mesh/halo.h"
#include "mesh/hand.h"
#include "mesh/nest.h"
#include "mesh/rigid.h"
#include "paint/paint.h"
#include "solve/adopt.h"
#include "solve/pace.h"
#include "solve/peak.h"
#include "solve/stage.h"
#include "solve/sync.h"
#include "solve/tag.h"
#include "solve/verdict.h"
#include "solve/wake.h"
#include "solve/normals.h"

#include <string.h>
#include <time.h>

/* How a born tile gets its state. */
enum regrid_origin { REGRID_PAINTED, REGRID_INTERPOLATED };

struct regrid {
    struct state *state;
    int base;
    bool root; /* level 0 gets other owners, too: those it has share the work badly */
    struct nest_keys wishes[MESH_LEVELS + 1];
    struct nest_set sets[MESH_LEVELS + 1]; /* this rank's pieces */
    long long n_tile[MESH_LEVELS + 1];     /* of the sets, on all ranks; level 0 as it is */
    long long before[MESH_LEVELS + 2];     /* alike, on the ranks below this one */
};

bool regrid_due(const struct state *state, int base)
{
    return base < state->mesh->most_level && state->level_steps[base] % state->scene->mesh.regrid_every == 0;
}

void regrid_signals(struct state *state)
{
    const struct mesh *mesh = state->mesh;
    double most[2 * MESH_LEVELS], *ahead = most + mesh->n_level;
    state->signal = 0.0;
    for (int l = 0; l < mesh->n_level; l++) {
        most[l] = state->stages[l]->signal;
        ahead[l] = verdict_ahead(state->stages[l], state->t);
    }
    comm_max(most, 2 * mesh->n_level);
    for (int l = 0; l < mesh->n_level; l++)
        state->signals[l] =
            (ahead[l] > PACE_EXCESS * most[l] ? ahead[l] : most[l]) + rigid_pace(mesh, &mesh->levels[l], state->t);
    double per_step = 1.0; /* steps of a level in one of level 0 */
    for (int l = 0; l < mesh->n_level; l++) {
        if (state->signals[l] / per_step > state->signal) state->signal = state->signals[l] / per_step;
        if (state->scene->mesh.subcycle) per_step *= 2.0;
    }
}

/* Tags a level and collects which tiles of the next one they ask for. */
static int regrid_tag(struct regrid *regrid, struct derive_moment *moment, int l)
{
    struct state *state = regrid->state;
    const struct mesh *mesh = state->mesh;
    const struct level *level = &mesh->levels[l];
    double **marks = mem_new(level->n_local + 1, sizeof *marks);
    double *all = mem_new(level->n_local * mesh->n_cell, sizeof *all);
    for (unsigned t = 0; t < level->n_local; t++) marks[t] = all + t * mesh->n_cell;
    int status = tag_level(moment, l, state->stages[l]->guard->halo, marks, state->tagged);
    for (unsigned t = 0; t < level->n_local && !status; t++)
        nest_wish(mesh, level, &level->tiles[level->first + t], marks[t], state->scene->mesh.buffer,
                  &regrid->wishes[l + 1]);
    mem_free(all);
    mem_free(marks);
    return comm_agree(status);
}

static int regrid_sets(struct regrid *regrid, int patience)
{
    const struct mesh *mesh = regrid->state->mesh;
    struct derive_moment moment = derive_moment(regrid->state->model, mesh, regrid->state->t);
    moment.base = regrid->base; /* ghosts of this level are those of a step that is under way */
    int count = 0;
    for (int l = regrid->base; l < mesh->most_level && l < mesh->n_level; l++) {
        TRY(regrid_tag(regrid, &moment, l));
        count++;
    }
    nest_join(mesh, regrid->base + 1, count, regrid->wishes + regrid->base + 1);
    nest_sets(mesh, regrid->base, regrid->wishes, patience, regrid->sets);
    return STATUS_OK;
}

static void regrid_free(struct regrid *regrid)
{
    for (int l = 0; l <= MESH_LEVELS; l++) {
        nest_keys_free(&regrid->wishes[l]);
        nest_keys_free_set(&regrid->sets[l]);
    }
}

/* Are all sets what the levels are? Then only the counts of unwanted tiles move on. */
static bool regrid_is_idle(struct regrid *regrid)
{
    struct mesh *mesh = regrid->state->mesh;
    long long sums[MESH_LEVELS + 2] = {mesh->levels[0].n_local}; /* the last one: pieces that differ */
    for (int l = regrid->base + 1; l <= mesh->most_level; l++) {
        sums[l] = regrid->sets[l].n;
        sums[MESH_LEVELS + 1] += !nest_same(mesh, l, &regrid->sets[l]);
    }
    gather_sums(sums, MESH_LEVELS + 2, regrid->before);
    memcpy(regrid->n_tile, sums, sizeof regrid->n_tile);
    if (sums[MESH_LEVELS + 1]) return false;
    for (int l = regrid->base + 1; l < mesh->n_level; l++) {
        struct tile *tiles = mesh->levels[l].tiles + mesh->levels[l].first;
        for (unsigned i = 0; i < regrid->sets[l].n; i++) tiles[i].unwanted = regrid->sets[l].tiles[i].unwanted;
    }
    return true;
}

/* Beside a solid all materials are computed, and its stretch with them. */
double regrid_cost(const struct stage *stage, unsigned local)
{
    const struct census_tile *tile = &stage->census.tiles[local];
    const struct model *model = stage->model;
    unsigned materials = 0, solid = 0;
    if (stage->level->tiles[stage->level->first + local].hidden) return 0.05;
    if (tile->still) return 0.2;
    for (unsigned present = tile->present; present; present &= present - 1) materials++;
    for (unsigned s = 0; s < model->n_solid; s++) solid |= tile->present >> model->solids[s].material & 1u;
    if (solid && materials > 1) materials = model->n_material;
    return (materials > 1 ? 1.2 * materials : 1.0) + (solid ? 1.5 : 0.0);
}

/* Costs of this rank's tiles of a level as it is, in their order. */
static double *regrid_costs(const struct stage *stage)
{
    double *own = mem_new(stage->level->n_local + 1, sizeof *own);
    for (unsigned t = 0; t < stage->level->n_local; t++) own[t] = regrid_cost(stage, t);
    return own;
}

/* Tells what this rank's tiles will cost, level by level: those up to `base` stay where they are; but level 0 is cut
 * anew if it is `base` itself and its cells under finer tiles, or at rest, leave some ranks idle. */
static void regrid_tell(const struct regrid *regrid, struct deal *deal)
{
    const struct state *state = regrid->state;
    const struct mesh *mesh = state->mesh;
    struct carry before[MESH_LEVELS + 1] = {0};
    double *costs[MESH_LEVELS] = {0}, *carried[MESH_LEVELS + 1] = {0};
    int highest = regrid->base;
    while (highest < mesh->most_level && regrid->n_tile[highest + 1]) highest++;
    for (int l = 0; l < mesh->n_level; l++) {
        const struct level *level = &mesh->levels[l];
        costs[l] = regrid_costs(state->stages[l]);
        before[l] = (struct carry){level->n_local, level->tiles + level->first, costs[l]};
    }
    carry_values(mesh, regrid->base, highest, regrid->sets, before, carried);
    for (int l = 0; l <= highest; l++) {
        if (l <= regrid->base) deal_add(deal, l, costs[l], before[l].n);
        else deal_add(deal, l, carried[l], regrid->sets[l].n);
    }
    for (int l = 0; l < MESH_LEVELS; l++) {
        mem_free(costs[l]);
        mem_free(carried[l]);
    }
}

/* The piece of level 0 as it is. */
static void regrid_take_root(struct regrid *regrid)
{
    const struct level *level = &regrid->state->mesh->levels[0];
    struct nest_set *set = &regrid->sets[0];
    *set = (struct nest_set){level->n_local, mem_new(level->n_local, sizeof *set->tiles)};
    if (set->n) memcpy(set->tiles, level->tiles + level->first, set->n * sizeof *set->tiles);
}

/* The new sets in the hands of their owners: of the levels from *ret_lowest to `highest`. */
static void regrid_deal(struct regrid *regrid, int highest, int *ret_lowest, struct mesh_set *ret_sets)
{
    const struct state *state = regrid->state;
    const struct mesh *mesh = state->mesh;
    struct deal deal = {.base = regrid->base, .subcycle = state->scene->mesh.subcycle};
    if (comm_size() > 1) { /* rank 0 owns all otherwise */
        regrid_tell(regrid, &deal);
        deal_cut(&deal);
        regrid->root = deal.root;
    }
    *ret_lowest = regrid->root ? 0 : regrid->base + 1;
    if (regrid->root) regrid_take_root(regrid);
    hand_sets(mesh, *ret_lowest, highest, regrid->sets, regrid->n_tile, regrid->before, &deal, ret_sets);
    deal_free(&deal);
}

/* Levels up to `base` and the new sets, against the case's limit. */
static bool regrid_affords(const struct regrid *regrid)
{
    struct state *state = regrid->state;
    const struct mesh *mesh = state->mesh;
    double tiles = 0.0, limit = state->scene->mesh.memory_limit;
    for (int l = 0; l <= regrid->base; l++) tiles += mesh->levels[l].n_tile;
    for (int l = regrid->base + 1; l <= mesh->most_level; l++) tiles += (double)regrid->n_tile[l];
    if (limit <= 0.0 || mesh_bytes(mesh, tiles) <= limit) return true;
    state->starved = tiles;
    return false;
}

int regrid_verdict(const struct state *state)
{
    if (state->starved <= 0.0) return STATUS_OK;
    return status_fail(
        STATUS_RUN,
        "at t = %.9g s refinement asks for %.0f tiles, %.4g GiB, but may take %.4g GiB (--max-memory, else what the "
        "machine has): allow more, or fewer levels, or a higher threshold",
        state->t, state->starved, mesh_bytes(state->mesh, state->starved) / 1073741824.0,
        state->scene->mesh.memory_limit / 1073741824.0);
}

static int regrid_paint(struct state *state, int l, const bool *born)
{
    const struct mesh *mesh = state->mesh;
    const struct level *level = &mesh->levels[l];
    int status = STATUS_OK;
    for (unsigned t = 0; t < level->n_local && !status; t++) {
        double *p = level->w[t] + state->model->i_E * mesh->n_cell;
        if (!born[level->first + t]) continue;
        status = paint_tile(state->model, mesh, level, &level->tiles[level->first + t], level->u_old[t]);
        for (size_t i = 0; i < mesh->n_cell; i++) p[i] = 1e5; /* where an iteration starts */
    }
    return comm_agree(status);
}

static void regrid_interpolate(struct state *state, int l, const bool *born)
{
    struct stage *coarse = state->stages[l - 1];
    halo_start(coarse->level->halo, coarse->level->w);
    halo_finish(coarse->level->halo);
    coarse->bound->t = state->t;
    state->counts.limited += prolong_tiles(state->work->prolong, state->mesh, l, coarse->bound, born);
}

/* Gives the tiles of a level that has been replaced their state. */
static int regrid_fill(struct regrid *regrid, int l, enum regrid_origin origin, const struct mesh_change *change)
{
    struct state *state = regrid->state;
    int status = STATUS_OK;
    if (l > 0 && origin == REGRID_PAINTED) status = regrid_paint(state, l, change->born);
    else if (l > 0) regrid_interpolate(state, l, change->born);
    if (l > 0) peak_down(state->mesh, l, change->born);
    if (!status) adopt_level(state->stages[l], change->from, change->born);
    return status;
}

static void regrid_drop(struct state *state, int l)
{
    stage_free(state->stages[l]);
    state->stages[l] = NULL;
    state->level_steps[l] = 0;
    state->signals[l] = 0.0;
}

static int regrid_apply(struct regrid *regrid, enum regrid_origin origin)
{
    struct state *state = regrid->state;
    struct mesh *mesh = state->mesh;
    struct mesh_set sets[MESH_LEVELS + 1];
    struct mesh_change changes[MESH_LEVELS + 1];
    int finest = regrid->base, before = mesh->n_level - 1, lowest, status = STATUS_OK;
    while (finest < mesh->most_level && regrid->n_tile[finest + 1]) finest++;
    int highest = finest > before ? finest : before;
    regrid_deal(regrid, highest, &lowest, sets);
    peak_up(mesh, &state->scene->output, regrid->base);
    for (int l = before + 1; l <= finest; l++) state->stages[l] = stage_new(state->model, mesh, l, state->work);
    mesh_replace(mesh, lowest, highest, sets, changes);
    for (int l = before; l > finest; l--) regrid_drop(state, l);
    for (int l = lowest; l <= finest && !status; l++) status = regrid_fill(regrid, l, origin, &changes[l]);
    for (int l = lowest; l <= highest; l++) mesh_change_free(&changes[l]);
    if (status) return status;
    for (int l = regrid->base; l < mesh->n_level; l++) adopt_level(state->stages[l], NULL, NULL);
    TRY(nest_check(mesh));
    state->counts.regrids++;
    return STATUS_OK;
}

int regrid_levels(struct state *state, int base)
{
    struct regrid regrid = {.state = state, .base = base};
    clock_t begin = clock();
    wake_levels(state, base);
    int status = regrid_sets(&regrid, state->scene->mesh.patience);
    if (!status && !regrid_is_idle(&regrid) && regrid_affords(&regrid))
        status = regrid_apply(&regrid, REGRID_INTERPOLATED);
    regrid_free(&regrid);
    state->counts.regrid_seconds += (double)(clock() - begin) / CLOCKS_PER_SEC;
    return status;
}

/* Averages the painted levels onto those below. */
static int regrid_settle(struct state *state)
{
    for (int l = state->mesh->n_level - 1; l > 0; l--) {
        wake_above(state->stages, l - 1);
        TRY(sync_up(state->stages[l - 1], state->stages[l], &state->counts.spread));
    }
    return STATUS_OK;
}

int regrid_initial(struct state *state)
{
    bool idle = state->mesh->most_level == 0;
    int status = STATUS_OK;
    for (int pass = 0; !idle && !status && pass <= 2 * MESH_LEVELS; pass++) {
        struct regrid regrid = {.state = state};
        status = regrid_sets(&regrid, 1);
        idle = !status && regrid_is_idle(&regrid);
        if (!status && !idle && !regrid_affords(&regrid)) status = regrid_verdict(state);
        if (!status && !idle) status = regrid_apply(&regrid, REGRID_PAINTED);
        regrid_free(&regrid);
    }
    state->counts.regrids = 0;
    for (int l = 1; l < state->mesh->n_level && !status; l++) {
        curve_take(state->work->curve, l - 1, state->mesh->levels[l - 1].w); /* of tiles that have changed hands */
        curve_finer(state->work->curve, l - 1, 0);
        curve_down(state->work->curve, l);
        curve_take(state->work->curve, l, state->mesh->levels[l].u_old);
        status = comm_agree(verdict_start(state->stages[l], normals_count(state)));
    }
    if (!status) status = normals_begin(state);
    return status ? status : regrid_settle(state);
}

void regrid_stages(struct state *state)
{
    for (int l = 0; l < state->mesh->n_level; l++) {
        if (!state->stages[l]) state->stages[l] = stage_new(state->model, state->mesh, l, state->work);
        adopt_level(state->stages[l], NULL, NULL);
    }
}
