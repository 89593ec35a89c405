/* map_values.h - what a space-time map records at one time: its fields at all of its places. */
#ifndef MAP_VALUES_H
#define MAP_VALUES_H

#include "base/text.h"
#include "derive/derive.h"
#include "solve/state.h"

struct map_values {
    const struct scene_map *map;
    unsigned n_value; /* per place: components of all fields */
    unsigned n_field;
    struct derive *fields;
    struct sample *sample; /* of a line */
    struct region *where;  /* of a surface, or NULL */
    double *values;        /* [n_point][n_value] */
};

/* Looks the fields up (STATUS_CASE) and adds the names of their columns, each after a comma. */
int map_values_init(struct map_values *values, const struct state *state, const struct scene_map *map,
                    struct text *columns);
void map_values_done(struct map_values *values);

/* Fills `values` for the present time: the same on all ranks. Collective. */
void map_values_take(struct map_values *values, const struct state *state, struct derive_moment *moment);

#endif
