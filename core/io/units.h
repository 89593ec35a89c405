/* units.h - what the numbers in tables are: columns.csv, beside the CSV files that are plain numbers in SI units.
 *
 *     file,column,unit
 *     history.csv,t,s
 *     history.csv,V,m3
 *     probes.csv,wall.pressure,Pa
 *
 * A pure number has the unit 1; of an expression (`value:`) nobody knows it, and the cell is empty. */
#ifndef UNITS_H
#define UNITS_H

#include "base/text.h"
#include "solve/state.h"

/* The column that says what the numbers of a column are: itself, or the one whose extremes it has. */
const struct scene_column *units_source(const struct scene *scene, const struct scene_column *column);

/* Unit of a measure of the history whose field has the unit `of_field` ("" or NULL: not known); "" if it is not known.
 * A static text. */
const char *units_of(const struct scene *scene, const struct scene_column *column, const char *of_field);

/* The text of columns.csv: all columns of history.csv and probes.csv, in their order. STATUS_CASE: an unknown field. */
int units_text(const struct state *state, struct text *text);

#endif
