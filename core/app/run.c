/* run.c - the loop: a step, then the outputs that are due, until an end comes.
 *
 * Ends are: the end time, a step limit, the wall clock, a signal, a failure. All ranks see the
 * same end after the same step, because they agree before each step; each end leaves readable
 * files, a snapshot of the last good state and a reason in provenance.json. */
#include "app/run.h"

#include "app/due.h"
#include "app/expect.h"
#include "app/human.h"
#include "app/launch.h"
#include "app/outdir.h"
#include "app/progress.h"
#include "app/record.h"
#include "app/scenes.h"
#include "app/stop.h"
#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "solve/advance.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

struct run {
    struct scene *scene;
    struct state *state;
    struct record *record;
    struct progress progress;
    bool shortened; /* the command line ends the run before the case does */
    bool quiet, json;
    double walltime;  /* seconds, or infinity */
    char reason[256]; /* why the run ended */
};

enum { RUN_GO = 0, RUN_CLOCK = 1, RUN_SIGNAL = 2 }; /* what ranks agree on; RUN_SIGNAL + number */

static int run_options(struct run *run, const struct cli_given *given)
{
    run->quiet = cli_value(given, "--quiet") != NULL;
    run->json = cli_value(given, "--json") != NULL;
    run->walltime = INFINITY;
    if (run->quiet && run->json) return status_fail(STATUS_CASE, "--quiet and --json exclude each other");
    const char *walltime = cli_value(given, "--walltime");
    if (walltime && human_read_duration(walltime, &run->walltime)) return status_wrap(STATUS_CASE, "--walltime: ");
    run->shortened = cli_value(given, "--until") != NULL;
    log_set_quiet(run->quiet || run->json);
    run->progress.mode = progress_choose(run->json, run->quiet, launch_terminal());
    return 0;
}

/* Reasons to end before the next step, agreed on by all ranks. */
static int run_interruption(struct run *run)
{
    double wish = RUN_GO;
    if (comm_rank() == 0 && progress_clock() - run->progress.start >= run->walltime) wish = RUN_CLOCK;
    if (stop_signal()) wish = RUN_SIGNAL + stop_signal();
    comm_max(&wish, 1);
    if (wish == RUN_GO) return 0;
    if (wish == RUN_CLOCK) snprintf(run->reason, sizeof run->reason, "walltime");
    else snprintf(run->reason, sizeof run->reason, "SIG%s", sigabbrev_np((int)wish - RUN_SIGNAL));
    return STATUS_STOPPED;
}

static bool run_is_over(struct run *run)
{
    const struct state *state = run->state;
    if (state->t >= run->scene->until) {
        snprintf(run->reason, sizeof run->reason, "end time");
        return true;
    }
    if (run->scene->max_steps > 0 && state->step >= run->scene->max_steps) {
        snprintf(run->reason, sizeof run->reason, "step limit");
        return true;
    }
    return false;
}

/* One step that ends at a target at the latest, and exactly on it. */
static int run_step(struct run *run)
{
    struct state *state = run->state;
    double target = record_target(run->record, state->t, run->scene->until), left = target - state->t;
    double dt = advance_dt(state);
    if (!(dt > 0) || state->t + dt <= state->t)
        return status_fail(STATUS_RUN, "the time step has shrunk to %g s at t = %g s", dt, state->t);
    double take = due_step(dt, left);
    TRY(advance_step(state, take));
    if (take == left && state->dt == take) state->t = target;
    progress_step(&run->progress, state->t, state->dt, state->step);
    return 0;
}

static int run_loop(struct run *run)
{
    TRY(record_due(run->record, run->state));
    while (!run_is_over(run)) {
        TRY(run_interruption(run));
        int code = run_step(run);
        if (code) { /* a script that fails now has stopped a run, not refused a case */
            snprintf(run->reason, sizeof run->reason, "failure");
            return STATUS_RUN;
        }
        TRY(record_due(run->record, run->state));
    }
    return 0;
}

