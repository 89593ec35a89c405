/* expect.c - see expect.h. Columns are those of history.csv, then those of probes.csv. */
#include "judge/expect.h"

#include "base/comm.h"
#include "base/log.h"
#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/formula.h"
#include "case/table.h"
#include "judge/norm.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct expect_run {
    const struct scene *scene;
    const char *directory;
    struct table tables[2]; /* history, probes */
    struct formula *formula;
};

struct expect_result {
    char *what, *bound, *fault; /* fault: why there is no value, or NULL */
    double value;
    bool passed;
};

static void expect_add_columns(struct expect_run *run, const struct table *table)
{
    const double *t = table_column(table, "t");
    for (unsigned c = 0; t && c < table->n_column; c++) {
        struct trace trace = {table->n_row, t, table->columns[c]};
        formula_add(run->formula, table->names[c], &trace);
    }
}

static int expect_open(struct expect_run *run)
{
    static const char *const files[2] = {"history.csv", "probes.csv"};
    run->formula = formula_new(run->scene->host, false);
    for (int i = 0; i < 2; i++) {
        char *path = mem_print("%s/%s", run->directory, files[i]);
        int code = access(path, F_OK) == 0 ? table_read(path, TABLE_OF_RUN, &run->tables[i]) : STATUS_OK;
        mem_free(path);
        TRY(code);
        expect_add_columns(run, &run->tables[i]);
    }
    return STATUS_OK;
}

static void expect_close(struct expect_run *run)
{
    formula_free(run->formula);
    table_done(&run->tables[0]);
    table_done(&run->tables[1]);
}

static int expect_norm(const struct expect_run *run, const struct scene_expect *expect, double *ret_value)
{
    struct trace trace;
    if (formula_column(run->formula, expect->field, &trace)) return norm_of_trace(expect, &trace, ret_value);
    return norm_of_field(run->scene, expect, run->directory, ret_value);
}

static bool expect_holds(const struct scene_expect *expect, double value)
{
    double slack = expect->tolerance + expect->relative * fabs(expect->equals);
    if (!isfinite(value)) return false;
    if (expect->has_at_most && !(value <= expect->at_most)) return false;
    if (expect->has_at_least && !(value >= expect->at_least)) return false;
    return !expect->has_equals || fabs(value - expect->equals) <= slack;
}

static char *expect_bound(const struct scene_expect *expect)
{
    struct text text = {0};
    double slack = expect->tolerance + expect->relative * fabs(expect->equals);
    if (expect->has_at_least) text_add(&text, ">= %.6g", expect->at_least);
    if (expect->has_at_most) text_add(&text, "%s<= %.6g", text.at ? ", " : "", expect->at_most);
    if (expect->has_equals) text_add(&text, "%s= %.6g +- %.3g", text.at ? ", " : "", expect->equals, slack);
    if (!text.at) text_add(&text, "no bound");
    return text.at;
}

static char *expect_what(const struct scene_expect *expect)
{
    if (expect->label) return mem_text(expect->label);
    if (expect->value) return mem_text(expect->value);
    return mem_print("%s(%s)", expect->norm, expect->field);
}

static int expect_result_of(struct expect_run *run, const struct scene_expect *expect, struct expect_result *ret)
{
    double value = NAN;
    char *fault = NULL;
    int code =
        expect->value ? formula_value(run->formula, expect->value, &value, NULL) : expect_norm(run, expect, &value);
    if (code) status_wrap(code, "%s:%d: expect: ", run->scene->path, expect->line);
    if (code && !expect->value) return code;
    if (code) {
        fault = mem_text(status_text());
        log_warn("%s", fault);
    }
    *ret = (struct expect_result){expect_what(expect), expect_bound(expect), fault, value, expect_holds(expect, value)};
    return STATUS_OK;
}

static int expect_evaluate(struct expect_run *run, struct expect_result *results)
{
    for (unsigned i = 0; i < run->scene->n_expect; i++)
        TRY(expect_result_of(run, &run->scene->expects[i], &results[i]));
    return STATUS_OK;
}

