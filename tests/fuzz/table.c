/* table.c - tables in files: measured series, reference data and histories, lists of snapshots, a history that is
 * taken up again. */
#include "case/series.h"
#include "case/table.h"
#include "fuzz.h"
#include "io/csv.h"
#include "io/filelist.h"

static void table_try_series(void)
{
    struct series series;
    const double *column;
    if (series_read("input", &series)) return;
    series_column(&series, "p", &column);
    series_ascending(&series, "1");
    series_done(&series);
}

static void table_try_table(void)
{
    struct table table;
    struct table_pair pair;
    if (table_reference("input", "t", "p", &pair) == 0) {
        table_average(pair.table.n_row, pair.x, pair.y, 0.25, 0.5);
        table_done(&pair.table);
    }
    if (table_read("input", TABLE_OF_RUN, &table)) return;
    const double *t = table_column(&table, "t");
    if (t && table.n_row) table_interpolate(table.n_row, t, table.columns[table.n_column - 1], 0.5);
    table_done(&table);
}

/* The file is changed: cut behind the rows up to t = 2, and a row added. */
static void table_try_history(void)
{
    struct csv *csv;
    if (csv_open("input", "step,t,m", NULL, true, 2.0, &csv)) return;
    csv_row(csv, 3, (const double[]){3, 2.5, 1});
    csv_close(csv);
    remove("input.before");
}

FUZZ(data, size)
{
    fuzz_start();
    fuzz_write("input", data, size);
    struct filelist list;
    if (filelist_read("input", &list) == 0) filelist_done(&list);
    table_try_series();
    table_try_table();
    table_try_history();
    return 0;
}
