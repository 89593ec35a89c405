/* verify_cost.c - see verify_cost.h. CPU time is that of the steps: starting a run takes 0.03 s, which says nothing of
 * a scheme, and output is the scene's own affair. */
#include "batch/verify_cost.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "batch/study.h"
#include "batch/verify_file.h"
#include "batch/verify_point.h"
#include "case/show.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct verify_cost_run {
    const struct verify_cost_options *options;
    const char *id;
    const struct node *scene, *schemes; /* of cases/cost.yaml */
    struct matrix matrix;               /* sizes */
    struct verify_point *points;        /* [n_point]: by scheme, then by size; then those of others */
    unsigned n_point;
};

/* Adds "scheme.limiter=koren" for each entry of a map. */
static char **verify_cost_sets(const struct node *map, const char *prefix, char **sets, unsigned *n)
{
    for (unsigned k = 0; map && map->kind == TREE_MAP && k < map->count; k++) {
        struct text text = {0};
        text_add(&text, "%s%s=", prefix, map->keys[k]->text);
        show_value(map->items[k], &text);
        sets = mem_grow(sets, *n + 1, *n + 2, sizeof *sets);
        sets[(*n)++] = text.at;
        sets[*n] = NULL;
    }
    return sets;
}

/* "64 x 32 + 1": cells, and levels where there are any. */
static char *verify_cost_size(const struct matrix_row *row, unsigned n_set)
{
    static const char levels[] = "mesh.levels=";
    for (unsigned s = 0; s < n_set; s++)
        if (strncmp(row->sets[s], levels, strlen(levels)) == 0 && strcmp(row->sets[s] + strlen(levels), "0") != 0)
            return mem_print("%s + %s", row->cells, row->sets[s] + strlen(levels));
    return mem_text(row->cells);
}

/* The error that the scene names, or the first that there is. */
static double verify_cost_error(const struct study_row *row, const char *what)
{
    for (unsigned v = 0; v < row->n_value; v++) {
        double error = study_row_error(&row->values[v]);
        if (what ? strcmp(row->values[v].what, what) == 0 : isfinite(error)) return error;
    }
    return NAN;
}

static const char *verify_cost_text(const struct node *map, const char *key)
{
    const struct node *node = tree_get(map, key);
    return node && node->kind == TREE_SCALAR ? node->text : NULL;
}

static int verify_cost_trial(struct verify_cost_run *run, const struct study_child *child, struct verify_point *point)
{
    struct study_row row = {0};
    TRY(study_trial(child, &row));
    point->error = verify_cost_error(&row, verify_cost_text(run->scene, "error"));
    point->cpu = row.steps_cpu;
    point->cell_steps = row.work;
    point->code = row.code;
    study_row_done(&row);
    return STATUS_OK;
}

/* The settings of a run: of the scheme, of the scene, of the mesh; [*n], then NULL. All are the caller's. */
static char **verify_cost_settings(const struct verify_cost_run *run, unsigned scheme, unsigned size, unsigned *n)
{
    char **sets = mem_new(1, sizeof *sets);
    sets = verify_cost_sets(run->schemes->items[scheme], "scheme.", sets, n);
    sets = verify_cost_sets(tree_get(run->scene, "set"), "", sets, n);
    for (unsigned s = 0; s < run->matrix.n_set; s++) {
        sets = mem_grow(sets, *n + 1, *n + 2, sizeof *sets);
        sets[(*n)++] = mem_text(run->matrix.rows[size].sets[s]);
        sets[*n] = NULL;
    }
    return sets;
}

/* One scheme on one mesh. */
static int verify_cost_point(struct verify_cost_run *run, unsigned scheme, unsigned size)
{
    const struct verify_cost_options *options = run->options;
    struct verify_point *point = &run->points[run->n_point++];
    char *path = mem_print("%s/cases/%s.yaml", options->source, verify_cost_text(run->scene, "case"));
    char *directory = mem_print("%s/cost/%s", options->directory, run->id), *log = mem_print("%s.txt", directory);
    unsigned n = 0;
    char **sets = verify_cost_settings(run, scheme, size, &n);
    *point = (struct verify_point){.scheme = mem_text(run->schemes->keys[scheme]->text),
                                   .cells = verify_cost_size(&run->matrix.rows[size], run->matrix.n_set)};
    struct study_child child = {
        .path = path, .directory = directory, .log = log, .ranks = options->ranks, .sets = sets};
    fprintf(stderr, "%s: %s, %s\n", run->id, point->scheme, point->cells);
    int code = verify_cost_trial(run, &child, point);
    for (unsigned s = 0; s < n; s++) mem_free(sets[s]);
    mem_free(sets);
    mem_free(log);
    mem_free(directory);
    mem_free(path);
    return code;
}

