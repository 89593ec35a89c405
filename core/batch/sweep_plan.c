/* sweep_plan.c - see sweep_plan.h. */
#include "batch/sweep_plan.h"

#include "base/mem.h"
#include "base/status.h"
#include "batch/sweep_name.h"
#include "case/scene_read.h"

#include <stdlib.h>
#include <string.h>

enum { SWEEP_PLAN_WRONG = 5 }; /* most combinations whose mistakes are printed */

/* Messages of combinations, each text once: most of them say the same. */
struct sweep_plan_messages {
    char **texts;
    unsigned n;
};

static void sweep_plan_say(struct sweep_plan_messages *messages, const char *text)
{
    for (unsigned i = 0; i < messages->n; i++)
        if (strcmp(messages->texts[i], text) == 0) return;
    messages->texts = mem_grow(messages->texts, messages->n, messages->n + 1, sizeof *messages->texts);
    messages->texts[messages->n++] = mem_text(text);
    fputs(text, stderr);
}

static int sweep_plan_read(const struct sweep_plan *plan, const struct sweep_plan_row *row,
                           struct sweep_plan_messages *messages, struct scene **ret_scene)
{
    char *text = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&text, &length);
    if (!stream) return status_fail(STATUS_RUN, "no memory for messages");
    struct scene_options options = {.sets = (const char *const *)(row ? row->sets : plan->sets),
                                    .variant = plan->variant,
                                    .directory = row ? row->directory : NULL,
                                    .messages = stream};
    int code = scene_read(plan->path, &options, ret_scene);
    fclose(stream);
    if (messages && text) sweep_plan_say(messages, text);
    free(text);
    return code;
}

int sweep_plan_scene(const struct sweep_plan *plan, unsigned index, struct scene **ret_scene)
{
    return sweep_plan_read(plan, &plan->rows[index], NULL, ret_scene);
}

/* A setting for all combinations that a list of the matrix would take back in each. */
static int sweep_plan_contradiction(const struct sweep_plan *plan)
{
    for (unsigned i = 0; plan->sets[i]; i++) {
        size_t length = strcspn(plan->sets[i], "=");
        for (unsigned k = 0; k < plan->matrix.n_set; k++) {
            const char *set = plan->matrix.rows[0].sets[k];
            if (strcspn(set, "=") != length || strncmp(set, plan->sets[i], length) != 0) continue;
            return status_fail(
                STATUS_CASE,
                "--set %.*s: the matrix has a list for it; --set 'matrix[%.*s]=[...]' replaces the list, "
                "--set 'matrix[%.*s]=null' takes it out",
                (int)length, set, (int)length, set, (int)length, set);
        }
    }
    return STATUS_OK;
}

static int sweep_plan_options(const struct cli_given *given, struct sweep_plan *plan)
{
    unsigned n = 0;
    plan->path = given->words[0];
    plan->variant = cli_value(given, "--variant");
    plan->sets = mem_new((size_t)given->n_option + 1, sizeof *plan->sets);
    for (int i = 0; i < given->n_option; i++)
        if (!strcmp(given->options[i]->name, "--set")) plan->sets[n++] = mem_text(given->values[i]);
    struct merge_options options = {(const char *const *)plan->sets, plan->variant};
    TRY(matrix_read(plan->path, &options, &plan->matrix));
    if (plan->matrix.n_set == 0)
        return status_fail(STATUS_CASE,
                           "%s has no 'matrix:' to combine; give it one, as in --set "
                           "'matrix[scheme.cfl]=[0.2, 0.4]', or use bulla run",
                           plan->path);
    return sweep_plan_contradiction(plan);
}

