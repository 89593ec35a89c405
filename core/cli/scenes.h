/* scenes.h - the scene that a command line means: a case file and the options that change it. */
#ifndef SCENES_H
#define SCENES_H

#include "case/scene.h"
#include "cli/cli.h"

/* Reads `path` with --set, --variant, -o, --until, --max-steps and --max-memory of the command line; --until and
 * --max-steps are settings of the case like any other, so that the resolved case has them. A coarsest level that
 * takes more than --max-memory, or is to be run and takes more than the machine has, is STATUS_CASE. Errors have been
 * printed when this returns. */
int scenes_read(const struct cli_given *given, const char *path, struct scene **ret_scene);

/* What a run takes beside the blocks of its cells, frames and messages, as a factor. */
#define SCENES_BESIDE 1.1

/* Cells of the coarsest level. */
double scenes_cells(const struct scene *scene);

/* Bytes that the blocks of so many cells take: all evolved fields three times (old, new, primitive), and once
 * or three times more where the integrator or super steps keep them. */
double scenes_bytes(const struct scene *scene, double cells);

#endif
