/* report_columns.h - histories and probes in a report: their pictures, and a table of what each column is and
 * reached. */
#ifndef REPORT_COLUMNS_H
#define REPORT_COLUMNS_H

#include "base/text.h"
#include "view/plot_option.h"

/* A section on DIR/NAME ("history.csv"): its columns but t, step and the counts of the guard, which are among the
 * figures of the run. Nothing where the file is not there or has no rows. STATUS_RUN: it is no table. */
int report_columns_add(struct text *page, const char *directory, const char *name, const char *title,
                       const struct plot_option *option);

#endif