/* Names, directories and settings of all rows. */
static int sweep_plan_rows(struct sweep_plan *plan)
{
    const struct matrix *matrix = &plan->matrix;
    char **names;
    unsigned n_own = 0;
    TRY(sweep_name_all(matrix, &names));
    while (plan->sets[n_own]) n_own++;
    plan->rows = mem_new(matrix->n_row, sizeof *plan->rows);
    for (unsigned i = 0; i < matrix->n_row; i++) {
        struct sweep_plan_row *row = &plan->rows[i];
        row->name = names[i];
        row->directory = mem_print("%s/%s", plan->directory, names[i]);
        row->sets = mem_new(n_own + matrix->n_set + 1, sizeof *row->sets);
        for (unsigned k = 0; k < n_own; k++) row->sets[k] = plan->sets[k];
        for (unsigned k = 0; k < matrix->n_set; k++) row->sets[n_own + k] = matrix->rows[i].sets[k];
    }
    mem_free(names);
    return STATUS_OK;
}

/* All combinations must be right before the first one runs. */
static int sweep_plan_check(struct sweep_plan *plan, struct sweep_plan_messages *messages)
{
    unsigned wrong = 0;
    for (unsigned i = 0; i < plan->matrix.n_row && wrong < SWEEP_PLAN_WRONG; i++) {
        struct scene *scene = NULL;
        int code = sweep_plan_read(plan, &plan->rows[i], messages, &scene);
        if (code > STATUS_CASE) return code;
        if (code) {
            fprintf(stderr, "in the combination %s\n", plan->rows[i].name);
            wrong++;
            continue;
        }
        plan->rows[i].resolved = mem_text(scene->resolved);
        scene_free(scene);
    }
    if (!wrong) return STATUS_OK;
    return status_fail(STATUS_CASE, "%s: %s%u of %u combinations cannot run; nothing was run", plan->path,
                       wrong == SWEEP_PLAN_WRONG ? "at least " : "", wrong, plan->matrix.n_row);
}

/* DIRECTORY of -o, or that of the case with "-sweep" behind it. */
static int sweep_plan_place(const struct cli_given *given, struct sweep_plan *plan,
                            struct sweep_plan_messages *messages)
{
    const char *directory = cli_value(given, "--output");
    struct scene *scene = NULL;
    TRY(sweep_plan_read(plan, NULL, messages, &scene));
    plan->directory = directory ? mem_text(directory) : mem_print("%s-sweep", scene->output.directory);
    scene_free(scene);
    return STATUS_OK;
}

void sweep_plan_look(struct sweep_plan *plan)
{
    for (unsigned i = 0; i < plan->matrix.n_row; i++) {
        struct sweep_plan_row *row = &plan->rows[i];
        mem_free(row->difference);
        row->found = sweep_look_at(row->directory, row->resolved, &row->difference);
    }
}

int sweep_plan_make(const struct cli_given *given, struct sweep_plan *ret_plan)
{
    struct sweep_plan plan = {0};
    struct sweep_plan_messages messages = {0};
    int code = sweep_plan_options(given, &plan);
    if (!code) code = sweep_plan_place(given, &plan, &messages);
    if (!code) code = sweep_plan_rows(&plan);
    if (!code) code = sweep_plan_check(&plan, &messages);
    if (!code) sweep_plan_look(&plan);
    for (unsigned i = 0; i < messages.n; i++) mem_free(messages.texts[i]);
    mem_free(messages.texts);
    if (code) sweep_plan_done(&plan);
    else *ret_plan = plan;
    return code;
}

void sweep_plan_done(struct sweep_plan *plan)
{
    for (unsigned i = 0; plan->rows && i < plan->matrix.n_row; i++) {
        struct sweep_plan_row *row = &plan->rows[i];
        char *texts[] = {row->name, row->directory, row->resolved, row->difference};
        for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) mem_free(texts[k]);
        mem_free(row->sets);
    }
    for (unsigned i = 0; plan->sets && plan->sets[i]; i++) mem_free(plan->sets[i]);
    mem_free(plan->sets);
    mem_free(plan->rows);
    mem_free(plan->directory);
    matrix_done(&plan->matrix);
    *plan = (struct sweep_plan){0};
}
