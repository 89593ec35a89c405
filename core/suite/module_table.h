/* module_table.h - `bulla module table LAW FILE`: the states of an equation of state on a grid, as a file that `type:
 * table` reads. */
#ifndef MODULE_TABLE_H
#define MODULE_TABLE_H

#include "cli/cli.h"

/* Words: "table", the law's name, the file (HDF5 if it ends in .h5 or .hdf5, else CSV). 0; 2: bad words, or the law has
 * no such states; 3: the file cannot be written. */
int module_table_command(const struct cli_given *given);

#endif
