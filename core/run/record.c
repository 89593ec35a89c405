/* record.c - see record.h. Snapshots and history rows at times make the run cut its steps; rows of
 * probes are interpolated between steps and do not, nor do maps, whose rows are those of steps, nor checkpoints: the
 * numbers of a run must not depend on how often it is saved. A checkpoint comes after all else that is due, so that it
 * knows what has been written; what ends a run is written after its checkpoint and is cut off again when the run goes
 * on. */
#include "run/record.h"

#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/checkpoint.h"
#include "io/dump.h"
#include "io/history.h"
#include "io/maps.h"
#include "io/probes.h"
#include "io/provenance.h"
#include "io/resume.h"
#include "io/snapshot.h"
#include "run/due.h"
#include "solve/cost.h"
#include "solve/wake.h"

#include <string.h>

struct record {
    struct snapshots *snapshots;
    struct history *history;
    struct probes *probes; /* NULL: the case has none */
    struct maps *maps;     /* NULL: the case has none */
    struct checkpoints *checkpoints;
    struct provenance *provenance;
    struct due snapshot_due, history_due, checkpoint_due;
    long fine_steps;      /* moments of the finest level so far, where the history counts those */
    long whole;           /* the step of level 0 counted last */
    struct due_wall late; /* checkpoints by the wall clock; of the rank that looks at it */
};

static int record_open_files(struct record *record, const struct state *state, int argc, char *const *argv)
{
    TRY(snapshot_new(state, &record->snapshots));
    snapshot_beside(record->snapshots);
    TRY(history_new(state, &record->history));
    TRY(probes_new(state, &record->probes));
    TRY(maps_new(state, &record->maps));
    record->checkpoints = checkpoint_new(state->scene);
    record->late.every = state->scene->output.checkpoints_wall;
    return provenance_new(state, argc, argv, &record->provenance);
}

/* The directory of the run that a checkpoint belongs to: <directory>/checkpoints/FILE. */
static char *record_origin(const char *path)
{
    const char *file = strrchr(path, '/');
    return file ? mem_print("%.*s/..", (int)(file - path), path) : mem_text("..");
}

/* The steps that the history counts. */
static long record_steps(const struct record *record, const struct state *state)
{
    return state->scene->output.history_finest ? record->fine_steps : state->step;
}

/* Takes up everything as it was when the checkpoint was written. */
static int record_recall(struct record *record, const struct state *state, const struct resume *from)
{
    const struct notes *notes = &from->notes;
    char *origin = record_origin(from->path);
    due_recall(&record->snapshot_due, "due.snapshots", notes, state->t, state->step);
    due_recall(&record->history_due, "due.history", notes, state->t, record_steps(record, state));
    due_written(&record->checkpoint_due, state->t, state->step);
    double fine_steps = 0.0;
    if (notes_get(notes, "history.fine_steps", 1, &fine_steps)) record->fine_steps = (long)fine_steps;
    snapshot_recall(record->snapshots, notes);
    int code = history_recall(record->history, notes, origin);
    if (!code) code = probes_recall(record->probes, notes, origin);
    if (!code) code = maps_recall(record->maps, notes, origin);
    if (!code) code = provenance_recall(record->provenance, state, notes);
    mem_free(origin);
    return code;
}

int record_open(const struct state *state, int argc, char *const *argv, const struct resume *from,
                struct record **ret_record)
{
    struct record *record = mem_new(1, sizeof *record);
    due_init(&record->snapshot_due, state->scene->output.snapshots);
    due_init(&record->history_due, state->scene->output.history);
    due_init(&record->checkpoint_due, state->scene->output.checkpoints);
    record->whole = state->step;
    due_written(&record->checkpoint_due, state->t, state->step); /* the start can be had again */
    int code = record_open_files(record, state, argc, argv);
    if (!code && from) code = record_recall(record, state, from);
    if (code) record_close(record);
    else *ret_record = record;
    return code;
}

double record_target(const struct record *record, double t, double until)
{
    const struct due *const dues[] = {&record->snapshot_due, &record->history_due};
    return due_target(dues, 2, t, until);
}

static int record_snapshot(struct record *record, const struct state *state, struct derive_moment *moment)
{
    return snapshot_write(record->snapshots, state, moment, provenance_text(record->provenance));
}

int record_now(struct record *record, const struct state *state)
{
    struct derive_moment moment = derive_moment(state->model, state->mesh, state->t);
    return record_snapshot(record, state, &moment);
}

static int record_due_snapshot(struct record *record, const struct state *state, struct derive_moment *moment)
{
    TRY(record_snapshot(record, state, moment));
    due_written(&record->snapshot_due, state->t, state->step);
    return 0;
}

static bool record_row_is_due(const struct record *record, const struct state *state)
{
    return due_now(&record->history_due, state->t, record_steps(record, state));
}

/* A row of the history, or a look between two. */
static int record_history(struct record *record, const struct state *state, struct derive_moment *moment)
{
    if (!record_row_is_due(record, state)) return history_look(record->history, state, moment);
    TRY(history_write(record->history, state, moment));
    due_written(&record->history_due, state->t, record_steps(record, state));
    return 0;
}