static void run_say_end(struct run *run, int code)
{
    char time[HUMAN_ROOM], wall[HUMAN_ROOM], rate[HUMAN_ROOM];
    const struct state *state = run->state;
    double passed = progress_clock() - run->progress.start;
    const char *directory = run->scene->directory;
    human_si(state->t, "s", time);
    if (code == 0) {
        double work = run->progress.cells * (double)state->step;
        log_note("done (%s): t = %s, %ld steps, %s wall, %s/s; output in %s", run->reason, time, state->step,
                 human_duration(passed, wall), human_si(passed > 0 ? work / passed : 0, "updates", rate), directory);
    } else if (code == STATUS_STOPPED) {
        log_warn("interrupted (%s) at t = %s, step %ld: snapshot, history and probes up to here are in %s; "
                 "version " BULLA_VERSION " cannot continue from them",
                 run->reason, time, state->step, directory);
    } else {
        log_error("the last good state (t = %s, step %ld) is saved in %s", time, state->step, directory);
    }
}

/* From the first output to the last; the outputs that end a run are written however it ends. */
static int run_recorded(struct run *run)
{
    struct scene *scene = run->scene;
    int code = record_open(run->state, &run->record);
    if (code) return cli_failed(code);
    run->progress.until = scene->until;
    run->progress.most_steps = scene->max_steps;
    run->progress.cells = scenes_cells(scene);
    progress_begin(&run->progress, scene->name, scene->directory);
    code = run_loop(run);
    progress_clear(&run->progress);
    if (code == STATUS_RUN) cli_failed(code);
    if (!*run->reason) snprintf(run->reason, sizeof run->reason, "failure");
    int last = record_last(run->record, run->state);
    int closed = record_close(run->record, run->state, run->reason);
    if (last || closed) {
        cli_failed(STATUS_RUN);
        if (code < STATUS_RUN) code = STATUS_RUN;
    }
    run_say_end(run, code);
    return code;
}

/* With a state in memory: the directory, the files, the loop, the expectations. */
static int run_in_directory(struct run *run)
{
    const struct scene *scene = run->scene;
    const char *directory = scene->directory;
    int code = outdir_prepare(directory);
    if (!code) code = outdir_write(directory, "case.yaml", scene->resolved);
    if (code) return cli_failed(code);
    char *log = mem_print("%s/log.txt", directory);
    code = comm_agree(log_open(log, false));
    mem_free(log);
    if (code) return cli_failed(code);
    log_file("bulla " BULLA_VERSION ", case %s, %d ranks, %.0f cells", scene->path, comm_size(), scenes_cells(scene));
    code = run_recorded(run);
    if (!code && scene->n_expect && run->shortened)
        log_note("expectations are not judged: the command line shortened the run");
    else if (!code) {
        code = expect_judge(scene, directory, run->quiet || run->json);
        if (code > STATUS_EXPECT) cli_failed(code);
    }
    progress_end(&run->progress, run->state->t, run->state->step, code, run->reason);
    log_close();
    return code;
}

static int run_ranks(const struct cli_given *given, bool *ret_started, int *ret_code)
{
    long ranks = 1;
    *ret_started = false;
    TRY(cli_count(given, "--ranks", 1, &ranks));
    if (comm_active()) {
        if (cli_value(given, "--ranks") && ranks != comm_size())
            return status_fail(STATUS_CASE, "-n %ld, but an MPI launcher has started %d ranks", ranks, comm_size());
    } else if (ranks > 1) {
        *ret_started = true;
        *ret_code = cli_failed(launch_run(ranks, given->argv));
    }
    return 0;
}

int run_command(const struct cli_given *given)
{
    struct run run = {0};
    bool started;
    int code = run_options(&run, given), outcome = 0;
    if (!code) code = run_ranks(given, &started, &outcome);
    if (code) return cli_failed(code);
    if (started) return outcome;
    stop_catch();
    launch_announce();
    code = comm_agree(scenes_read(given, given->words[0], &run.scene));
    if (code) return code;
    run.shortened = run.shortened || cli_value(given, "--max-steps");
    code = outdir_check(run.scene->directory, cli_value(given, "--overwrite") != NULL);
    if (!code) code = state_new(run.scene, &run.state);
    if (code) cli_failed(code);
    else code = run_in_directory(&run);
    state_free(run.state);
    scene_free(run.scene);
    return code;
}
