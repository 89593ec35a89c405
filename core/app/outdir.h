/* outdir.h - the output directory of a run: who may write there, and what an old run left. */
#ifndef OUTDIR_H
#define OUTDIR_H

#include <stdbool.h>

/* Makes the directory (and its parents). If it holds the output of a run, that is removed when
 * `overwrite`, else it is STATUS_CASE with a message that lists what is there. Files that are
 * not ours are never touched. Collective; rank 0 acts. */
int outdir_prepare(const char *path, bool overwrite);

/* Writes a text file of the run, for example case.yaml. Collective; rank 0 acts. */
int outdir_write(const char *directory, const char *name, const char *text);

#endif
