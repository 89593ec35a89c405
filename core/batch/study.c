/* study.c - see study.h. */
#include "batch/study.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/scene_read.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>

static char *study_id(const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
    return mem_text_n(name, dot ? (size_t)(dot - name) : strlen(name));
}

/* mesh.levels of the case as it stands; 0 if it cannot be read, which its runs will report. A case with laws that make
 * tables takes seconds to read, so that is done for an expression alone. */
static int study_levels(const char *path, const struct matrix *matrix)
{
    struct scene *scene = NULL;
    if (matrix->levels >= 0) return matrix->levels;
    FILE *nowhere = fopen("/dev/null", "w");
    if (!nowhere) return 0;
    int levels = scene_read(path, &(struct scene_options){.messages = nowhere}, &scene) ? 0 : scene->mesh.levels;
    scene_free(scene);
    fclose(nowhere);
    return levels;
}

/* Counts the cells of the matrix as if all were of the finest level, and names levels: "64 x 64 + 2". */
static void study_refine(struct study *study)
{
    static const char key[] = "mesh.levels=";
    struct matrix *matrix = &study->matrix;
    int own = study_levels(study->path, matrix);
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
    TRY(matrix_read(path, NULL, &study.matrix));
    study.id = study_id(path);
    study.path = mem_text(path);
    study.rows = mem_new(study.matrix.n_row, sizeof *study.rows);
    study_refine(&study);
    *ret_study = study;
    return STATUS_OK;
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

static double study_user_time(void)
{
    struct rusage usage;
    getrusage(RUSAGE_CHILDREN, &usage);
    return (double)usage.ru_utime.tv_sec + 1e-6 * (double)usage.ru_utime.tv_usec;
}

int study_trial(const struct study_child *child, struct study_row *ret_row)
{
    double before = study_user_time();
    int state = 0;
    pid_t pid = 0;
    TRY(study_child_start(child, &pid));
    while (waitpid(pid, &state, 0) < 0 && errno == EINTR) continue;
    study_row_read(child->directory, study_child_code(state), ret_row);
    if (isnan(ret_row->cpu)) ret_row->cpu = study_user_time() - before;
    return STATUS_OK;
}

int study_run(struct study *study, unsigned index, const struct study_options *options)
{
    char *directory = mem_print("%s/%s/%u", options->directory, study->id, index);
    char *log = mem_print("%s.txt", directory);
    struct study_child child = {.path = study->path,
                                .directory = directory,
                                .log = log,
                                .ranks = options->ranks,
                                .sets = study->matrix.rows[index].sets};
    int code = study_trial(&child, &study->rows[index]);
    study->rows[index].judged = study->matrix.rows[index].count >= study->matrix.count;
    mem_free(log);
    mem_free(directory);
    return code;
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
