/* verify_hard.c - see verify_hard.h. A combination that a scene does not allow (exit code 2: thinc with a solid) counts
 * nowhere. Errors are those of the first expectation with a known truth, over that of the first combination. */
#include "batch/verify_hard.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "batch/study.h"
#include "batch/verify_file.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct verify_hard_run {
    const struct verify_hard_options *options;
    struct matrix matrix;
    char **names; /* of the scenes, sorted */
    unsigned n_name;
    struct study_row *rows; /* [n_name][matrix.n_row] */
};

/* What a combination did in all scenes. */
struct verify_hard_sum {
    unsigned legal, finish, hold, mirrored, symmetric, n_ratio;
    double *ratios; /* errors over those of the first combination, ascending; [n_ratio] */
    double worst;
    unsigned worst_scene;
    struct study_guard guard;
    double cpu;
    struct text lost; /* names of scenes that do not finish */
};

static int verify_hard_order(const void *a, const void *b)
{
    const char *one = *(char *const *)a, *other = *(char *const *)b;
    long first = strtol(one + 1, NULL, 10), second = strtol(other + 1, NULL, 10);
    return first != second ? (first < second ? -1 : 1) : strcmp(one, other);
}

static int verify_hard_ascending(const void *a, const void *b)
{
    const double *one = a, *other = b;
    return *one < *other ? -1 : *one > *other;
}

static bool verify_hard_wanted(const struct verify_hard_options *options, const char *name, size_t stem)
{
    for (int i = 0; i < options->n_word; i++) {
        size_t length = strlen(options->words[i]);
        if (strncmp(name, options->words[i], length) == 0 && (stem == length || name[length] == '-')) return true;
    }
    return options->n_word == 0;
}

static int verify_hard_scan(struct verify_hard_run *run)
{
    char *folder = mem_print("%s/cases/hard", run->options->source);
    DIR *directory = opendir(folder);
    for (struct dirent *entry; directory && (entry = readdir(directory));) {
        const char *dot = strrchr(entry->d_name, '.');
        if (!dot || strcmp(dot, ".yaml") != 0) continue;
        size_t stem = (size_t)(dot - entry->d_name);
        if (!verify_hard_wanted(run->options, entry->d_name, stem)) continue;
        run->names = mem_grow(run->names, run->n_name, run->n_name + 1, sizeof *run->names);
        run->names[run->n_name++] = mem_text_n(entry->d_name, stem);
    }
    if (directory) closedir(directory);
    mem_free(folder);
    if (run->n_name == 0) return status_fail(STATUS_CASE, "no such scenes in cases/hard");
    qsort(run->names, run->n_name, sizeof *run->names, verify_hard_order);
    return STATUS_OK;
}

static struct study_row *verify_hard_row(const struct verify_hard_run *run, unsigned scene, unsigned k)
{
    return &run->rows[scene * run->matrix.n_row + k];
}

/* The next part of a list "a + b", from `at`; moves `at` behind it. The caller frees it; NULL: there is none. */
static char *verify_hard_part(const char **at, const char *end)
{
    static const char join[] = " + ";
    const char *next = strstr(*at, join);
    if (*at >= end) return NULL;
    const char *stop = next && next < end ? next : end;
    char *part = mem_text_n(*at, (size_t)(stop - *at));
    *at = stop == end ? end : stop + strlen(join);
    return part;
}

/* "a + b=1 + 2" is two settings, "a=1" and "b=2": adds them to a list that ends with NULL. */
static char **verify_hard_split(const char *set, char **sets, unsigned *n)
{
    const char *middle = strchr(set, '='), *key = set, *value = middle + 1, *end = set + strlen(set);
    for (char *name; (name = verify_hard_part(&key, middle));) {
        char *what = verify_hard_part(&value, end);
        sets = mem_grow(sets, *n + 1, *n + 2, sizeof *sets);
        sets[(*n)++] = mem_print("%s=%s", name, what ? what : "");
        sets[*n] = NULL;
        mem_free(what);
        mem_free(name);
    }
    return sets;
}

static int verify_hard_trial(struct study_child *child, char *const *lists, struct study_row *ret_row)
{
    unsigned n = 0;
    char **sets = mem_new(1, sizeof *sets);
    for (unsigned s = 0; lists[s]; s++) sets = verify_hard_split(lists[s], sets, &n);
    child->sets = sets;
    int code = study_trial(child, ret_row);
    for (unsigned s = 0; s < n; s++) mem_free(sets[s]);
    mem_free(sets);
    return code;
}

