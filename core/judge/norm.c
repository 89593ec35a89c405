/* norm.c - see norm.h. Numerical cell values are averages, so a reference must be averaged over
 * the same cells: a point value in the middle differs by O(h^2), and at a jump by O(1). */
#include "judge/norm.h"

#include "base/mem.h"
#include "base/status.h"
#include "base/text.h"
#include "case/table.h"
#include "io/read.h"
#include "judge/mirror.h"
#include "judge/overlap.h"
#include "judge/tube.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

struct norm {
    double sum, square, most, weight;
};

static void norm_add(struct norm *norm, double weight, double difference)
{
    double size = fabs(difference);
    norm->sum += weight * size;
    norm->square += weight * size * size;
    norm->weight += weight;
    if (!(size <= norm->most)) norm->most = size; /* takes a NaN too */
}

static double norm_value(const struct norm *norm, const struct scene_expect *expect)
{
    double value = norm->sum / norm->weight;
    if (strcmp(expect->norm, "L2") == 0) value = sqrt(norm->square / norm->weight);
    if (strcmp(expect->norm, "Linf") == 0) value = norm->most;
    return value / expect->scale;
}

static bool norm_is_reference(const struct scene_expect *expect, const char *name)
{
    const char *slash = strrchr(expect->reference, '/');
    return strcmp(slash ? slash + 1 : expect->reference, name) == 0;
}

/* One number per cell of a field or of a component of it ("velocity_x"). */
struct norm_cells {
    const double *data;
    unsigned stride;
};

static int norm_cells_of(const struct snapshot *snapshot, const char *name, struct norm_cells *ret)
{
    const struct snapshot_field *field = read_field(snapshot, name);
    size_t length = strlen(name);
    unsigned axis = 0;
    if (!field && length > 2 && name[length - 2] == '_' && name[length - 1] >= 'x' && name[length - 1] <= 'z') {
        char *vector = mem_text_n(name, length - 2);
        axis = (unsigned)(name[length - 1] - 'x');
        field = read_field(snapshot, vector);
        mem_free(vector);
    }
    if (!field || axis >= field->components) {
        struct text known = {0};
        for (unsigned i = 0; i < snapshot->n_field; i++) text_add(&known, " %s", snapshot->fields[i].name);
        int code = status_fail(STATUS_CASE,
                               "'%s' is neither a column of history.csv or probes.csv nor a field of the "
                               "snapshots (output: snapshots: fields:), which hold%s",
                               name, known.at ? known.at : " none");
        text_done(&known);
        return code;
    }
    *ret = (struct norm_cells){field->data + axis, field->components};
    return STATUS_OK;
}

static double norm_weight(const struct snapshot *snapshot, size_t cell)
{
    double weight = 1;
    for (int d = 0; d < snapshot->dim; d++) weight *= snapshot->upper[cell][d] - snapshot->lower[cell][d];
    return weight;
}

/* Which value of the exact solution a field is. `ret_flip`: alpha of the right material. */
static int norm_exact_value(const struct scene *scene, const struct tube *tube, const char *name, int *ret_value,
                            bool *ret_flip)
{
    *ret_flip = false;
    *ret_value = strcmp(name, "density") == 0      ? EXACT_RHO
                 : strcmp(name, "velocity_x") == 0 ? EXACT_U
                 : strcmp(name, "pressure") == 0   ? EXACT_P
                                                   : EXACT_VALUES;
    if (*ret_value < EXACT_VALUES) return STATUS_OK;
    for (int k = 0; k < 2 && tube->material[0] != tube->material[1]; k++)
        if (strncmp(name, "alpha_", 6) == 0 && strcmp(name + 6, scene->material[tube->material[k]].name) == 0) {
            *ret_flip = k == 1;
            *ret_value = EXACT_LEFT;
            return STATUS_OK;
        }
    return status_fail(STATUS_CASE,
                       "the exact solution has density, velocity_x, pressure and the volume fractions of "
                       "its two materials, not '%s'",
                       name);
}

static int norm_against_exact(const struct scene *scene, const char *name, const struct snapshot *last,
                              struct norm *norm)
{
    struct tube tube;
    struct norm_cells cells;
    int value;
    bool flip;
    TRY(tube_of_scene(scene, &tube));
    TRY(norm_exact_value(scene, &tube, name, &value, &flip));
    TRY(norm_cells_of(last, name, &cells));
    if (last->time <= 0) return status_fail(STATUS_CASE, "the exact solution needs a snapshot after t = 0");
    for (size_t i = 0; i < last->n_cell; i++) {
        double mean[EXACT_VALUES];
        exact_average(&tube.exact, last->time, last->lower[i][0] - tube.x0, last->upper[i][0] - tube.x0, mean);
        double wanted = flip ? 1 - mean[value] : mean[value];
        norm_add(norm, norm_weight(last, i), cells.data[i * cells.stride] - wanted);
    }
    return STATUS_OK;
}

