/* map_store.h - the table of a space-time map as arrays in an HDF5 file (maps.h says which). */
#ifndef MAP_STORE_H
#define MAP_STORE_H

#include "io/map_values.h"

/* Writes `arrays` from the table `csv`, as far as it holds whole times; no file if it holds none. Collective. */
int map_store_write(const struct map_values *values, const struct scene *scene, const char *csv, const char *arrays);

/* The name of the column of places: x, y, z, or s for a distance; "s1,s2" of a rectangle. Columns up to these. */
const char *map_store_place(const struct scene_map *map);
unsigned map_store_head(const struct scene_map *map);

#endif