/* All combinations of a scene, into one folder, which the next one uses again. */
static int verify_hard_scene(const struct verify_hard_run *run, unsigned scene)
{
    const struct verify_hard_options *options = run->options;
    char *path = mem_print("%s/cases/hard/%s.yaml", options->source, run->names[scene]);
    char *directory = mem_print("%s/hard/%s", options->directory, run->names[scene]);
    char *log = mem_print("%s.txt", directory);
    struct study_child child = {
        .path = path, .directory = directory, .log = log, .ranks = options->ranks, .variant = "quick"};
    int code = STATUS_OK;
    fprintf(stderr, "%s (%u of %u)\n", run->names[scene], scene + 1, run->n_name);
    for (unsigned k = 0; !code && k < run->matrix.n_row; k++)
        code = verify_hard_trial(&child, run->matrix.rows[k].sets, verify_hard_row(run, scene, k));
    mem_free(log);
    mem_free(directory);
    mem_free(path);
    return code;
}

static bool verify_hard_finished(const struct study_row *row)
{
    return row->code <= STATUS_EXPECT;
}

/* The first value of a run with a known truth; NULL: none. */
static const struct study_value *verify_hard_value(const struct study_row *row)
{
    for (unsigned v = 0; v < row->n_value; v++)
        if (isfinite(study_row_error(&row->values[v]))) return &row->values[v];
    return NULL;
}

static double verify_hard_error(const struct study_row *row)
{
    const struct study_value *value = verify_hard_value(row);
    return value ? study_row_error(value) : NAN;
}

/* Are all mirror images equal? -1: none was looked at. */
static int verify_hard_symmetric(const struct study_row *row)
{
    int symmetric = -1;
    for (unsigned v = 0; v < row->n_value; v++) {
        const struct study_value *value = &row->values[v];
        if (!value->reference || strncmp(value->reference, "mirror-", 7) != 0) continue;
        symmetric = symmetric != 0 && value->value == 0;
    }
    return symmetric;
}

static void verify_hard_ratio(const struct verify_hard_run *run, struct verify_hard_sum *sum, unsigned scene,
                              unsigned k)
{
    double ratio =
        verify_hard_error(verify_hard_row(run, scene, k)) / verify_hard_error(verify_hard_row(run, scene, 0));
    if (!isfinite(ratio)) return;
    sum->ratios[sum->n_ratio++] = ratio;
    if (!(ratio > sum->worst)) return;
    sum->worst = ratio;
    sum->worst_scene = scene;
}

static void verify_hard_add(const struct verify_hard_run *run, struct verify_hard_sum *sum, unsigned scene, unsigned k)
{
    const struct study_row *row = verify_hard_row(run, scene, k);
    int symmetric = verify_hard_symmetric(row);
    if (row->code == STATUS_CASE) return;
    sum->legal++;
    if (!verify_hard_finished(row)) {
        text_add(&sum->lost, "%s%s", sum->lost.length ? ", " : "", run->names[scene]);
        return;
    }
    sum->finish++;
    sum->hold += row->code == STATUS_OK;
    sum->mirrored += symmetric >= 0;
    sum->symmetric += symmetric > 0;
    sum->guard.fallback += row->guard.fallback;
    sum->guard.relaxed += row->guard.relaxed;
    sum->guard.clipped += row->guard.clipped;
    sum->guard.retries += row->guard.retries;
    sum->cpu += row->cpu;
    verify_hard_ratio(run, sum, scene, k);
}

static struct verify_hard_sum verify_hard_sum_of(const struct verify_hard_run *run, unsigned k)
{
    struct verify_hard_sum sum = {.ratios = mem_new(run->n_name, sizeof(double))};
    for (unsigned scene = 0; scene < run->n_name; scene++) verify_hard_add(run, &sum, scene, k);
    qsort(sum.ratios, sum.n_ratio, sizeof *sum.ratios, verify_hard_ascending);
    return sum;
}

/* The values of a combination, as cells of a table: "kapila | hllc | ...". */
static void verify_hard_settings(struct text *out, const struct matrix *matrix, unsigned k)
{
    for (unsigned s = 0; s < matrix->n_set; s++) text_add(out, " %s |", strchr(matrix->rows[k].sets[s], '=') + 1);
}

/* The keys of a setting without what all begin with: "limiter + interface-limiter". */
static void verify_hard_key(struct text *out, const char *set)
{
    const char *at = set, *end = strchr(set, '='), *between = " ";
    for (char *key; (key = verify_hard_part(&at, end)); between = " + ") {
        const char *dot = strrchr(key, '.');
        text_add(out, "%s%s", between, dot ? dot + 1 : key);
        mem_free(key);
    }
    text_add(out, " |");
}

