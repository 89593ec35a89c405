/* advance.c - a step: run the plan on a level, judge, climb the guard's ladder where needed, then take the finer
 * levels through the same time (Berger & Oliger 1984, J. Comput. Phys. 53, 484).
 *
 * u_old of a level is never touched before its step is accepted, and finer levels start only then, so any attempt
 * can be repeated. A finer level that cannot take its step takes two of half the size: its ghosts are
 * linear in time and its registers are sums over time, so that the coarser level does not notice. One reduction
 * per attempt carries the judgement and the signal speed. */
#include "solve/advance.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "mesh/rigid.h"
#include "phys/mix.h"
#include "solve/beyond.h"
#include "solve/blame.h"
#include "solve/evaporate.h"
#include "solve/flow.h"
#include "solve/pace.h"
#include "solve/peak.h"
#include "solve/plan.h"
#include "solve/regrid.h"
#include "solve/rkl.h"
#include "solve/sync.h"
#include "solve/verdict.h"
#include "solve/wake.h"

#include <stdio.h>
#include <string.h>

/* The least part of a coarser step: sums of such parts still move. */
#define ADVANCE_PART 0x1p-40

double advance_dt(const struct state *state)
{
    const struct scene *scene = state->scene;
    if (scene->scheme.dt_fixed > 0.0) return scene->scheme.dt_fixed * state->dt_shrink;
    return state->dt_shrink * scene->scheme.cfl / state->signal;
}

/* Runs the plan once. */
static void advance_run(struct stage *stage)
{
    const struct plan *plan = plan_of(stage->tableau);
    rkl_plan(stage);
    for (int i = 0; i < plan->n; i++) {
        stage->turn = plan->step[i].turn;
        stage->at = stage->tableau->stage[stage->turn].at;
        plan->step[i].run(stage);
    }
}

/* Runs it as an attempt; returns the number of inadmissible cells of all ranks (in the first stage
 * that has any) and, through *ret_signal, the signal speed of the new state; *ret_blind: a script of a boundary or
 * of a term failed on some rank. */
static double advance_attempt(struct stage *stage, double *ret_signal, bool *ret_blind)
{
    const char *words, *place;
    int n = stage->tableau->n, first = 0;
    double found[TABLEAU_STAGES + 2];
    guard_attempt(stage->guard);
    stage->clipped = 0; /* what an attempt that fails has clipped depends on where it stops */
    evaporate_forget(stage);
    stage->fault.status = STATUS_OK;
    advance_run(stage);
    for (int s = 0; s < n; s++) found[s] = (double)stage->guard->bad[s];
    found[n] = stage->signal;
    bool blind = stage->bound->status || stage->fault.status || terms_failure(stage->work->own, &words, &place);
    found[n + 1] = blind ? 1.0 : 0.0;
    comm_max(found, n + 2);
    cost_lap(&stage->work->cost, COST_EXCHANGE);
    *ret_signal = found[n];
    *ret_blind = found[n + 1] > 0.0;
    while (first + 1 < n && found[first] == 0.0) first++;
    if (found[first] > 0.0) guard_settle(stage->guard, first);
    return found[first];
}

/* Attempts with the given dt: plain, then with more and more marked cells. 0, or the last count. What a script does not
 * give is in vain tried again. */
static double advance_rounds(struct state *state, struct stage *stage, double *ret_signal, bool *ret_blind)
{
    bool strict = state->scene->scheme.guard == SCENE_GUARD_STRICT;
    stage->cells = stage->carried = 0;
    stage->effort = (struct mix_effort){0};
    stage->steps = state->level_steps[stage->l];
    guard_clear(stage->guard);
    for (int round = 0;; round++) {
        stage->guard->last = strict || round == GUARD_ROUNDS;
        double bad = advance_attempt(stage, ret_signal, ret_blind);
        if (bad == 0.0 || strict || round == GUARD_ROUNDS || *ret_blind) return bad;
        state->counts.fallback += guard_bad(stage->guard);
        stage->guard->masked = true;
        verdict_reset(stage);
    }
}

