/* verify_beside.c - see verify_beside.h. Scenes in which no value changes by a bit (a setting that says nothing to
 * them) are counted, not listed. */
#include "batch/verify_beside.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "batch/study.h"
#include "batch/verify_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* An error that grows by more than this is named. */
#define VERIFY_BESIDE_WORSE 1.15

struct verify_beside_scene {
    char *name;
    struct study_row rows[2]; /* as it is, and with the settings */
    unsigned worst;           /* the value whose error grows most */
    double ratio;             /* of its errors; NaN: no truth is known to any value */
    bool same;                /* no value differs */
};

struct verify_beside_run {
    const struct verify_beside_options *options;
    struct verify_beside_scene *scenes; /* [n_path] */
};

static char *verify_beside_name(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    return mem_text_n(name, strlen(name) - strlen(".yaml"));
}

static void verify_beside_compare(struct verify_beside_scene *scene)
{
    const struct study_row *before = &scene->rows[0], *after = &scene->rows[1];
    unsigned n = before->n_value < after->n_value ? before->n_value : after->n_value;
    scene->same = before->code == after->code && before->n_value == after->n_value;
    scene->ratio = NAN;
    for (unsigned v = 0; v < n; v++) {
        double old = before->values[v].value, now = after->values[v].value;
        double ratio = study_row_error(&after->values[v]) / study_row_error(&before->values[v]);
        if (old != now && !(isnan(old) && isnan(now))) scene->same = false;
        if (!isfinite(ratio) || ratio <= scene->ratio) continue;
        scene->ratio = ratio;
        scene->worst = v;
    }
}

/* The coarse variant, or what there is where a scene has none. */
static int verify_beside_trial(struct study_child *child, struct study_row *ret_row)
{
    child->variant = "quick";
    TRY(study_trial(child, ret_row));
    child->variant = NULL;
    return ret_row->code == STATUS_CASE ? study_trial(child, ret_row) : STATUS_OK;
}

static int verify_beside_scene(struct verify_beside_run *run, unsigned index)
{
    const struct verify_beside_options *options = run->options;
    struct verify_beside_scene *scene = &run->scenes[index];
    scene->name = verify_beside_name(options->paths[index]);
    char *directory = mem_print("%s/beside/%s", options->directory, scene->name);
    char *log = mem_print("%s.txt", directory);
    struct study_child child = {.path = options->paths[index],
                                .directory = directory,
                                .log = log,
                                .ranks = options->ranks,
                                .sets = options->plain};
    fprintf(stderr, "%s (%u of %u)\n", scene->name, index + 1, options->n_path);
    int code = verify_beside_trial(&child, &scene->rows[0]);
    child.sets = options->beside;
    if (!code) code = verify_beside_trial(&child, &scene->rows[1]);
    verify_beside_compare(scene);
    mem_free(log);
    mem_free(directory);
    return code;
}

static const char *verify_beside_word(const struct study_row *row)
{
    return row->code == STATUS_OK ? "yes" : row->code == STATUS_EXPECT ? "no" : "**stops**";
}

static void verify_beside_line(struct text *out, const struct verify_beside_scene *scene)
{
    const struct study_row *before = &scene->rows[0], *after = &scene->rows[1];
    text_add(out, "| %s |", scene->name);
    if (isfinite(scene->ratio)) {
        const struct study_value *old = &before->values[scene->worst], *now = &after->values[scene->worst];
        const char *mark = scene->ratio > VERIFY_BESIDE_WORSE ? "**" : "";
        text_add(out, " %s | %.4g | %.4g | %s%.3g%s |", old->what, old->value, now->value, mark, scene->ratio, mark);
    } else text_add(out, " | | | |");
    text_add(out, " %.2f | %.2f | %s | %s |\n", before->cpu, after->cpu, verify_beside_word(before),
             verify_beside_word(after));
}

static int verify_beside_ascending(const void *a, const void *b)
{
    const double *one = a, *other = b;
    return *one < *other ? -1 : *one > *other;
}

/* Median of the ratios, how many are named, and times. */
static void verify_beside_sum(struct text *out, const struct verify_beside_run *run)
{
    unsigned n = run->options->n_path, n_ratio = 0, same = 0, worse = 0;
    double *ratios = mem_new(n, sizeof *ratios), cpu[2] = {0};
    for (const struct verify_beside_scene *scene = run->scenes; scene < run->scenes + n; scene++) {
        same += scene->same;
        if (scene->same) continue;
        for (int i = 0; i < 2; i++) cpu[i] += scene->rows[i].cpu;
        worse += scene->ratio > VERIFY_BESIDE_WORSE;
        if (isfinite(scene->ratio)) ratios[n_ratio++] = scene->ratio;
    }
    qsort(ratios, n_ratio, sizeof *ratios, verify_beside_ascending);
    text_add(out, "\n%u scenes, %u of them without any change.", n, same);
    if (n_ratio)
        text_add(
            out,
            " Of the others the error that changes most is %.3g times what it was in the middle, in %u more than %g.",
            ratios[n_ratio / 2], worse, VERIFY_BESIDE_WORSE);
    text_add(out, " CPU seconds with start and output: %.1f and %.1f.\n", cpu[0], cpu[1]);
    mem_free(ratios);
}

static int verify_beside_print(const struct verify_beside_run *run)
{
    struct text table = {0};
    const char *title = run->options->title;
    int code = STATUS_OK;
    text_add(&table,
             "| scene | error that changes most | as it is | beside | ratio | CPU s | beside | holds | beside |\n"
             "| --- | --- | ---: | ---: | ---: | ---: | ---: | --- | --- |\n");
    for (unsigned i = 0; i < run->options->n_path; i++)
        if (!run->scenes[i].same) verify_beside_line(&table, &run->scenes[i]);
    verify_beside_sum(&table, run);
    printf("\n## %s\n\n%s", title, table.at);
    fflush(stdout);
    if (run->options->save) {
        char *path = mem_print("%s/docs/beside.md", run->options->source ? run->options->source : ".");
        code = verify_file_save(path, title, title, table.at);
        mem_free(path);
    }
    text_done(&table);
    return code;
}

int verify_beside(const struct verify_beside_options *options)
{
    struct verify_beside_run run = {.options = options};
    char *folder = mem_print("%s/beside", options->directory);
    int code = verify_file_folder(folder);
    run.scenes = mem_new(options->n_path, sizeof *run.scenes);
    for (unsigned i = 0; !code && i < options->n_path; i++) code = verify_beside_scene(&run, i);
    if (!code) code = verify_beside_print(&run);
    for (unsigned i = 0; i < options->n_path; i++) {
        for (int r = 0; r < 2; r++) study_row_done(&run.scenes[i].rows[r]);
        mem_free(run.scenes[i].name);
    }
    mem_free(run.scenes);
    mem_free(folder);
    return code;
}
