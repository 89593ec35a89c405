/* study_row.c - see study_row.h. */
#include "batch/study_row.h"

#include "base/mem.h"
#include "base/status.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

void study_row_done(struct study_row *row)
{
    for (unsigned v = 0; v < row->n_value; v++) {
        mem_free(row->values[v].what);
        mem_free(row->values[v].bound);
        mem_free(row->values[v].reference);
    }
    mem_free(row->values);
    *row = (struct study_row){0};
}

static double study_row_number(const json_t *object, const char *key, double fallback)
{
    const json_t *item = json_object_get(object, key);
    return json_is_number(item) ? json_number_value(item) : fallback;
}

/* expect.json of a run; NULL: it has none. */
static void study_row_values(const json_t *root, struct study_row *row)
{
    const json_t *list = json_object_get(root, "expectations");
    row->n_value = (unsigned)json_array_size(list);
    row->values = mem_new(row->n_value, sizeof *row->values);
    for (unsigned v = 0; v < row->n_value; v++) {
        const json_t *item = json_array_get(list, v);
        row->values[v] = (struct study_value){
            .what = mem_text(json_string_value(json_object_get(item, "what"))),
            .bound = mem_text(json_string_value(json_object_get(item, "bound"))),
            .value = study_row_number(item, "value", NAN),
            .order = study_row_number(item, "order", 0),
            .equals = study_row_number(item, "equals", NAN),
            .passed = json_is_true(json_object_get(item, "passed")),
            .is_norm = json_is_string(json_object_get(item, "norm")),
        };
        const char *reference = json_string_value(json_object_get(item, "reference"));
        if (reference) row->values[v].reference = mem_text(reference);
    }
}

static json_t *study_row_load(const char *directory, const char *name)
{
    char *path = mem_print("%s/%s", directory, name);
    json_t *root = json_load_file(path, 0, NULL);
    mem_free(path);
    return root;
}

static struct study_guard study_row_guard(const json_t *origin)
{
    const json_t *guard = json_object_get(origin, "guard");
    return (struct study_guard){study_row_number(guard, "fallback", 0), study_row_number(guard, "relaxed", 0),
                                study_row_number(guard, "clipped", 0), study_row_number(guard, "retries", 0)};
}

static double study_row_steps(const json_t *origin)
{
    static const char *const parts[] = {"exchange", "gather", "faces", "update", "primitives", "levels", "regrid"};
    const json_t *split = json_object_get(origin, "cpu_split_s");
    double sum = 0;
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) sum += study_row_number(split, parts[i], NAN);
    return sum;
}

double study_row_error(const struct study_value *value)
{
    if (value->is_norm) return value->reference && strncmp(value->reference, "mirror-", 7) == 0 ? NAN : value->value;
    double distance = fabs(value->value - value->equals);
    return fabs(value->equals) > 0 ? distance / fabs(value->equals) : distance;
}

void study_row_read(const char *directory, int code, struct study_row *row)
{
    bool judged = row->judged;
    study_row_done(row);
    json_t *origin = study_row_load(directory, "provenance.json");
    row->code = code;
    row->judged = judged;
    row->cpu = study_row_number(origin, "cpu_s", NAN);
    row->wall = study_row_number(origin, "wall_s", NAN);
    row->cells = study_row_number(origin, "cells_updated", NAN);
    row->steps_cpu = study_row_steps(origin);
    row->guard = study_row_guard(origin);
    row->work = study_row_number(origin, "cells_updated", 0) / 2;
    json_t *judgement = code <= STATUS_EXPECT ? study_row_load(directory, "expect.json") : NULL;
    study_row_values(judgement, row);
    json_decref(judgement);
    json_decref(origin);
}

int study_row_exit(const char *directory)
{
    json_t *origin = study_row_load(directory, "provenance.json");
    int code = (int)study_row_number(origin, "exit_code", -1);
    json_decref(origin);
    return code;
}