static void advance_accept(struct state *state, struct stage *stage, double signal)
{
    mesh_swap(stage->level);
    reflux_commit(stage->reflux, stage->dt);
    state->signals[stage->l] = signal + rigid_pace(state->mesh, stage->level, stage->t + stage->dt);
    state->level_steps[stage->l]++;
    state->dt_last = stage->dt;
    state->counts.cells += stage->cells;
    state->counts.carried += stage->carried;
    state->counts.clipped += stage->clipped;
    mix_pressure_sum(&state->counts.closures, stage->effort);
    state->counts.relaxed += stage->guard->relaxed;
    evaporate_accept(state, stage);
    stage->clipped = 0;
}

static void advance_stamp(const struct state *state, const struct stage *stage, struct blame *blame)
{
    int s = blame->facts.stage;
    double at = s == BLAME_FAILED_SYNC ? 1.0 : s < stage->tableau->n ? stage->tableau->stage[s].at : 0.0;
    blame->facts.integrator = tableau_number(stage->tableau);
    blame->facts.step = state->step + 1;
    blame->facts.t = stage->t;
    blame->facts.dt = stage->dt;
    blame->facts.at = stage->t + at * stage->dt;
}

/* Repeats the last attempt, which failed, with an eye on its first bad cell: an attempt changes nothing that another
 * one would see. A closure that is iterated may come out differently: then there is nothing to keep. */
static void advance_watch(const struct state *state, struct stage *stage)
{
    struct guard_place was = stage->guard->found;
    bool mine = comm_first(stage->guard->cause[0]) == comm_rank();
    if (rkl_acts(stage) || stage->work->part != TERM_WHOLE)
        return; /* a dump has the integrator's stages with all terms */
    if (mine) {
        stage->blame = blame_new(stage->model, stage->guard);
        advance_stamp(state, stage, stage->blame);
    }
    guard_attempt(stage->guard);
    advance_run(stage);
    verdict_reset(stage);
    const struct guard_place *is = &stage->guard->found;
    if (!mine) return;
    stage->blame->turn = -1;
    bool same = stage->guard->cause[0] && was.local == is->local && was.cell == is->cell && was.stage == is->stage;
    if (same && stage->blame->whole) return;
    blame_free(stage->blame);
    stage->blame = NULL;
}

/* The message of the first rank that found a bad cell, on all ranks; the blame stays on that rank. */
static int advance_give_up(const struct state *state, struct stage *stage)
{
    char cause[sizeof stage->guard->cause];
    memcpy(cause, stage->guard->cause, sizeof cause);
    const char *tried = state->scene->scheme.guard == SCENE_GUARD_STRICT
                            ? "guard: strict allows no repair"
                            : "first-order fluxes and smaller steps did not help";
    char face[BLAME_NAME + 64] = "";
    int code = STATUS_OK;
    advance_watch(state, stage);
    if (stage->blame) blame_say_face(stage->blame, stage->model, sizeof face, face);
    if (cause[0])
        code = status_fail(STATUS_RUN, "step %ld at t = %.9g s cannot be completed: %s%s (%s; dt = %.3g s)",
                           state->step + 1, stage->t, cause, face, tried, stage->dt);
    return comm_agree(code);
}

/* The cell, of a tile of this rank, that asks for too short a step: what the tile holds. */
static void advance_blame_pace(const struct state *state, struct stage *stage, const struct guard_place *place)
{
    const struct model *path = model_numbered(stage->model, place->pure);
    size_t n_cell = stage->mesh->n_cell, block = stage->model->n_field * n_cell;
    const double *u = stage->level->u_old[place->local], *w = stage->level->w[place->local];
    double *kept = mem_new(2 * block, sizeof *kept);
    memcpy(kept, u, block * sizeof *u);
    memcpy(kept + block, w, block * sizeof *w);
    mix_primitives(path, n_cell, n_cell, u, kept + block);
    stage->guard->found = *place;
    blame_free(stage->blame); /* of a step that was tried before */
    stage->blame = blame_new(stage->model, stage->guard);
    advance_stamp(state, stage, stage->blame);
    blame_keep(stage->blame, stage->model, w, kept);
    mem_free(kept);
}

