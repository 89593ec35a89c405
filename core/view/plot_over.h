/* plot_over.h - reference curves over the histories of runs: --over FILE.csv[:X,Y]. */
#ifndef PLOT_OVER_H
#define PLOT_OVER_H

#include "case/table.h"
#include "view/chart.h"
#include "view/plot_option.h"

struct plot_over {
    struct table table;
    const char *given;   /* what --over said; the caller's */
    char *path, *column; /* column: Y, or NULL: whatever columns of the runs are in the file, by their names */
    const double *x;     /* [table.n_row] */
    bool used;           /* something of it is in the chart */
    char label[PICTURE_SCALE_LABEL]; /* in legends: the name of the file, and Y */
};

/* Reads the file (case/table.h; SI units as histories). X is `t` if it is not given. STATUS_CASE: no such file, not a
 * table, no such columns; the message has those there are. Release with plot_over_done, whatever is returned. */
int plot_over_read(const char *given, struct plot_over *ret_over);
void plot_over_done(struct plot_over *over);

/* Puts into the panel that shows `column` what the reference has for it: the column of that name. Y goes to the panel
 * of the column of its name, `other` to any: the first, where no column has its name. STATUS_CASE: the panel is
 * full. */
int plot_over_add(struct plot_over *over, const char *column, bool other, struct chart_panel *panel);

/* STATUS_CASE: nothing of a reference found its place in the chart. */
int plot_over_unused(const struct plot_over *over);

#endif