/* At a moment inside a step of level 0. Rows by time come at the ends of steps, which are cut to hit them. */
static int record_look(void *data, const struct state *state, int base)
{
    struct record *record = data;
    double begin = cost_cpu();
    struct derive_moment moment = derive_moment(state->model, state->mesh, state->t);
    moment.base = base;
    record->fine_steps++;
    int code = state->scene->output.history.steps > 0 ? record_history(record, state, &moment)
                                                      : history_look(record->history, state, &moment);
    provenance_output(record->provenance, cost_cpu() - begin);
    return code;
}

void record_follow(struct record *record, struct state *state)
{
    if (!state->scene->output.history_finest) return;
    state->look = record_look;
    state->look_data = record;
}

/* What outputs need to go on as if nothing had happened. */
static int record_note(const struct record *record, const struct state *state, struct notes *notes)
{
    due_keep(&record->snapshot_due, "due.snapshots", notes);
    due_keep(&record->history_due, "due.history", notes);
    notes_put_one(notes, "history.fine_steps", (double)record->fine_steps);
    snapshot_keep(record->snapshots, notes);
    provenance_keep(record->provenance, state, notes);
    TRY(history_keep(record->history, notes));
    TRY(maps_keep(record->maps, notes));
    return probes_keep(record->probes, notes);
}

/* A checkpoint says which snapshots there are: they must be there. */
static int record_checkpoint(struct record *record, const struct state *state)
{
    struct notes notes = {0};
    TRY(snapshot_wait(record->snapshots));
    int code = record_note(record, state, &notes);
    wake_levels(state, 0);
    if (!code) code = checkpoint_write(record->checkpoints, state, &notes);
    text_done(&notes.text);
    if (!code) due_wall_written(&record->late);
    return code;
}

/* Does some writing, on the account of outputs. */
static int record_timed(struct record *record, const struct state *state,
                        int (*write)(struct record *record, const struct state *state))
{
    double begin = cost_cpu();
    int code = write(record, state);
    provenance_output(record->provenance, cost_cpu() - begin);
    return code;
}

int record_save(struct record *record, const struct state *state)
{
    return record_timed(record, state, record_checkpoint);
}

bool record_late(struct record *record, double clock)
{
    return due_wall_now(&record->late, clock);
}

void record_rescue(struct record *record, const struct state *state)
{
    if (record_save(record, state)) log_warn("%s; the run goes on without it", status_text());
    due_wall_written(&record->late);
}

const char *record_saved(const struct record *record)
{
    return checkpoint_last(record->checkpoints);
}

static int record_due_save(struct record *record, const struct state *state)
{
    TRY(record_checkpoint(record, state));
    due_written(&record->checkpoint_due, state->t, state->step);
    return 0;
}

/* One moment for all that is due: what one output has brought for its fields the others find. */
static int record_write_due(struct record *record, const struct state *state)
{
    struct derive_moment moment = derive_moment(state->model, state->mesh, state->t);
    TRY(probes_record(record->probes, state, &moment));
    TRY(maps_record(record->maps, state, &moment));
    TRY(record_history(record, state, &moment));
    if (due_now(&record->snapshot_due, state->t, state->step)) TRY(record_due_snapshot(record, state, &moment));
    if (due_now(&record->checkpoint_due, state->t, state->step)) TRY(record_due_save(record, state));
    return 0;
}

/* Most steps write nothing and do not even look at the clock. */
int record_due(struct record *record, const struct state *state)
{
    const struct due *const dues[] = {&record->snapshot_due, &record->checkpoint_due};
    record->fine_steps += state->step != record->whole;
    record->whole = state->step;
    bool any = record->probes || record->maps || state->look || history_looks(record->history) ||
               record_row_is_due(record, state);
    provenance_watch(record->provenance, state);
    for (int i = 0; i < 2; i++) any = any || due_now(dues[i], state->t, state->step);
    return any ? record_timed(record, state, record_write_due) : 0;
}

int record_dump(const struct record *record, const struct state *state, char **ret_path)
{
    return dump_write(state, provenance_text(record->provenance), ret_path);
}

static int record_write_last(struct record *record, const struct state *state)
{
    struct derive_moment moment = derive_moment(state->model, state->mesh, state->t);
    TRY(maps_finish(record->maps, state, &moment));
    if (state->whole) { /* else levels are at different times: to look at, not to measure */
        TRY(probes_finish(record->probes, state, &moment));
        TRY(history_write(record->history, state, &moment));
    } else {
        TRY(history_flush(record->history));
    }
    TRY(record_snapshot(record, state, &moment));
    return snapshot_wait(record->snapshots);
}

bool record_busy(const struct record *record)
{
    return snapshot_busy(record->snapshots);
}

int record_settle(struct record *record, bool is_busy)
{
    return is_busy ? STATUS_OK : snapshot_settle(record->snapshots);
}

int record_finish(struct record *record)
{
    return snapshot_wait(record->snapshots);
}

int record_last(struct record *record, const struct state *state)
{
    return record_timed(record, state, record_write_last);
}

int record_conclude(struct record *record, const struct state *state, const char *reason, int exit_code)
{
    return provenance_write(record->provenance, state, reason, exit_code);
}

void record_close(struct record *record)
{
    if (!record) return;
    snapshot_free(record->snapshots);
    history_free(record->history);
    probes_free(record->probes);
    maps_free(record->maps);
    checkpoint_free(record->checkpoints);
    provenance_free(record->provenance);
    mem_free(record);
}