/* A step that is too short ends the run: the state is good, but it will not get anywhere. */
static int advance_too_slow(const struct state *state, int l, double t, double dt)
{
    struct guard_place place;
    struct stage *stage = pace_find(state, l, &place);
    double least = pace_least(state, l);
    char limit[96], repeated[96] = "";
    int code = STATUS_OK;
    if (state->scene->run.dt_least >= 0.0 && dt < least) snprintf(limit, sizeof limit, "below run.smallest-step");
    else if (dt < least)
        snprintf(limit, sizeof limit, "below %.3g of the longest so far", pace_least(state, 0) / state->dt_longest);
    else snprintf(limit, sizeof limit, "which t does not notice");
    if (state->dt_shrink < 1.0)
        snprintf(repeated, sizeof repeated, ", of which the start and steps that had to be repeated have left %.3g",
                 state->dt_shrink);
    if (stage) {
        stage->t = t;
        stage->dt = dt;
        advance_blame_pace(state, stage, &place);
        code = status_fail(STATUS_RUN, "step %ld at t = %.9g s: the time step has fallen to %.3g s, %s%s; %s",
                           state->step + 1, t, dt, limit, repeated, place.words);
    }
    return comm_agree(code);
}

/* What a script did not give, and where. */
static void advance_say_blind(const struct stage *stage, size_t room, char *ret_text)
{
    const struct tile *tile = &stage->level->tiles[stage->level->first + (unsigned)stage->blind / 3];
    const struct neighbour *sides = stage->level->neighbours[stage->blind / 3];
    int axis = stage->blind % 3;
    char name = "xyz"[axis];
    bool lower = sides[2 * axis].kind == NEIGHBOUR_BOUNDARY, upper = sides[2 * axis + 1].kind == NEIGHBOUR_BOUNDARY;
    snprintf(ret_text, room, ", tile (%d, %d, %d), boundary %c%s: %s", tile->at[0], tile->at[1], tile->at[2], name,
             lower && upper ? "- or +"
             : lower        ? "-"
                            : "+",
             stage->bound->blind);
}

/* A script of a boundary or of a source failed on some rank: which step asked it, for what, and where. The cells that
 * met its NaN are kept as those of any failed step. */
static int advance_script(const struct state *state, struct stage *stage)
{
    int status = stage->bound->status;
    char place[320] = "";
    const char *message = stage->bound->message, *inside = "";
    if (status && stage->blind >= 0) advance_say_blind(stage, sizeof place, place);
    if (!status && (status = terms_failure(stage->work->own, &message, &inside)))
        snprintf(place, sizeof place, ", %s", inside);
    char fault[sizeof stage->fault.message]; /* the repetition overwrites it */
    snprintf(fault, sizeof fault, "%s", stage->fault.message);
    if (!status && (status = stage->fault.status)) message = fault;
    guard_clear(stage->guard);
    stage->guard->last = true; /* no marks, which would make the repetition another attempt */
    advance_watch(state, stage);
    if (status)
        status_fail(status, "%s; step %ld at t = %.9g s, level %d%s", message, state->step + 1, stage->t, stage->l,
                    place);
    return comm_agree(status);
}

/* The last of all tries is one explicit step. With first-order fluxes that leaves no cell less than nothing; stages
 * that start from u can, however short the step is: they take out of a cell what only the middle of the step has there.
 */
