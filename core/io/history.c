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
    unsigned width;       /* numbers in a row */
    unsigned n_row, room; /* rows in memory, and how many have room */
    double *rows;         /* [room][width] */
    bool looks;           /* there are extremes between rows */
    bool *wanted;         /* [n_column] is needed for them */
    double *since;        /* [n_column] extremes since the last row; NaN: none */
    double dt;            /* of the step before the last look or row */
    long last, seen;      /* steps of the last row and the last look at a whole state, or -1 */
};

static int history_open(struct history *history, const struct state *state)
{
    const struct scene *scene = state->scene;
    struct text header = {0};
    char *path = mem_print("%s/history.csv", scene->output.directory);
    text_add(&header, "step,t,dt");
    for (unsigned i = 0; i < scene->output.n_column; i++) text_add(&header, ",%s", scene->output.columns[i].name);
    text_add(&header, ",guard_fallback,guard_relaxed,guard_clipped,guard_retries");
    int code = csv_open(path, header.at, NULL, state->step > 0, (double)state->step, &history->csv);
    text_done(&header);
    mem_free(path);
    return code;
}

static bool history_between(const struct scene_column *column)
{
    return column->measure == SCENE_MIN_BETWEEN || column->measure == SCENE_MAX_BETWEEN;
}

static void history_forget(struct history *history, const struct scene *scene)
{
    for (unsigned i = 0; i < scene->output.n_column; i++) history->since[i] = NAN;
}

/* What extremes between rows hang on: columns name only columns before them. */
static void history_plan(struct history *history, const struct scene *scene)
{
    const struct scene_column *columns = scene->output.columns;
    history->wanted = mem_new(scene->output.n_column, sizeof *history->wanted);
    history->since = mem_new(scene->output.n_column, sizeof *history->since);
    history_forget(history, scene);
    for (unsigned i = scene->output.n_column; i-- > 0;) {
        bool between = history_between(&columns[i]), *wanted = history->wanted;
        wanted[i] = wanted[i] || between;
        history->looks = history->looks || between;
        if (between) wanted[columns[i].of] = true;
        for (unsigned k = 0; wanted[i] && k < columns[i].n_use; k++)
            for (unsigned j = 0; j < i; j++)
                if (!strcmp(columns[j].name, columns[i].uses[k])) wanted[j] = true;
    }
}

int history_new(const struct state *state, struct history **ret_history)
{
    struct history *history = mem_new(1, sizeof *history);
    history->last = history->seen = -1;
    history->width = HISTORY_FIRST + state->scene->output.n_column + HISTORY_GUARD;
    history_plan(history, state->scene);
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
    mem_free(history->rows);
    mem_free(history->wanted);
    mem_free(history->since);
    mem_free(history);
}

int history_keep(struct history *history, struct notes *notes)
{
    notes_put_one(notes, "history.last", (double)history->last);
    notes_put_one(notes, "history.seen", (double)history->seen);
    notes_put_one(notes, "history.dt", history->dt);
    if (history->looks)
        notes_put(notes, "history.since", history->width - HISTORY_FIRST - HISTORY_GUARD, history->since);
    measure_keep(history->measures, notes);
    return csv_keep(history->csv, "history.csv", notes);
}

int history_recall(struct history *history, const struct notes *notes, const char *origin)
{
    double last = -1.0, seen = -1.0;
    if (notes_get(notes, "history.last", 1, &last)) history->last = (long)last;
    if (notes_get(notes, "history.seen", 1, &seen)) history->seen = (long)seen;
    notes_get(notes, "history.dt", 1, &history->dt);
    notes_get(notes, "history.since", history->width - HISTORY_FIRST - HISTORY_GUARD, history->since);
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

/* A column that is an expression of t and of columns before it. */
static int history_value(const struct scene *scene, const struct scene_column *column, double t, double *columns)
{
    double in[SCRIPT_ARGUMENTS], *to = &columns[column - scene->output.columns];
    for (unsigned k = 0; k < column->n_use; k++) in[k] = history_argument(scene, column->uses[k], t, columns);
    if (script_call(column->script, in, column->n_use, to, 1)) *to = NAN;
    return script_guard_struck() ? status_wrap(STATUS_RUN, "history column '%s': ", column->name) : STATUS_OK;
}

/* The extreme since the last row, with what its column is now. */
static double history_extreme(const struct scene_column *column, double since, double now)
{
    if (isnan(now) || isnan(since)) return isnan(now) ? since : now;
    bool more = column->measure == SCENE_MAX_BETWEEN ? now > since : now < since;
    return more ? now : since;
}

/* Measures all columns or those wanted, and computes those that follow from others. */
static int history_take(struct history *history, const struct state *state, struct derive_moment *moment,
                        const bool *wanted, double *ret_columns)
{
    const struct scene *scene = state->scene;
    int code = STATUS_OK;
    if (state->whole) history->seen = state->step;
    if (state->dt_last > 0.0) history->dt = state->dt_last;
    measure_take(history->measures, state, moment, wanted, ret_columns);
    for (unsigned i = 0; !code && i < scene->output.n_column; i++) {
        const struct scene_column *column = &scene->output.columns[i];
        if (wanted && !wanted[i]) continue;
        if (column->measure == SCENE_VALUE) code = history_value(scene, column, state->t, ret_columns);
        if (!history_between(column)) continue;
        history->since[i] = history_extreme(column, history->since[i], ret_columns[column->of]);
        ret_columns[i] = history->since[i];
    }
    return comm_agree(code);
}

int history_flush(struct history *history)
{
    unsigned n = history->n_row;
    history->n_row = 0;
    return n ? csv_rows(history->csv, n, history->width, history->rows) : STATUS_OK;
}

int history_look(struct history *history, const struct state *state, struct derive_moment *moment)
{
    int code = STATUS_OK;
    if (state->whole && history->seen == state->step)
        return STATUS_OK; /* taken up again: it counts for the row before */
    if (history->looks) {
        double *columns = mem_new(history->width, sizeof *columns);
        code = history_take(history, state, moment, history->wanted, columns);
        mem_free(columns);
    } else {
        measure_pass(history->measures, moment->base);
    }
    return !code && state->whole ? history_flush(history) : code;
}

bool history_looks(const struct history *history)
{
    return history->looks;
}

/* Fills a row of the table. */
static int history_row(struct history *history, const struct state *state, struct derive_moment *moment, double *row)
{
    unsigned n = state->scene->output.n_column;
    struct state_counts counts = state_counts_total(state);
    double *guard = row + HISTORY_FIRST + n;
    TRY(history_take(history, state, moment, NULL, row + HISTORY_FIRST));
    row[0] = (double)(state->whole ? state->step : state->step + 1);
    row[1] = state->t;
    row[2] = state->scene->output.history_finest ? history->dt : state->dt;
    guard[0] = (double)counts.fallback;
    guard[1] = (double)counts.relaxed;
    guard[2] = (double)counts.clipped;
    guard[3] = (double)counts.retries;
    history_forget(history, state->scene);
    return STATUS_OK;
}

int history_write(struct history *history, const struct state *state, struct derive_moment *moment)
{
    if (state->whole && history->last == state->step) return STATUS_OK;
    if (history->n_row == history->room) {
        unsigned room = 2 * history->room + 1;
        history->rows = mem_grow(history->rows, (size_t)history->room * history->width, (size_t)room * history->width,
                                 sizeof *history->rows);
        history->room = room;
    }
    TRY(history_row(history, state, moment, history->rows + (size_t)history->n_row * history->width));
    history->n_row++;
    if (!state->whole) return STATUS_OK;
    history->last = state->step;
    return history_flush(history);
}
