/* record.c - see record.h. Snapshots and history rows at times make the run cut its steps; rows of
 * probes are interpolated between steps and do not. */
#include "app/record.h"

#include "app/due.h"
#include "base/mem.h"
#include "base/status.h"
#include "io/history.h"
#include "io/probes.h"
#include "io/provenance.h"
#include "io/snapshot.h"

struct record {
    struct snapshots *snapshots;
    struct history *history;
    struct probes *probes; /* NULL: the case has none */
    struct provenance *provenance;
    struct due snapshot_due, history_due;
};

static int record_open_files(struct record *record, const struct state *state, int argc, char *const *argv)
{
    TRY(snapshot_new(state, &record->snapshots));
    TRY(history_new(state, &record->history));
    TRY(probes_new(state, &record->probes));
    return provenance_new(state, argc, argv, &record->provenance);
}

int record_open(const struct state *state, int argc, char *const *argv, struct record **ret_record)
{
    struct record *record = mem_new(1, sizeof *record);
    due_init(&record->snapshot_due, state->scene->snapshots);
    due_init(&record->history_due, state->scene->history);
    int code = record_open_files(record, state, argc, argv);
    if (code) record_close(record);
    else *ret_record = record;
    return code;
}

double record_target(const struct record *record, double t, double until)
{
    const struct due *const dues[] = {&record->snapshot_due, &record->history_due};
    return due_target(dues, 2, t, until);
}

static int record_snapshot(struct record *record, const struct state *state)
{
    due_written(&record->snapshot_due, state->t, state->step);
    return snapshot_write(record->snapshots, state, provenance_text(record->provenance));
}

static int record_row(struct record *record, const struct state *state)
{
    due_written(&record->history_due, state->t, state->step);
    return history_write(record->history, state);
}

int record_due(struct record *record, const struct state *state)
{
    provenance_watch(record->provenance, state);
    TRY(probes_record(record->probes, state));
    if (due_now(&record->history_due, state->t, state->step)) TRY(record_row(record, state));
    if (due_now(&record->snapshot_due, state->t, state->step)) TRY(record_snapshot(record, state));
    return 0;
}

int record_last(struct record *record, const struct state *state)
{
    TRY(probes_finish(record->probes, state));
    TRY(record_row(record, state));
    return record_snapshot(record, state);
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
    provenance_free(record->provenance);
    mem_free(record);
}
