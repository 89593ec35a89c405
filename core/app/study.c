/* study.c - see study.h. */
#include "app/study.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/scene.h"

#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static char *study_id(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
    return mem_text_n(name, dot ? (size_t)(dot - name) : strlen(name));
}

/* mesh.levels of the case as it stands; 0 if it cannot be read, which its runs will report. */
static int study_levels(const char *path)
{
    struct scene *scene = NULL;
    FILE *nowhere = fopen("/dev/null", "w");
    if (!nowhere) return 0;
    int levels = scene_read(path, &(struct scene_options){.messages = nowhere}, &scene) ? 0 : scene->levels;
    scene_free(scene);
    fclose(nowhere);
    return levels;
}

/* Counts the cells of the matrix as if all were of the finest level, and names levels: "64 x 64 + 2". */
static void study_refine(struct study *study)
{
    static const char key[] = "mesh.levels=";
    struct matrix *matrix = &study->matrix;
    int own = study_levels(study->path);
    unsigned dim = matrix->n_row ? matrix->rows[0].dim : 1;
    matrix->count = ldexp(matrix->count, own * (int)dim);
    for (unsigned i = 0; i < matrix->n_row; i++) {
        struct matrix_row *row = &matrix->rows[i];
        int levels = own;
        for (unsigned k = 0; k < matrix->n_set; k++)
            if (strncmp(row->sets[k], key, strlen(key)) == 0)
                levels = (int)strtol(row->sets[k] + strlen(key), NULL, 10);
        if (levels <= 0) continue;
        char *base = row->cells;
        row->cells = mem_print("%s + %d", base, levels);
        row->count = ldexp(row->count, levels * (int)row->dim);
        study->levels = true;
        mem_free(base);
    }
}

int study_new(const char *path, struct study *ret_study)
{
    struct study study = {0};
    TRY(matrix_read(path, &study.matrix));
    study.id = study_id(path);
    study.path = mem_text(path);
    study.rows = mem_new(study.matrix.n_row, sizeof *study.rows);
    study_refine(&study);
    *ret_study = study;
    return STATUS_OK;
}

static void study_row_done(struct study_row *row)
{
    for (unsigned v = 0; v < row->n_value; v++) {
        mem_free(row->values[v].what);
        mem_free(row->values[v].bound);
    }
    mem_free(row->values);
    *row = (struct study_row){0};
}

void study_done(struct study *study)
{
    for (unsigned i = 0; i < study->matrix.n_row; i++) study_row_done(&study->rows[i]);
    mem_free(study->rows);
    mem_free(study->id);
    mem_free(study->path);
    matrix_done(&study->matrix);
    *study = (struct study){0};
}

static double study_number(const json_t *object, const char *key, double fallback)
{
    const json_t *item = json_object_get(object, key);
    return json_is_number(item) ? json_number_value(item) : fallback;
}

/* expect.json of a run. A run that failed has none. */
static void study_read(const char *directory, struct study_row *row)
{
    char *path = mem_print("%s/expect.json", directory);
    json_t *root = json_load_file(path, 0, NULL), *list = json_object_get(root, "expectations");
    row->n_value = (unsigned)json_array_size(list);
    row->values = mem_new(row->n_value, sizeof *row->values);
    for (unsigned v = 0; v < row->n_value; v++) {
        const json_t *item = json_array_get(list, v);
        row->values[v] = (struct study_value){
            .what = mem_text(json_string_value(json_object_get(item, "what"))),
            .bound = mem_text(json_string_value(json_object_get(item, "bound"))),
            .value = study_number(item, "value", NAN),
            .order = study_number(item, "order", 0),
            .passed = json_is_true(json_object_get(item, "passed")),
            .is_norm = json_is_string(json_object_get(item, "norm")),
        };
    }
    json_decref(root);
    mem_free(path);
}

/* CPU time as the run counted it, without start and judgement; `fallback` if it could not write that.
 * Cells are counted in both stages of a step. */
