/* sweep_name.h - what the directories of a sweep are called: by their settings, "R0=10um,standoff=1.1". */
#ifndef SWEEP_NAME_H
#define SWEEP_NAME_H

#include "batch/matrix.h"

/* The key of setting `k` in short: the end of its path, as much as tells it from the others. Points into the row. */
const char *sweep_name_key(const struct matrix *matrix, unsigned k);

/* Names of all rows, [n_row]; a name depends on the settings of its row alone, unless two rows would have the same:
 * these get a checksum of their settings behind it. STATUS_CASE if rows are equal. Release each, then the array. */
int sweep_name_all(const struct matrix *matrix, char ***ret_names);

/* What a row has of the settings with more than one value: "limiter=mc,cells=64"; "" if there is none. */
char *sweep_name_varied(const struct matrix *matrix, unsigned index);

#endif