/* The rows of other codes: name: [[CPU seconds, error], ...]. */
static void verify_cost_others(struct verify_cost_run *run)
{
    const struct node *others = tree_get(run->scene, "others");
    for (unsigned k = 0; others && k < others->count; k++)
        for (unsigned i = 0; i < others->items[k]->count; i++) {
            const struct node *pair = others->items[k]->items[i];
            struct verify_point point = {.scheme = mem_text(others->keys[k]->text),
                                         .cells = mem_text(""),
                                         .other = true};
            if (pair->kind == TREE_LIST && pair->count == 2) {
                text_number(pair->items[0]->text, &point.cpu);
                text_number(pair->items[1]->text, &point.error);
            }
            run->points = mem_grow(run->points, run->n_point, run->n_point + 1, sizeof *run->points);
            run->points[run->n_point++] = point;
        }
}

static int verify_cost_all(struct verify_cost_run *run)
{
    run->points = mem_new((size_t)run->schemes->count * run->matrix.n_row, sizeof *run->points);
    for (unsigned scheme = 0; scheme < run->schemes->count; scheme++)
        for (unsigned size = 0; size < run->matrix.n_row; size++) TRY(verify_cost_point(run, scheme, size));
    verify_point_front(run->points, run->n_point);
    verify_cost_others(run);
    return STATUS_OK;
}

/* Table, CSV and picture. */
static int verify_cost_write(const struct verify_cost_run *run)
{
    const struct verify_cost_options *options = run->options;
    char *csv = mem_print("%s/cost/%s.csv", options->directory, run->id);
    char *png = options->save ? mem_print("%s/docs/images/cost-%s.png", options->source, run->id)
                              : mem_print("%s/cost/%s.png", options->directory, run->id);
    char *page = mem_print("%s/docs/cost.md", options->source);
    const char *title = verify_cost_text(run->scene, "title");
    struct text table = {0};
    verify_point_table(&table, run->points, run->n_point, run->matrix.n_row);
    printf("\n## %s\n\n%s", title ? title : run->id, table.at);
    fflush(stdout);
    int code = verify_point_csv(csv, title ? title : run->id, run->points, run->n_point);
    if (!code && options->save) code = verify_file_save(page, run->id, title ? title : run->id, table.at);
    if (!code) code = verify_point_picture(csv, png);
    text_done(&table);
    mem_free(page);
    mem_free(png);
    mem_free(csv);
    return code;
}

static int verify_cost_scene(struct verify_cost_run *run, const struct node *root)
{
    run->scene = tree_get(tree_get(root, "scenes"), run->id);
    const struct node *own = tree_get(run->scene, "schemes");
    run->schemes = own ? own : tree_get(root, "schemes");
    if (!run->scene || run->scene->kind != TREE_MAP || !verify_cost_text(run->scene, "case"))
        return status_fail(STATUS_CASE, "cases/cost.yaml has no scene '%s' with a 'case'", run->id);
    if (!run->schemes || run->schemes->kind != TREE_MAP)
        return status_fail(STATUS_CASE, "cases/cost.yaml has no 'schemes'");
    TRY(matrix_combine(run->scene, &run->matrix));
    char *folder = mem_print("%s/cost", run->options->directory);
    int code = verify_file_folder(folder);
    mem_free(folder);
    if (!code) code = verify_cost_all(run);
    if (!code) code = verify_cost_write(run);
    for (unsigned i = 0; i < run->n_point; i++) verify_point_done(&run->points[i]);
    mem_free(run->points);
    matrix_done(&run->matrix);
    return code;
}

int verify_cost(const struct verify_cost_options *options, const char *id)
{
    static const struct merge_options none;
    struct verify_cost_run run = {.options = options, .id = id};
    struct forest *forest = tree_forest_new();
    struct diag *diag = diag_new();
    char *path = mem_print("%s/cases/cost.yaml", options->source);
    const struct node *root = merge_case(forest, diag, path, &none);
    int code = root && !diag_errors(diag) ? STATUS_OK : status_fail(STATUS_CASE, "%s cannot be read", path);
    if (code) diag_print(diag, stderr, false);
    else code = verify_cost_scene(&run, root);
    diag_free(diag);
    tree_forest_free(forest);
    mem_free(path);
    return code;
}