static void advance_choose(struct stage *stage, int retries)
{
    const struct scene *scene = stage->model->scene;
    const struct tableau *tableau = retries == GUARD_RETRIES ? tableau_numbered(TABLEAU_SINGLE) : tableau_of(scene);
    if (stage->tableau == tableau) return;
    stage->tableau = tableau;
    for (unsigned local = 0; local < stage->level->n_local; local++) stage->census.tiles[local].streak = 0;
}

/* One step of a level, from stage->t over stage->dt, after so many that failed: STATUS_OK, or a script's failure.
 * *ret_good: accepted. */
static int advance_once(struct state *state, struct stage *stage, int retries, bool *ret_good)
{
    advance_choose(stage, retries);
    cost_open(&state->work->cost, COST_STEP);
    double signal = 0.0;
    wake_leave(stage);
    bool blind = false, bad = advance_rounds(state, stage, &signal, &blind) > 0.0;
    *ret_good = !bad && !blind;
    if (*ret_good) advance_accept(state, stage, signal);
    else verdict_reset(stage);
    double seconds = cost_close(&state->work->cost, COST_STEP);
    if (seconds > 0.0) balance_note(&state->work->balance, stage, seconds);
    return blind ? advance_script(state, stage) : STATUS_OK;
}

/* After sync_up failed: the level whose guard has the words of the message holds the tile. */
static void advance_blame_sync(const struct state *state, struct stage *coarse, struct stage *fine)
{
    struct stage *stages[] = {coarse, fine};
    for (int i = 0; i < 2; i++) {
        struct stage *stage = stages[i];
        const char *words = stage->guard->found.words; /* survive the end of the synchronisation */
        bool mine = comm_first(words[0] && strstr(status_text(), words)) == comm_rank();
        if (!mine) continue;
        stage->guard->found.stage = BLAME_FAILED_SYNC;
        stage->blame = blame_new(stage->model, stage->guard);
        advance_stamp(state, stage, stage->blame);
        blame_keep(stage->blame, stage->model, stage->level->w[stage->blame->local], stage->guard->kept);
    }
}

static int advance_through(struct state *state, int l, double t, double dt);

/* The levels above l through the step that l has just taken. */
static int advance_finer(struct state *state, int l)
{
    if (l + 1 >= state->mesh->n_level) return STATUS_OK;
    struct stage *coarse = state->stages[l], *fine = state->stages[l + 1];
    struct cost *cost = &state->work->cost;
    cost_open(cost, COST_SYNC);
    sync_down(coarse, fine);
    cost_lap(cost, COST_LEVELS);
    cost_close(cost, COST_SYNC);
    TRY(advance_through(state, l + 1, coarse->t, coarse->dt));
    cost_open(cost, COST_SYNC);
    coarse->guard->found.words[0] = fine->guard->found.words[0] = '\0';
    wake_above(state->stages, l);
    int status = sync_up(coarse, fine, &state->counts.spread);
    cost_lap(cost, COST_LEVELS);
    cost_close(cost, COST_SYNC);
    if (status) advance_blame_sync(state, coarse, fine);
    state->counts.clipped += coarse->clipped;
    coarse->clipped = 0;
    return status;
}

/* After a step of level l that does not end the step of a coarser level which will regrid anyway. */
static int advance_regrid(struct state *state, int l, bool last)
{
    if (!regrid_due(state, l) || (last && l > 0 && regrid_due(state, l - 1))) return STATUS_OK;
    double t = state->t;
    state->t = state->stages[l]->t + state->stages[l]->dt; /* tags see the time of the level */
    int status = regrid_levels(state, l);
    state->t = t;
    return status;
}

/* The levels from l on have reached t, those below have not. */
static int advance_look(struct state *state, int l, double t)
{
    double whole = state->t;
    if (!state->look) return STATUS_OK;
    state->t = t;
    int status = state->look(state->look_data, state, l);
    state->t = whole;
    return status;
}

