/* watch_curve.c - see watch_curve.h. */
#include "watch/watch_curve.h"

#include "base/mem.h"
#include "base/status.h"
#include "watch/watch_file.h"
#include "watch/watch_row.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { CURVE_MOST = 2 * WATCH_CURVE_STRETCHES + 2, CURVE_WORDS = 400 };

static size_t watch_curve_add(size_t row, size_t n, size_t *rows)
{
    if (n && rows[n - 1] >= row) return n;
    rows[n] = row;
    return n + 1;
}

size_t watch_curve_choose(size_t n, const double *values, size_t *ret_rows)
{
    size_t chosen = 0, stretches = n < CURVE_MOST ? n : WATCH_CURVE_STRETCHES;
    if (n) chosen = watch_curve_add(0, chosen, ret_rows);
    for (size_t s = 0; s < stretches; s++) {
        size_t from = s * n / stretches, to = (s + 1) * n / stretches, least = from, most = from;
        for (size_t i = from + 1; i < to; i++) {
            if (values[i] < values[least] || isnan(values[least])) least = i;
            if (values[i] > values[most] || isnan(values[most])) most = i;
        }
        chosen = watch_curve_add(least < most ? least : most, chosen, ret_rows);
        chosen = watch_curve_add(least < most ? most : least, chosen, ret_rows);
    }
    return n ? watch_curve_add(n - 1, chosen, ret_rows) : 0;
}

static json_t *watch_curve_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static void watch_curve_points(const struct table *table, unsigned column, json_t *curve)
{
    const double *times = table_column(table, "t"), *values = table->columns[column];
    size_t rows[CURVE_MOST], n = times ? watch_curve_choose(table->n_row, values, rows) : 0;
    json_t *t = json_array(), *v = json_array();
    for (size_t i = 0; i < n; i++) {
        json_array_append_new(t, watch_curve_number(times[rows[i]]));
        json_array_append_new(v, watch_curve_number(values[rows[i]]));
    }
    json_object_set_new(curve, "rows", json_integer((json_int_t)table->n_row));
    json_object_set_new(curve, "t", t);
    json_object_set_new(curve, "v", v);
}

void watch_curve_done(struct watch_curve_kept *kept)
{
    mem_free(kept->path);
    table_done(&kept->table);
    *kept = (struct watch_curve_kept){0};
}

static bool watch_curve_is_kept(const struct watch_curve_kept *kept, const char *path, const struct stat *file)
{
    return kept->path && strcmp(kept->path, path) == 0 && kept->file.st_ino == file->st_ino &&
           kept->file.st_size == file->st_size && kept->file.st_mtim.tv_sec == file->st_mtim.tv_sec &&
           kept->file.st_mtim.tv_nsec == file->st_mtim.tv_nsec;
}

/* Makes `kept` that table; takes the path. */
static int watch_curve_keep(struct watch_curve_kept *kept, char *path)
{
    struct stat file = {0};
    if (!stat(path, &file) && watch_curve_is_kept(kept, path, &file)) {
        mem_free(path);
        return STATUS_OK;
    }
    watch_curve_done(kept);
    int code = table_read(path, TABLE_OF_RUN, &kept->table);
    if (code) mem_free(path);
    else *kept = (struct watch_curve_kept){path, file, kept->table};
    return code;
}

/* A table that a run is writing may lack its rows yet; one of somebody else may be anything. */
static json_t *watch_curve_read(struct watch_curve_kept *kept, char *path, unsigned column, const char *name)
{
    json_t *curve = json_pack("{s:o}", "name", watch_file_word(name, CURVE_WORDS));
    if (watch_curve_keep(kept, path)) json_object_set_new(curve, "fault", watch_file_word(status_text(), CURVE_WORDS));
    else if (column < kept->table.n_column) watch_curve_points(&kept->table, column, curve);
    return curve;
}

json_t *watch_curve_look(struct watch_curve_kept *kept, const char *directory, unsigned long index)
{
    static const char *const files[] = {"history.csv", "probes.csv"};
    json_t *curve = NULL;
    for (size_t f = 0; !curve && f < sizeof files / sizeof *files; f++) {
        struct watch_row row;
        watch_row_read(directory, files[f], &row);
        if (index < row.n)
            curve = watch_curve_read(kept, mem_print("%s/%s", directory, files[f]), (unsigned)index, row.names[index]);
        else index -= row.n;
        watch_row_done(&row);
    }
    return curve;
}
