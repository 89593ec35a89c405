/* sweep.c - see sweep.h. What a combination needs is decided by what its directory holds (sweep_look.h) and nothing
 * else: a sweep that was interrupted or killed keeps no state of its own. table.csv is written anew whenever
 * a combination ends. */
#include "batch/sweep.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "batch/study_child.h"
#include "batch/sweep_lock.h"
#include "batch/sweep_plan.h"
#include "batch/sweep_pool.h"
#include "batch/sweep_table.h"
#include "cli/human.h"
#include "io/place.h"
#include "judge/expect.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct sweep {
    const char *ranks;
    long jobs;
    struct sweep_plan plan;
    struct sweep_value *values;
    unsigned n_value;
    struct sweep_table_row *rows; /* [plan.matrix.n_row] */
    unsigned *todo, n_todo;       /* combinations to be run, in order */
    unsigned n_ended;
};

enum { SWEEP_NAMED = 5 }; /* most directories that a refusal names */

static int sweep_options(struct sweep *sweep, const struct cli_given *given)
{
    long ranks = 1;
    sweep->jobs = 1;
    sweep->ranks = cli_value(given, "--ranks");
    if (comm_size() > 1)
        return status_fail(STATUS_CASE,
                           "bulla sweep starts its runs itself: without mpirun, with -n for ranks of each run");
    TRY(cli_count(given, "--jobs", 1, &sweep->jobs));
    TRY(cli_count(given, "--ranks", 1, &ranks));
    log_set_quiet(cli_value(given, "--quiet") != NULL);
    return STATUS_OK;
}

/* Values that no run could have are refused before any run. */
static int sweep_check_values(struct sweep *sweep, const struct cli_given *given)
{
    struct scene *scene = NULL;
    int code = STATUS_OK;
    sweep_value_read(given, &sweep->values, &sweep->n_value);
    if (sweep->n_value == 0) return STATUS_OK;
    TRY(sweep_plan_scene(&sweep->plan, 0, &scene));
    for (unsigned v = 0; v < sweep->n_value && !code; v++) code = sweep_value_check(&sweep->values[v], scene);
    scene_free(scene);
    return code;
}

/* What is in the way: only --overwrite removes it. */
static int sweep_check_places(const struct sweep *sweep)
{
    unsigned n = 0;
    for (unsigned i = 0; i < sweep->plan.matrix.n_row; i++) {
        const struct sweep_plan_row *row = &sweep->plan.rows[i];
        if (row->found == SWEEP_LOOK_FOREIGN && n++ < SWEEP_NAMED)
            log_error("%s holds another run: %s", row->directory, row->difference);
    }
    if (!n) return STATUS_OK;
    return status_fail(STATUS_CASE,
                       "%u of %u directories hold runs of another case, or of this one before it was changed; "
                       "--overwrite replaces these, -o DIR writes elsewhere",
                       n, sweep->plan.matrix.n_row);
}

static double sweep_evaluate(const struct sweep_value *value, const struct scene *scene, const char *directory)
{
    double number = NAN;
    if (expect_formula(scene, directory, value->text, &number)) {
        log_warn("%s: --value %s", directory, status_text());
        return NAN;
    }
    return number;
}

/* The values of a combination that has come to its end. */
static void sweep_measure(struct sweep *sweep, unsigned index)
{
    struct scene *scene = NULL;
    if (sweep->n_value == 0 || sweep_plan_scene(&sweep->plan, index, &scene)) return;
    for (unsigned v = 0; v < sweep->n_value; v++)
        sweep->rows[index].values[v] = sweep_evaluate(&sweep->values[v], scene, sweep->plan.rows[index].directory);
    scene_free(scene);
}

/* Reads what a combination left. */
static void sweep_take(struct sweep *sweep, unsigned index, int code)
{
    struct sweep_table_row *row = &sweep->rows[index];
    study_row_read(sweep->plan.rows[index].directory, code, &row->run);
    if (code <= STATUS_EXPECT) sweep_measure(sweep, index);
}

