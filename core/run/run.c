/* run.c - the loop: a step, then the outputs that are due, until an end comes.
 *
 * Ends are: the end time, a step limit, the wall clock, a signal, a failure. All ranks see the
 * same end after the same step, because they agree before each step; each end leaves readable
 * files, a snapshot of the last good state and a reason in provenance.json. */
#include "run/run.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/system.h"
#include "base/text.h"
#include "cli/human.h"
#include "cli/scenes.h"
#include "io/rebuild.h"
#include "io/units.h"
#include "judge/expect.h"
#include "run/again.h"
#include "run/check.h"
#include "run/due.h"
#include "run/launch.h"
#include "run/laws.h"
#include "run/outdir.h"
#include "run/progress.h"
#include "run/record.h"
#include "run/stop.h"
#include "run/travel.h"
#include "run/unmixed_say.h"
#include "solve/advance.h"
#include "solve/tag.h"

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct run {
    const struct cli_given *given;
    struct scene *scene;
    struct resume *from; /* the checkpoint that the run goes on from, or NULL */
    bool in_place;       /* its files are those of the run that wrote it */
    long step_0;         /* steps done before */
    struct state *state;
    struct record *record;
    struct progress progress;
    struct travel travel;
    bool limited;   /* the command line gives the step limit */
    bool shortened; /* the command line ended the run before the case does */
    bool quiet, json;
    double walltime;   /* seconds, or infinity */
    double pace;       /* seconds of wall time that count for each step; 0: the clock counts */
    char *now;         /* a file by this name asks for a snapshot; NULL: nobody looks */
    char reason[1024]; /* why the run ended */
};

enum { RUN_GO = 0, RUN_CLOCK = 1, RUN_SIGNAL = 2 }; /* what ranks agree on; RUN_SIGNAL + number */

