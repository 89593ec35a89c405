/* watch_look.c - see watch_look.h. */
#include "watch/watch_look.h"

#include "base/mem.h"
#include "base/system.h"
#include "base/text.h"
#include "case/parse.h"
#include "io/read.h"
#include "watch/watch_file.h"
#include "watch/watch_life.h"
#include "watch/watch_row.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { LOOK_NAME = 200, LOOK_LINE = 1000, LOOK_LINES = 200, LOOK_ROWS = 500 };

static json_t *watch_look_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

/* A run writes into its folders by renaming, which changes their times. */
static double watch_look_silence(const char *directory)
{
    static const char *const names[] = {"history.csv", "probes.csv",  "log.txt",        "fields",
                                        "maps",        "checkpoints", "provenance.json"};
    time_t newest = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        time_t when = watch_file_time(directory, names[i]);
        if (when > newest) newest = when;
    }
    return newest ? difftime(time(NULL), newest) : NAN;
}

static bool watch_look_is_here(const json_t *origin)
{
    char host[256] = "";
    gethostname(host, sizeof host - 1);
    return json_object_get(json_object_get(origin, "hosts"), host) != NULL;
}

static struct watch_life_signs watch_look_signs(const char *directory, const json_t *origin)
{
    const json_t *code = json_object_get(origin, "exit_code");
    double silent = watch_look_silence(directory);
    return (struct watch_life_signs){.known = origin != NULL,
                                     .ended = json_is_integer(code),
                                     .exit_code = (int)json_integer_value(code),
                                     .locked = system_locked(directory),
                                     .here = watch_look_is_here(origin),
                                     .silent_s = isfinite(silent) ? silent : 0.0};
}

/* What the resolved case says under these keys; NaN. */
static double watch_look_wanted(const struct node *root, const char *section, const char *key)
{
    const struct node *node = tree_get(tree_get(root, section), key);
    double value = NAN;
    if (!node || node->kind != TREE_SCALAR || !text_number(node->text, &value)) value = NAN;
    return value;
}

static double watch_look_share(double t, double until, double step, double most)
{
    double share = until > 0.0 ? t / until : NAN;
    if (most > 0.0 && !(step / most < share)) share = step / most;
    return share > 1.0 ? 1.0 : share;
}

/* Time left at the mean pace so far: provenance.json is written when a run begins. One that goes on from a checkpoint
 * has done part of its work before. */
static double watch_look_left(const char *directory, const json_t *origin, double share)
{
    double passed = difftime(time(NULL), watch_file_time(directory, "provenance.json"));
    bool begun_here = json_integer_value(json_object_get(origin, "runs")) == 1;
    return begun_here && share > 0.005 && share < 1.0 && passed > 2.0 ? passed * (1.0 - share) / share : NAN;
}

static void watch_look_guard(const struct watch_row *row, json_t *run)
{
    static const char *const counts[][2] = {{"fallback", "guard_fallback"},
                                            {"relaxed", "guard_relaxed"},
                                            {"clipped", "guard_clipped"},
                                            {"retries", "guard_retries"}};
    json_t *guard = json_object();
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        json_object_set_new(guard, counts[i][0], watch_look_number(watch_row_value(row, counts[i][1])));
    json_object_set_new(run, "guard", guard);
}

/* Where it is, from the last row of the history, or of what has ended from its provenance. */
static void watch_look_progress(const char *directory, const json_t *origin, const struct node *wanted,
                                enum watch_life life, json_t *run)
{
    struct watch_row row;
    watch_row_read(directory, "history.csv", &row);
    double t = watch_row_value(&row, "t"), step = watch_row_value(&row, "step");
    const json_t *end_t = json_object_get(origin, "time"), *end_step = json_object_get(origin, "steps");
    bool at_work = life == WATCH_LIFE_RUNNING || life == WATCH_LIFE_QUIET,
         ended = !at_work && life != WATCH_LIFE_KILLED;
    if (ended && json_is_number(end_t)) t = json_number_value(end_t);
    if (ended && json_is_number(end_step)) step = json_number_value(end_step);
    double until = watch_look_wanted(wanted, "run", "until"), most = watch_look_wanted(wanted, "run", "max-steps");
    double share = watch_look_share(t, until, step, most);
    json_object_set_new(run, "t", watch_look_number(t));
    json_object_set_new(run, "until", watch_look_number(until));
    json_object_set_new(run, "step", watch_look_number(step));
    json_object_set_new(run, "dt", watch_look_number(watch_row_value(&row, "dt")));
    json_object_set_new(run, "percent", watch_look_number(100.0 * share));
    json_object_set_new(run, "left_s", watch_look_number(at_work ? watch_look_left(directory, origin, share) : NAN));
    watch_look_guard(&row, run);
    watch_row_done(&row);
}

