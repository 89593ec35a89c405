/* watch_curve.c - see watch_curve.h. */
#include "watch/watch_curve.h"

#include "base/mem.h"
#include "base/status.h"
#include "case/table.h"
#include "watch/watch_file.h"
#include "watch/watch_row.h"

#include <math.h>
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

/* A table that a run is writing may lack its rows yet; one of somebody else may be anything. */
static json_t *watch_curve_read(const char *directory, const char *file, unsigned column, const char *name)
{
    struct table table = {0};
    char *path = mem_print("%s/%s", directory, file);
    json_t *curve = json_pack("{s:o}", "name", watch_file_word(name, CURVE_WORDS));
    if (table_read(path, TABLE_OF_RUN, &table))
        json_object_set_new(curve, "fault", watch_file_word(status_text(), CURVE_WORDS));
    else if (column < table.n_column) watch_curve_points(&table, column, curve);
    table_done(&table);
    mem_free(path);
    return curve;
}

json_t *watch_curve_look(const char *directory, unsigned long index)
{
    static const char *const files[] = {"history.csv", "probes.csv"};
    json_t *curve = NULL;
    for (size_t f = 0; !curve && f < sizeof files / sizeof *files; f++) {
        struct watch_row row;
        watch_row_read(directory, files[f], &row);
        if (index < row.n) curve = watch_curve_read(directory, files[f], (unsigned)index, row.names[index]);
        else index -= row.n;
        watch_row_done(&row);
    }
    return curve;
}
