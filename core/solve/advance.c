/* advance.c - a step: run the plan, judge, and climb the guard's ladder where needed.
 *
 * u_old is never touched before a step is accepted, so any attempt can be repeated. One
 * reduction per attempt carries the judgement and the signal speed of the next step. */
#include "solve/advance.h"

#include "base/comm.h"
#include "base/status.h"
#include "solve/plan.h"

double advance_dt(const struct state *state)
{
    const struct scene *scene = state->scene;
    if (scene->dt_fixed > 0.0) return scene->dt_fixed * state->dt_shrink;
    return state->dt_shrink * scene->cfl / state->signal;
}

/* Runs the plan once; returns the number of inadmissible cells of all ranks (in the first stage
 * that has any) and, through *ret_signal, the signal speed of the new state. */
static double advance_attempt(struct stage *stage, double *ret_signal)
{
    guard_attempt(stage->guard);
    for (const struct plan_stage *step = plan_stages(); step->name; step++) step->run(stage);
    double found[3] = {(double)stage->guard->bad[0], (double)stage->guard->bad[1], stage->signal};
    comm_max(found, 3);
    *ret_signal = found[2];
    if (found[0] > 0.0 || found[1] > 0.0) guard_settle(stage->guard, found[0] > 0.0);
    return found[0] > 0.0 ? found[0] : found[1];
}

/* Attempts with the given dt: plain, then with more and more marked cells. 0, or the last count. */
static double advance_rounds(struct state *state, double *ret_signal)
{
    struct stage *stage = state->stage;
    bool strict = state->scene->guard == SCENE_GUARD_STRICT;
    guard_clear(stage->guard);
    for (int round = 0;; round++) {
        double bad = advance_attempt(stage, ret_signal);
        if (bad == 0.0 || strict || round == GUARD_ROUNDS) return bad;
        state->counts.fallback += stage->guard->bad[0] + stage->guard->bad[1];
        stage->guard->masked = true;
        stage_reset(stage);
    }
}

static void advance_accept(struct state *state, double signal)
{
    struct stage *stage = state->stage;
    mesh_swap(stage->level);
    state->signal = signal;
    state->t += stage->dt;
    state->dt = stage->dt;
    state->step++;
    state->counts.cells += stage->cells;
    state->counts.carried += stage->carried;
    state->counts.clipped += stage->clipped;
    state->counts.relaxed += stage->guard->relaxed;
    state->dt_shrink = state->dt_shrink * 1.1 < 1.0 ? state->dt_shrink * 1.1 : 1.0;
}

/* The message of the first rank that found a bad cell, on all ranks. */
static int advance_give_up(const struct state *state, double dt)
{
    const char *cause = state->stage->guard->cause;
    const char *tried = state->scene->guard == SCENE_GUARD_STRICT ? "guard: strict allows no repair"
                                                                  : "first-order fluxes and smaller steps did not help";
    int code = STATUS_OK;
    if (cause[0])
        code = status_fail(STATUS_RUN, "step %ld at t = %.9g s cannot be completed: %s (%s; dt = %.3g s)",
                           state->step + 1, state->t, cause, tried, dt);
    return comm_agree(code);
}

int advance_step(struct state *state, double dt_most)
{
    struct stage *stage = state->stage;
    double dt = advance_dt(state);
    if (dt_most <= ADVANCE_STRETCH * dt) dt = dt_most;
    for (int retry = 0; retry <= GUARD_RETRIES; retry++) {
        double signal = 0.0;
        stage->t = state->t;
        stage->dt = dt;
        stage->cells = stage->carried = stage->clipped = 0;
        double bad = advance_rounds(state, &signal);
        int status = comm_agree(stage->bound->status);
        if (status) stage_reset(stage);
        TRY(status);
        if (bad == 0.0) {
            advance_accept(state, signal);
            return STATUS_OK;
        }
        stage_reset(stage);
        if (state->scene->guard == SCENE_GUARD_STRICT) break;
        state->counts.retries++;
        state->dt_shrink *= 0.5;
        dt *= 0.5;
    }
    return advance_give_up(state, dt);
}