static void watch_look_case(const char *directory, struct forest *forest, struct diag *diag, struct node **ret_root)
{
    char *text = watch_file_whole(directory, "case.yaml");
    *ret_root = parse_source(forest, diag, diag_text(diag, "case.yaml", text));
    mem_free(text);
}

static const char *watch_look_text(const json_t *object, const char *key)
{
    return json_string_value(json_object_get(object, key));
}

json_t *watch_look_short(const char *directory, const char *name)
{
    struct forest *forest = tree_forest_new();
    struct diag *diag = diag_new();
    struct node *wanted;
    watch_look_case(directory, forest, diag, &wanted);
    json_t *origin = watch_file_json(directory, "provenance.json"), *run = json_object();
    struct watch_life_signs signs = watch_look_signs(directory, origin);
    enum watch_life life = watch_life_of(&signs);
    const struct node *title = tree_get(wanted, "title");
    json_object_set_new(run, "name", watch_file_word(name, LOOK_NAME));
    json_object_set_new(run, "title",
                        watch_file_word(title && title->kind == TREE_SCALAR ? title->text : NULL, LOOK_NAME));
    json_object_set_new(run, "life", json_string(watch_life_word(life)));
    json_object_set_new(run, "says", json_string(watch_life_sentence(life, &signs)));
    json_object_set_new(run, "reason",
                        watch_file_word(signs.ended ? watch_look_text(origin, "exit_reason") : NULL, LOOK_LINE));
    json_object_set_new(run, "silent_s", watch_look_number(watch_look_silence(directory)));
    json_object_set_new(run, "started", watch_file_word(watch_look_text(origin, "started"), LOOK_NAME));
    json_object_set(run, "wall_s", json_object_get(origin, "wall_s"));
    json_object_set(run, "ranks", json_object_get(origin, "ranks"));
    watch_look_progress(directory, origin, wanted, life, run);
    json_decref(origin);
    diag_free(diag);
    tree_forest_free(forest);
    return run;
}

/* Fields of the last snapshot and the times of all. */
static void watch_look_snapshots(const char *directory, json_t *run)
{
    struct snapshot_series series = {0};
    json_t *times = json_array(), *fields = json_array();
    unsigned n = 0;
    char **names = NULL;
    if (read_series(directory, &series)) series.n = 0; /* a run need not have any */
    for (size_t i = 0; i < series.n; i++) json_array_append_new(times, watch_look_number(series.times[i]));
    if (series.n && read_names(series.paths[series.n - 1], &n, &names)) n = 0;
    for (unsigned i = 0; i < n; i++) {
        json_array_append_new(fields, watch_file_word(names[i], LOOK_NAME));
        mem_free(names[i]);
    }
    mem_free(names);
    read_series_done(&series);
    json_object_set_new(run, "times", times);
    json_object_set_new(run, "fields", fields);
}

static void watch_look_expect(const char *directory, json_t *run)
{
    json_t *root = watch_file_json(directory, "expect.json"), *list = json_array();
    const json_t *rows = json_object_get(root, "expectations");
    for (size_t i = 0; i < json_array_size(rows) && i < LOOK_ROWS; i++) {
        const json_t *row = json_array_get(rows, i), *value = json_object_get(row, "value");
        json_array_append_new(list, json_pack("{s:o, s:o, s:o, s:o, s:b}", "what",
                                              watch_file_word(watch_look_text(row, "what"), LOOK_LINE), "value",
                                              watch_look_number(json_is_number(value) ? json_number_value(value) : NAN),
                                              "bound", watch_file_word(watch_look_text(row, "bound"), LOOK_LINE),
                                              "fault", watch_file_word(watch_look_text(row, "fault"), LOOK_LINE),
                                              "passed", json_is_true(json_object_get(row, "passed"))));
    }
    json_decref(root);
    json_object_set_new(run, "expect", list);
}

static void watch_look_log(const char *directory, json_t *run)
{
    char *text = watch_file_tail(directory, "log.txt", LOOK_LINES), *rest = text;
    json_t *lines = json_array();
    for (char *line; *text && (line = strsep(&rest, "\n"));)
        json_array_append_new(lines, watch_file_word(line, LOOK_LINE));
    mem_free(text);
    json_object_set_new(run, "log", lines);
}

json_t *watch_look_whole(const char *directory, const char *name)
{
    json_t *run = watch_look_short(directory, name);
    json_object_set_new(run, "columns", watch_row_columns(directory));
    watch_look_snapshots(directory, run);
    watch_look_expect(directory, run);
    watch_look_log(directory, run);
    return run;
}
