/* history.c - see history.h. */
#include "io/history.h"

#include "base/comm.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/script_guard.h"
#include "io/csv.h"
#include "io/measure.h"
#include "io/place.h"

#include <math.h>
#include <string.h>

enum { HISTORY_FIRST = 3, HISTORY_GUARD = 4 }; /* step, t, dt; the counts at the end */

struct history {
    struct csv *csv;
    struct measures *measures;
    double *row;
    long last; /* step of the last row, or -1 */
};

static int history_open(struct history *history, const struct state *state)
{
    const struct scene *scene = state->scene;
    struct text header = {0};
    char *path = mem_print("%s/history.csv", scene->output.directory);
    text_add(&header, "step,t,dt");
    for (unsigned i = 0; i < scene->output.n_column; i++) text_add(&header, ",%s", scene->output.columns[i].name);
    text_add(&header, ",guard_fallback,guard_relaxed,guard_clipped,guard_retries");
    int code = csv_open(path, header.at, state->step > 0, (double)state->step, &history->csv);
    text_done(&header);
    mem_free(path);
    return code;
}

int history_new(const struct state *state, struct history **ret_history)
{
    struct history *history = mem_new(1, sizeof *history);
    history->last = -1;
    history->row = mem_new(HISTORY_FIRST + state->scene->output.n_column + HISTORY_GUARD, sizeof *history->row);
    int code = measure_new(state, &history->measures);
    if (!code) code = place_folder(state->scene->output.directory);
    if (!code) code = history_open(history, state);
    if (code) history_free(history);
    else *ret_history = history;
    return code;
}

void history_free(struct history *history)
{
    if (!history) return;
    csv_close(history->csv);
    measure_free(history->measures);
    mem_free(history->row);
    mem_free(history);
}

int history_keep(struct history *history, struct notes *notes)
{
    notes_put_one(notes, "history.last", (double)history->last);
    measure_keep(history->measures, notes);
    return csv_keep(history->csv, "history.csv", notes);
}

int history_recall(struct history *history, const struct notes *notes, const char *origin)
{
    double last = -1.0;
    if (notes_get(notes, "history.last", 1, &last)) history->last = (long)last;
    measure_recall(history->measures, notes);
    char *path = mem_print("%s/history.csv", origin);
    int code = csv_recall(history->csv, "history.csv", notes, path);
    mem_free(path);
    return code;
}

/* Value of the argument `name` of an expression: t or a column. */
static double history_argument(const struct scene *scene, const char *name, double t, const double *columns)
{
    for (unsigned i = 0; i < scene->output.n_column; i++)
        if (!strcmp(scene->output.columns[i].name, name)) return columns[i];
    return t;
}

/* Columns that are expressions of t and of columns before them. */
static int history_compute(const struct scene *scene, double t, double *columns)
{
    int code = STATUS_OK;
    for (unsigned i = 0; i < scene->output.n_column; i++) {
        const struct scene_column *column = &scene->output.columns[i];
        double in[SCRIPT_ARGUMENTS];
        if (column->measure != SCENE_VALUE) continue;
        for (unsigned k = 0; k < column->n_use; k++) in[k] = history_argument(scene, column->uses[k], t, columns);
        if (script_call(column->script, in, column->n_use, &columns[i], 1)) columns[i] = NAN;
        if (script_guard_struck()) code = status_wrap(STATUS_RUN, "history column '%s': ", column->name);
        if (code) break;
    }
    return comm_agree(code);
}

int history_write(struct history *history, const struct state *state, struct derive_moment *moment)
{
    if (history->last == state->step) return STATUS_OK;
    unsigned n = state->scene->output.n_column;
    double *row = history->row, *columns = row + HISTORY_FIRST, *guard = columns + n;
    struct state_counts counts = state_counts_total(state);
    row[0] = (double)state->step;
    row[1] = state->t;
    row[2] = state->dt;
    measure_take(history->measures, state, moment, columns);
    TRY(history_compute(state->scene, state->t, columns));
    guard[0] = (double)counts.fallback;
    guard[1] = (double)counts.relaxed;
    guard[2] = (double)counts.clipped;
    guard[3] = (double)counts.retries;
    history->last = state->step;
    return csv_row(history->csv, HISTORY_FIRST + n + HISTORY_GUARD, row);
}
