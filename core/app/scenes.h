/* scenes.h - the scene that a command line means: a case file and the options that change it. */
#ifndef SCENES_H
#define SCENES_H

#include "app/cli.h"
#include "case/scene.h"

/* Reads `path` with --set, --variant, -o, --until and --max-steps of the command line; the last
 * two are settings of the case like any other, so that the resolved case has them. Errors have
 * been printed when this returns. */
int scenes_read(const struct cli_given *given, const char *path, struct scene **ret_scene);

/* Cells of the whole mesh. */
double scenes_cells(const struct scene *scene);

#endif
