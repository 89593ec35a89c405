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
    bool limited;   /* the command line gives the step limit */
    bool shortened; /* the command line ended the run before the case does */
    bool quiet, json;
    double walltime;   /* seconds, or infinity */
    char reason[1024]; /* why the run ended */
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

static void run_because(struct run *run, const char *format, const char *what)
{
    snprintf(run->reason, sizeof run->reason, format, what);
}

/* Reasons to end before the next step, agreed on by all ranks. */
static int run_interruption(struct run *run)
{
    double wish = RUN_GO;
    if (comm_rank() == 0 && progress_clock() - run->progress.start >= run->walltime) wish = RUN_CLOCK;
    if (stop_signal()) wish = RUN_SIGNAL + stop_signal();
    comm_max(&wish, 1);
    if (wish == RUN_GO) return 0;
    if (wish == RUN_CLOCK) run_because(run, "interrupted by %s", "walltime");
    else run_because(run, "interrupted by SIG%s", sigabbrev_np((int)wish - RUN_SIGNAL));
    return STATUS_STOPPED;
}

static bool run_is_over(struct run *run)
{
    const struct state *state = run->state;
    bool at_end = state->t >= run->scene->until;
    bool at_limit = run->scene->max_steps > 0 && state->step >= run->scene->max_steps;
    if (at_end || at_limit) run_because(run, "finished%s", at_end ? "" : " at the step limit");
    run->shortened = run->shortened || (at_limit && !at_end && run->limited);
    return at_end || at_limit;
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
    progress_mesh(&run->progress, state->mesh, state->level_steps);
    progress_step(&run->progress, state->t, state->dt, state->step);
    return 0;
}

/* Any failure from here on is that of a run: a script that fails now has not refused a case. */
static int run_loop(struct run *run)
{
    int code = record_due(run->record, run->state);
    while (!code && !run_is_over(run)) {
        code = run_interruption(run);
        if (!code) code = run_step(run);
        if (!code) code = record_due(run->record, run->state);
    }
    return code && code != STATUS_STOPPED ? STATUS_RUN : code;
}

static void run_say_end(const struct run *run, int code)
{
    char time[HUMAN_ROOM], wall[HUMAN_ROOM], rate[HUMAN_ROOM];
    const struct state *state = run->state;
    double passed = progress_clock() - run->progress.start, work = run->progress.work;
    const char *directory = run->scene->directory;
    human_si(state->t, "s", time);
    if (code == 0)
        log_note("%s: t = %s, %ld steps, %s wall, %s cell updates/s; output in %s", run->reason, time, state->step,
                 passed < 60 ? human_si(passed, "s", wall) : human_duration(passed, wall),
                 human_count(passed > 0 ? work / passed : 0, rate), directory);
    else if (code == STATUS_STOPPED)
        log_warn("%s at t = %s, step %ld: snapshot, history and probes up to here are in %s (version " BULLA_VERSION
                 " cannot continue from them)",
                 run->reason, time, state->step, directory);
    else log_error("the last good state (t = %s, step %ld) is saved in %s", time, state->step, directory);
}

/* The loop, and the outputs that end a run however it ends. */
static int run_until_end(struct run *run)
{
    progress_begin(&run->progress, run->scene->name, run->scene->directory);
    int code = run_loop(run);
    progress_clear(&run->progress);
    if (code == STATUS_RUN) {
        run_because(run, "%s", status_text());
        cli_failed(code);
    }
    if (record_last(run->record, run->state)) {
        log_error("the last state could not be saved: %s", status_text());
        if (code != STATUS_RUN) run_because(run, "%s", status_text());
        return STATUS_RUN;
    }
    run_say_end(run, code);
    return code;
}

static int run_judge(struct run *run)
{
    if (!run->scene->n_expect) return 0;
    if (run->shortened) {
        log_note("expectations are not judged: the command line shortened the run");
        return 0;
    }
    int code = expect_judge(run->scene, run->scene->directory, run->quiet || run->json);
    return code > STATUS_EXPECT ? cli_failed(code) : code;
}

static int run_files(struct run *run, const struct cli_given *given)
{
    const char *directory = run->scene->directory;
    TRY(outdir_prepare(directory));
    TRY(outdir_write(directory, "case.yaml", run->scene->resolved));
    char *log = mem_print("%s/log.txt", directory);
    int code = comm_agree(log_open(log, false));
    mem_free(log);
    TRY(code);
    log_file("bulla " BULLA_VERSION ", case %s, %d ranks, %.0f cells", run->scene->path, comm_size(),
             run->progress.cells);
    return record_open(run->state, given->argc, given->argv, &run->record);
}

/* With a state in memory: the directory, the files, the loop, the expectations. */
static int run_in_directory(struct run *run, const struct cli_given *given)
{
    run->progress.until = run->scene->until;
    run->progress.most_steps = run->scene->max_steps;
    progress_mesh(&run->progress, run->state->mesh, run->state->level_steps);
    int code = run_files(run, given);
    if (code) {
        cli_failed(code);
    } else {
        code = run_until_end(run);
        if (!code) code = run_judge(run);
        if (record_conclude(run->record, run->state, run->reason, code)) code = cli_failed(STATUS_RUN);
        progress_end(&run->progress, run->state->t, run->state->step, code, run->reason);
    }
    record_close(run->record);
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
    run.limited = cli_value(given, "--max-steps") != NULL;
    code = outdir_check(run.scene->directory, cli_value(given, "--overwrite") != NULL);
    if (!code) code = state_new(run.scene, &run.state);
    if (code) cli_failed(code);
    else code = run_in_directory(&run, given);
    state_free(run.state);
    scene_free(run.scene);
    return code;
}
