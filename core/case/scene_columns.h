/* scene_columns.h - the columns that a run of a scene will write: those of history.csv and of probes.csv. */
#ifndef SCENE_COLUMNS_H
#define SCENE_COLUMNS_H

#include "case/formula.h"
#include "case/scene.h"

/* The language of expressions over a run of the scene, before there is one. Release with formula_free, before the
 * scene. */
struct formula *scene_columns_plan(const struct scene *scene);

#endif