/* Sorts the combinations: what is there is read, the rest is to be done. */
static void sweep_sort(struct sweep *sweep)
{
    unsigned n = sweep->plan.matrix.n_row;
    sweep->rows = mem_new(n, sizeof *sweep->rows);
    sweep->todo = mem_new(n, sizeof *sweep->todo);
    for (unsigned i = 0; i < n; i++) {
        sweep->rows[i].run.code = SWEEP_TABLE_WAITING;
        sweep->rows[i].values = mem_new(sweep->n_value, sizeof *sweep->rows[i].values);
        for (unsigned v = 0; v < sweep->n_value; v++) sweep->rows[i].values[v] = NAN;
        if (sweep->plan.rows[i].found != SWEEP_LOOK_DONE) sweep->todo[sweep->n_todo++] = i;
        else sweep_take(sweep, i, study_row_exit(sweep->plan.rows[i].directory));
    }
    sweep->n_ended = n - sweep->n_todo;
}

static struct sweep_table sweep_table_of(const struct sweep *sweep)
{
    return (struct sweep_table){&sweep->plan, sweep->values, sweep->n_value, sweep->rows};
}

static int sweep_save(const struct sweep *sweep)
{
    struct sweep_table table = sweep_table_of(sweep);
    struct text text = {0};
    char *path = mem_print("%s/table.csv", sweep->plan.directory);
    sweep_table_csv(&table, &text);
    int code = place_text(path, text.at);
    mem_free(path);
    text_done(&text);
    return code;
}

static char *sweep_log(const struct sweep *sweep, unsigned index)
{
    return mem_print("%s/terminal.txt", sweep->plan.rows[index].directory);
}

/* The last error that a run printed; "" if it printed none. */
static char *sweep_last_error(const struct sweep *sweep, unsigned index)
{
    char *path = sweep_log(sweep, index), *line = NULL, *last = mem_text("");
    FILE *file = fopen(path, "r");
    size_t room = 0;
    while (file && getline(&line, &room, file) > 0) {
        char *at = strstr(line, "error: ");
        if (!at) continue;
        mem_free(last);
        last = mem_text_n(at + strlen("error: "), strcspn(at, "\n") - strlen("error: "));
    }
    if (file) fclose(file);
    free(line);
    mem_free(path);
    return last;
}

static void sweep_say(const struct sweep *sweep, unsigned index, int code)
{
    char wall[HUMAN_ROOM];
    const struct sweep_plan_row *row = &sweep->plan.rows[index];
    const struct study_row *run = &sweep->rows[index].run;
    char *head = mem_print("[%u/%u] %s", sweep->n_ended, sweep->plan.matrix.n_row, row->name);
    char *error = sweep_last_error(sweep, index);
    if (code <= STATUS_EXPECT)
        log_note("%s: done in %s%s", head,
                 run->wall < 60 ? human_si(run->wall, "s", wall) : human_duration(run->wall, wall),
                 code ? "; an expectation failed" : "");
    else if (code == STATUS_STOPPED) log_note("%s: interrupted", head);
    else
        log_error("%s: failed with exit code %d: %s", head, code, *error ? error : "see terminal.txt in its directory");
    mem_free(error);
    mem_free(head);
}

static int sweep_start(void *context, unsigned item, const sigset_t *mask, pid_t *ret_pid)
{
    const struct sweep *sweep = context;
    unsigned index = sweep->todo[item];
    const struct sweep_plan_row *row = &sweep->plan.rows[index];
    TRY(place_folder(row->directory));
    char *log = sweep_log(sweep, index);
    struct study_child child = {.path = sweep->plan.path,
                                .directory = row->directory,
                                .log = log,
                                .ranks = sweep->ranks,
                                .variant = sweep->plan.variant,
                                .sets = row->sets,
                                .restart = row->found == SWEEP_LOOK_SAVED,
                                .mask = mask};
    int code = study_child_start(&child, ret_pid);
    mem_free(log);
    return code;
}