int norm_check(const struct scene *scene)
{
    for (unsigned i = 0; i < scene->n_expect; i++) {
        const struct scene_expect *expect = &scene->expects[i];
        struct tube tube;
        int value;
        bool flip;
        if (!expect->norm || !norm_is_reference(expect, "exact-riemann")) continue;
        int code = tube_of_scene(scene, &tube);
        if (!code) code = norm_exact_value(scene, &tube, expect->field, &value, &flip);
        if (code) return status_wrap(STATUS_CASE, "%s:%d: expect: ", scene->path, expect->line);
    }
    return STATUS_OK;
}

static void norm_visit(void *data, double size, double one, double other)
{
    norm_add(data, size, one - other);
}

static int norm_against_initial(const char *name, const struct snapshot *last, const char *first_path,
                                struct norm *norm)
{
    struct snapshot *first;
    struct norm_cells cells, before;
    TRY(read_snapshot(first_path, NULL, &first));
    int code = norm_cells_of(last, name, &cells);
    if (!code) code = norm_cells_of(first, name, &before);
    if (!code && first->time != 0) code = status_fail(STATUS_CASE, "'initial' needs a snapshot at t = 0");
    if (!code)
        code = overlap_visit(&(struct overlap_side){last, cells.data, cells.stride},
                             &(struct overlap_side){first, before.data, before.stride}, norm_visit, norm);
    read_free(first);
    return code;
}

/* The axis that `mirror-x` names; -1: the reference is another one. */
static int norm_mirror_axis(const struct scene_expect *expect)
{
    static const char *const words[] = {"mirror-x", "mirror-y", "mirror-z"};
    for (int axis = 0; axis < 3; axis++)
        if (norm_is_reference(expect, words[axis])) return axis;
    return -1;
}

static int norm_against_mirror(const char *name, const struct snapshot *last, int axis, struct norm *norm)
{
    struct norm_cells cells;
    TRY(norm_cells_of(last, name, &cells));
    size_t length = strlen(name);
    bool turned = cells.stride == 3 && length > 2 && name[length - 2] == '_' && name[length - 1] == 'x' + axis;
    mirror_visit(&(struct mirror_side){last, cells.data, cells.stride, turned ? -1.0 : 1.0}, axis, norm_visit, norm);
    return STATUS_OK;
}

/* The two columns of the reference; release `table`. `coordinate` if the case names none. */
static int norm_reference(const struct scene_expect *expect, const char *coordinate, struct table_pair *ret)
{
    return table_reference(expect->reference, expect->coordinate ? expect->coordinate : coordinate,
                           expect->column ? expect->column : expect->field, ret);
}

static int norm_against_profile(const struct scene_expect *expect, const struct snapshot *last, struct norm *norm)
{
    struct norm_cells cells;
    struct table_pair wanted;
    if (last->dim != 1) return status_fail(STATUS_CASE, "a CSV profile is a reference for 1D scenes only");
    TRY(norm_cells_of(last, expect->field, &cells));
    TRY(norm_reference(expect, "x", &wanted));
    for (size_t i = 0; i < last->n_cell; i++) {
        double mean = table_average(wanted.table.n_row, wanted.x, wanted.y, last->lower[i][0], last->upper[i][0]);
        norm_add(norm, norm_weight(last, i), cells.data[i * cells.stride] - mean);
    }
    table_done(&wanted.table);
    return STATUS_OK;
}

int norm_of_field(const struct scene *scene, const struct scene_expect *expect, const char *directory, double *ret_norm)
{
    struct snapshot_series series;
    struct snapshot *last;
    struct norm norm = {0};
    TRY(read_series(directory, &series));
    int code = series.n ? read_snapshot(series.paths[series.n - 1], NULL, &last)
                        : status_fail(STATUS_RUN, "%s holds no snapshots", directory);
    if (!code) {
        if (norm_is_reference(expect, "exact-riemann")) code = norm_against_exact(scene, expect->field, last, &norm);
        else if (norm_is_reference(expect, "initial"))
            code = norm_against_initial(expect->field, last, series.paths[0], &norm);
        else if (norm_mirror_axis(expect) >= 0)
            code = norm_against_mirror(expect->field, last, norm_mirror_axis(expect), &norm);
        else code = norm_against_profile(expect, last, &norm);
        read_free(last);
    }
    read_series_done(&series);
    if (!code) *ret_norm = norm_value(&norm, expect);
    return code;
}

int norm_of_trace(const struct scene_expect *expect, const struct trace *trace, double *ret_norm)
{
    struct table_pair wanted;
    struct norm norm = {0};
    TRY(norm_reference(expect, "t", &wanted));
    const double *t = wanted.x;
    size_t n = wanted.table.n_row;
    for (size_t i = 0; i < trace->n; i++) {
        if (trace->t[i] < t[0] || trace->t[i] > t[n - 1]) continue;
        double before = i > 0 ? trace->t[i - 1] : trace->t[i], after = i + 1 < trace->n ? trace->t[i + 1] : trace->t[i];
        norm_add(&norm, (after - before) / 2, trace->v[i] - table_interpolate(n, t, wanted.y, trace->t[i]));
    }
    table_done(&wanted.table);
    if (!(norm.weight > 0))
        return status_fail(STATUS_CASE, "%s covers none of the times of the run", expect->reference);
    *ret_norm = norm_value(&norm, expect);
    return STATUS_OK;
}
