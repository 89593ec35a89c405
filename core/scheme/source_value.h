/* source_value.h - what the sources of a scene are in the middles of cells: numbers, expressions and Lua, asked in
 * rows.
 *
 * Places come from the integer index of a cell in its level, mirrored to the bit in a domain that is symmetric about 0,
 * so that results depend neither on tiles nor on ranks. */
#ifndef SOURCE_VALUE_H
#define SOURCE_VALUE_H

#include "mesh/metric.h"
#include "phys/model.h"
#include "scheme/frame.h"
#include "scheme/swell.h"

enum { SOURCE_VALUE_BATCH = SWELL_BATCH, SOURCE_VALUE_NAMES = 2 * SCENE_SOURCES };

/* The values of one rank, and where they are asked. */
struct source_value {
    const struct model *model, *path; /* of the scene; the one that cells are computed with */
    const struct mesh *mesh;
    double *row[SCENE_SOURCES];                      /* values of a batch; NULL: not given */
    double *rows;                                    /* where they lie */
    unsigned char varying[SCENE_SOURCES], n_varying; /* those that are expressions */
    const struct script_table *names;                /* of a Lua table */
    unsigned n_name;
    unsigned char slot[SOURCE_VALUE_NAMES]; /* which value each name of the table means */
    double x[3][METRIC_CELLS];              /* middles of the cells of the tile */
    int status;
    char *message, place[192];
};

struct source_value *source_value_new(const struct model *model, const struct mesh *mesh);
void source_value_free(struct source_value *values);

/* Where the cells of a tile are; before any of them is asked. */
void source_value_places(struct source_value *values, const struct level *level, const struct tile *tile);

/* Rows of the values in n <= SOURCE_VALUE_BATCH cells of the tile from cell `from` on, at time t. */
void source_value_cells(struct source_value *values, const struct tile *tile, double t, size_t from, size_t n);

/* In a tile, at a time, along an axis. */
struct source_value_place {
    const struct level *level;
    const struct tile *tile;
    double t;
    int axis;
};

/* Acceleration along the axis in the middle of a cell, counted from the first of the tile, which may lie beside
 * it, behind a boundary as in the cell inside; 0 where a script fails: who asks for the cells finds out. */
double source_value_cell(struct source_value *values, const struct source_value_place *place, const int cell[3]);

/* The same in the cells from <= i < to along the axis of a piece, of all its slices, at their places in the frame. */
void source_value_frame(struct source_value *values, const struct source_value_place *place, const struct frame *frame,
                        int from, int to, double *acceleration);

#endif