static void expect_print(const struct expect_result *results, unsigned n)
{
    int wide = 0;
    for (unsigned i = 0; i < n; i++) {
        int length = (int)strlen(results[i].what);
        if (length > wide) wide = length;
    }
    for (unsigned i = 0; i < n; i++)
        printf("  %-4s  %-*s  %13.6g  %s\n", results[i].passed ? "pass" : "FAIL", wide, results[i].what,
               results[i].value, results[i].bound);
    fflush(stdout);
}

static json_t *expect_json(const struct scene *scene, const struct expect_result *results)
{
    json_t *list = json_array();
    bool all = true;
    for (unsigned i = 0; i < scene->n_expect; i++) {
        json_t *item = json_object();
        json_object_set_new(item, "what", json_string(results[i].what));
        json_object_set_new(item, "value", isfinite(results[i].value) ? json_real(results[i].value) : json_null());
        if (results[i].fault) json_object_set_new(item, "fault", json_string(results[i].fault));
        json_object_set_new(item, "bound", json_string(results[i].bound));
        json_object_set_new(item, "passed", json_boolean(results[i].passed));
        json_object_set_new(item, "norm", scene->expects[i].value ? json_null() : json_string(scene->expects[i].norm));
        json_object_set_new(item, "field",
                            scene->expects[i].value ? json_null() : json_string(scene->expects[i].field));
        json_object_set_new(item, "order", json_real(scene->expects[i].order));
        if (scene->expects[i].norm) json_object_set_new(item, "reference", json_string(scene->expects[i].reference));
        if (scene->expects[i].has_equals) json_object_set_new(item, "equals", json_real(scene->expects[i].equals));
        json_array_append_new(list, item);
        all = all && results[i].passed;
    }
    json_t *root = json_object();
    json_object_set_new(root, "passed", json_boolean(all));
    json_object_set_new(root, "expectations", list);
    return root;
}

static int expect_save(const struct expect_run *run, const struct expect_result *results)
{
    char *path = mem_print("%s/expect.json", run->directory);
    json_t *root = expect_json(run->scene, results);
    int code =
        json_dump_file(root, path, JSON_INDENT(2)) ? status_fail(STATUS_RUN, "cannot write %s", path) : STATUS_OK;
    json_decref(root);
    mem_free(path);
    return code;
}

static int expect_on_one_rank(const struct scene *scene, const char *directory, bool quiet)
{
    struct expect_run run = {.scene = scene, .directory = directory};
    struct expect_result *results = mem_new(scene->n_expect, sizeof *results);
    int code = expect_open(&run), failed = 0;
    if (!code) code = expect_evaluate(&run, results);
    if (!code) {
        for (unsigned i = 0; i < scene->n_expect; i++) failed += !results[i].passed;
        if (!quiet) expect_print(results, scene->n_expect);
        code = expect_save(&run, results);
    }
    for (unsigned i = 0; i < scene->n_expect; i++) {
        mem_free(results[i].what);
        mem_free(results[i].bound);
        mem_free(results[i].fault);
    }
    mem_free(results);
    expect_close(&run);
    if (!code && failed)
        code = status_fail(STATUS_EXPECT, "%d of %u expectations failed (%s/expect.json)", failed, scene->n_expect,
                           directory);
    return code;
}

int expect_judge(const struct scene *scene, const char *directory, bool quiet)
{
    int code = STATUS_OK;
    if (scene->n_expect && comm_rank() == 0) code = expect_on_one_rank(scene, directory, quiet);
    return comm_agree(code);
}

int expect_formula(const struct scene *scene, const char *directory, const char *text, double *ret_value)
{
    struct expect_run run = {.scene = scene, .directory = directory};
    int code = expect_open(&run);
    if (!code) code = formula_value(run.formula, text, ret_value, NULL);
    expect_close(&run);
    return code;
}
