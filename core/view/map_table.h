/* map_table.h - the table of a space-time map of a run (DIR/maps/NAME.csv, io/maps.h) in memory. Running and killed
 * runs have it too. */
#ifndef MAP_TABLE_H
#define MAP_TABLE_H

#include "case/scene.h"
#include "case/table.h"

struct map_table {
    const char *name;   /* of the map; the caller's */
    struct table table; /* t, the place, fields; all places of the first time, then of the next */
    size_t n_place, n_time;
    size_t n_side[2];    /* of a rectangle: places along its sides (columns s1, s2, which varies faster); else 0 */
    struct scene *scene; /* or NULL */
};

/* Reads DIR/maps/NAME.csv. STATUS_CASE: there is none (the message lists those there are), or fewer than two times or
 * places. Release with map_table_done, whatever is returned. */
int map_table_open(const char *directory, const char *name, struct map_table *ret_map);
void map_table_done(struct map_table *map);

/* STATUS_CASE with the maps that a directory has; name: the one that is not there, NULL if none was named. */
int map_table_missing(const char *directory, const char *name);

/* The column of a field, [n_time * n_place]; STATUS_CASE with those there are. */
int map_table_column(const struct map_table *map, const char *field, const double **ret_values);

/* The coordinate's name with its italic marks: x, y, z, s; r and z in round geometries. In new memory. */
char *map_table_place(const struct map_table *map);

/* The time, 0 to n_time - 1, at which a column is largest, of all places or those within [lo, hi] of column 1. */
size_t map_table_highest(const struct map_table *map, const double *values, const double window[2]);

/* What pictures call a field ("temperature of water"), in new memory; its SI unit, "" if it is not known. */
char *map_table_label(const struct map_table *map, const char *field);
const char *map_table_unit(const struct map_table *map, const char *field);

#endif