static int sweep_ended(void *context, unsigned item, int state)
{
    struct sweep *sweep = context;
    unsigned index = sweep->todo[item];
    int code = study_child_code(state);
    sweep->n_ended++;
    sweep_take(sweep, index, code);
    sweep_say(sweep, index, code);
    return sweep_save(sweep);
}

static void sweep_list(const struct sweep *sweep)
{
    static const char *const found[] = {"to be run", "finished", "begun, to be run again", "to go on",
                                        "to be replaced"};
    for (unsigned i = 0; i < sweep->plan.matrix.n_row; i++)
        printf("%-24s%s\n", found[sweep->plan.rows[i].found], sweep->plan.rows[i].directory);
}

/* The exit code of the sweep by those of its combinations. */
static int sweep_judge(const struct sweep *sweep)
{
    unsigned failed = 0, expect = 0;
    for (unsigned i = 0; i < sweep->plan.matrix.n_row; i++) {
        failed += sweep->rows[i].run.code > STATUS_EXPECT;
        expect += sweep->rows[i].run.code == STATUS_EXPECT;
    }
    if (failed)
        return status_fail(STATUS_RUN, "%u of %u combinations failed; a later call tries them again", failed,
                           sweep->plan.matrix.n_row);
    if (expect)
        return status_fail(STATUS_EXPECT, "%u of %u combinations do not show what they expect", expect,
                           sweep->plan.matrix.n_row);
    return STATUS_OK;
}

static void sweep_print(const struct sweep *sweep)
{
    struct sweep_table table = sweep_table_of(sweep);
    struct text text = {0};
    sweep_table_print(&table, &text);
    fputs(text.at, stdout);
    fflush(stdout);
    text_done(&text);
    log_note("the table is in %s/table.csv", sweep->plan.directory);
}

/* With the directory locked: what is there is looked at again, since another sweep may have been at work. */
static int sweep_run(struct sweep *sweep)
{
    TRY(place_folder(sweep->plan.directory));
    TRY(sweep_lock_take(sweep->plan.directory));
    sweep_plan_look(&sweep->plan);
    sweep_sort(sweep);
    log_note("%u combinations in %s, %u of them finished before; %ld at a time", sweep->plan.matrix.n_row,
             sweep->plan.directory, sweep->n_ended, sweep->jobs);
    TRY(sweep_save(sweep));
    unsigned jobs = sweep->jobs < (long)sweep->n_todo ? (unsigned)sweep->jobs : sweep->n_todo;
    struct sweep_pool pool = {jobs, sweep->n_todo, sweep, sweep_start, sweep_ended};
    int code = sweep_pool_run(&pool);
    sweep_print(sweep);
    if (code == STATUS_STOPPED) return status_fail(code, "interrupted; the same command goes on");
    return code ? code : sweep_judge(sweep);
}

static void sweep_done(struct sweep *sweep)
{
    for (unsigned i = 0; sweep->rows && i < sweep->plan.matrix.n_row; i++) {
        study_row_done(&sweep->rows[i].run);
        mem_free(sweep->rows[i].values);
    }
    mem_free(sweep->rows);
    mem_free(sweep->todo);
    sweep_value_done(sweep->values, sweep->n_value);
    sweep_plan_done(&sweep->plan);
}

int sweep_command(const struct cli_given *given)
{
    struct sweep sweep = {0};
    int code = sweep_options(&sweep, given);
    if (!code) code = sweep_plan_make(given, &sweep.plan);
    if (!code) code = sweep_check_values(&sweep, given);
    if (!code && !cli_value(given, "--overwrite")) code = sweep_check_places(&sweep);
    if (!code && cli_value(given, "--dry-run")) sweep_list(&sweep);
    else if (!code) code = sweep_run(&sweep);
    sweep_done(&sweep);
    return cli_failed(code);
}
