/* script_table.h - Lua functions that return a table of named numbers.
 *
 * Names are those of fields ("pressure"); a dot leads into an inner table: "alpha.water" for
 * { alpha = { water = 1 } }, "velocity.1" for { velocity = { 10 } }. */
#ifndef SCRIPT_TABLE_H
#define SCRIPT_TABLE_H

#include "case/script.h"

struct script_table; /* the fields that a returned table may have; owned by its host */

/* Equal lists give the same object; the names are copied. */
const struct script_table *script_table(struct script_host *host, const char *const *names, unsigned n_name);

/* Calls with n_in numbers. For each name, in order, the value is stored in out[n_name], NaN if the table has none.
 * A key that is no name is an error with a suggestion; so is a value that is no finite number. STATUS_CASE. */
int script_table_call(const struct script *script, const double *in, unsigned n_in, const struct script_table *table,
                      double *out);

/* Frees a list of them (script_host_free does). */
void script_table_free(struct script_table *first);

#endif
