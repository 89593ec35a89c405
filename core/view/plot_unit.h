/* plot_unit.h - the units of columns: CSV files are plain numbers, the case beside them knows what they are. */
#ifndef PLOT_UNIT_H
#define PLOT_UNIT_H

#include "case/scene.h"

/* The scene of DIR/case.yaml, read without a word; NULL if that does not work here. Free with scene_free. */
struct scene *plot_unit_scene(const char *directory);

/* SI unit of a column of history.csv or probes.csv ("Pa", "m3"), "" if it is not known. `scene` may be NULL. */
const char *plot_unit_of(const struct scene *scene, const char *column);

#endif