static void verify_hard_combination(struct text *out, const struct verify_hard_run *run, unsigned k)
{
    struct verify_hard_sum sum = verify_hard_sum_of(run, k);
    text_add(out, "| %u |", k + 1);
    verify_hard_settings(out, &run->matrix, k);
    text_add(out, " %u/%u | %u | %u/%u |", sum.finish, sum.legal, sum.hold, sum.symmetric, sum.mirrored);
    if (sum.n_ratio)
        text_add(out, " %.2f | %.3g (%s) |", sum.ratios[sum.n_ratio / 2], sum.worst, run->names[sum.worst_scene]);
    else text_add(out, " | |");
    text_add(out, " %.3g | %.3g | %.2g | %.3g | %.1f | %s |\n", sum.guard.fallback, sum.guard.relaxed,
             sum.guard.clipped, sum.guard.retries, sum.cpu, sum.lost.at ? sum.lost.at : "");
    text_done(&sum.lost);
    mem_free(sum.ratios);
}

static void verify_hard_combinations(struct text *out, const struct verify_hard_run *run)
{
    text_add(out, "| |");
    for (unsigned s = 0; s < run->matrix.n_set; s++) verify_hard_key(out, run->matrix.rows[0].sets[s]);
    text_add(
        out,
        " finish | hold | symmetric | error / 1: median | worst | first order | relaxed | clipped | halved | CPU s "
        "| do not finish |\n| ---: |");
    for (unsigned s = 0; s < run->matrix.n_set; s++) text_add(out, " --- |");
    text_add(out, " ---: | ---: | ---: | ---: | --- | ---: | ---: | ---: | ---: | ---: | --- |\n");
    for (unsigned k = 0; k < run->matrix.n_row; k++) verify_hard_combination(out, run, k);
}

/* One cell: the error over that of the first combination, or "ok" where no truth is known; then what the guard
 * repaired. */
static void verify_hard_cell(struct text *out, const struct study_row *row, double first)
{
    double ratio = verify_hard_error(row) / first, repairs = row->guard.fallback + row->guard.relaxed;
    if (row->code == STATUS_CASE) text_add(out, " - |");
    else if (!verify_hard_finished(row)) text_add(out, " **%d** |", row->code);
    else {
        if (isfinite(ratio)) text_add(out, " %.3g", ratio);
        else text_add(out, " ok");
        if (row->guard.retries > 0) text_add(out, " h%g", row->guard.retries);
        if (repairs > 0) text_add(out, " r%.2g", repairs);
        text_add(out, "%s |", verify_hard_symmetric(row) == 0 ? " skew" : "");
    }
}

static void verify_hard_scenes(struct text *out, const struct verify_hard_run *run)
{
    text_add(out, "\n| scene | error of 1 | CPU s |");
    for (unsigned k = 0; k < run->matrix.n_row; k++) text_add(out, " %u |", k + 1);
    text_add(out, "\n| --- | --- | ---: |");
    for (unsigned k = 0; k < run->matrix.n_row; k++) text_add(out, " ---: |");
    text_add(out, "\n");
    for (unsigned scene = 0; scene < run->n_name; scene++) {
        const struct study_row *first = verify_hard_row(run, scene, 0);
        const struct study_value *value = verify_hard_value(first);
        text_add(out, "| %s |", run->names[scene]);
        if (value) text_add(out, " %s %.3g |", value->what, study_row_error(value));
        else text_add(out, " |");
        text_add(out, " %.2f |", first->cpu);
        for (unsigned k = 0; k < run->matrix.n_row; k++)
            verify_hard_cell(out, verify_hard_row(run, scene, k), verify_hard_error(first));
        text_add(out, "\n");
    }
}

static int verify_hard_print(const struct verify_hard_run *run)
{
    struct text table = {0};
    int code = STATUS_OK;
    verify_hard_combinations(&table, run);
    verify_hard_scenes(&table, run);
    printf("\n## %s\n\n%s", run->matrix.title, table.at);
    fflush(stdout);
    if (run->options->save) {
        char *path = mem_print("%s/docs/hard.md", run->options->source);
        code = verify_file_save(path, "hard", run->matrix.title, table.at);
        mem_free(path);
    }
    text_done(&table);
    return code;
}

int verify_hard(const struct verify_hard_options *options)
{
    struct verify_hard_run run = {.options = options};
    char *path = mem_print("%s/cases/hard.yaml", options->source);
    char *folder = mem_print("%s/hard", options->directory);
    int code = matrix_read(path, NULL, &run.matrix);
    if (!code) code = verify_hard_scan(&run);
    if (!code) code = verify_file_folder(folder);
    if (!code) run.rows = mem_new((size_t)run.n_name * run.matrix.n_row, sizeof *run.rows);
    for (unsigned scene = 0; !code && scene < run.n_name; scene++) code = verify_hard_scene(&run, scene);
    if (!code) code = verify_hard_print(&run);
    for (size_t i = 0; run.rows && i < (size_t)run.n_name * run.matrix.n_row; i++) study_row_done(&run.rows[i]);
    for (unsigned i = 0; i < run.n_name; i++) mem_free(run.names[i]);
    mem_free(run.rows);
    mem_free(run.names);
    matrix_done(&run.matrix);
    mem_free(folder);
    mem_free(path);
    return code;
}