static void study_cost(const char *directory, double fallback, struct study_row *row)
{
    char *path = mem_print("%s/provenance.json", directory);
    json_t *root = json_load_file(path, 0, NULL);
    row->cpu = study_number(root, "cpu_s", fallback);
    row->work = study_number(root, "cells_updated", 0) / 2;
    json_decref(root);
    mem_free(path);
}

/* In the child: becomes `bulla run ...`, its terminal output in DIRECTORY.txt. */
static void study_become(const struct study *study, unsigned index, const struct study_options *options,
                         const char *directory)
{
    const struct matrix *matrix = &study->matrix;
    char **arguments = mem_new(2 * matrix->n_set + 10, sizeof *arguments);
    unsigned n = 0;
    char *fixed[] = {"bulla", "run", study->path, "--quiet", "--overwrite", "-o", (char *)(uintptr_t)directory};
    for (size_t i = 0; i < sizeof fixed / sizeof *fixed; i++) arguments[n++] = fixed[i];
    if (options->ranks) {
        arguments[n++] = "-n";
        arguments[n++] = (char *)(uintptr_t)options->ranks;
    }
    for (unsigned k = 0; k < matrix->n_set; k++) {
        arguments[n++] = "--set";
        arguments[n++] = matrix->rows[index].sets[k];
    }
    char *log = mem_print("%s.txt", directory);
    int file = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0) {
        dup2(file, STDOUT_FILENO);
        dup2(file, STDERR_FILENO);
    }
    execv("/proc/self/exe", arguments);
    _exit(STATUS_RUN);
}

static double study_user_time(void)
{
    struct rusage usage;
    getrusage(RUSAGE_CHILDREN, &usage);
    return (double)usage.ru_utime.tv_sec + 1e-6 * (double)usage.ru_utime.tv_usec;
}

int study_run(struct study *study, unsigned index, const struct study_options *options)
{
    struct study_row *row = &study->rows[index];
    char *directory = mem_print("%s/%s/%u", options->directory, study->id, index);
    double before = study_user_time();
    int state = 0;
    study_row_done(row);
    pid_t child = fork();
    if (child == 0) study_become(study, index, options, directory);
    while (child > 0 && waitpid(child, &state, 0) < 0 && errno == EINTR) continue;
    if (child < 0) {
        mem_free(directory);
        return status_fail(STATUS_RUN, "cannot start a run: %s", strerror(errno));
    }
    row->code = WIFEXITED(state) ? WEXITSTATUS(state) : STATUS_RUN;
    study_cost(directory, study_user_time() - before, row);
    row->judged = study->matrix.rows[index].count >= study->matrix.count;
    if (row->code <= STATUS_EXPECT) study_read(directory, row);
    mem_free(directory);
    return STATUS_OK;
}

double study_order(const struct study *study, unsigned from, unsigned to, unsigned v)
{
    const struct matrix_row *coarse = &study->matrix.rows[from], *fine = &study->matrix.rows[to];
    const struct study_row *before = &study->rows[from], *after = &study->rows[to];
    if (!(coarse->count > 0) || !(fine->count > coarse->count) || v >= before->n_value || v >= after->n_value)
        return NAN;
    double ratio = pow(fine->count / coarse->count, 1.0 / fine->dim);
    return log(before->values[v].value / after->values[v].value) / log(ratio);
}

static bool study_row_passed(const struct study_row *row)
{
    return row->code == STATUS_OK || (row->code == STATUS_EXPECT && !row->judged);
}

static bool study_orders_passed(const struct study *study)
{
    unsigned last = study->matrix.n_row - 1;
    for (unsigned v = 0; v < study->rows[last].n_value; v++) {
        double wanted = study->rows[last].values[v].order;
        if (last == 0 || !(wanted > 0)) continue;
        if (!(study_order(study, last - 1, last, v) >= wanted) && !(study_order(study, 0, last, v) >= wanted))
            return false;
    }
    return true;
}

bool study_passed(const struct study *study)
{
    for (unsigned i = 0; i < study->matrix.n_row; i++)
        if (!study_row_passed(&study->rows[i])) return false;
    return study_orders_passed(study);
}