/* Level l through the time [t, t + dt] of a step of the coarser one. */
static int advance_through(struct state *state, int l, double t, double dt)
{
    struct stage *stage = state->stages[l];
    double done = 0.0, part = l > 0 && state->scene->mesh.subcycle ? 0.5 : 1.0;
    double most = PACE_EXCESS * state->scene->scheme.cfl;
    int retries = 0;
    while (done < 1.0) {
        bool good;
        stage->t = t + done * dt;
        while (state->scene->scheme.dt_fixed <= 0.0 && part * dt * state->signals[l] > most && part > ADVANCE_PART &&
               pace_allows(state, l, stage->t, part * dt))
            part *= 0.5;
        stage->dt = part * dt;
        stage->from = done;
        stage->part = part;
        if (!pace_allows(state, l, stage->t, stage->dt)) return advance_too_slow(state, l, stage->t, stage->dt);
        TRY(advance_once(state, stage, retries, &good));
        if (!good) {
            if (state->scene->scheme.guard == SCENE_GUARD_STRICT || ++retries > GUARD_RETRIES)
                return advance_give_up(state, stage);
            state->counts.retries++;
            part *= 0.5;
            continue;
        }
        done += part;
        TRY(advance_finer(state, l));
        peak_take(state, l, stage->t + stage->dt);
        TRY(advance_regrid(state, l, done >= 1.0));
        if (done < 1.0) TRY(advance_look(state, l, t + done * dt));
    }
    return STATUS_OK;
}

/* All levels have gone through dt. */
static void advance_count(struct state *state, double dt)
{
    state->t += dt;
    state->dt = dt;
    if (dt > state->dt_longest) state->dt_longest = dt;
    state->step++;
    state->whole = true;
    state->dt_shrink = state->dt_shrink * 1.1 < 1.0 ? state->dt_shrink * 1.1 : 1.0;
}

/* Level 0 has made its step: the others follow, then the mesh. */
static int advance_follow(struct state *state)
{
    state->whole = false;
    TRY(advance_finer(state, 0));
    advance_count(state, state->stages[0]->dt);
    peak_take(state, 0, state->t);
    TRY(advance_regrid(state, 0, true));
    regrid_signals(state);
    beyond_count(state);
    return regrid_verdict(state);
}

/* A step in which what diffuses goes through half the time before all levels do the rest, and half after it. Level 0 is
 * like a finer one here: a step that it cannot take becomes two. */
static int advance_apart(struct state *state, double dt)
{
    int parts = 0;
    state->whole = false;
    TRY(flow_take(state, state->t, 0.5 * dt, &parts));
    state->work->part = TERM_SLOW;
    int status = advance_through(state, 0, state->t, dt);
    state->work->part = TERM_WHOLE;
    if (status) return status;
    TRY(flow_take(state, state->t + 0.5 * dt, 0.5 * dt, &parts));
    advance_count(state, dt);
    beyond_count(state);
    return regrid_verdict(state);
}

int advance_step(struct state *state, double dt_most)
{
    struct stage *stage = state->stages[0];
    double dt = advance_dt(state);
    if (!pace_allows(state, 0, state->t, dt)) return advance_too_slow(state, 0, state->t, dt);
    if (dt_most <= ADVANCE_STRETCH * dt) dt = dt_most;
    if (flow_binds(state, dt)) return advance_apart(state, dt);
    for (int retry = 0; retry <= GUARD_RETRIES; retry++) {
        bool good;
        stage->t = state->t;
        stage->dt = dt;
        stage->from = 0.0;
        stage->part = 1.0;
        TRY(advance_once(state, stage, retry, &good));
        if (good) return advance_follow(state);
        if (state->scene->scheme.guard == SCENE_GUARD_STRICT) break;
        state->counts.retries++;
        state->dt_shrink *= 0.5;
        dt *= 0.5;
    }
    return advance_give_up(state, stage);
}