static int run_options(struct run *run, const struct cli_given *given)
{
    run->quiet = cli_value(given, "--quiet") != NULL;
    run->json = cli_value(given, "--json") != NULL;
    run->walltime = INFINITY;
    const char *pace = getenv("BULLA_STEP_SECONDS");
    if (pace) text_number(pace, &run->pace);
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

/* A snapshot that somebody asked for by making a file. */
static int run_snapshot(struct run *run)
{
    TRY(record_now(run->record, run->state));
    int kept = comm_rank() == 0 && unlink(run->now) ? errno : 0;
    if (kept) log_warn("%s cannot be removed: %s; it is not looked for any more", run->now, strerror(kept));
    else log_note("a snapshot of step %ld, as %s asked", run->state->step, run->now);
    if (comm_agree(kept ? STATUS_RUN : STATUS_OK)) run->now = NULL;
    return STATUS_OK;
}

/* Wall time since the run began. Tests let it pass with the steps. */
static double run_clock(const struct run *run)
{
    if (run->pace > 0.0) return run->pace * (double)(run->state->step - run->step_0);
    return progress_clock() - run->progress.start;
}

/* Wishes from outside before the next step, agreed on by all ranks: an end, a snapshot, a checkpoint because the last
 * one is long ago. */
static int run_interruption(struct run *run)
{
    double wish[4] = {RUN_GO, 0.0, 0.0, record_busy(run->record)};
    if (comm_rank() == 0) {
        double clock = run_clock(run);
        if (clock >= run->walltime) wish[0] = RUN_CLOCK;
        wish[1] = run->now && !access(run->now, F_OK);
        wish[2] = record_late(run->record, clock);
    }
    if (stop_signal()) wish[0] = RUN_SIGNAL + stop_signal();
    comm_max(wish, 4);
    TRY(record_settle(run->record, wish[3] > 0.0));
    if (wish[1] > 0.0) TRY(run_snapshot(run));
    if (wish[2] > 0.0 && wish[0] == RUN_GO) record_rescue(run->record, run->state); /* an end saves the state itself */
    if (wish[0] == RUN_GO) return 0;
    if (wish[0] == RUN_CLOCK) run_because(run, "interrupted by %s", "walltime");
    else run_because(run, "interrupted by SIG%s", system_signal_name((int)wish[0] - RUN_SIGNAL));
    return STATUS_STOPPED;
}

static bool run_is_over(struct run *run)
{
    const struct state *state = run->state;
    bool at_end = state->t >= run->scene->run.until;
    bool at_limit = run->scene->run.max_steps > 0 && state->step >= run->scene->run.max_steps;
    if (at_end || at_limit) run_because(run, "finished%s", at_end ? "" : " at the step limit");
    run->shortened = run->shortened || (at_limit && !at_end && run->limited);
    return at_end || at_limit;
}

/* One step that ends at a target at the latest, and exactly on it. */
static int run_step(struct run *run)
{
    struct state *state = run->state;
    double target = record_target(run->record, state->t, run->scene->run.until), left = target - state->t;
    double take = due_step(advance_dt(state), left);
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

static void run_say_how_to_go_on(const struct run *run, const char *time)
{
    char *command = again_command(run->given);
    log_warn("%s at t = %s, step %ld: saved as %s; to go on: %s", run->reason, time, run->state->step,
             record_saved(run->record), command);
    mem_free(command);
}

/* After a failure. */
static void run_say_what_is_left(const struct run *run, const char *time)
{
    const char *saved = record_saved(run->record);
    const char *what = run->state->scene->mesh.levels ? "a finer level" : "what diffuses"; /* solve/flow.h */
    long step = run->state->step;
    if (run->state->whole) log_error("the last good state (t = %s, step %ld) is saved as %s", time, step, saved);
    else if (saved || run->from)
        log_error("%s failed half way through step %ld; the newest checkpoint is %s", what, step + 1,
                  saved ? saved : run->from->path);
    else
        log_error("%s failed half way through step %ld; there is no checkpoint, none was asked for until then", what,
                  step + 1);
}

/* Refluxing that a coarse cell could not bear: what the mesh refines does not hold the shocks. Collective. */
static void run_say_spread(const struct state *state)
{
    long long tiles = state_counts_total(state).spread;
    if (tiles > 0)
        log_note("refluxing: %lld times a tile had cells that could not bear what the finer level asks of them; cells "
                 "around took it, or the finer level",
                 tiles);
}

static void run_say_end(const struct run *run, int code)
{
    char time[HUMAN_ROOM], wall[HUMAN_ROOM], rate[HUMAN_ROOM];
    const struct state *state = run->state;
    double passed = progress_clock() - run->progress.start, work = run->progress.work;
    const char *directory = run->scene->output.directory;
    human_si(state->t, "s", time);
    if (code == 0)
        log_note("%s: t = %s, %ld steps, %s wall, %s cell updates/s; output in %s", run->reason, time, state->step,
                 passed < 60 ? human_si(passed, "s", wall) : human_duration(passed, wall),
                 human_count(passed > 0 ? work / passed : 0, rate), directory);
    else if (code == STATUS_STOPPED) run_say_how_to_go_on(run, time);
    else run_say_what_is_left(run, time);
    laws_say(state);
    run_say_spread(state);
    travel_say(&run->travel, state);
}

/* A run leaves a checkpoint if it could go on: it did not come to the end of its case, or the case asks for them. */
static bool run_may_go_on(const struct run *run, int code)
{
    const struct scene_every *every = &run->scene->output.checkpoints;
    if (!run->state->whole) return false;
    return code || run->shortened || every->time > 0.0 || every->steps > 0;
}

/* The outputs that end a run however it ends; the checkpoint first, because it leaves most. */
static int run_save(struct run *run, int code)
{
    int late = record_finish(run->record);
    if (late) log_error("%s", status_text());
    if (late && code != STATUS_RUN) run_because(run, "%s", status_text());
    int bad = run_may_go_on(run, code) ? record_save(run->record, run->state) : STATUS_OK;
    if (bad && strcmp(status_text(), run->reason) != 0) /* the same failure once more needs no second line */
        log_error("the last state could not be saved: %s", status_text());
    if (bad && code != STATUS_RUN) run_because(run, "%s", status_text());
    int worse = record_last(run->record, run->state);
    if (worse) log_error("the last state could not be written: %s", status_text());
    if (worse && !bad && code != STATUS_RUN) run_because(run, "%s", status_text());
    return late || bad || worse ? STATUS_RUN : STATUS_OK;
}

/* Criteria of refinement that have not tagged a single cell: a threshold that is never reached looks like a mesh that
 * is good enough. */
static void run_say_unused(const struct run *run)
{
    const struct scene *scene = run->scene;
    long long *hits = mem_new(scene->mesh.n_refine + 1, sizeof *hits);
    memcpy(hits, run->state->tagged, scene->mesh.n_refine * sizeof *hits);
    comm_sum_counts(hits, (int)scene->mesh.n_refine);
    for (unsigned i = 0; scene->mesh.levels > 0 && i < scene->mesh.n_refine; i++) {
        if (hits[i] > 0) continue;
        char *criterion = tag_describe(scene, i);
        log_warn("mesh.refine[%u], %s, has not tagged a single cell: lower its threshold, or leave it out", i,
                 criterion);
        mem_free(criterion);
    }
    mem_free(hits);
}

/* What a step that cannot be completed leaves to look at. */
static void run_dump(const struct run *run)
{
    char *path;
    if (record_dump(run->record, run->state, &path))
        log_error("the failed step could not be dumped: %s", status_text());
    else if (path)
        log_error("what the step failed on is in %s: look at it with bulla info, try it again with bulla info "
                  "--replay",
                  path);
    mem_free(path);
}

/* The loop, and what ends it. */
static int run_until_end(struct run *run)
{
    run->progress.share = run->state->t / run->scene->run.until;
    progress_begin(&run->progress, run->scene->name, run->scene->output.directory);
    int code = run_loop(run);
    progress_clear(&run->progress);
    if (code == STATUS_RUN) {
        run_because(run, "%s", status_text());
        cli_failed(code);
        run_dump(run);
    }
    TRY(run_save(run, code));
    run_say_end(run, code);
    if (code == 0) run_say_unused(run);
    return code;
}

static int run_judge(struct run *run)
{
    if (!run->scene->n_expect) return 0;
    if (run->shortened) {
        log_note("expectations are not judged: the command line shortened the run");
        return 0;
    }
    int code = expect_judge(run->scene, run->scene->output.directory, run->quiet || run->json);
    return code > STATUS_EXPECT ? cli_failed(code) : code;
}

/* What the numbers of history.csv and probes.csv are. */
static int run_units(const struct run *run, const char *directory)
{
    struct text text = {0};
    int code = units_text(run->state, &text);
    if (!code) code = outdir_write(directory, "columns.csv", text.at);
    text_done(&text);
    return code;
}

static int run_files(struct run *run, const struct cli_given *given)
{
    const char *directory = run->scene->output.directory;
    TRY((run->in_place ? outdir_go_on : outdir_prepare)(directory));
    TRY(outdir_write(directory, "case.yaml", run->scene->resolved));
    TRY(run_units(run, directory));
    char *log = mem_print("%s/log.txt", directory);
    int code = comm_agree(log_open(log, run->in_place));
    mem_free(log);
    TRY(code);
    log_file("bulla " BULLA_VERSION ", case %s, %d ranks, %.0f cells", run->scene->path, comm_size(),
             run->progress.cells);
    if (run->from) log_note("going on from %s: t = %.9g s, step %ld", run->from->path, run->state->t, run->state->step);
    const struct resume *past = run->step_0 > 0 ? run->from : NULL; /* the start has none: its outputs begin anew */
    TRY(record_open(run->state, given->argc, given->argv, past, &run->record));
    record_follow(run->record, run->state);
    run->travel = travel_begin(run->state);
    if (!run->from) unmixed_say(run->state);
    return STATUS_OK;
}

/* With a state in memory: the directory, the files, the loop, the expectations. */
static int run_in_directory(struct run *run, const struct cli_given *given)
{
    run->progress.until = run->scene->run.until;
    run->progress.most_steps = run->scene->run.max_steps;
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
    TRY(launch_check(cli_value(given, "--ranks") ? ranks : 0));
    if (comm_active()) return STATUS_OK;
    if (ranks > launch_most()) {
        return status_fail(STATUS_CASE, "-n %ld: this machine has processors for %ld ranks at most", ranks,
                           launch_most());
    } else if (ranks > 1) {
        *ret_started = true;
        *ret_code = cli_failed(launch_run(ranks, given->argv));
    }
    return 0;
}

/* The checkpoint to go on from, if the command line wants one. */
static int run_find(struct run *run, const struct cli_given *given)
{
    const char *file = cli_value(given, "--restart"), *directory = run->scene->output.directory;
    if (!file) return 0;
    double in_place = !*file || outdir_holds(directory, "checkpoints", file) ? 1.0 : 0.0;
    comm_max(&in_place, 1);
    run->in_place = in_place > 0.0;
    if (run->in_place) TRY(outdir_claim(directory));
    TRY(*file ? resume_open(file, &run->from) : resume_newest(directory, &run->from));
    if (run->in_place && cli_value(given, "--overwrite"))
        return status_fail(STATUS_CASE, "--restart goes on with the run in %s, which --overwrite would remove",
                           directory);
    return 0;
}

/* The state to start from. */
static int run_begin(struct run *run, const struct cli_given *given)
{
    TRY(run_find(run, given));
    if (!run->in_place) TRY(outdir_check(run->scene->output.directory, cli_value(given, "--overwrite") != NULL));
    TRY(run->from ? rebuild_state(run->from, run->scene, &run->state) : state_new(run->scene, &run->state));
    run->step_0 = run->state->step;
    return 0;
}

/* --dry-run: everything is there for the first step. Nothing was run, so any failure is one of the case. */
static int run_rehearse(struct run *run, int code)
{
    if (code) return cli_failed(STATUS_CASE);
    if (!run->from) unmixed_say(run->state);
    check_ready(run->scene, run->state);
    return STATUS_OK;
}

int run_command(const struct cli_given *given)
{
    struct run run = {.given = given};
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
    char *now = run.now = mem_print("%s/output_now", run.scene->output.directory);
    code = run_begin(&run, given);
    if (cli_value(given, "--dry-run")) code = run_rehearse(&run, code);
    else if (code) cli_failed(code);
    else code = run_in_directory(&run, given);
    mem_free(now);
    state_free(run.state);
    resume_close(run.from);
    scene_free(run.scene);
    return code;
}
