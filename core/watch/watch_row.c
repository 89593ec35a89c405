/* watch_row.c - see watch_row.h. */
#include "watch/watch_row.h"

#include "base/mem.h"
#include "watch/watch_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROW_COLUMNS = 4096, ROW_NAME = 160 };

void watch_row_read(const char *directory, const char *name, struct watch_row *ret_row)
{
    char *head = watch_file_head(directory, name), *last = watch_file_tail(directory, name, 1), *at = last;
    struct watch_row row = {.text = head};
    row.names = mem_new(ROW_COLUMNS, sizeof *row.names);
    row.values = mem_new(ROW_COLUMNS, sizeof *row.values);
    for (char *word = head; word && *head && row.n < ROW_COLUMNS;) {
        char *comma = strchr(word, ','), *end = at;
        if (comma) *comma = '\0';
        row.names[row.n] = word;
        row.values[row.n] = strtod(at, &end);
        if (end == at) row.values[row.n] = NAN; /* the line of names, where no row is there yet */
        row.n++;
        word = comma ? comma + 1 : NULL;
        at += strcspn(at, ",");
        at += *at == ',';
    }
    mem_free(last);
    *ret_row = row;
}

void watch_row_done(struct watch_row *row)
{
    mem_free(row->names);
    mem_free(row->values);
    mem_free(row->text);
    *row = (struct watch_row){0};
}

double watch_row_value(const struct watch_row *row, const char *column)
{
    for (unsigned i = 0; i < row->n; i++)
        if (strcmp(row->names[i], column) == 0) return row->values[i];
    return NAN;
}

/* What columns.csv, "file,column,unit" each line, says of a column. */
static json_t *watch_row_unit(const char *units, const char *file, const char *column)
{
    char *key = mem_print("\n%s,%s,", file, column);
    const char *found = strstr(units, key), *start = found ? found + strlen(key) : "";
    char *unit = mem_text_n(start, strcspn(start, "\n"));
    json_t *word = watch_file_word(unit, ROW_NAME);
    mem_free(unit);
    mem_free(key);
    return word;
}

static void watch_row_list(const char *directory, const char *file, const char *units, json_t *list)
{
    struct watch_row row;
    watch_row_read(directory, file, &row);
    for (unsigned i = 0; i < row.n; i++)
        json_array_append_new(list, json_pack("{s:s, s:o, s:o}", "file", file, "name",
                                              watch_file_word(row.names[i], ROW_NAME), "unit",
                                              watch_row_unit(units, file, row.names[i])));
    watch_row_done(&row);
}

json_t *watch_row_columns(const char *directory)
{
    char *units = watch_file_tail(directory, "columns.csv", ROW_COLUMNS);
    json_t *list = json_array();
    watch_row_list(directory, "history.csv", units, list);
    watch_row_list(directory, "probes.csv", units, list);
    mem_free(units);
    return list;
}
