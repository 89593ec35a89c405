/* h5view.h - data sets that interleave columns of others and store no numbers: the second layout of a plot file. Of the
 * rank that writes, others return at once. */
#ifndef H5VIEW_H
#define H5VIEW_H

#include "io/h5.h"

/* A column of a data set written before: what a view is made of. */
struct h5view_column {
    const char *path;
    unsigned columns, column; /* columns 0: the data set has shape [rows] */
};

/* n_group groups of `group` rows, from row `first` on. */
struct h5view_groups {
    size_t first, group, n_group;
};

/* A virtual data set: for each group of rows, all columns one after the other. Stores no numbers itself. */
struct h5view {
    enum h5_type type;
    unsigned n_column;
    const struct h5view_column *columns;
    size_t total; /* rows of the sources */
    unsigned n_run;
    const struct h5view_groups *runs; /* those without groups are passed over */
};

void h5view_write(struct h5 *file, const char *path, const struct h5view *view);

#endif
